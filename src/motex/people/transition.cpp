// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/transition.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "motex/people/align_sprites.h"
#include "motex/people/dissolve.h"
#include "motex/people/field_morph.h"
#include "motex/people/measure_silhouette.h"

namespace motex {

namespace {

/// Shapes set out and arrive without a jump of velocity or acceleration; colours follow Figure 6.
double eased(double weight) { return weight * weight * weight * (10 - 15 * weight + 6 * weight * weight); }

constexpr double kSmooth = 1;         // as sudden as the most sudden twentieth of the footage
constexpr double kMoreSudden = 1.25;  // times the smoothest: not much

/// Silhouette of the frame at that place of the film, without its moments.
Silhouette moved(const Silhouette& silhouette, const Placement& placement) {
  Silhouette out = silhouette;
  out.area *= placement.scale * placement.scale;
  out.centroid_x = placement.scale * out.centroid_x + placement.x;
  out.centroid_y = placement.scale * out.centroid_y + placement.y;
  return out;
}

}  // namespace

Transition::Transition(const PeopleTexture& texture, const SecondDifferenceScales& scales, std::vector<Frame> frames,
                       const RenderFilmOptions& options, int jobs)
    : texture_(texture), scales_(scales), frames_(std::move(frames)), options_(options), jobs_(jobs) {
  report_.transition_frames = static_cast<int>(frames_.size());
  if (frames_.empty()) return;
  measure_errors();
  report_.renderer = options_.renderer;
  if (options_.renderer == TransitionRenderer::kAuto)
    choose();
  else
    rendered_ = render_all(options_.renderer);
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

Sprite Transition::render_on(const Way& way, const Frame& frame, double weight, double dissolve) const {
  if (way.flow) return flow_morph(left(frame), entered(frame), *way.flow, weight, dissolve, jobs_);
  return field_morph(left(frame), entered(frame), way.lines, weight, dissolve, {}, jobs_);
}

Sprite Transition::render(std::size_t k, TransitionRenderer renderer) const {
  const Frame& frame = frames_[k];
  if (renderer == TransitionRenderer::kHardCut)
    return k < (frames_.size() + 1) / 2 ? placed(*frame.sprite_a, frame.a.placement)
                                        : placed(*frame.sprite_b, frame.b.placement);
  const Way way = way_of(frame, renderer);
  const double shapes = eased(frame.weight);
  if (renderer == TransitionRenderer::kCrossDissolve) return render_on(way, frame, shapes, frame.weight);
  return dissolve_where_alike(render_on(way, frame, shapes, 0), render_on(way, frame, shapes, 1), frame.weight);
}

std::vector<Sprite> Transition::render_all(TransitionRenderer renderer) const {
  std::vector<Sprite> rendered;
  for (std::size_t k = 0; k < frames_.size(); ++k) rendered.push_back(render(k, renderer));
  return rendered;
}

double Transition::smoothness_of(const std::vector<Sprite>& rendered) const {
  std::vector<Silhouette> film;
  const auto add_footage = [&](const PlacedFrame& placed_frame, int first, int last) {
    const FrameSpan& take = take_of(texture_, placed_frame.frame).frames;
    for (int frame = std::max(first, take.start); frame <= std::min(last, take.end() - 1); ++frame)
      film.push_back(moved(texture_.silhouettes[static_cast<std::size_t>(frame)], placed_frame.placement));
  };
  const PlacedFrame &first = frames_.front().a, &last = frames_.back().b;
  add_footage(first, first.frame - 2, first.frame - 1);
  for (const Sprite& sprite : rendered) film.push_back(measure_silhouette(sprite));
  add_footage(last, last.frame + 1, last.frame + 2);
  return film_smoothness(film, scales_).largest();
}

void Transition::measure_errors() {
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
}

void Transition::choose() {
  struct Candidate {
    TransitionRenderer renderer;
    double error = 0, smoothness = 0;
    std::vector<Sprite> rendered = {};
  };
  std::vector<Candidate> candidates{{TransitionRenderer::kCrossDissolve, report_.dissolve_error},
                                    {TransitionRenderer::kFieldMorph, report_.morph_error},
                                    {TransitionRenderer::kFlow, report_.flow_error}};
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.error < b.error; });
  if (candidates[0].error > options_.max_error)
    candidates.insert(candidates.begin(), {TransitionRenderer::kHardCut, candidates[0].error});
  double smoothest = std::numeric_limits<double>::infinity();
  for (Candidate& candidate : candidates) {
    candidate.rendered = render_all(candidate.renderer);
    candidate.smoothness = smoothness_of(candidate.rendered);
    smoothest = std::min(smoothest, candidate.smoothness);
    if (smoothest == candidates[0].smoothness && smoothest <= kSmooth) break;  // the best is smooth: no need to compare
  }
  const double limit = std::max(kSmooth, kMoreSudden * smoothest);
  Candidate& chosen = *std::find_if(candidates.begin(), candidates.end(),
                                    [&](const Candidate& candidate) { return candidate.smoothness <= limit; });
  report_.renderer = chosen.renderer;
  rendered_ = std::move(chosen.rendered);
}

}  // namespace motex
