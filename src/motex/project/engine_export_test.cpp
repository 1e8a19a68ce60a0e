// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/engine_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "motex/core/error.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

const MotionTexture& model() { return sample_model(); }

TEST(EngineExport, OneClipATextonAndProbabilitiesThatAddUp) {
  const EnginePack pack = make_engine_pack(model(), "walk");
  EXPECT_EQ(pack.clips.size(), model().textons.size());
  std::vector<double> sums(pack.clips.size(), 0);
  for (const EngineTransition& t : pack.transitions) {
    const int from = pack.clips[static_cast<std::size_t>(t.from)].texton,
              to = pack.clips[static_cast<std::size_t>(t.to)].texton;
    EXPECT_EQ(t.texton_probability, model().transitions.probability(from, to));
    EXPECT_GT(t.probability, 0);
    sums[static_cast<std::size_t>(t.from)] += t.probability;
    EXPECT_GE(t.blend_secs, 0);
    EXPECT_LE(t.blend_secs, 0.25);
    if (t.distance_cm == 0) {
      EXPECT_EQ(t.blend_secs, 0);
    }
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(EngineExport, ClipsBeginAtTheOriginAndAreTheExamples) {
  const EnginePack pack = make_engine_pack(model(), "walk");
  for (const EngineClip& c : pack.clips) {
    const RootPlace start = root_place(model().features, c.clip, 0);
    EXPECT_NEAR(std::hypot(start.x, start.z), 0, 1e-9);
    EXPECT_NEAR(std::remainder(start.heading, 6.283185307179586), 0, 1e-9);
    const Instance& a = model().instances[static_cast<std::size_t>(c.instance)];
    EXPECT_EQ(a.texton, c.texton);
    const FrameMatrix again = encode(model().features, c.clip);
    const Index n = c.clip.num_frames() - 1;
    EXPECT_LT((again.bottomRows(n) - model().corpus.middleRows(a.row + 1, n).cast<double>()).cwiseAbs().maxCoeff(),
              1e-3);
  }
}

/// Mean distance of the transitions, each as often as it is taken from its clip.
double mean_distance(const EnginePack& pack) {
  double sum = 0;
  for (const EngineTransition& t : pack.transitions) sum += t.probability * t.distance_cm;
  return sum / static_cast<double>(pack.clips.size());
}

TEST(EngineExport, TheChosenExamplesJoinBetterThanTheFirstOnes) {
  MotionTexture first = model();
  for (Texton& texton : first.textons) texton.instances.resize(1);
  EXPECT_LT(mean_distance(make_engine_pack(model(), "walk")), mean_distance(make_engine_pack(first, "walk")));
}

TEST(EngineExport, AllExamples) {
  EngineExportOptions options;
  options.all_examples = true;
  options.most_transitions = 5;
  const EnginePack pack = make_engine_pack(model(), "walk", options);
  EXPECT_EQ(pack.clips.size(), model().instances.size());
  std::set<std::string> names;
  for (const EngineClip& c : pack.clips) names.insert(c.name);
  EXPECT_EQ(names.size(), pack.clips.size());
  std::vector<int> counts(pack.clips.size(), 0);
  std::vector<double> sums(pack.clips.size(), 0);
  for (const EngineTransition& t : pack.transitions) {
    ++counts[static_cast<std::size_t>(t.from)];
    sums[static_cast<std::size_t>(t.from)] += t.probability;
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    EXPECT_LE(counts[k], 5);
    EXPECT_NEAR(sums[k], 1, 1e-9);
  }
}

TEST(EngineExport, NamesAndGraph) {
  MotionTexture named = model();
  named.textons[0].name = "Kleine Drehung/2";
  named.textons[1].name = "Kleine Drehung 2";
  const EnginePack pack = make_engine_pack(named, "walk");
  EXPECT_EQ(pack.clips[0].name, "Kleine_Drehung_2");
  EXPECT_EQ(pack.clips[1].name, "Kleine_Drehung_2_2");
  const auto graph = nlohmann::json::parse(pack.graph);
  EXPECT_EQ(graph["motex_graph"], 1);
  EXPECT_EQ(graph["clips"].size(), pack.clips.size());
  EXPECT_EQ(graph["transitions"].size(), pack.transitions.size());
  EXPECT_EQ(graph["textons"][0]["name"], "Kleine Drehung/2");
  EXPECT_EQ(graph["clips"][0]["frames"], pack.clips[0].clip.num_frames());
}

TEST(EngineExport, GlbHoldsEveryClip) {
  const EnginePack pack = make_engine_pack(model(), "walk");
  const std::string glb = engine_glb(pack);
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  const Clip first = read_gltf_bytes(glb, "pack.glb", {}, job);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find(std::to_string(pack.clips.size()) + " animations"), std::string::npos) << warnings[0];
  EXPECT_EQ(first.num_frames(), pack.clips[0].clip.num_frames());
}

TEST(EngineExport, NothingToPlay) {
  MotionTexture empty = model();
  for (Texton& texton : empty.textons) texton.instances.clear();
  EXPECT_THROW(make_engine_pack(empty, "walk"), InvalidInput);
  EngineExportOptions options;
  options.blend = -1;
  EXPECT_THROW(make_engine_pack(model(), "walk", options), InvalidInput);
}

}  // namespace
}  // namespace motex
