// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/edit.h"

#include <cmath>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

void check(const MovetonEdits& edits) {
  std::set<std::int64_t> moved, inserted;
  for (const MovetonEdits::Displacement& edit : edits.displacements) {
    if (!std::isfinite(edit.dx) || !std::isfinite(edit.dy))
      throw InvalidInput("track " + std::to_string(edit.track) + " is to be moved by numbers that are not finite");
    if (!moved.insert(edit.track).second)
      throw InvalidInput("track " + std::to_string(edit.track) + " is to be moved twice");
  }
  for (const MovetonEdits::Insertion& edit : edits.insertions) {
    const InsertedElement& element = edit.element;
    if (edit.frame < 0) throw InvalidInput("an element is to be inserted in a frame before 0");
    for (const double number : {element.x, element.y, element.vx, element.vy})
      if (!std::isfinite(number) || std::abs(number) > 1e6)
        throw InvalidInput("an element is to be inserted at a place or velocity that is not finite");
    if (!inserted.insert(element.track).second)
      throw InvalidInput("two inserted elements have the track number " + std::to_string(element.track));
  }
}

}  // namespace

bool LearnedMovetons::next_frame(MovetonFrame& frame) {
  if (frame_ >= model_.num_frames) return false;
  frame.clear();
  frame.frame = frame_;
  for (std::size_t k = 0; k < model_.cables.size(); ++k) {
    const Cable& cable = model_.cables[k];
    if (!cable.covers(frame_)) continue;
    const auto at = static_cast<std::size_t>(frame_ - cable.first_frame);
    Moveton moveton;
    moveton.track = static_cast<std::int64_t>(k);
    moveton.species = cable.species;
    moveton.pose = cable.poses.empty() ? 0 : cable.poses[at];
    if (cable.core.size() > 1) {
      const std::size_t to = std::max<std::size_t>(at, 1);
      moveton.vx = cable.core[to].x - cable.core[to - 1].x;
      moveton.vy = cable.core[to].y - cable.core[to - 1].y;
    }
    moveton.first_base = frame.bases.size();
    moveton.num_bases = 1 + cable.coils.size();
    frame.bases.push_back(cable.core[at]);
    for (const std::vector<Base>& coil : cable.coils) frame.bases.push_back(coil[at]);
    frame.movetons.push_back(moveton);
  }
  ++frame_;
  return true;
}

EditedMovetons::EditedMovetons(MovetonSource& source, MovetonEdits edits, const TexturedMotion& model,
                               const SynthesizeParticlesOptions& options)
    : source_(source), edits_(std::move(edits)), removed_(edits_.removals.begin(), edits_.removals.end()) {
  check(edits_);
  unseen_ = removed_;
  for (const MovetonEdits::Displacement& edit : edits_.displacements) {
    moved_[edit.track] = {edit.dx, edit.dy};
    unseen_.insert(edit.track);
  }
  if (edits_.insertions.empty()) return;
  SynthesizeParticlesOptions alone = options;
  alone.rate = 0;
  alone.loop = false;
  inserted_ = std::make_unique<CableSynthesizer>(model, alone);
  for (const MovetonEdits::Insertion& edit : edits_.insertions) inserted_->check(edit.element);
}

void EditedMovetons::append(const MovetonFrame& from, MovetonFrame& to) {
  for (const Moveton& moveton : from.movetons) {
    unseen_.erase(moveton.track);
    if (removed_.contains(moveton.track)) continue;
    const std::span<const Base> bases = from.bases_of(moveton);
    to.movetons.push_back(moveton);
    to.movetons.back().first_base = to.bases.size();
    to.bases.insert(to.bases.end(), bases.begin(), bases.end());
    const auto found = moved_.find(moveton.track);
    if (found == moved_.end()) continue;
    for (std::size_t k = to.movetons.back().first_base; k < to.bases.size(); ++k) {
      to.bases[k].x += found->second.first;
      to.bases[k].y += found->second.second;
    }
  }
}

bool EditedMovetons::next_frame(MovetonFrame& frame) {
  if (!source_.next_frame(source_frame_)) return false;
  frame.clear();
  frame.frame = source_frame_.frame;
  append(source_frame_, frame);
  if (inserted_ != nullptr) {
    for (const MovetonEdits::Insertion& edit : edits_.insertions)
      if (edit.frame == frame_) inserted_->insert(edit.element);
    inserted_->next_frame(inserted_frame_);
    append(inserted_frame_, frame);
  }
  ++frame_;
  return true;
}

}  // namespace motex
