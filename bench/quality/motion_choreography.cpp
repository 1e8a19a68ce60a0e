// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Dances from random pose to random pose in a random number of frames: how many are found, how exactly the poses of the
// source files are met, how the dances compare with the examples that they play, and how well places, boxes, hands and
// the floor are kept.
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "bench/motion_data.h"
#include "motex/core/rng.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/choreograph.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"

namespace {

using motex::Clip;
using motex::Index;
using motex::Vector3;

constexpr int kPlain = 200, kLed = 20;

double secs_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_spread(const char* name, const std::vector<double>& values) {
  std::printf("  %-52s median %9.4g   90 %% %9.4g   worst %9.4g\n", name, quantile(values, 0.5), quantile(values, 0.9),
              quantile(values, 1));
}

class Bench {
 public:
  Bench(const motex::MotionTexture& model, const std::vector<Clip>& clips) : model_(model), clips_(clips), rng_(7) {}

  void run() {
    plain();
    led();
    around_boxes();
    reaching();
    floor();
  }

 private:
  motex::ClipFrame random_pose(Index offset) {
    for (;;) {
      const auto c = rng_.below(clips_.size());
      const auto frames = static_cast<std::uint64_t>(clips_[c].num_frames());
      motex::ClipFrame pose{model_.clip_names[c], static_cast<Index>(rng_.below(frames))};
      try {
        const Index row = motex::corpus_row(model_, pose);
        const motex::ClipFrame other{pose.clip, pose.frame + (offset == 0 ? 1 : -1)};
        if (motex::corpus_row(model_, other) == row + (offset == 0 ? 1 : -1)) return pose;
      } catch (const motex::InvalidInput&) {  // a glitch, or the end of the clip
      }
    }
  }

  motex::ChoreographyRequest random_request(Index least, Index most) {
    motex::ChoreographyRequest request;
    request.start = random_pose(0);
    request.end = random_pose(1);
    request.num_frames = least + static_cast<Index>(rng_.below(static_cast<std::uint64_t>(most - least + 1)));
    return request;
  }

  const Clip& source(const motex::ClipFrame& pose) const {
    const auto& names = model_.clip_names;
    return clips_[static_cast<std::size_t>(std::find(names.begin(), names.end(), pose.clip) - names.begin())];
  }

  /// Largest angle of a joint, tilt included, and difference of height, against a frame of a file.
  void pose_error(const Clip& dance, Index t, const motex::ClipFrame& pose, Index frame, double& angle,
                  double& height) const {
    const Clip& clip = source(pose);
    const auto& space = model_.features;
    for (const int j : space.joints)
      angle = std::max(angle, motex::angle_between(dance.rotation(t, j), clip.rotation(frame, j)));
    const auto tilt = [&](const Clip& c, Index f) {
      const motex::Quat back(Eigen::AngleAxisd(-motex::root_place(space, c, f).heading, Vector3::UnitY()));
      return motex::Quat(back * c.rotation(f, space.travelling_joint));
    };
    angle = std::max(angle, motex::angle_between(tilt(dance, t), tilt(clip, frame)));
    height = std::max(height, std::abs(dance.translation(t, space.travelling_joint).y() -
                                       clip.translation(frame, space.travelling_joint).y()));
  }

  void count_ends(const Clip& dance, const motex::ChoreographyRequest& request) {
    const Index n = dance.num_frames();
    pose_error(dance, 0, request.start, request.start.frame, angle_, height_);
    pose_error(dance, 1, request.start, request.start.frame + 1, angle_, height_);
    pose_error(dance, n - 2, request.end, request.end.frame - 1, angle_, height_);
    pose_error(dance, n - 1, request.end, request.end.frame, angle_, height_);
  }

