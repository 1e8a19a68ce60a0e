// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/templates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/clusters.h"
#include "motex/particles/coil_search.h"
#include "motex/particles/coils.h"
#include "motex/particles/poses.h"
#include "motex/particles/template_coils.h"

namespace motex {
namespace {

constexpr double kIsolation = 1.5;  // |distance| > 1.5 · (scale + other scale)
constexpr double kLeastPresence = 0.1;
constexpr int kMostTemplateCoils = 8;
constexpr std::size_t kEnoughFrames = 3;  // of isolated ones, for a cable to take part in clustering

/// What one cable looks like.
struct Look {
  PoseSequence shape;
  std::vector<std::vector<RelativeBase>> coils;  // of each frame
  std::size_t num_usable = 0;
};

/// Gcos and streaks are the same after half a turn: the half is chosen in which the first coils lie to the positive
/// side of u.
void choose_half(Cable& cable) {
  const BaseKind kind = cable.core.empty() ? BaseKind::kGaussian : cable.core[0].kind;
  if (kind != BaseKind::kGaborCos && kind != BaseKind::kStreak) return;
  double moment = 0;
  for (const std::vector<Base>& coil : cable.coils)
    for (std::size_t at = 0; at < cable.core.size(); ++at) {
      const RelativeBase base = relative_to(coil[at], cable.core[at], 1);
      moment += base.coefficient[0] * (base.u + 0.1 * base.v);
    }
  if (moment >= 0) return;
  for (Base& core : cable.core) core.angle += std::numbers::pi;
}

Look look_of(const Cable& cable, const std::vector<char>& isolated, int num_planes) {
  const std::size_t num = cable.core.size();
  Look out{{Matrix(static_cast<Index>(num), static_cast<Index>(kPatchSize)), isolated}, {}, 0};
  std::array<float, kPatchSize> patch{};
  for (std::size_t at = 0; at < num; ++at) {
    std::vector<RelativeBase> coils;
    for (const std::vector<Base>& coil : cable.coils)
      coils.push_back(relative_to(coil[at], cable.core[at], num_planes));
    render_moveton(cable.core[at].kind, coils, num_planes, patch.data());
    for (std::size_t i = 0; i < kPatchSize; ++i)
      out.shape.patches(static_cast<Index>(at), static_cast<Index>(i)) = static_cast<double>(patch[i]);
    out.coils.push_back(std::move(coils));
    out.num_usable += isolated[at] != 0 ? 1 : 0;
  }
  return out;
}

Eigen::RowVectorXd mean_patch(const Look& look) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(static_cast<Index>(kPatchSize));
  double num = 0;
  for (Index at = 0; at < look.shape.patches.rows(); ++at) {
    if (look.num_usable > 0 && look.shape.is_usable[static_cast<std::size_t>(at)] == 0) continue;
    sum += look.shape.patches.row(at);
    num += 1;
  }
  return sum / std::max(1.0, num);
}

/// One label a cable of `group`.
std::vector<int> species_of(const std::vector<Look>& looks, const std::vector<std::size_t>& group,
                            const LearnTemplatesOptions& options) {
  Matrix means(static_cast<Index>(group.size()), static_cast<Index>(kPatchSize));
  std::vector<Index> training;
  for (std::size_t i = 0; i < group.size(); ++i) {
    means.row(static_cast<Index>(i)) = mean_patch(looks[group[i]]);
    if (looks[group[i]].num_usable >= kEnoughFrames) training.push_back(static_cast<Index>(i));
  }
  std::vector<int> labels(group.size(), 0);
  if (training.size() < 10 || options.max_species < 2) return labels;
  Matrix points(static_cast<Index>(training.size()), means.cols());
  for (std::size_t i = 0; i < training.size(); ++i) points.row(static_cast<Index>(i)) = means.row(training[i]);
  const PrincipalAxes axes = principal_axes(points, 0.8, 2, 8);
  ChooseClustersOptions choose;
  choose.max_clusters = options.max_species;
  choose.min_silhouette = 0.5;
  choose.min_distance = 0.05;
  choose.min_share = 0.05;
  choose.seed = options.seed;
  const Clusters clusters = choose_clusters(coordinates(points, axes), choose);
  const Matrix scores = cluster_log_densities(coordinates(means, axes), clusters, true);
  for (Index i = 0; i < scores.rows(); ++i) {
    Index best = 0;
    scores.row(i).maxCoeff(&best);
    labels[static_cast<std::size_t>(i)] = static_cast<int>(best);
  }
  return labels;
}

double mean_of(const std::vector<double>& values) { return spread_of(values).mean; }

/// Colours of faint elements are noise: each counts by its strength.
Spread weighted_spread(const std::vector<double>& values, const std::vector<double>& weights) {
  double sum = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i];
    mean += weights[i] * values[i];
  }
  if (sum <= 0) return {};
  mean /= sum;
  for (std::size_t i = 0; i < values.size(); ++i) square += weights[i] * (values[i] - mean) * (values[i] - mean);
  return {mean, std::sqrt(square / sum)};
}

