// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/mix_models.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

/// Two models of walks at other speeds and turns.
const MotionTexture& model_of(int which, Basis basis = Basis::kShared) {
  static const auto learn = [](int half, Basis b) {
    std::vector<Clip> clips = walking_clips(4, 600);
    LearnOptions options;
    options.state_size = 4;
    options.basis = b;
    options.init = Init::kGreedy;
    LearnReport report;
    const auto from = static_cast<std::size_t>(2 * half);
    return apply_edits(learn_motion_texture(std::span(clips).subspan(from, 2), options, report));
  };
  static const MotionTexture models[] = {learn(0, Basis::kShared), learn(1, Basis::kShared), learn(0, Basis::kOwn),
                                         learn(1, Basis::kOwn)};
  return models[which + (basis == Basis::kOwn ? 2 : 0)];
}

MotionTexture mixed_of(const MotionTexture& a, const MotionTexture& b) {
  MixReport report;
  return mix_models(a, b, report);
}

TEST(MixModels, Errors) {
  MotionTexture other = model_of(1);
  other.features.skeleton.joints[3].name = "Tail";
  try {
    mixed_of(model_of(0), other);
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("Tail"), std::string::npos) << error.what();
  }
  other = model_of(1);
  other.features.frame_time_secs = 1.0 / 120;
  try {
    mixed_of(model_of(0), other);
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("120 Hz"), std::string::npos) << error.what();
  }
}

/// The instance's poses in the model's own space.
Clip poses(const MotionTexture& model, const Instance& x) {
  return decode(model.features, model.corpus.middleRows(x.row, x.length).cast<double>(), x.place);
}

TEST(MixModels, ExamplesAreThoseOfBoth) {
  const MotionTexture &a = model_of(0), &b = model_of(1);
  MixReport report;
  const MotionTexture mixed = mix_models(a, b, report);
  ASSERT_EQ(mixed.instances.size(), a.instances.size() + b.instances.size());
  ASSERT_EQ(mixed.textons.size(), a.textons.size() + b.textons.size());
  for (std::size_t k = 0; k < mixed.instances.size(); ++k) {
    const bool is_of_a = k < a.instances.size();
    const MotionTexture& source = is_of_a ? a : b;
    const Instance &x = mixed.instances[k], &y = source.instances[is_of_a ? k : k - a.instances.size()];
    const auto& numbers = is_of_a ? report.textons_of_a : report.textons_of_b;
    EXPECT_EQ(x.texton, numbers[static_cast<std::size_t>(y.texton)]);
    const Clip now = poses(mixed, x), before = poses(source, y);
    ASSERT_EQ(now.num_frames(), before.num_frames());
    EXPECT_LT((now.translations.leftCols(3) - before.translations.leftCols(3)).cwiseAbs().maxCoeff(), 0.01);
    double worst = 0;
    for (Index t = 0; t < now.num_frames(); ++t)
      for (Index c = 0; c < now.rotations.cols(); c += 4) {
        const double dot = now.rotations.row(t).segment(c, 4).dot(before.rotations.row(t).segment(c, 4));
        worst = std::max(worst, 1 - std::abs(dot));
      }
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(MixModels, TheDanceVisitsBoth) {
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const MotionTexture &a = model_of(0, basis), &b = model_of(1, basis);
    MixReport report;
    const MotionTexture mixed = apply_edits(mix_models(a, b, report));
    EXPECT_EQ(mixed.subspaces.size(), basis == Basis::kOwn ? mixed.textons.size() : 1U);
    EXPECT_GT(report.num_crossings, 0);
    for (const TransitionCount& c : a.transitions.counts())
      EXPECT_DOUBLE_EQ(mixed.transitions.count(report.textons_of_a[static_cast<std::size_t>(c.from)],
                                               report.textons_of_a[static_cast<std::size_t>(c.to)]),
                       c.count);
    SynthesizeOptions options;
    options.foot_fix = false;
    SynthesizeReport played;
    const Clip clip = synthesize_motion(mixed, 12'000, {}, options, played);
    EXPECT_TRUE(clip.rotations.allFinite());
    Index of_a = 0;
    int crossings = 0;
    for (std::size_t k = 0; k < played.played.size(); ++k) {
      const bool is_a = played.played[k].texton < report.textons_of_b[0];
      of_a += is_a ? played.played[k].length : 0;
      crossings += k > 0 && is_a != (played.played[k - 1].texton < report.textons_of_b[0]) ? 1 : 0;
    }
    EXPECT_GT(of_a, 12'000 / 10);
    EXPECT_LT(of_a, 12'000 * 9 / 10);
    EXPECT_GT(crossings, 2);
  }
}

TEST(MixModels, EditsAreTakenOverAsTheyAct) {
  MotionTexture a = model_of(0), b = model_of(1);
  a.edits_applied = b.edits_applied = false;
  add_edit(a, {ModelEdit::Kind::kName, {1}, 1, "step"});
  add_edit(a, {ModelEdit::Kind::kDrop, {0}});
  add_edit(b, {ModelEdit::Kind::kName, {1}, 1, "step"});
  a = apply_edits(a), b = apply_edits(b);
  MixReport report;
  const MotionTexture mixed = apply_edits(mix_models(a, b, report));
  EXPECT_EQ(report.textons_of_a[0], -1);
  EXPECT_EQ(mixed.textons.size(), a.textons.size() + b.textons.size() - 1);
  EXPECT_EQ(mixed.instances.size(), a.instances.size() + b.instances.size());
  EXPECT_EQ(find_texton(mixed, "step"), report.textons_of_a[1]);
  EXPECT_EQ(find_texton(mixed, "step 2"), report.textons_of_b[1]);
}

}  // namespace
}  // namespace motex