  void count_ratios(const Clip& dance, const motex::ChoreographyReport& report) {
    std::vector<motex::ClipRange> ranges;
    for (const motex::ChoreographedTexton& played : report.played) {
      const motex::Instance& instance = model_.instances[static_cast<std::size_t>(played.instance)];
      const motex::Run& run = model_.runs[static_cast<std::size_t>(instance.run_idx)];
      ranges.push_back({run.clip_idx, run.clip_start + played.source_row - run.row, played.source_length});
    }
    try {
      const motex::CompareReport compared = motex::compare_motion(clips_, ranges, dance);
      jerk_.push_back(compared.jerk_ratio);
      contact_.push_back(compared.contact_speed_ratio);
      speed_.push_back(compared.speed_ratio);
      if (!whole_) whole_ = motex::compare_motion(clips_, dance).reference;
      sum_speed_ += compared.generated.speed * static_cast<double>(dance.num_frames());
      sum_jerk_ += compared.generated.jerk * static_cast<double>(dance.num_frames());
      sum_frames_ += static_cast<double>(dance.num_frames());
    } catch (const motex::InvalidInput&) {  // shorter than a second: nothing to compare
    }
  }

  void print_ratios() {
    print_spread("jerk / that of the examples played", jerk_);
    print_spread("contact speed / that of the examples played", contact_);
    print_spread("joint speed / that of the examples played", speed_);
    if (whole_)
      std::printf("  all frames together / the whole source: joint speed %.3f, jerk %.3f\n",
                  sum_speed_ / sum_frames_ / whole_->speed, sum_jerk_ / sum_frames_ / whole_->jerk);
    jerk_.clear(), contact_.clear(), speed_.clear();
    sum_speed_ = sum_jerk_ = sum_frames_ = 0;
  }

  /// The nearest N that the message names is feasible.
  bool nearest_works(motex::ChoreographyRequest request, const std::string& message) const {
    const std::string before = "the nearest that works is ";
    const std::size_t at = message.find(before);
    if (at == std::string::npos) return false;
    request.num_frames = std::stol(message.substr(at + before.size()));
    motex::ChoreographyReport report;
    motex::choreograph(model_, request, {}, report);
    return true;
  }

  void plain() {
    int made = 0, refused = 0, refused_well = 0;
    std::vector<double> secs, bent;
    for (int k = 0; k < kPlain; ++k) {
      const motex::ChoreographyRequest request = random_request(k % 4 == 0 ? 8 : 60, k % 4 == 0 ? 120 : 900);
      motex::ChoreographyReport report;
      const auto start = std::chrono::steady_clock::now();
      try {
        const Clip dance = motex::choreograph(model_, request, {}, report);
        secs.push_back(secs_since(start));
        ++made;
        if (dance.num_frames() != request.num_frames) throw motex::NumericalFailure("another number of frames");
        count_ends(dance, request);
        if (dance.num_frames() >= 60) count_ratios(dance, report);
        for (const auto& played : report.played) bent.push_back(std::max(played.first_distance, played.last_distance));
      } catch (const motex::InvalidInput& error) {
        ++refused;
        refused_well += nearest_works(request, error.what()) ? 1 : 0;
      }
    }
    std::printf(
        " %d requests, a quarter of them 8 ... 120 frames, the rest 60 ... 900: %d made, %d refused,\n"
        "  %d of these with a nearest N that works\n",
        kPlain, made, refused, refused_well);
    std::printf("  ends against the files: %.2g rad, %.2g units of height\n", angle_, height_);
    print_spread("bent at a joint, cm", bent);
    print_ratios();
    print_spread("seconds", secs);
  }

