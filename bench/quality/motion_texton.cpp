// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Textons stretched, varied and edited, against their examples.
#include <cmath>
#include <numbers>

#include "bench/motion_data.h"
#include "motex/core/quantile.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/texton_edit.h"
#include "motex/motion_texture/texton_stretch.h"
#include "motex/motion_texture/texton_vary.h"

namespace {

using motex::Index;

constexpr int kEvery = 9;  // of the examples

struct Scores {
  std::vector<double> speed, jerk, contact, jump, cut, gain;
  int num_within = 0;
};

void print_row(const std::string& name, const Scores& s) {
  const auto q = [](const std::vector<double>& values, double p) {
    return values.empty() ? NAN : motex::quantile(values, p);
  };
  std::printf("  %-14s %4zu  %5.1f %%  %5.3f %5.3f %5.3f  %6.3f %6.3f  %6.3f %6.3f  %6.3f %6.3f %6.1f %5.2f %5.2f\n",
              name.c_str(), s.speed.size(), 100.0 * s.num_within / static_cast<double>(s.speed.size()), q(s.speed, 0),
              q(s.speed, 0.5), q(s.speed, 1), q(s.jerk, 0.5), q(s.jerk, 0.9), q(s.contact, 0.5), q(s.contact, 0.9),
              q(s.jump, 0.5), q(s.jump, 0.9), q(s.cut, 0.9), q(s.gain, 0.1), q(s.gain, 0.9));
}

void stretch_all(const motex::MotionTexture& model, motex::StretchMethod method, const char* name) {
  std::printf(" %s\n", name);
  for (const double factor : {0.5, 0.67, 0.8, 1.0, 1.25, 1.48, 2.0}) {
    Scores scores;
    for (int i = 0; i < static_cast<int>(model.instances.size()); i += kEvery) {
      const auto length = static_cast<double>(model.instances[static_cast<std::size_t>(i)].length);
      motex::StretchOptions options;
      options.method = method;
      motex::StretchReport report;
      const motex::Clip clip = motex::stretch_texton(model, i, std::lround(factor * length), options, report);
      scores.speed.push_back(report.speed_ratio);
      scores.num_within += std::abs(report.speed_ratio - 1) <= 0.05;
      scores.cut.push_back(report.largest_cut);
      scores.gain.push_back(report.gain);
      const motex::Clip example = motex::example_clip(model, i);
      if (clip.num_frames() < 61 || example.num_frames() < 61) continue;
      const motex::CompareReport compared = motex::compare_motion({&example, 1}, clip);
      scores.jerk.push_back(compared.jerk_ratio);
      scores.contact.push_back(compared.contact_speed_ratio);
      scores.jump.push_back(compared.pose_jump_ratio);
    }
    char label[32];
    std::snprintf(label, sizeof label, "x %.2f", factor);
    print_row(label, scores);
  }
}

/// Edits of one joint by that many degrees, at a quarter, a half and three quarters of the texton.
struct EditScores {
  std::vector<double> survival, others, ends, jerk, strain, speed;
  int num_warned = 0;
};

double largest_turn(const motex::Clip& a, const motex::Clip& b, Index frame, int but_joint = -1) {
  double largest = 0;
  for (int j = 0; j < a.skeleton.num_joints(); ++j)
    if (j != but_joint) largest = std::max(largest, motex::angle_between(a.rotation(frame, j), b.rotation(frame, j)));
  return largest;
}

/// Largest turn of the change from one frame to the next, degrees.
double quickest_change(const motex::Clip& base, const motex::Clip& edited, int joint) {
  double quickest = 0;
  for (Index t = 1; t < base.num_frames(); ++t) {
    const motex::Quat before = edited.rotation(t - 1, joint) * base.rotation(t - 1, joint).conjugate();
    const motex::Quat now = edited.rotation(t, joint) * base.rotation(t, joint).conjugate();
    quickest = std::max(quickest, motex::angle_between(before, now));
  }
  return quickest * 180 / std::numbers::pi;
}

void edit_once(const motex::MotionTexture& model, int instance, int joint, double degrees, double where,
               const motex::Clip& base, EditScores& scores) {
  const double angle = degrees * std::numbers::pi / 180;
  motex::PoseEdit edit;
  edit.frame = static_cast<Index>(where * static_cast<double>(base.num_frames()));
  edit.joint = joint;
  edit.rotation = motex::exp_map(angle * motex::Vector3(1, 1, 1) / std::sqrt(3.0));
  motex::EditOptions options;
  options.foot_fix = false;
  motex::EditReport report;
  const motex::Clip clip = motex::edit_texton(model, instance, {&edit, 1}, options, report);
  const motex::Quat wanted = edit.rotation * base.rotation(edit.frame, joint);
  scores.survival.push_back(1 - motex::angle_between(clip.rotation(edit.frame, joint), wanted) / angle);
  double others = 0, ends = 0;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    others = std::max(others, largest_turn(base, clip, t, joint) / angle);
    if (t < 2 || t >= clip.num_frames() - 2) ends = std::max(ends, largest_turn(base, clip, t));
  }
  scores.others.push_back(others);
  scores.ends.push_back(ends);
  scores.strain.push_back(report.parts.at(0).strain);
  scores.num_warned += report.parts[0].strain > 5;
  scores.speed.push_back(quickest_change(base, clip, joint));
  if (base.num_frames() >= 61) scores.jerk.push_back(motex::compare_motion({&base, 1}, clip).jerk_ratio);
}

