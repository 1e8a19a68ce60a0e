// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/transition.h"

#include <utility>

#include "motex/people/align_sprites.h"
#include "motex/people/field_morph.h"
#include "motex/people/flow_warp.h"

namespace motex {

namespace {

/// Shapes set out and arrive gently, so that velocities do not jump; colours follow Figure 6.
double eased(double weight) { return weight * weight * (3 - 2 * weight); }

}  // namespace

Transition::Transition(const PeopleTexture& texture, std::vector<Frame> frames, const RenderFilmOptions& options,
                       int jobs)
    : texture_(texture), frames_(std::move(frames)), options_(options), jobs_(jobs) {
  report_.transition_frames = static_cast<int>(frames_.size());
  if (!frames_.empty()) choose();
}

std::vector<FeatureLinePair> Transition::lines_of(const Frame& frame) const {
  std::vector<FeatureLinePair> lines = fixed_edges(texture_, frame.a, frame.b);
  if (options_.lines == MorphLines::kEdges) return lines.empty() ? box_edges(texture_, frame.a, frame.b) : lines;
  lines.clear();
  for (const FeatureLinePair& pair :
       outline_lines({*frame.sprite_a, frame.a.placement}, {*frame.sprite_b, frame.b.placement}))
    lines.push_back(pair);
  return lines;
}

/// weight: how far the shapes are on their way; dissolve: how far the colours are.
Sprite Transition::render_with(TransitionRenderer renderer, const Frame& frame, double weight, double dissolve) const {
  const PlacedSprite a{*frame.sprite_a, frame.a.placement}, b{*frame.sprite_b, frame.b.placement};
  std::vector<FeatureLinePair> lines;
  if (renderer != TransitionRenderer::kCrossDissolve) lines = lines_of(frame);
  if (renderer == TransitionRenderer::kFlow) return flow_morph(a, b, sprite_flow(a, b, lines), weight, dissolve, jobs_);
  return field_morph(a, b, lines, weight, dissolve, {}, jobs_);
}

double Transition::error_of(TransitionRenderer renderer) const {
  const Frame& middle = frames_[frames_.size() / 2];
  return sprite_difference(render_with(renderer, middle, 0.5, 0), render_with(renderer, middle, 0.5, 1));
}

void Transition::choose() {
  report_.num_lines = static_cast<int>(lines_of(frames_[frames_.size() / 2]).size());
  report_.dissolve_error = error_of(TransitionRenderer::kCrossDissolve);
  report_.morph_error = error_of(TransitionRenderer::kFieldMorph);
  report_.flow_error = error_of(TransitionRenderer::kFlow);
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
  return render_with(report_.renderer, frame, eased(frame.weight), frame.weight);
}

}  // namespace motex