  void led() {
    std::vector<double> place, heading, turn, way;
    int made = 0, met = 0;
    const double metre = 100 / model_.features.cm_per_unit;
    for (int k = 0; k < kLed; ++k) {
      motex::ChoreographyRequest request = random_request(300, 700);
      request.place = motex::RootPlace{0, 0, 0};
      const auto target = [&](Index frame, double far) {
        const double angle = rng_.uniform(0, 2 * std::numbers::pi);
        return motex::RootTarget{frame, far * std::sin(angle), far * std::cos(angle),
                                 rng_.uniform(-std::numbers::pi, std::numbers::pi)};
      };
      request.at = {target(request.num_frames / 2, 0.5 * metre), target(request.num_frames - 1, metre)};
      motex::ChoreographyReport report;
      try {
        const Clip dance = motex::choreograph(model_, request, {}, report);
        ++made;
        for (const motex::RootTarget& wanted : request.at) {
          const motex::RootPlace found = motex::root_place(model_.features, dance, wanted.frame);
          place.push_back(std::hypot(found.x - wanted.x, found.z - wanted.z));
          heading.push_back(std::abs(std::remainder(found.heading - *wanted.heading, 2 * std::numbers::pi)));
          met += place.back() < 1e-6 && heading.back() < 1e-6 ? 1 : 0;
        }
        turn.push_back(report.path.largest_turn * 180 / std::numbers::pi);
        way.push_back(report.path.way);
        count_ends(dance, request);
        count_ratios(dance, report);
      } catch (const motex::InvalidInput& error) {
        std::printf("  refused: %s\n", error.what());
      }
    }
    std::printf(
        " %d requests with a place and heading half way (within 0.5 m) and at the end (1 m): %d made, %d of %d met\n",
        kLed, made, met, 2 * made);
    print_spread("distance from the place, units", place);
    print_spread("angle from the heading, rad", heading);
    print_spread("largest turn of the way, degrees", turn);
    print_spread("way / that of the examples", way);
    std::printf("  ends against the files: %.2g rad, %.2g units of height\n", angle_, height_);
    print_ratios();
  }

  void around_boxes() {
    int asked = 0, clear = 0, refused = 0;
    std::vector<double> turn;
    const double cm = 1 / model_.features.cm_per_unit;
    for (int k = 0; k < 10 * kLed && asked < kLed; ++k) {
      motex::ChoreographyRequest request = random_request(300, 700);
      request.place = motex::RootPlace{0, 0, 0};
      motex::ChoreographyReport report;
      const Clip free = motex::choreograph(model_, request, {}, report);
      const motex::RootPlace on_the_way = motex::root_place(
          model_.features, free, static_cast<Index>(rng_.below(static_cast<std::uint64_t>(free.num_frames()))));
      if (std::hypot(on_the_way.x, on_the_way.z) < 80 * cm) continue;  // it must be possible to start
      ++asked;
      const double half = 25 * cm;
      request.avoid = {{on_the_way.x - half, on_the_way.z - half, on_the_way.x + half, on_the_way.z + half}};
      try {
        const Clip dance = motex::choreograph(model_, request, {}, report);
        motex::RootPath path{motex::Vector(dance.num_frames()), motex::Vector(dance.num_frames()), {}};
        for (Index t = 0; t < dance.num_frames(); ++t) {
          const motex::RootPlace place = motex::root_place(model_.features, dance, t);
          path.x[t] = place.x, path.z[t] = place.z;
        }
        Index frame = 0;
        clear += motex::clearance(path, request.avoid, frame) >= 30 * cm ? 1 : 0;
        turn.push_back(report.path.largest_turn * 180 / std::numbers::pi);
        count_ratios(dance, report);
      } catch (const motex::InvalidInput& error) {
        ++refused;
        std::printf("  refused: %s\n", error.what());
      }
    }
    std::printf(" %d dances with a box of 50 cm put on their way: %d stay 30 cm away in every frame, %d refused\n",
                asked, clear, refused);
    print_spread("largest turn of the way, degrees", turn);
    print_ratios();
  }

