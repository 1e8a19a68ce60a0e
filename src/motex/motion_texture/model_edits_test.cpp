// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/model_edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "motex/core/error.h"
#include "motex/motion_texture/choreograph.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/motion_texture/texton_fitter.h"
#include "motex/motion_texture/texton_paths.h"

namespace motex {
namespace {

using Kind = ModelEdit::Kind;

const MotionTexture& learned_model(Basis basis = Basis::kShared) {
  static const auto learn = [](Basis which) {
    LearnOptions options;
    options.state_size = 4;
    options.basis = which;
    options.init = Init::kGreedy;
    LearnReport report;
    return learn_motion_texture(walking_clips(4, 600), options, report);
  };
  static const MotionTexture shared = learn(Basis::kShared), own = learn(Basis::kOwn);
  return basis == Basis::kShared ? shared : own;
}

MotionTexture edited(std::vector<ModelEdit> edits, Basis basis = Basis::kShared) {
  MotionTexture model = learned_model(basis);
  for (ModelEdit& edit : edits) add_edit(model, std::move(edit));
  return apply_edits(std::move(model));
}

/// A texton with two followers or more, none of them itself, and its likeliest.
struct Fork {
  int from = 0, to = 0, other = 0;
};
Fork a_fork(const MotionTexture& model) {
  for (const int i : danced_textons(model)) {
    std::vector<int> followers;
    for (const TransitionCount& c : model.transitions.counts_from(i))
      if (c.to != i) followers.push_back(c.to);
    if (followers.size() >= 2) return {i, followers[0], followers[1]};
  }
  ADD_FAILURE() << "no texton has two followers";
  return {};
}

SynthesizeReport dance(const MotionTexture& model, Index frames) {
  SynthesizeOptions options;
  options.foot_fix = false;
  SynthesizeReport report;
  const Clip clip = synthesize_motion(model, frames, {}, options, report);
  EXPECT_TRUE(clip.rotations.allFinite());
  return report;
}

TEST(ModelEdits, WhatCannotBe) {
  MotionTexture model = learned_model();
  const int count = static_cast<int>(model.textons.size());
  ASSERT_GE(count, 4);
  const auto refused = [&](const ModelEdit& edit) {
    const auto before = model.edits;
    EXPECT_THROW(add_edit(model, edit), InvalidInput) << static_cast<int>(edit.kind);
    EXPECT_EQ(model.edits, before) << "a refused edit is not kept";
  };
  refused({Kind::kDrop, {count}});
  refused({Kind::kDrop, {-1}});
  refused({Kind::kDrop, {}});
  refused({Kind::kMerge, {1, 1}});
  refused({Kind::kMerge, {1}});
  refused({Kind::kMerge, {1, 2, 2}});
  refused({Kind::kWeight, {0, 1}, -0.5});
  refused({Kind::kWeight, {0, 1}, 1e7});
  refused({Kind::kWeight, {0}, 2});
  for (const char* name : {"3", "-x", "a,b", " a", "a\nb", "any"}) refused({Kind::kName, {0}, 1, name});
  std::vector<int> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) all[static_cast<std::size_t>(i)] = i;
  refused({Kind::kDrop, all});
  add_edit(model, {Kind::kName, {0}, 1, "step"});
  refused({Kind::kName, {1}, 1, "step"});
  add_edit(model, {Kind::kMerge, {0, 1}});
  refused({Kind::kName, {1}, 1, "gone"});
  refused({Kind::kMerge, {1, 2}});
  EXPECT_THROW(undo_edit(model, 2), InvalidInput);
  EXPECT_THROW(undo_edit(model, -2), InvalidInput);
  MotionTexture applied = apply_edits(model);
  EXPECT_THROW(apply_edits(applied), InvalidInput) << "twice";
}

TEST(ModelEdits, TextAndBack) {
  for (const ModelEdit& edit :
       {ModelEdit{Kind::kName, {3}, 1, "turn to the left"}, ModelEdit{Kind::kName, {3}, 1, ""},
        ModelEdit{Kind::kDrop, {4, 5}}, ModelEdit{Kind::kKeep, {1}}, ModelEdit{Kind::kMerge, {2, 9, 4}},
        ModelEdit{Kind::kWeight, {3, 7}, 0.1}, ModelEdit{Kind::kWeight, {-1, 7}, 0}})
    EXPECT_EQ(parse_edit(edit_text(edit)), edit) << edit_text(edit);
  EXPECT_EQ(edit_text({Kind::kWeight, {-1, 7}, 10}), "weight any 7 10");
  for (const char* line : {"", "drop", "fly 3", "drop x", "drop -3", "weight 3", "weight 3 4", "weight 3 4 x",
                           "weight 3 any 2", "name 3 a,b", "drop 3.5", "weight 1 2 nan"})
    EXPECT_THROW(parse_edit(line), InvalidInput) << line;
}

TEST(ModelEdits, NamesStandForNumbers) {
  MotionTexture model = learned_model();
  add_edit(model, {Kind::kName, {2}, 1, "long step"});
  const MotionTexture applied = apply_edits(model);
  EXPECT_EQ(find_texton(applied, "long step"), 2);
  EXPECT_EQ(find_texton(applied, "2"), 2);
  EXPECT_EQ(texton_label(applied, 2), "2 (long step)");
  for (const char* word : {"", "x", "2x", "-1", "99999", "2 "}) EXPECT_EQ(find_texton(applied, word), std::nullopt);
  EXPECT_EQ(dance(applied, 900).played.back().instance, dance(learned_model(), 900).played.back().instance)
      << "a name changes no dance";
  add_edit(model, {Kind::kName, {2}, 1, ""});
  EXPECT_EQ(find_texton(apply_edits(model), "long step"), std::nullopt);
}

TEST(ModelEdits, DroppedTextonsAreDancedNoMore) {
  const MotionTexture before = apply_edits(learned_model());
  const int gone = danced_textons(before)[1];
  const MotionTexture model = edited({{Kind::kDrop, {gone}}});
  EXPECT_FALSE(model.textons[static_cast<std::size_t>(gone)].is_playable());
  EXPECT_TRUE(model.textons[static_cast<std::size_t>(gone)].is_dropped);
  ASSERT_EQ(model.textons.size(), before.textons.size()) << "numbers stay";
  const auto left = before.instances.size() - before.textons[static_cast<std::size_t>(gone)].instances.size();
  ASSERT_EQ(model.instances.size(), left);
  for (std::size_t k = 0; k < model.instances.size(); ++k) {
    const Instance& x = model.instances[k];
    const motex::Run& run = model.runs[static_cast<std::size_t>(x.run_idx)];
    EXPECT_NE(x.texton, gone);
    const bool begins = k == 0 || model.instances[k - 1].run_idx != x.run_idx;
    EXPECT_EQ(x.row, begins ? run.row : model.instances[k - 1].row + model.instances[k - 1].length);
    EXPECT_LE(x.row + x.length, run.row + run.length);
    EXPECT_GE(run.clip_start, 0);
    EXPECT_LE(run.clip_start + run.length, model.clip_lengths[static_cast<std::size_t>(run.clip_idx)]);
    EXPECT_FALSE(model.transitions.is_dead_end(x.texton)) << "jumps close dead ends";
  }
  for (const TransitionCount& c : model.transitions.counts()) EXPECT_TRUE(c.from != gone && c.to != gone);
  for (const PlayedTexton& played : dance(model, 3000).played) EXPECT_NE(played.texton, gone);
  EXPECT_THROW(find_texton_paths(model, gone, 0), InvalidInput);
  SynthesizeReport report;
  EXPECT_THROW(synthesize_motion(model, 0, {gone}, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model, gone, 60, {}, report), InvalidInput);
  for (const Clip& clip : walking_clips(1, 240))
    for (const RecognisedSegment& segment : segment_clip(model, clip)) EXPECT_NE(segment.texton, gone);
  const Instance& lost =
      before.instances[static_cast<std::size_t>(before.textons[static_cast<std::size_t>(gone)].instances[0])];
  const motex::Run& run = before.runs[static_cast<std::size_t>(lost.run_idx)];
  const std::string clip = before.clip_names[static_cast<std::size_t>(run.clip_idx)];
  EXPECT_THROW(corpus_row(model, {clip, run.clip_start + lost.row - run.row + 2}), InvalidInput);
}

TEST(ModelEdits, KeepDropsTheOthers) {
  const std::vector<int> danced = danced_textons(apply_edits(learned_model()));
  const std::set<int> kept(danced.begin(), danced.begin() + 3);
  const MotionTexture model = edited({{Kind::kKeep, {kept.begin(), kept.end()}}});
  for (std::size_t i = 0; i < model.textons.size(); ++i)
    EXPECT_EQ(model.textons[i].is_dropped, kept.count(static_cast<int>(i)) == 0);
  for (const PlayedTexton& played : dance(model, 1500).played) EXPECT_TRUE(kept.count(played.texton));
}

TEST(ModelEdits, MergedTextonsAddUp) {
  const MotionTexture& before = learned_model();
  const MotionTexture model = edited({{Kind::kMerge, {2, 0, 3}}});
  EXPECT_EQ(model.textons[0].merged_into, 2);
  EXPECT_EQ(model.textons[3].merged_into, 2);
  std::set<int> expected;
  for (const std::size_t i : {0, 2, 3})
    expected.insert(before.textons[i].instances.begin(), before.textons[i].instances.end());
  const auto& joined = model.textons[2].instances;
  EXPECT_EQ(std::set<int>(joined.begin(), joined.end()), expected);
  for (const int k : joined) EXPECT_EQ(model.instances[static_cast<std::size_t>(k)].texton, 2);
  LdsStatistics sum = before.textons[2].statistics;
  sum += before.textons[0].statistics;
  sum += before.textons[3].statistics;
  EXPECT_EQ(model.textons[2].statistics.moments, sum.moments);
  const Lds refit = fit_lds(sum, make_prior(before.global_statistics, prior_frames_of(before.options)));
  EXPECT_EQ(model.textons[2].dynamics.transition, refit.transition);
  EXPECT_GT(log_likelihood(model.textons[2].dynamics, sum), log_likelihood(before.textons[2].dynamics, sum));
  double counted = 0;
  for (const int i : {0, 2, 3})
    for (const int j : {0, 2, 3}) counted += before.transitions.count(i, j);
  EXPECT_NEAR(model.transitions.count(2, 2), counted, 1e-12);
  for (const TransitionCount& c : model.transitions.counts())
    EXPECT_TRUE(c.from != 0 && c.from != 3 && c.to != 0 && c.to != 3);
  dance(model, 1500);
}

TEST(ModelEdits, MergedTextonsWithBasesOfTheirOwnGetANewOne) {
  const MotionTexture& before = learned_model(Basis::kOwn);
  ASSERT_GT(before.subspaces.size(), 1U);
  const MotionTexture model = edited({{Kind::kMerge, {1, 0}}}, Basis::kOwn);
  const Subspace& space = model.subspaces[1];
  FrameMatrix rows(0, before.corpus.cols());
  for (const int k : model.textons[1].instances) {
    const Instance& x = model.instances[static_cast<std::size_t>(k)];
    const Index at = rows.rows();
    rows.conservativeResize(at + x.length, Eigen::NoChange);
    rows.bottomRows(x.length) = before.corpus.middleRows(x.row, x.length).cast<double>();
  }
  EXPECT_LT((space.mean.transpose() - rows.colwise().mean()).norm(), 1e-9);
  const auto outside = [&](const Subspace& s) {
    const FrameMatrix centred = rows.rowwise() - s.mean.transpose();
    return centred.squaredNorm() - (centred * s.basis).squaredNorm();
  };
  EXPECT_LT(outside(space), outside(before.subspaces[0]));
  EXPECT_LT(outside(space), outside(before.subspaces[1]));
  dance(model, 1500);
}

TEST(ModelEdits, WeightsMultiplyCounts) {
  const MotionTexture& before = learned_model();
  const Fork fork = a_fork(before);
  const double p = before.transitions.probability(fork.from, fork.to);
  const MotionTexture preferred = edited({{Kind::kWeight, {fork.from, fork.to}, 10}});
  EXPECT_NEAR(preferred.transitions.probability(fork.from, fork.to), 10 * p / (10 * p + 1 - p), 1e-12);
  const MotionTexture forbidden = edited({{Kind::kWeight, {fork.from, fork.to}, 0}});
  EXPECT_EQ(forbidden.transitions.probability(fork.from, fork.to), 0);
  EXPECT_NEAR(forbidden.transitions.probability(fork.from, fork.other),
              before.transitions.probability(fork.from, fork.other) / (1 - p), 1e-12);
  const auto share = [&](const MotionTexture& model) {
    const auto played = dance(model, 30'000).played;
    double left = 0, taken = 0;
    for (std::size_t k = 1; k < played.size(); ++k)
      if (played[k - 1].texton == fork.from) ++left, taken += played[k].texton == fork.to ? 1 : 0;
    return left > 0 ? taken / left : -1;
  };
  const double danced = share(apply_edits(before));
  EXPECT_GT(share(preferred), danced);
  EXPECT_LE(share(forbidden), 0);
}

TEST(ModelEdits, AWholeColumnCanBeWeighed) {
  const MotionTexture& before = learned_model();
  const int texton = danced_textons(before)[2];
  const auto secs = [&](double factor) {
    Index frames = 0;
    for (const PlayedTexton& played : dance(edited({{Kind::kWeight, {-1, texton}, factor}}), 30'000).played)
      if (played.texton == texton) frames += played.length;
    return frames;
  };
  const Index rarely = secs(0.1), usually = secs(1), often = secs(10);
  EXPECT_LT(rarely, usually);
  EXPECT_LT(usually, often);
}

TEST(ModelEdits, TheOnlyWayOutIsNotForbidden) {
  MotionTexture model = learned_model();
  const Fork fork = a_fork(model);
  std::vector<int> followers;
  for (const TransitionCount& c : model.transitions.counts_from(fork.from)) followers.push_back(c.to);
  const int last = followers.back();
  followers.pop_back();
  for (const int to : followers) add_edit(model, {Kind::kWeight, {fork.from, to}, 0});
  const std::size_t made = model.edits.size();
  try {
    add_edit(model, {Kind::kWeight, {fork.from, last}, 0});
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("ways out"), std::string::npos) << error.what();
  }
  EXPECT_EQ(model.edits.size(), made);
  // What was never seen cannot be weighed either.
  EXPECT_THROW(add_edit(model, {Kind::kWeight, {fork.from, fork.to}, 2}), InvalidInput);
}

TEST(ModelEdits, AWeightActsOnWhatItsTextonsWere) {
  const MotionTexture& before = learned_model();
  const Fork fork = a_fork(before);
  const MotionTexture first =
      edited({{Kind::kWeight, {fork.from, fork.to}, 10}, {Kind::kMerge, {fork.to, fork.other}}});
  const MotionTexture last = edited({{Kind::kMerge, {fork.to, fork.other}}, {Kind::kWeight, {fork.from, fork.to}, 10}});
  const double a = before.transitions.count(fork.from, fork.to), b = before.transitions.count(fork.from, fork.other);
  EXPECT_NEAR(first.transitions.count(fork.from, fork.to), 10 * a + b, 1e-9);
  EXPECT_NEAR(last.transitions.count(fork.from, fork.to), 10 * (a + b), 1e-9);
}

TEST(ModelEdits, UndoTakesBackAnyThatNoLaterOneNeeds) {
  MotionTexture model = learned_model();
  add_edit(model, {Kind::kDrop, {1}});
  add_edit(model, {Kind::kName, {0}, 1, "a"});
  add_edit(model, {Kind::kName, {0}, 1, ""});
  add_edit(model, {Kind::kName, {2}, 1, "a"});
  EXPECT_THROW(undo_edit(model, 2), InvalidInput) << "two would have one name";
  EXPECT_EQ(model.edits.size(), 4U);
  EXPECT_EQ(undo_edit(model, 0), (ModelEdit{Kind::kDrop, {1}}));
  EXPECT_TRUE(apply_edits(model).textons[1].is_playable());
  undo_edit(model);
  undo_edit(model);
  EXPECT_EQ(undo_edit(model), (ModelEdit{Kind::kName, {0}, 1, "a"}));
  EXPECT_TRUE(model.edits.empty());
  EXPECT_THROW(undo_edit(model), InvalidInput);
}

TEST(ModelEdits, LostTextonsAreReported) {
  const std::vector<int> danced = danced_textons(learned_model());
  MotionTexture model = learned_model();
  const int texton = danced.back();
  bool cut = false;
  std::vector<int> from;
  for (const TransitionCount& c : model.transitions.counts())
    if (c.to == texton && c.from != texton) from.push_back(c.from);
  try {
    const EditReport report = add_edit(model, {Kind::kWeight, {-1, texton}, 0});
    cut = true;
    EXPECT_NE(std::find(report.lost.begin(), report.lost.end(), texton), report.lost.end());
    undo_edit(model);
  } catch (const InvalidInput&) {  // it was somewhere the only way out
  }
  EXPECT_TRUE(cut || !from.empty());
}

}  // namespace
}  // namespace motex
