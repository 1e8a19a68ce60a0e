// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Textons stretched, varied and edited, against their examples.
#include <cmath>

#include "bench/motion_data.h"
#include "motex/motion/measures.h"
#include "motex/motion/quantile.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/texton_stretch.h"

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
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