void edit_all(const motex::MotionTexture& model) {
  std::printf(" edits of every second joint of every %dth example, at 1/4, 1/2, 3/4 of it\n", 6 * kEvery);
  std::printf(
      "  size      num  survives: least %%  others move: most %%  ends: most rad  strain: median, most  warned %%"
      "  quickest deg/frame: median, most  jerk: median, most\n");
  for (const double degrees : {10.0, 30.0, 60.0, 120.0}) {
    EditScores s;
    for (int i = 0; i < static_cast<int>(model.instances.size()); i += 6 * kEvery) {
      motex::EditOptions options;
      options.foot_fix = false;
      motex::EditReport report;
      const motex::Clip base = motex::edit_texton(model, i, {}, options, report);
      for (std::size_t k = 0; k < model.features.joints.size(); k += 2)
        for (const double where : {0.25, 0.5, 0.75})
          edit_once(model, i, model.features.joints[k], degrees, where, base, s);
    }
    const auto q = [](const std::vector<double>& values, double p) { return motex::quantile(values, p); };
    std::printf("  %3.0f deg %5zu  %12.6f  %12.6f  %12.2e  %8.2f %6.2f  %8.1f  %8.2f %6.2f  %8.3f %6.3f\n", degrees,
                s.survival.size(), 100 * q(s.survival, 0), 100 * q(s.others, 1), q(s.ends, 1), q(s.strain, 0.5),
                q(s.strain, 1), 100.0 * s.num_warned / static_cast<double>(s.survival.size()), q(s.speed, 0.5),
                q(s.speed, 1), q(s.jerk, 0.5), q(s.jerk, 1));
  }
}

void vary_all(const motex::MotionTexture& model) {
  std::printf(" variants of every %dth example\n", kEvery);
  std::printf("  noise   cm: mean, most   speed: least, median, most   jerk: median, 90 %%\n");
  for (const double noise : {0.2, 0.4, 0.6, 1.0}) {
    std::vector<double> mean, most, speed, jerk;
    for (int i = 0; i < static_cast<int>(model.instances.size()); i += kEvery) {
      motex::VaryOptions options;
      options.noise = noise;
      motex::VaryReport report;
      const motex::Clip clip = motex::vary_texton(model, i, options, report), example = motex::example_clip(model, i);
      mean.push_back(report.mean_distance);
      most.push_back(report.largest_distance);
      speed.push_back(report.speed_ratio);
      if (clip.num_frames() >= 61) jerk.push_back(motex::compare_motion({&example, 1}, clip).jerk_ratio);
    }
    const auto q = [](const std::vector<double>& values, double p) { return motex::quantile(values, p); };
    std::printf("  %4.1f   %6.1f %6.1f   %6.3f %6.3f %6.3f   %6.3f %6.3f\n", noise, q(mean, 0.5), q(most, 0.5),
                q(speed, 0), q(speed, 0.5), q(speed, 1), q(jerk, 0.5), q(jerk, 0.9));
  }
}

void measure(const std::filesystem::path& folder) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  motex::LearnReport report;
  const motex::MotionTexture model = motex::learn_motion_texture(dance.clips, {}, report);
  std::printf("%s: every %dth of %zu examples\n", dance.name.c_str(), kEvery, model.instances.size());
  std::printf(
      "  length         num  within   speed: least, median, most  jerk: median, 90 %%  contact  jump  cut: 90 %% cm  "
      "gain: 10 %%, 90 %%\n");
  stretch_all(model, motex::StretchMethod::kRevisit, "revisit (default)");
  stretch_all(model, motex::StretchMethod::kWarp, "linear warp");
  stretch_all(model, motex::StretchMethod::kWhite, "white noise");
  vary_all(model);
  edit_all(model);
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