  void reaching() {
    std::vector<double> before, after;
    int within = 0, asked = 0;
    const auto& skeleton = model_.features.skeleton;
    std::vector<std::string> tips;
    for (const char* name : {"lHand", "rHand", "lFoot", "rFoot", "LeftHand", "RightHand", "LeftFoot", "RightFoot"})
      if (skeleton.find(name) >= 0) tips.emplace_back(name);
    for (int k = 0; k < kLed && !tips.empty(); ++k) {
      motex::ChoreographyRequest request = random_request(200, 500);
      motex::ChoreographyReport report;
      const Clip free = motex::choreograph(model_, request, {}, report);
      motex::Pose pose;
      for (const Index frame : {request.num_frames / 3, 2 * request.num_frames / 3}) {
        motex::forward_kinematics(free, frame, pose);
        const std::string& joint = tips[rng_.below(tips.size())];
        const Vector3 way = Vector3(rng_.normal(), rng_.normal(), rng_.normal()).normalized() * rng_.uniform(5, 25);
        request.reach.push_back(
            {joint, frame, pose.positions.col(skeleton.find(joint)) + way / model_.features.cm_per_unit});
      }
      const Clip dance = motex::choreograph(model_, request, {}, report);
      for (const motex::ReachedTarget& reached : report.reached) {
        ++asked;
        before.push_back(reached.distance_before * model_.features.cm_per_unit);
        after.push_back(reached.distance_after * model_.features.cm_per_unit);
        within += after.back() <= 1 ? 1 : 0;
      }
      count_ends(dance, request);
      count_ratios(dance, report);
    }
    std::printf(" %d targets for hands and feet, 5 ... 25 cm from where they are: %d within 1 cm\n", asked, within);
    print_spread("before, cm", before);
    print_spread("after, cm", after);
    std::printf("  ends against the files: %.2g rad, %.2g units of height\n", angle_, height_);
    print_ratios();
  }

  void floor() const {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      motex::SynthesizeOptions options;
      options.seed = seed;
      options.floor_fix = false;
      motex::SynthesizeReport report;
      Clip dance = motex::synthesize_motion(model_, 10000, {}, options, report);
      const Clip before = dance;
      const motex::FloorReport floor = motex::keep_above_floor(dance, model_.feet);
      const motex::CompareReport without = motex::compare_motion(clips_, before),
                                 with = motex::compare_motion(clips_, dance);
      const double cm = model_.features.cm_per_unit;
      std::printf(
          " floor, endless dance, seed %d: frames below by > 1 mm %ld -> %ld of %ld, deepest %.2f -> %.2f cm, lift "
          "<= %.2f cm;\n  jerk %.3f -> %.3f, contact %.3f -> %.3f\n",
          static_cast<int>(seed), static_cast<long>(floor.num_below_before), static_cast<long>(floor.num_below_after),
          static_cast<long>(floor.num_frames), floor.deepest_before * cm, floor.deepest_after * cm,
          floor.largest_lift * cm, without.jerk_ratio, with.jerk_ratio, without.contact_speed_ratio,
          with.contact_speed_ratio);
    }
    Index below = 0, frames = 0;
    double deepest = 0;
    for (Clip clip : clips_) {
      const motex::FloorReport report = motex::keep_above_floor(clip, model_.feet);
      below += report.num_below_before, frames += report.num_frames;
      deepest = std::max(deepest, report.deepest_before);
    }
    std::printf(" floor, the source itself: frames below %ld of %ld, deepest %.2f cm\n", static_cast<long>(below),
                static_cast<long>(frames), deepest * model_.features.cm_per_unit);
  }

  const motex::MotionTexture& model_;
  const std::vector<Clip>& clips_;
  motex::Rng rng_;
  double angle_ = 0, height_ = 0;
  std::vector<double> jerk_, contact_, speed_;
  std::optional<motex::MotionMeasures> whole_;
  double sum_speed_ = 0, sum_jerk_ = 0, sum_frames_ = 0;
};

void measure(const std::filesystem::path& folder) {
  std::printf(
      "wanted: all made, ends <= 1e-6, places met, clear of boxes, hands within 1 cm, none below the floor;\n"
      "jerk, contact <= 1.10, speed 0.90 ... 1.10 of the examples\n");
  for (const motex::bench::Dance& dance : motex::bench::all_dances(folder)) {
    if (dance.name != "salsa" && motex::bench::all_dances(folder).size() > 1) continue;
    std::printf("%s\n", dance.name.c_str());
    motex::LearnReport report;
    const motex::MotionTexture model = motex::learn_motion_texture(dance.clips, {}, report);
    Bench(model, dance.clips).run();
  }
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
