// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/instance_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "motex/core/error.h"
#include "motex/markov/graph.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

MotionTexture walking_model() {
  LearnOptions options;
  options.state_size = 6;
  options.init = Init::kGreedy;
  options.threshold = 15;
  LearnReport report;
  return learn_motion_texture(walking_clips(4, 500), options, report);
}

int texton_of(const MotionTexture& model, int instance) {
  return model.instances.at(static_cast<std::size_t>(instance)).texton;
}

TEST(InstanceWalk, UnknownTextonsAreRefused) {
  const MotionTexture model = walking_model();
  const int none = static_cast<int>(model.textons.size());
  EXPECT_THROW(InstanceWalk(model, {}, {0, none}, false), InvalidInput);
  EXPECT_THROW(InstanceWalk(model, {}, {-1}, true), InvalidInput);
}

TEST(InstanceWalk, PlaysThePathAndEnds) {
  const MotionTexture model = walking_model();
  ASSERT_GE(model.textons.size(), 3U);
  const std::vector<int> path{2, 0, 0, 1, 2};
  for (const KeyPoses key_poses : {KeyPoses::kNearest, KeyPoses::kRandom}) {
    SynthesizeOptions options;
    options.key_poses = key_poses;
    InstanceWalk walk(model, options, path, false);
    for (const int texton : path) EXPECT_EQ(texton_of(model, walk.next()), texton);
    EXPECT_EQ(walk.next(), -1);
    EXPECT_EQ(walk.next(), -1);
    InstanceWalk endless(model, options, path, true);
    for (const int texton : path) EXPECT_EQ(texton_of(model, endless.next()), texton);
    EXPECT_GE(endless.next(), 0);
  }
  EXPECT_EQ(InstanceWalk(model, {}, {}, false).next(), -1);
}

TEST(InstanceWalk, StaysInTheLargestPartAndShowsAllOfIt) {
  const MotionTexture model = walking_model();
  const auto components = strongly_connected_components(counted_graph(model.transitions));
  const auto& allowed = components.largest();
  std::size_t instances = 0;
  for (const int texton : allowed) instances += model.textons[static_cast<std::size_t>(texton)].instances.size();
  InstanceWalk walk(model, {}, {}, true);
  std::set<int> seen;
  for (std::size_t k = 0; k < 40 * instances; ++k) {
    const int instance = walk.next();
    EXPECT_TRUE(std::binary_search(allowed.begin(), allowed.end(), texton_of(model, instance)));
    seen.insert(instance);
  }
  EXPECT_EQ(seen.size(), instances);
}

TEST(InstanceWalk, FollowsTransitionsThatExist) {
  const MotionTexture model = walking_model();
  InstanceWalk walk(model, {}, {}, true);
  int before = walk.next();
  for (int k = 0; k < 300; ++k) {
    const int now = walk.next();
    EXPECT_GT(model.transitions.probability(texton_of(model, before), texton_of(model, now)), 0);
    before = now;
  }
}

/// Also where a few begin near one another and far from all the rest.
TEST(InstanceWalk, LeadsFromEveryInstanceToEveryOther) {
  MotionTexture model = walking_model();
  ASSERT_GE(model.instances.size(), 6U);
  model.textons.resize(1);
  model.textons[0].instances.clear();
  for (std::size_t k = 0; k < model.instances.size(); ++k) {
    model.instances[k].texton = 0;
    model.textons[0].instances.push_back(static_cast<int>(k));
  }
  model.transitions = TransitionMatrix(1, 1);
  model.corpus.topRows(model.instances[2].row + 2).rightCols(9).array() += 300;
  const auto followers = InstanceWalk(model, {}, {}, true).followers();
  Graph graph(static_cast<int>(followers.size()));
  for (std::size_t a = 0; a < followers.size(); ++a)
    for (const int b : followers[a]) graph.add_edge(static_cast<int>(a), b);
  EXPECT_EQ(strongly_connected_components(graph).members.size(), 1U);
}

TEST(InstanceWalk, GoesOnForEver) {
  const MotionTexture model = walking_model();
  InstanceWalk walk(model, {}, {}, true);
  std::map<int, int> counts;
  for (int k = 0; k < 50'000; ++k) ++counts[walk.next()];
  int least = 50'000;
  for (const auto& [instance, count] : counts) least = std::min(least, count);
  EXPECT_GT(least, 100) << "what was shown is not forgotten";
}

TEST(InstanceWalk, RepeatsWithItsSeed) {
  const MotionTexture model = walking_model();
  SynthesizeOptions options;
  InstanceWalk a(model, options, {}, true), b(model, options, {}, true);
  options.seed = 2;
  InstanceWalk c(model, options, {}, true);
  int differences = 0;
  for (int k = 0; k < 50; ++k) {
    const int x = a.next();
    EXPECT_EQ(x, b.next());
    differences += x != c.next() ? 1 : 0;
  }
  EXPECT_GT(differences, 10);
}

TEST(InstanceWalk, NearestPosesLieNearerThanRandomOnes) {
  const MotionTexture model = walking_model();
  const auto mean_distance = [&](KeyPoses key_poses) {
    SynthesizeOptions options;
    options.key_poses = key_poses;
    InstanceWalk walk(model, options, {}, true);
    double sum = 0;
    int before = walk.next();
    for (int k = 0; k < 300; ++k) {
      const int now = walk.next();
      sum += key_pose_distance(model.corpus, hand_over_row(model, model.instances[static_cast<std::size_t>(before)]),
                               model.instances[static_cast<std::size_t>(now)].row);
      before = now;
    }
    return sum / 300;
  };
  EXPECT_LT(mean_distance(KeyPoses::kNearest), 0.8 * mean_distance(KeyPoses::kRandom));
}

TEST(InstanceWalk, OfOneInstanceIsThatInstance) {
  MotionTexture model = walking_model();
  model.instances.resize(1);
  model.instances[0].texton = 0;
  model.textons.resize(1);
  model.textons[0].instances = {0};
  model.transitions = TransitionMatrix(1, 0);
  InstanceWalk walk(model, {}, {}, true);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(walk.next(), 0);
}

}  // namespace
}  // namespace motex
