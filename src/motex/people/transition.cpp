// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/transition.h"

#include <utility>

#include "motex/people/align_sprites.h"
#include "motex/people/field_morph.h"

namespace motex {

namespace {

/// Shapes set out and arrive without a jump of velocity or acceleration; colours follow Figure 6.
double eased(double weight) { return weight * weight * weight * (10 - 15 * weight + 6 * weight * weight); }

}  // namespace

Transition::Transition(const PeopleTexture& texture, std::vector<Frame> frames, const RenderFilmOptions& options,
                       int jobs)
    : texture_(texture), frames_(std::move(frames)), options_(options), jobs_(jobs) {
  report_.transition_frames = static_cast<int>(frames_.size());
  if (!frames_.empty()) choose();
}

PlacedSprite Transition::left(const Frame& frame) const {
  return {*frame.sprite_a, frame.a.placement, cut_off_sides(*frame.sprite_a, texture_.width, texture_.height)};
}

PlacedSprite Transition::entered(const Frame& frame) const {
  return {*frame.sprite_b, frame.b.placement, cut_off_sides(*frame.sprite_b, texture_.width, texture_.height)};
}

std::vector<FeatureLinePair> Transition::lines_of(const Frame& frame) const {
  if (options_.lines == MorphLines::kOutline) return outline_lines(left(frame), entered(frame));
  std::vector<FeatureLinePair> lines = fixed_edges(texture_, frame.a, frame.b);
  return lines.empty() ? box_edges(texture_, frame.a, frame.b) : lines;
}

Transition::Way Transition::way_of(const Frame& frame, TransitionRenderer renderer) const {
  Way way;
  if (renderer == TransitionRenderer::kFieldMorph || renderer == TransitionRenderer::kFlow) way.lines = lines_of(frame);
  if (renderer == TransitionRenderer::kFlow) way.flow = sprite_flow(left(frame), entered(frame), way.lines);
  return way;
}

/// weight: how far the shapes are on their way; dissolve: how far the colours are.
Sprite Transition::render_on(const Way& way, const Frame& frame, double weight, double dissolve) const {
  if (way.flow) return flow_morph(left(frame), entered(frame), *way.flow, weight, dissolve, jobs_);
  return field_morph(left(frame), entered(frame), way.lines, weight, dissolve, {}, jobs_);
}

void Transition::choose() {
  const Frame& middle = frames_[frames_.size() / 2];
  const auto error_of = [&](const Way& way) {
    return sprite_difference(render_on(way, middle, 0.5, 0), render_on(way, middle, 0.5, 1));
  };
  Way way = way_of(middle, TransitionRenderer::kFlow);
  report_.num_lines = static_cast<int>(way.lines.size());
  report_.flow_error = error_of(way);
  report_.flow_consistency = way.flow->consistency;
  way.flow.reset();
  report_.morph_error = error_of(way);
  report_.dissolve_error = error_of({});
  report_.renderer = options_.renderer;
  if (options_.renderer != TransitionRenderer::kAuto) return;
  report_.renderer = TransitionRenderer::kFieldMorph;
  double least = report_.morph_error;
  if (report_.flow_error < least) least = report_.flow_error, report_.renderer = TransitionRenderer::kFlow;
  if (report_.dissolve_error <= least)
    least = report_.dissolve_error, report_.renderer = TransitionRenderer::kCrossDissolve;
  if (least > options_.max_error) report_.renderer = TransitionRenderer::kHardCut;
}

Sprite Transition::render(int k) const {
  const Frame& frame = frames_[static_cast<std::size_t>(k)];
  if (report_.renderer == TransitionRenderer::kHardCut)
    return k < (static_cast<int>(frames_.size()) + 1) / 2 ? placed(*frame.sprite_a, frame.a.placement)
                                                          : placed(*frame.sprite_b, frame.b.placement);
  return render_on(way_of(frame, report_.renderer), frame, eased(frame.weight), frame.weight);
}

}  // namespace motex
