// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/sweep.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "motex/plot/charts.h"

namespace motex {
namespace {

double length_secs(const MotionTexture& model, const Instance& instance) {
  return static_cast<double>(instance.length) * model.frame_time_secs();
}

void measure_lengths(const MotionTexture& model, SweepPoint& point) {
  if (model.instances.empty()) return;
  point.min_length_secs = point.max_length_secs = length_secs(model, model.instances[0]);
  for (const Instance& instance : model.instances) {
    const double secs = length_secs(model, instance);
    point.mean_length_secs += secs / static_cast<double>(model.instances.size());
    point.min_length_secs = std::min(point.min_length_secs, secs);
    point.max_length_secs = std::max(point.max_length_secs, secs);
  }
}

/// Numbers that only this texton has.
double own_parameters(const MotionTexture& model, std::size_t texton) {
  const auto d = static_cast<double>(model.textons[texton].dynamics.state_size());
  return (model.options.common_dynamics ? 0 : 2 * d * d) + d + d * (d + 1) / 2;
}

double description_length(const MotionTexture& model, double log_likelihood, double num_frames) {
  std::vector<double> frames_of_texton(model.textons.size());
  for (const Instance& instance : model.instances)
    frames_of_texton[static_cast<std::size_t>(instance.texton)] += static_cast<double>(instance.length);
  double nats = -log_likelihood, own = 0;
  for (std::size_t i = 0; i < model.textons.size(); ++i) {
    own += own_parameters(model, i);
    nats += 0.5 * own_parameters(model, i) * std::log(std::max(frames_of_texton[i], 1.0));
  }
  nats += 0.5 * (count_parameters(model) - own) * std::log(num_frames);
  const LearnOptions& options = model.options;
  const double num_lengths = (options.max_duration - options.min_duration) / model.frame_time_secs() + 1;
  return nats + static_cast<double>(model.instances.size()) * std::log(std::max(num_lengths, 1.0));
}

SweepPoint learn_point(const HeldOutSplit& split, const LearnOptions& options, const JobContext& job) {
  LearnReport report;
  const MotionTexture model = learn_motion_texture(split.training, options, report, job.part(0, 0.9));
  const ScoreReport training = score_clips(model, split.training, job.part(0.9, 0.98));
  const ScoreReport held_out = score_clips(model, split.held_out, job.part(0.98, 1));
  SweepPoint point;
  point.threshold = report.threshold;
  point.is_auto = options.threshold == 0;
  point.num_textons = report.num_textons;
  point.num_segments = report.num_segments;
  measure_lengths(model, point);
  point.num_frames = training.num_frames;
  point.num_parameters = count_parameters(model);
  point.training_log_likelihood_per_frame = training.log_likelihood_per_frame;
  point.held_out_log_likelihood_per_frame = held_out.log_likelihood_per_frame;
  point.held_out_global_lds_log_likelihood_per_frame = held_out.global_lds_log_likelihood_per_frame;
  const double n = static_cast<double>(training.num_frames);
  point.bic = n * training.log_likelihood_per_frame - 0.5 * point.num_parameters * std::log(n);
  point.mdl = description_length(model, n * training.log_likelihood_per_frame, n);
  return point;
}

JobContext without_warnings(JobContext job) {
  job.on_warning = {};
  return job;
}

Axis threshold_axis(const std::string& unit) {
  Axis axis;
  axis.label = "threshold (" + unit + ")";
  axis.log = true;
  return axis;
}

/// Place of a point on the logarithmic axis: 0, which it cannot show, stands a step before the first that it can.
double threshold_place(const std::vector<SweepPoint>& points, const SweepPoint& point) {
  if (point.threshold > 0) return point.threshold;
  for (const SweepPoint& other : points)
    if (other.threshold > 0) return other.threshold / 3;
  return 1;
}

using Measure = double (*)(const SweepPoint&);

Series series(const std::vector<SweepPoint>& points, const std::string& name, Measure measure) {
  Series out;
  out.name = name;
  out.mark = Mark::kLineAndPoints;
  for (const SweepPoint& point : points) {
    out.x.push_back(threshold_place(points, point));
    out.y.push_back(measure(point));
  }
  return out;
}

Drawing panel(const std::vector<SweepPoint>& points, const std::string& unit, const std::string& title,
              const std::string& y_label, std::vector<Series> lines) {
  LinePlot plot;
  plot.title = title;
  plot.x_axis = threshold_axis(unit);
  plot.y_axis.label = y_label;
  plot.series = std::move(lines);
  for (const SweepPoint& point : points)
    if (point.is_auto)
      plot.x_markers.push_back({threshold_place(points, point), point.threshold > 0 ? "auto" : "auto, 0"});
  return draw(plot);
}

}  // namespace

double count_parameters(const MotionTexture& model) {
  double count = 1;  // the deviation outside the subspace
  for (const Subspace& subspace : model.subspaces) {
    const auto d = static_cast<double>(subspace.basis.cols());
    count += static_cast<double>(subspace.mean.size() + subspace.basis.size()) - d * (d + 1) / 2;
  }
  for (std::size_t i = 0; i < model.textons.size(); ++i) count += own_parameters(model, i);
  if (model.options.common_dynamics && !model.textons.empty()) {
    const auto d = static_cast<double>(model.textons[0].dynamics.state_size());
    count += 2 * d * d;
  }
  const auto num_textons = static_cast<double>(model.textons.size());
  return count + num_textons * (num_textons - 1);
}

std::vector<SweepPoint> sweep_threshold(const HeldOutSplit& split, const std::vector<double>& thresholds,
                                        const LearnOptions& options, const JobContext& job) {
  constexpr double kFactors[] = {0.25, 0.4, 0.63, 1.6, 2.5, 4};
  constexpr double kBayesFactors[] = {3, 10, 30, 100, 300, 1000};
  std::vector<double> wanted = thresholds;
  std::vector<SweepPoint> points;
  LearnOptions learn = options;
  double done = 0;
  if (wanted.empty()) {
    done = 1.0 / 7;
    learn.threshold = 0;
    points.push_back(learn_point(split, learn, job.part(0, done)));
    const bool around = points[0].threshold > 0;
    for (int i = 0; i < 6; ++i) wanted.push_back(around ? kFactors[i] * points[0].threshold : kBayesFactors[i]);
  }
  const double step = (1 - done) / static_cast<double>(wanted.size());
  for (const double threshold : wanted) {
    learn.threshold = threshold;
    const JobContext part = job.part(done, done + step);
    points.push_back(learn_point(split, learn, points.empty() ? part : without_warnings(part)));
    done += step;
  }
  std::sort(points.begin(), points.end(),
            [](const SweepPoint& a, const SweepPoint& b) { return a.threshold < b.threshold; });
  return points;
}

Drawing draw_sweep(const std::vector<SweepPoint>& points, const std::string& unit) {
  const auto lines = [&](const std::vector<std::pair<std::string, Measure>>& measures) {
    std::vector<Series> all;
    for (const auto& [name, measure] : measures) all.push_back(series(points, name, measure));
    return all;
  };
  const std::vector<Drawing> panels{
      panel(points, unit, "Textons and segments", "number",
            lines({{"textons", [](const SweepPoint& p) { return static_cast<double>(p.num_textons); }},
                   {"segments", [](const SweepPoint& p) { return static_cast<double>(p.num_segments); }}})),
      panel(points, unit, "Lengths of segments", "s",
            lines({{"longest", [](const SweepPoint& p) { return p.max_length_secs; }},
                   {"mean", [](const SweepPoint& p) { return p.mean_length_secs; }},
                   {"shortest", [](const SweepPoint& p) { return p.min_length_secs; }}})),
      panel(points, unit, "Clips not learned from", "log-likelihood, nats per frame",
            lines({{"textons", [](const SweepPoint& p) { return p.held_out_log_likelihood_per_frame; }},
                   {"one global system",
                    [](const SweepPoint& p) { return p.held_out_global_lds_log_likelihood_per_frame; }}})),
      panel(points, unit, "Fit less the cost of parameters", "nats per frame learned from",
            lines({{"BIC", [](const SweepPoint& p) { return p.bic / static_cast<double>(p.num_frames); }},
                   {"−MDL", [](const SweepPoint& p) { return -p.mdl / static_cast<double>(p.num_frames); }},
                   {"log L", [](const SweepPoint& p) { return p.training_log_likelihood_per_frame; }}}))};
  return grid(panels, 2, "Threshold of learning");
}

std::string sweep_csv(const std::vector<SweepPoint>& points) {
  std::ostringstream csv;
  csv.precision(10);
  csv << "threshold,is_auto,num_textons,num_segments,mean_length_secs,min_length_secs,max_length_secs,num_frames,"
         "num_parameters,training_log_likelihood_per_frame,held_out_log_likelihood_per_frame,"
         "held_out_global_lds_log_likelihood_per_frame,bic,mdl\n";
  for (const SweepPoint& p : points)
    csv << p.threshold << ',' << p.is_auto << ',' << p.num_textons << ',' << p.num_segments << ',' << p.mean_length_secs
        << ',' << p.min_length_secs << ',' << p.max_length_secs << ',' << p.num_frames << ',' << p.num_parameters << ','
        << p.training_log_likelihood_per_frame << ',' << p.held_out_log_likelihood_per_frame << ','
        << p.held_out_global_lds_log_likelihood_per_frame << ',' << p.bic << ',' << p.mdl << '\n';
  return csv.str();
}

}  // namespace motex
