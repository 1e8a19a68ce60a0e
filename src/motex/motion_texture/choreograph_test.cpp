// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/choreograph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion_texture/choreography_plan.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

const std::vector<Clip>& clips() { return sample_clips(); }
const MotionTexture& model() { return sample_model(); }

ChoreographyRequest request(Index frames, Index start = 130, Index end = 310) {
  ChoreographyRequest out;
  out.start = {"walk_0.bvh", start};
  out.end = {"walk_2", end};
  out.num_frames = frames;
  return out;
}

/// Features of output frame t, encoded anew, against those of a frame of a clip: height, tilt and joints, in cm.
double pose_error(const Clip& dance, Index t, const std::string& clip, Index frame) {
  const FrameMatrix found = encode(model().features, dance);
  const Index row = corpus_row(model(), {clip, frame});
  const Vector difference = (found.row(t) - model().corpus.row(row).cast<double>()).transpose();
  double largest = std::abs(difference[2]);
  for (Index c = 4; c < difference.size(); ++c)
    largest = std::max(largest, std::abs(difference[c]) / model().features.weights[c]);
  return largest;
}

std::string message_of(const ChoreographyRequest& wanted, const ChoreographyOptions& options = {}) {
  ChoreographyReport report;
  try {
    choreograph(model(), wanted, options, report);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Choreograph, WrongRequestsAreNamed) {
  ChoreographyRequest wanted = request(200);
  wanted.start.clip = "run.bvh";
  EXPECT_TRUE(contains(message_of(wanted), "no clip run.bvh; it has walk_0.bvh")) << message_of(wanted);
  EXPECT_TRUE(contains(message_of(request(200, 500)), "walk_0.bvh@500: the clip has frames 0 … 499"));
  EXPECT_TRUE(contains(message_of(request(200, -1)), "walk_0.bvh@-1"));
  EXPECT_TRUE(contains(message_of(request(200, 499)), "follows it"));
  EXPECT_TRUE(contains(message_of(request(200, 130, 0)), "precedes it"));
  wanted.start.clip = "walk_0.npz";
  EXPECT_EQ(message_of(wanted), "") << "extensions do not count where names differ without them";
  EXPECT_NE(message_of(request(1)), "");
  EXPECT_NE(message_of(request(-5)), "");
  ChoreographyOptions options;
  options.stretch = 2;
  EXPECT_NE(message_of(request(200), options), "");
  wanted = request(400);
  wanted.via = {{{"walk_1", 100}, 398}};
  EXPECT_TRUE(contains(message_of(wanted), "walk_1@100: frame 398 is not")) << message_of(wanted);
  wanted.via = {{{"walk_1", 100}, 200}, {{"walk_1", 150}, 150}};
  EXPECT_TRUE(contains(message_of(wanted), "walk_1@150: frame 150 is not")) << message_of(wanted);
}

TEST(Choreograph, AFrameThatWasLeftOutNamesTheNearest) {
  std::vector<Clip> some = walking_clips(3, 400);
  for (Index t = 200; t < 203; ++t)
    some[0].set_translation(t, 0, some[0].translation(t, 0) + Vector3(0, 90.0 * static_cast<double>(t - 198), 0));
  LearnOptions options;
  options.state_size = 6;
  LearnReport learned;
  const MotionTexture with_gap = learn_motion_texture(some, options, learned);
  ASSERT_GT(learned.num_glitch_frames, 0);
  std::string message;
  try {
    corpus_row(with_gap, {"walk_0.bvh", 201});
  } catch (const InvalidInput& error) {
    message = error.what();
  }
  EXPECT_TRUE(contains(message, "walk_0.bvh@201: this frame was left out")) << message;
  EXPECT_TRUE(contains(message, "the nearest that was not is ")) << message;
}

TEST(Choreograph, HasExactlyTheFramesAskedFor) {
  ChoreographyOptions options;
  options.foot_fix = options.floor_fix = false;
  for (Index n = 130; n < 700; n += n < 200 ? 1 : 37) {
    ChoreographyReport report;
    const Clip dance = choreograph(model(), request(n), options, report);
    ASSERT_EQ(dance.num_frames(), n);
    check_clip(dance);
    Index sum = 0;
    for (const ChoreographedTexton& played : report.played) {
      EXPECT_EQ(played.start, sum);
      sum += played.length - 2;
      EXPECT_LE(static_cast<double>(played.length), 1.15 * static_cast<double>(played.source_length) + 1e-9);
      EXPECT_GE(static_cast<double>(played.length), static_cast<double>(played.source_length) / 1.15 - 1e-9);
    }
    EXPECT_EQ(sum + 2, n);
  }
}

TEST(Choreograph, MeetsTheFirstAndLastTwoFrames) {
  for (const bool foot_fix : {false, true})
    for (const NoiseSource source : {NoiseSource::kReplay, NoiseSource::kWhite})
      for (const Index n : {150, 320, 611}) {
        ChoreographyOptions options;
        options.foot_fix = foot_fix;
        options.noise_source = source;
        ChoreographyReport report;
        const Clip dance = choreograph(model(), request(n), options, report);
        EXPECT_LT(pose_error(dance, 0, "walk_0.bvh", 130), 1e-6);
        EXPECT_LT(pose_error(dance, 1, "walk_0.bvh", 131), 1e-6);
        EXPECT_LT(pose_error(dance, n - 2, "walk_2.bvh", 309), 1e-6);
        EXPECT_LT(pose_error(dance, n - 1, "walk_2.bvh", 310), 1e-6);
      }
}

TEST(Choreograph, MeetsAnyPoseOfTheModel) {
  ChoreographyOptions options;
  options.foot_fix = options.floor_fix = false;
  for (Index start = 0; start <= 498; start += 83)
    for (Index end = 1; end <= 499; end += 83) {
      ChoreographyReport report;
      const Clip dance = choreograph(model(), request(260, start, end), options, report);
      EXPECT_LT(pose_error(dance, 0, "walk_0.bvh", start), 1e-6);
      EXPECT_LT(pose_error(dance, 259, "walk_2.bvh", end), 1e-6);
    }
}

TEST(Choreograph, PassesThroughPosesOnTheWay) {
  ChoreographyRequest wanted = request(700);
  wanted.via = {{{"walk_1.bvh", 222}, 250}, {{"walk_3.bvh", 77}, 480}};
  ChoreographyReport report;
  const Clip dance = choreograph(model(), wanted, {}, report);
  EXPECT_EQ(dance.num_frames(), 700);
  EXPECT_LT(pose_error(dance, 250, "walk_1.bvh", 222), 1e-6);
  EXPECT_LT(pose_error(dance, 251, "walk_1.bvh", 223), 1e-6);
  EXPECT_LT(pose_error(dance, 480, "walk_3.bvh", 77), 1e-6);
  EXPECT_LT(pose_error(dance, 481, "walk_3.bvh", 78), 1e-6);
  EXPECT_LT(pose_error(dance, 699, "walk_2.bvh", 310), 1e-6);
}

TEST(Choreograph, AStretchOfTheSourceIsTheLikeliestDanceBetweenItsEnds) {
  ChoreographyRequest wanted = request(221, 100, 320);
  wanted.end.clip = "walk_0.bvh";
  ChoreographyOptions options;
  options.foot_fix = options.floor_fix = false;
  options.noise = 1e-9;
  options.lively = false;
  ChoreographyReport report;
  const Clip dance = choreograph(model(), wanted, options, report);
  EXPECT_LT(report.start_distance + report.end_distance, 1e-6);
  EXPECT_LT((dance.rotations - slice(clips()[0], 100, 221).rotations).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((dance.translations - slice(clips()[0], 100, 221).translations).cwiseAbs().maxCoeff(), 0.05);
}

TEST(Choreograph, TheSourceSlowerOrFasterGoesTheSameWay) {
  const RootPlace from = root_place(model().features, clips()[0], 100),
                  to = root_place(model().features, clips()[0], 320);
  const double way = std::hypot(to.x - from.x, to.z - from.z);
  ASSERT_GT(way, 100);
  for (const Index n : {205, 240}) {
    ChoreographyRequest wanted = request(n, 100, 320);
    wanted.end.clip = "walk_0.bvh";
    ChoreographyOptions options;
    options.foot_fix = options.floor_fix = false;
    options.noise = 1e-9;
    options.lively = false;
    ChoreographyReport report;
    const Clip dance = choreograph(model(), wanted, options, report);
    const RootPlace end = root_place(model().features, dance, n - 1);
    EXPECT_LT(std::hypot(end.x - to.x, end.z - to.z), 0.01 * way) << n;
  }
}

TEST(Choreograph, WithoutAWayTheNearestLengthIsNamedAndWorks) {
  const std::string message = message_of(request(5));
  const std::string before = "the nearest that works is ";
  ASSERT_TRUE(contains(message, before)) << message;
  const Index nearest = std::stol(message.substr(message.find(before) + before.size()));
  EXPECT_GT(nearest, 5);
  for (Index n = 5; n < nearest; ++n) EXPECT_NE(message_of(request(n)), "") << n;
  EXPECT_EQ(message_of(request(nearest)), "");
}

TEST(Choreograph, GoesBetweenPosesThatAreNotInTheModel) {
  const std::vector<Clip> others = walking_clips(6, 300);
  const FeatureSpace& space = model().features;
  ChoreographyRequest wanted = request(240);
  wanted.first_two = pose_pair(space, others[4], 111);
  wanted.last_two = pose_pair(space, others[5], 0);
  ChoreographyReport report;
  const Clip dance = choreograph(model(), wanted, {}, report);
  ASSERT_EQ(dance.num_frames(), 240);
  const auto difference = [&](Index t, const Clip& other, Index u) {
    double largest = std::abs(dance.translation(t, 0).y() - other.translation(u, 0).y());
    for (int j = 1; j < dance.skeleton.num_joints(); ++j)
      largest = std::max(largest, angle_between(dance.rotation(t, j), other.rotation(u, j)));
    return largest;
  };
  EXPECT_LT(difference(0, others[4], 111), 1e-7);
  EXPECT_LT(difference(1, others[4], 112), 1e-7);
  EXPECT_LT(difference(238, others[5], 0), 1e-7);
  EXPECT_LT(difference(239, others[5], 1), 1e-7);
  EXPECT_LT((dance.translation(0, 0) - others[4].translation(111, 0)).norm(), 1e-9) << "stands where it stood";
  EXPECT_LT(angle_between(dance.rotation(0, 0), others[4].rotation(111, 0)), 1e-7);
  wanted.last_two->features.conservativeResize(1, space.size());
  EXPECT_TRUE(contains(message_of(wanted), "2 finite rows"));
  EXPECT_THROW(pose_pair(space, others[4], 299), InvalidInput);
}

TEST(Choreograph, EndsAreThoseOfTheSourceFile) {
  for (const Index n : {150, 320}) {
    ChoreographyReport report;
    const Clip dance = choreograph(model(), request(n), {}, report);
    const auto height_error = [&](Index t, const Clip& clip, Index u) {
      return std::abs(dance.translation(t, 0).y() - clip.translation(u, 0).y());
    };
    EXPECT_LT(height_error(0, clips()[0], 130), 1e-9);
    EXPECT_LT(height_error(1, clips()[0], 131), 1e-9);
    EXPECT_LT(height_error(n - 2, clips()[2], 309), 1e-9);
    EXPECT_LT(height_error(n - 1, clips()[2], 310), 1e-9);
    for (int j = 1; j < dance.skeleton.num_joints(); ++j) {
      EXPECT_LT(angle_between(dance.rotation(0, j), clips()[0].rotation(130, j)), 1e-6);
      EXPECT_LT(angle_between(dance.rotation(n - 1, j), clips()[2].rotation(310, j)), 1e-6);
    }
  }
}

TEST(Choreograph, StandsWhereItIsPut) {
  ChoreographyRequest wanted = request(200);
  wanted.place = RootPlace{12, -7, 1.5};
  ChoreographyReport report;
  const Clip dance = choreograph(model(), wanted, {}, report);
  const RootPlace place = root_place(model().features, dance, 0);
  EXPECT_NEAR(place.x, 12, 1e-9);
  EXPECT_NEAR(place.z, -7, 1e-9);
  EXPECT_NEAR(place.heading, 1.5, 1e-9);
  wanted.place.reset();
  const Clip home = choreograph(model(), wanted, {}, report);
  const RootPlace found = root_place(model().features, home, 0), source = root_place(model().features, clips()[0], 130);
  EXPECT_NEAR(found.x, source.x, 0.02);
  EXPECT_NEAR(found.z, source.z, 0.02);
  EXPECT_NEAR(std::remainder(found.heading - source.heading, 2 * 3.14159265358979), 0, 1e-3);
}

TEST(Choreograph, IsThereAtThatFrameFacingThatWay) {
  ChoreographyRequest wanted = request(480);
  wanted.place = RootPlace{0, 0, 0};
  wanted.at = {{220, 100, 250, {}}, {479, -50, 480, 0.9}};
  ChoreographyReport report;
  const Clip dance = choreograph(model(), wanted, {}, report);
  for (const RootTarget& target : wanted.at) {
    const RootPlace found = root_place(model().features, dance, target.frame);
    EXPECT_NEAR(found.x, target.x, 1e-6);
    EXPECT_NEAR(found.z, target.z, 1e-6);
    if (target.heading) {
      EXPECT_NEAR(std::remainder(found.heading - *target.heading, 2 * 3.14159265358979), 0, 1e-9);
    }
  }
  EXPECT_GT(report.path.cost, 0);
  EXPECT_LT(pose_error(dance, 0, "walk_0.bvh", 130), 1e-6);
  EXPECT_LT(pose_error(dance, 479, "walk_2.bvh", 310), 1e-6);
  wanted.at[0].frame = 480;
  EXPECT_TRUE(contains(message_of(wanted), "frame 480")) << message_of(wanted);
}

TEST(Choreograph, GoesAroundBoxes) {
  ChoreographyRequest wanted = request(480);
  wanted.place = RootPlace{0, 0, 0};
  ChoreographyReport report;
  const Clip free = choreograph(model(), wanted, {}, report);
  const RootPlace middle = root_place(model().features, free, 240);
  wanted.avoid = {{middle.x - 15, middle.z - 15, middle.x + 15, middle.z + 15}};
  const Clip dance = choreograph(model(), wanted, {}, report);
  const auto clearance_of = [&](const Clip& clip) {
    RootPath path{Vector(480), Vector(480), {}};
    for (Index t = 0; t < 480; ++t) {
      const RootPlace place = root_place(model().features, clip, t);
      path.x[t] = place.x, path.z[t] = place.z;
    }
    Index frame = 0;
    return clearance(path, wanted.avoid, frame);
  };
  ASSERT_LT(clearance_of(free), -10);
  EXPECT_GE(clearance_of(dance), 30);
  EXPECT_LT(pose_error(dance, 479, "walk_2.bvh", 310), 1e-6);
  wanted.avoid = {{-10, -10, 10, 10}};
  EXPECT_TRUE(contains(message_of(wanted), "the start lies inside the box -10,-10,10,10")) << message_of(wanted);
  wanted.avoid = {{-1e4, 45, 1e4, 65}, {-1e4, -65, 1e4, -45}, {45, -1e4, 65, 1e4}, {-65, -1e4, -45, 1e4}};
  EXPECT_TRUE(contains(message_of(wanted), "no way around the box")) << message_of(wanted);
}

TEST(Choreograph, HandsAreWhereTheyAreWanted) {
  ChoreographyRequest wanted = request(300);
  ChoreographyReport report;
  const Clip free = choreograph(model(), wanted, {}, report);
  const auto place = [](const Clip& clip, const std::string& joint, Index frame) {
    Pose pose;
    forward_kinematics(clip, frame, pose);
    return Vector3(pose.positions.col(clip.skeleton.find(joint)));
  };
  wanted.reach = {{"LeftHand", 120, place(free, "LeftHand", 120) + Vector3(10, 15, 15)},
                  {"RightFoot", 200, place(free, "RightFoot", 200) + Vector3(0, 15, 10)}};
  const Clip dance = choreograph(model(), wanted, {}, report);
  for (const LimbTarget& target : wanted.reach)
    EXPECT_LT((place(dance, target.joint, target.frame) - target.position).norm(), 0.1) << target.joint;
  EXPECT_EQ(dance.rotations.topRows(60), free.rotations.topRows(60));
  EXPECT_LT(pose_error(dance, 299, "walk_2.bvh", 310), 1e-6);
  wanted.reach[0].frame = 299;
  EXPECT_TRUE(contains(message_of(wanted), "LeftHand at frame 299")) << message_of(wanted);
}

TEST(Choreograph, SaysHowFarPosesAreThatTheModelDoesNotHave) {
  Clip bowed = walking_clips(5, 300)[4];
  for (Index t = 0; t < 300; ++t) bowed.set_rotation(t, bowed.skeleton.find("Spine"), exp_map(Vector3(1.4, 0, 0)));
  ChoreographyRequest wanted = request(240);
  wanted.last_two = pose_pair(model().features, bowed, 100);
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  ChoreographyReport report;
  choreograph(model(), wanted, {}, report, job);
  EXPECT_EQ(report.start_from_model, 0);
  EXPECT_GT(report.end_from_model, 10);
  EXPECT_GE(report.end_distance, report.end_from_model - 1e-9);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(contains(warnings[0], "the end poses are ") && contains(warnings[0], "of all poses in the model"))
      << warnings[0];
}

TEST(Choreograph, IsAsLivelyAsTheExamples) {
  const ChoreographyPlanner planner(model());
  ChoreographyOptions dull;
  dull.lively = false;
  double likely = 0, lively = 0;
  for (const Index n : {500, 600, 700}) {
    const auto speed = [&](const ChoreographyOptions& options) {
      ChoreographyReport report;
      const FrameMatrix p = world_positions(choreograph(model(), request(n), options, report));
      return (p.bottomRows(n - 1) - p.topRows(n - 1)).rowwise().norm().mean();
    };
    likely += speed(dull);
    lively += speed({});
  }
  EXPECT_GE(lively, 0.999 * likely);
}

TEST(Choreograph, OneSeedIsOneDance) {
  ChoreographyOptions options;
  ChoreographyReport report;
  const Clip a = choreograph(model(), request(333), options, report);
  EXPECT_EQ(a.rotations, choreograph(model(), request(333), options, report).rotations);
  options.seed = 2;
  EXPECT_NE(a.rotations, choreograph(model(), request(333), options, report).rotations);
}

TEST(Choreograph, StepsAreNoLargerThanInTheExamples) {
  const auto largest_bend = [](const Clip& clip) {
    const FrameMatrix p = world_positions(clip);
    double largest = 0;
    for (Index t = 1; t + 1 < p.rows(); ++t)
      largest = std::max(largest, (p.row(t + 1) - 2 * p.row(t) + p.row(t - 1)).cwiseAbs().maxCoeff());
    return largest;
  };
  double source = 0;
  for (const Clip& clip : clips()) source = std::max(source, largest_bend(clip));
  for (const Index n : {150, 173, 320, 487}) {
    ChoreographyReport report;
    EXPECT_LT(largest_bend(choreograph(model(), request(n), {}, report)), 2 * source) << n;
  }
}

/// What the planner minimises, by trying every chain of instances and lengths.
struct Exhaustive {
  double stretch;
  Index end_row, wanted;
  double best = 1e300;
  double tau = usual_jump_distance(model());

  double pace(Index l, Index n) const {
    const double ratio = std::log(static_cast<double>(l) / static_cast<double>(n)) / std::log1p(stretch);
    return l == n ? 0 : ratio * ratio;
  }
  /// Rows r … r + l − 1 bent at both ends.
  void bridge(Index start_row, Index r, Index l) {
    const double ratio = static_cast<double>(wanted + 2) / static_cast<double>(l);
    if (ratio < 1 / (1 + stretch) - 1e-9 || ratio > 1 + stretch + 1e-9) return;
    const double bent =
        key_pose_distance(model().corpus, start_row, r) + key_pose_distance(model().corpus, r + l - 2, end_row);
    best = std::min(best, 2 * bent / tau + 2 * std::log(1.3 / 0.3) + pace(wanted + 2, l));
  }
  /// Instance a begins at frame `frames` at this cost.
  void go(int a, Index frames, double cost) {
    if (cost >= best) return;
    const MotionTexture& m = model();
    const Instance& from = m.instances[static_cast<std::size_t>(a)];
    const Index n = hand_over_row(m, from) + 2 - from.row;
    for (Index l = 60; l <= 2 * n; ++l) {
      const double ratio = static_cast<double>(l) / static_cast<double>(n);
      if (ratio < 1 / (1 + stretch) - 1e-9 || ratio > 1 + stretch + 1e-9 || frames + l - 2 > wanted) continue;
      const double now = cost + pace(l, n);
      const Index end = hand_over_row(m, from);
      if (frames + l - 2 == wanted)
        best = std::min(best, now + 2 * key_pose_distance(m.corpus, end, end_row) / tau + std::log(1.3 / 0.3));
      for (int b = 0; b < static_cast<int>(m.instances.size()); ++b) {
        const Instance& to = m.instances[static_cast<std::size_t>(b)];
        const double log_prob = m.transitions.log_prob(from.texton, to.texton);
        if (!std::isfinite(log_prob)) continue;
        const double there = now - log_prob + key_pose_distance(m.corpus, end, to.row) / tau + (a == b ? 2 : 0);
        if (to.row == end_row && frames + l - 2 == wanted) best = std::min(best, there);
        go(b, frames + l - 2, there);
      }
    }
  }
};

TEST(ChoreographyPlanner, FindsTheCheapestOfAllWays) {
  const MotionTexture& m = model();
  const ChoreographyPlanner planner(m);
  const int last = static_cast<int>(m.instances.size()) - 1;
  int num_feasible = 0;
  for (const Index n : {70, 131, 160, 195}) {
    PlanRequest wanted;
    const Index start_row = m.instances[1].row;
    wanted.start = poses_at(m, start_row);
    wanted.end = poses_at(m, m.instances[static_cast<std::size_t>(last)].row);
    wanted.num_frames = n;
    wanted.stretch = 0.05;
    Exhaustive all{wanted.stretch, wanted.end.row, n - 2};
    all.go(1, 0, 0);
    for (int b = 0; b <= last; ++b)
      all.go(b, 0,
             2 * key_pose_distance(m.corpus, start_row, m.instances[static_cast<std::size_t>(b)].row) / all.tau +
                 std::log(1.3 / 0.3));
    if (n <= 120)
      for (const auto& run : m.runs)
        for (Index l = 4; l <= run.length; ++l)
          for (Index r = run.row; r + l <= run.row + run.length; ++r) all.bridge(start_row, r, l);
    if (all.best == 1e300) {
      EXPECT_THROW(planner.plan(wanted), InvalidInput) << n;
    } else {
      ++num_feasible;
      EXPECT_NEAR(planner.plan(wanted).cost, all.best, 1e-6) << n;
    }
  }
  EXPECT_GE(num_feasible, 2);
}

/// Numbers of frames in which any chain of instances leads from pose to pose, by flooding (instance, frames).
std::vector<bool> reachable_lengths(Index start_row, Index end_row, double stretch, Index most) {
  const MotionTexture& m = model();
  const int n = static_cast<int>(m.instances.size());
  std::vector<bool> found(static_cast<std::size_t>(most) + 1, false);
  std::vector<std::vector<bool>> begun(static_cast<std::size_t>(most) + 1, std::vector<bool>(m.instances.size()));
  const auto each_length = [&](Index source, Index least, const auto& visit) {
    for (Index l = least; l <= most; ++l) {
      const double ratio = static_cast<double>(l) / static_cast<double>(source);
      if (ratio >= 1 / (1 + stretch) - 1e-9 && ratio <= 1 + stretch + 1e-9) visit(l);
    }
  };
  const auto mark = [&](Index frames) {
    if (frames <= most) found[static_cast<std::size_t>(frames)] = true;
  };
  const auto hand_over = [&](int a, Index frames) {
    mark(frames + 2);
    for (int b = 0; b < n && frames < most; ++b)
      if (std::isfinite(m.transitions.log_prob(m.instances[static_cast<std::size_t>(a)].texton,
                                               m.instances[static_cast<std::size_t>(b)].texton)))
        begun[static_cast<std::size_t>(frames)][static_cast<std::size_t>(b)] = true;
  };
  const auto rows_of = [&](int a, Index row) {
    return hand_over_row(m, m.instances[static_cast<std::size_t>(a)]) + 2 - row;
  };
  const int home = instance_at(m, start_row), away = instance_at(m, end_row);
  begun[0].assign(m.instances.size(), true);
  each_length(rows_of(home, start_row), 30, [&](Index l) { hand_over(home, l - 2); });
  for (Index frames = 0; frames <= most; ++frames)
    for (int a = 0; a < n; ++a) {
      if (!begun[static_cast<std::size_t>(frames)][static_cast<std::size_t>(a)]) continue;
      const Index row = m.instances[static_cast<std::size_t>(a)].row;
      each_length(rows_of(a, row), 60, [&](Index l) { hand_over(a, frames + l - 2); });
      if (a == away) each_length(end_row + 2 - row, frames > 0 ? 4 : 30, [&](Index l) { mark(frames + l); });
    }
  return found;
}

TEST(ChoreographyPlanner, FindsAWayWheneverThereIsOne) {
  const MotionTexture& m = model();
  const ChoreographyPlanner planner(m);
  int num_refused = 0, num_short = 0;
  for (const double stretch : {0.0, 0.15})
    for (const Index start : {7, 812})
      for (const Index end : {60, 1200, 1937}) {
        const std::vector<bool> reachable = reachable_lengths(start, end, stretch, 330);
        PlanRequest wanted{poses_at(m, start), poses_at(m, end), 0, stretch, 1};
        const ChoreographyBridge bridge(m, wanted, 1, fastest_step(m));
        for (Index n = 2; n <= 330; n += n < 130 ? 1 : 23) {
          wanted.num_frames = n;
          const bool can_bridge = n >= bridge.least_frames() && n <= bridge.most_frames();
          if (!can_bridge && !reachable[static_cast<std::size_t>(n)]) {
            ++num_refused;
            continue;
          }
          num_short += n < 60 ? 1 : 0;
          ASSERT_NO_THROW(planner.plan(wanted)) << start << " to " << end << " in " << n;
          Index sum = 2;
          for (const PlannedSegment& s : planner.plan(wanted).segments) sum += s.piece.length - 2;
          ASSERT_EQ(sum, n);
        }
      }
  EXPECT_GT(num_refused, 0);
  EXPECT_GT(num_short, 100);
}

}  // namespace
}  // namespace motex