/// Sizes, brightness, angles and colours over the cables of a species.
void describe_cores(const std::vector<Cable>& cables, const std::vector<std::size_t>& members, int num_planes,
                    MovetonTemplate& out) {
  std::vector<double> log_scales, amplitudes, angles;
  std::array<std::vector<double>, 3> colours;
  std::vector<double> strengths;
  for (const std::size_t c : members) {
    std::vector<double> log_scale, amplitude, angle;
    std::array<double, 3> colour{};
    double strength = 0;
    for (const Base& core : cables[c].core) {
      Base grey = core;
      grey.coefficients[0] = static_cast<float>(luma_coefficient(core, num_planes));
      log_scale.push_back(std::log(core.scale));
      amplitude.push_back(peak_amplitude(grey));
      angle.push_back(is_oriented(core.kind) ? core.angle : 0);
      strength += static_cast<double>(grey.coefficients[0]);
      for (std::size_t k = 0; k < 3; ++k) colour[k] += static_cast<double>(core.coefficients[k]);
    }
    log_scales.push_back(mean_of(log_scale));
    amplitudes.push_back(mean_of(amplitude));
    angles.push_back(mean_of(angle));
    if (strength == 0) continue;
    strengths.push_back(std::abs(strength));
    for (std::size_t k = 0; k < 3; ++k) colours[k].push_back(colour[k] / strength);
  }
  out.log_scale = spread_of(log_scales);
  out.amplitude = spread_of(amplitudes);
  out.angle = spread_of(angles);
  for (std::size_t k = 0; k < 3; ++k) out.colour[k] = weighted_spread(colours[k], strengths);
}

BaseKind usual_kind(const std::vector<Cable>& cables, const std::vector<std::size_t>& members) {
  std::array<std::size_t, kNumBaseKinds> counts{};
  for (const std::size_t c : members)
    for (const Base& core : cables[c].core) ++counts[static_cast<std::size_t>(core.kind)];
  return static_cast<BaseKind>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

MovetonTemplate template_of(std::vector<Cable>& cables, const std::vector<Look>& looks,
                            const std::vector<std::size_t>& members, int num_planes,
                            const LearnTemplatesOptions& options) {
  std::vector<PoseSequence> shapes;
  for (const std::size_t c : members) shapes.push_back(looks[c].shape);
  FindPosesOptions find;
  find.max_poses = options.max_poses;
  find.seed = options.seed;
  const Poses poses = find_poses(shapes, find);
  MovetonTemplate out;
  out.pose_transitions = poses.transitions;
  out.share = static_cast<double>(members.size()) / static_cast<double>(cables.size());
  describe_cores(cables, members, num_planes, out);
  std::vector<std::vector<std::vector<RelativeBase>>> shown(static_cast<std::size_t>(poses.num()));
  double num_frames = 0;
  std::vector<double> counts(shown.size(), 0);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Look& look = looks[members[i]];
    cables[members[i]].poses = poses.num() > 1 ? poses.sequences[i] : std::vector<int>();
    for (std::size_t at = 0; at < look.coils.size(); ++at) {
      const auto pose = static_cast<std::size_t>(poses.sequences[i][at]);
      counts[pose] += 1;
      num_frames += 1;
      if (look.shape.is_usable[at] != 0 || look.num_usable == 0) shown[pose].push_back(look.coils[at]);
    }
  }
  const BaseKind kind = usual_kind(cables, members);
  for (std::size_t p = 0; p < shown.size(); ++p)
    out.poses.push_back({kind, common_coils(shown[p], num_planes, kLeastPresence, kMostTemplateCoils),
                         num_frames > 0 ? counts[p] / num_frames : 1});
  return out;
}

/// Cables whose core is oriented and others are never of one species: their patches are not comparable.
std::vector<std::vector<std::size_t>> comparable_groups(const std::vector<Cable>& cables) {
  std::vector<std::vector<std::size_t>> groups(2);
  for (std::size_t c = 0; c < cables.size(); ++c)
    if (!cables[c].core.empty()) groups[is_oriented(cables[c].core[0].kind) ? 1 : 0].push_back(c);
  return groups;
}

}  // namespace

std::vector<MovetonTemplate> learn_templates(std::vector<Cable>& cables, int num_planes,
                                             const LearnTemplatesOptions& options, const JobContext& job) {
  check_options(options);
  const std::vector<std::vector<char>> isolated = isolated_frames(cables, kIsolation);
  std::vector<Look> looks(cables.size());
  parallel_for(job.jobs, static_cast<int>(cables.size()), [&](int c) {
    job.check_cancelled();
    const auto idx = static_cast<std::size_t>(c);
    choose_half(cables[idx]);
    looks[idx] = look_of(cables[idx], isolated[idx], num_planes);
  });
  std::vector<std::vector<std::size_t>> species;
  for (const std::vector<std::size_t>& group : comparable_groups(cables)) {
    if (group.empty()) continue;
    const std::vector<int> labels = species_of(looks, group, options);
    std::vector<std::vector<std::size_t>> found(
        static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end())) + 1);
    for (std::size_t i = 0; i < group.size(); ++i) found[static_cast<std::size_t>(labels[i])].push_back(group[i]);
    for (std::vector<std::size_t>& members : found)
      if (!members.empty()) species.push_back(std::move(members));
  }
  std::stable_sort(species.begin(), species.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<MovetonTemplate> templates;
  for (const std::vector<std::size_t>& members : species) {
    job.check_cancelled();
    for (const std::size_t c : members) cables[c].species = static_cast<int>(templates.size());
    templates.push_back(template_of(cables, looks, members, num_planes, options));
  }
  return templates;
}

}  // namespace motex
