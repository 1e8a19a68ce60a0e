// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "motex/particles/moveton_frame.h"
#include "motex/particles/synthesize.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// Changes made by hand to single movetons.
struct MovetonEdits {
  struct Insertion {
    std::int64_t frame = 0;
    InsertedElement element;
  };
  struct Displacement {
    std::int64_t track = 0;
    double dx = 0, dy = 0;  ///< pixels, for its whole life
  };
  std::vector<Insertion> insertions;
  std::vector<Displacement> displacements;
  std::vector<std::int64_t> removals;  ///< tracks

  bool empty() const { return insertions.empty() && displacements.empty() && removals.empty(); }
};

/// Inserted elements that are given no number get this one and the following.
constexpr std::int64_t kFirstInsertedTrack = 1'000'000'000;

/// The learned movetons as they were tracked, track = index of the cable. It ends with the clip.
class LearnedMovetons : public MovetonSource {
 public:
  /// The model must outlive it.
  explicit LearnedMovetons(const TexturedMotion& model) : model_(model) {}
  bool next_frame(MovetonFrame& frame) override;

 private:
  const TexturedMotion& model_;
  std::int64_t frame_ = 0;
};

/// Another source with edits. Inserted elements move by the model's dynamics as CableSynthesizer has them.
class EditedMovetons : public MovetonSource {
 public:
  /// source, model and what options point to must outlive it. Throws InvalidInput: a species that is not there, a
  /// number that is not finite, a frame before 0, a track moved or inserted twice.
  EditedMovetons(MovetonSource& source, MovetonEdits edits, const TexturedMotion& model,
                 const SynthesizeParticlesOptions& options);
  bool next_frame(MovetonFrame& frame) override;

  /// Tracks to be moved or removed that have not been seen so far.
  std::vector<std::int64_t> unseen() const { return {unseen_.begin(), unseen_.end()}; }

 private:
  void append(const MovetonFrame& from, MovetonFrame& to);

  MovetonSource& source_;
  MovetonEdits edits_;
  std::set<std::int64_t> removed_, unseen_;
  std::map<std::int64_t, std::pair<double, double>> moved_;
  std::unique_ptr<CableSynthesizer> inserted_;
  MovetonFrame source_frame_, inserted_frame_;
  std::int64_t frame_ = 0;
};

}  // namespace motex
