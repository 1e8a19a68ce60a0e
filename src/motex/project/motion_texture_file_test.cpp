// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/motion_texture_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/rng.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

const MotionTexture& small_model(Basis basis = Basis::kShared) {
  static const auto learn = [](Basis which) {
    LearnOptions options;
    options.state_size = 4;
    options.basis = which;
    options.init = Init::kGreedy;
    options.seed = 17'000'000'000'000'000'001U;
    options.transition_prior = 0.1;
    LearnReport report;
    return learn_motion_texture(walking_clips(2, 240), options, report);
  };
  static const MotionTexture shared = learn(Basis::kShared), own = learn(Basis::kOwn);
  return basis == Basis::kShared ? shared : own;
}

Clip dance(const MotionTexture& model, Index frames) {
  SynthesizeReport report;
  return synthesize_motion(model, frames, {}, {}, report);
}

/// Reads and, where the reader accepts the bytes, uses the model in every way: what it accepts must be safe.
/// Returns whether it was accepted.
bool read_and_use(const std::string& bytes) {
  MotionTexture model;
  try {
    model = parse_motion_texture(bytes, "altered.motex");
  } catch (const InvalidInput&) {
    return false;
  } catch (const NumericalFailure&) {
    return false;
  }
  try {
    const Clip clip = dance(model, 100);
    segment_clip(model, clip);
    score_clips(model, {&clip, 1});
  } catch (const Error&) {
  }
  return true;
}

/// The bytes with the right checksum at their end.
std::string sealed(std::string bytes) {
  const auto size = bytes.size() - 4;
  const auto crc = archive_checksum(std::string_view(bytes).substr(0, size));
  std::memcpy(bytes.data() + size, &crc, 4);
  return bytes;
}

/// Where the elements of an array begin in the file.
std::size_t elements_of(const std::string& bytes, const std::string& name, int dimensions) {
  std::string key(2, '\0');
  key[0] = static_cast<char>(name.size());
  const auto at = bytes.find(key + name);
  if (at == std::string::npos) ADD_FAILURE() << "no array " << name;
  return at + key.size() + name.size() + 2 + 8 * static_cast<std::size_t>(dimensions);
}

template <typename T>
std::string with_value(std::string bytes, const std::string& name, int dimensions, std::size_t i, T value) {
  std::memcpy(bytes.data() + elements_of(bytes, name, dimensions) + i * sizeof(T), &value, sizeof(T));
  return sealed(std::move(bytes));
}

TEST(MotionTextureFile, WriteReadWriteIsIdentity) {
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const MotionTexture& model = small_model(basis);
    const std::string bytes = motion_texture_bytes(model);
    const MotionTexture again = parse_motion_texture(bytes, "again");
    EXPECT_EQ(motion_texture_bytes(again), bytes);
    EXPECT_EQ(again.options.seed, model.options.seed);
    EXPECT_EQ(again.options.basis, basis);
    EXPECT_EQ(again.options.transition_prior, 0.1);
    const Clip a = dance(model, 400), b = dance(again, 400);
    EXPECT_EQ(a.rotations, b.rotations);
    EXPECT_EQ(a.translations, b.translations);
    EXPECT_EQ(a.skeleton.joints[0].channels, b.skeleton.joints[0].channels);
    const Clip clip = walking_clips(1, 240)[0];
    EXPECT_EQ(score_clips(model, {&clip, 1}).log_likelihood_per_frame,
              score_clips(again, {&clip, 1}).log_likelihood_per_frame);
  }
}

TEST(MotionTextureFile, SameSeedSameBytesForAnyNumberOfThreads) {
  const std::vector<Clip> clips = walking_clips(3, 300);
  JobContext one, two;
  one.jobs = 1, two.jobs = 2;
  LearnReport report;
  LearnOptions options;
  options.state_size = 6;
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    options.basis = basis;
    EXPECT_EQ(motion_texture_bytes(learn_motion_texture(clips, options, report, one)),
              motion_texture_bytes(learn_motion_texture(clips, options, report, two)));
  }
}

TEST(MotionTextureFile, OnDisk) {
  const auto path = std::filesystem::path(testing::TempDir()) / "model_file_test.motex";
  save_motion_texture(path, small_model());
  EXPECT_EQ(read_file(path), motion_texture_bytes(small_model()));
  EXPECT_EQ(load_motion_texture(path).textons.size(), small_model().textons.size());
  std::filesystem::remove(path);
  EXPECT_THROW(load_motion_texture(path), InvalidInput);
}

TEST(MotionTextureFile, WithoutLegs) {
  MotionTexture model = small_model();
  model.feet.legs.clear();
  const std::string bytes = motion_texture_bytes(model);
  EXPECT_EQ(motion_texture_bytes(parse_motion_texture(bytes, "legless")), bytes);
}

TEST(MotionTextureFile, NamesOfAnyKind) {
  MotionTexture model = small_model();
  model.clip_names[0] = "two\nlines.bvh";
  model.clip_names[1] = "";
  model.features.skeleton.joints[3].name = "a name with spaces and ü";
  const MotionTexture again = parse_motion_texture(motion_texture_bytes(model), "names");
  EXPECT_EQ(again.clip_names, (std::vector<std::string>{"two lines.bvh", ""}));
  EXPECT_EQ(again.features.skeleton.joints[3].name, "a name with spaces and ü");
}

TEST(MotionTextureFile, EveryTruncationIsRefused) {
  const std::string bytes = motion_texture_bytes(small_model());
  for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 397)
    EXPECT_THROW(parse_motion_texture(bytes.substr(0, size), "cut"), InvalidInput) << size;
  // Cut at every place of the beginning, with a checksum that agrees.
  for (std::size_t size = 40; size < 4000; size += 3) EXPECT_FALSE(read_and_use(sealed(bytes.substr(0, size)))) << size;
  EXPECT_THROW(parse_motion_texture(bytes + '\0', "longer"), InvalidInput);
}

TEST(MotionTextureFile, AlteredBytesAreRefusedOrReadSafely) {
  const std::string bytes = motion_texture_bytes(small_model());
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    std::string altered = bytes;
    altered[rng.below(bytes.size())] ^= static_cast<char>(1 + rng.below(255));
    EXPECT_THROW(parse_motion_texture(altered, "altered"), InvalidInput);
  }
  int accepted = 0;
  for (int i = 0; i < 800; ++i) {
    std::string altered = bytes;
    // Half of them where names, types, sizes and indices are, which are few among the numbers.
    const std::size_t below = i % 2 == 0 ? bytes.size() : 3500;
    altered[rng.below(below)] ^= static_cast<char>(1 + rng.below(255));
    accepted += read_and_use(sealed(std::move(altered))) ? 1 : 0;
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, 800);
}

TEST(MotionTextureFile, HostileIndicesAndNumbersAreRefused) {
  const std::string bytes = motion_texture_bytes(small_model());
  const auto refused = [&](const std::string& altered) {
    EXPECT_THROW(parse_motion_texture(altered, "hostile"), InvalidInput);
  };
  constexpr std::int64_t kHuge = std::numeric_limits<std::int64_t>::max();
  ASSERT_EQ(sealed(bytes), bytes);
  for (const std::int64_t value : {std::int64_t{-1}, std::int64_t{1'000'000}, kHuge, -kHuge - 1}) {
    for (const std::size_t field : {0, 1, 2, 3}) refused(with_value(bytes, "instances", 1, field, value));
    for (const std::size_t field : {0, 1, 2}) refused(with_value(bytes, "runs", 1, field, value));
    for (const std::size_t joint : {1, 2, 9}) {
      if (value != -1) refused(with_value(bytes, "joint_parents", 1, joint, value));
      refused(with_value(bytes, "feature_joints", 1, joint, value));
    }
    refused(with_value(bytes, "end_site_parents", 1, 0, value));
    refused(with_value(bytes, "joint_channels", 1, 0, value));
    refused(with_value(bytes, "num_textons_and_subspaces", 1, 0, value));
    refused(with_value(bytes, "num_textons_and_subspaces", 1, 1, value));
    if (value != 1'000'000) refused(with_value(bytes, "clip_lengths", 1, 0, value));
  }
  refused(with_value(bytes, "joint_parents", 1, 4, std::int64_t{4}));  // its own parent
  refused(with_value(bytes, "joint_parents", 1, 4, std::int64_t{7}));  // a child of what comes later
  for (const double value : {0.0, -1.0}) {
    refused(with_value(bytes, "feature_weights", 1, 3, value));
    refused(with_value(bytes, "frame_time_and_cm_per_unit", 1, 0, value));
    refused(with_value(bytes, "frame_time_and_cm_per_unit", 1, 1, value));
    refused(with_value(bytes, "outside_deviation", 1, 0, value));
    refused(with_value(bytes, "feature_references", 2, 0, value + 0.5));
  }
  for (const double value : {-1.0, 1e9, 0.5, 1e300}) refused(with_value(bytes, "legs", 2, 0, value));
  for (const double value : {-1.0, 1e9}) {
    refused(with_value(bytes, "transitions", 2, 0, value));
    refused(with_value(bytes, "transitions", 2, 1, value));
    refused(with_value(bytes, "foot_thresholds", 1, 0, value));
  }
  refused(with_value(bytes, "transitions", 2, 2, -1.0));
  for (const double value : {-1.0, 1e6, 1e18, 1e300}) refused(with_value(bytes, "foot_thresholds", 1, 5, value));
  refused(with_value(bytes, "frame_time_and_cm_per_unit", 1, 0, 1.1e-6));
}

TEST(MotionTextureFile, NumbersThatAreNotFiniteAreRefused) {
  const std::string bytes = motion_texture_bytes(small_model());
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (const char* name : {"joint_offsets", "feature_held", "subspace/0", "dynamics/0", "statistics/0", "places",
                             "transitions", "global_subspace", "global_statistics", "legs"})
      EXPECT_THROW(parse_motion_texture(with_value(bytes, name, 2, 2, value), "hostile"), InvalidInput) << name;
    for (const char* name : {"metres_per_unit", "outside_deviation", "foot_thresholds", "feature_weights"})
      EXPECT_THROW(parse_motion_texture(with_value(bytes, name, 1, 0, value), "hostile"), InvalidInput) << name;
    EXPECT_THROW(parse_motion_texture(with_value(bytes, "corpus", 2, 7, static_cast<float>(value)), "hostile"),
                 InvalidInput);
  }
}

TEST(MotionTextureFile, HugeSizesAllocateNothing) {
  const std::string bytes = motion_texture_bytes(small_model());
  for (const char* name : {"corpus", "instances", "options", "legs"}) {
    const int dimensions = name[0] == 'c' || name[0] == 'l' ? 2 : 1;
    const std::size_t sizes = elements_of(bytes, name, dimensions) - 8 * static_cast<std::size_t>(dimensions);
    for (const std::uint64_t value :
         {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 61, std::uint64_t{1} << 31})
      for (int d = 0; d < dimensions; ++d) {
        std::string altered = bytes;
        std::memcpy(altered.data() + sizes + 8 * static_cast<std::size_t>(d), &value, 8);
        EXPECT_THROW(parse_motion_texture(sealed(altered), "hostile"), InvalidInput) << name << ' ' << value;
      }
  }
}

TEST(MotionTextureFile, DynamicsWithoutUsableNoiseAreRefused) {
  const std::string bytes = motion_texture_bytes(small_model());
  const std::size_t row = 3 * 4 + 1;  // [A₁ A₂ | D | B Bᵀ], 4 states
  EXPECT_THROW(parse_motion_texture(with_value(bytes, "dynamics/0", 2, row - 4, -1.0), "hostile"), Error);
}

TEST(MotionTextureFile, ForeignAndNewerFiles) {
  std::string bytes = motion_texture_bytes(small_model());
  EXPECT_THROW(parse_motion_texture("", "empty"), UnsupportedFile);
  EXPECT_THROW(parse_motion_texture("HIERARCHY\nROOT Hips\n", "dance.bvh"), UnsupportedFile);
  bytes[8] = 3;
  EXPECT_THROW(parse_motion_texture(sealed(bytes), "newer"), UnsupportedFile);
}

TEST(MotionTextureFile, EditsStandBesideTheLearnedModel) {
  MotionTexture model = small_model();
  const std::string learned = motion_texture_bytes(model);
  const std::vector<ModelEdit> edits{{ModelEdit::Kind::kName, {1}, 1, "long step"},
                                     {ModelEdit::Kind::kMerge, {1, 0}},
                                     {ModelEdit::Kind::kWeight, {-1, 1}, 0.1}};
  std::vector<std::string> stages{learned};
  for (const ModelEdit& edit : edits) {
    add_edit(model, edit);
    stages.push_back(motion_texture_bytes(model));
    model = parse_motion_texture(stages.back(), "edited");
    EXPECT_EQ(motion_texture_bytes(model), stages.back());
  }
  EXPECT_EQ(model.edits, edits);
  EXPECT_EQ(model.textons[1].name, "") << "not applied";
  EXPECT_EQ(stages.back()[8], 2) << "old programs must not dance it without its edits";
  const MotionTexture applied = apply_edits(model);
  EXPECT_EQ(applied.textons[1].name, "long step");
  EXPECT_THROW(motion_texture_bytes(applied), InvalidInput);
  for (std::size_t k = edits.size(); k-- > 0;) {
    EXPECT_EQ(undo_edit(model), edits[k]);
    EXPECT_TRUE(motion_texture_bytes(model) == stages[k]) << "undone to the byte";
  }
}

TEST(MotionTextureFile, LoadingAppliesEdits) {
  MotionTexture model = small_model();
  add_edit(model, {ModelEdit::Kind::kName, {0}, 1, "start"});
  const auto path = std::filesystem::path(testing::TempDir()) / "edited.motex";
  save_motion_texture(path, model);
  EXPECT_TRUE(load_learned_motion_texture(path).textons[0].name.empty());
  EXPECT_EQ(load_motion_texture(path).textons[0].name, "start");
  model.edits[0].textons[0] = 100'000;
  save_motion_texture(path, model);
  EXPECT_NO_THROW(load_learned_motion_texture(path));
  EXPECT_THROW(load_motion_texture(path), InvalidInput);
  std::filesystem::remove(path);
}

TEST(MotionTextureFile, BrokenEditsAreRefused) {
  MotionTexture model = small_model();
  model.edits = {{ModelEdit::Kind::kDrop, {0, 1}}};
  const std::string bytes = motion_texture_bytes(model);
  ASSERT_NE(bytes.find("drop 0 1\n"), std::string::npos);
  for (const char* line : {"dorp 0 1\n", "drop 0 x\n", "name 0,1\n", "\n\n\n\n\n\n\n\n\n", "weight 1\n"}) {
    std::string altered = bytes;
    altered.replace(bytes.find("drop 0 1\n"), 9, std::string(line).append(9, ' ').substr(0, 9));
    EXPECT_THROW(parse_motion_texture(sealed(altered), "hostile"), InvalidInput) << line;
  }
}

/// A file of every format version is kept (tests/old_files); what it held when it was new is what it holds for ever.
TEST(MotionTextureFile, ReadsVersionOne) {
  const MotionTexture model =
      load_motion_texture(std::filesystem::path(MOTEX_TEST_DATA) / "../old_files/motion_texture_v1.motex");
  EXPECT_EQ(model.clip_names, (std::vector<std::string>{"walk_0.bvh", "walk_1.bvh"}));
  EXPECT_EQ(model.clip_lengths, (std::vector<Index>{75, 75}));
  EXPECT_EQ(model.features.skeleton.num_joints(), 17);
  EXPECT_EQ(model.features.skeleton.joints[16].name, "RightToeBase");
  EXPECT_DOUBLE_EQ(model.frame_time_secs(), 1.0 / 15);
  EXPECT_DOUBLE_EQ(model.features.weights[6], 32.320675218781105);
  EXPECT_EQ(model.corpus.rows(), 150);
  EXPECT_FLOAT_EQ(model.corpus(10, 2), 82.5327759F);
  EXPECT_EQ(model.options.init, Init::kGreedy);
  EXPECT_EQ(model.options.seed, 7U);
  ASSERT_EQ(model.textons.size(), 6U);
  EXPECT_DOUBLE_EQ(model.textons[0].dynamics.transition(0, 0), 1.7961084423117679);
  ASSERT_EQ(model.instances.size(), 7U);
  EXPECT_EQ(model.instances[1].row, 15);
  EXPECT_EQ(model.instances[1].length, 17);
  EXPECT_DOUBLE_EQ(model.instances[1].place.z, 80);
  EXPECT_DOUBLE_EQ(model.transitions.count(4, 0), 0.6);
  EXPECT_DOUBLE_EQ(model.outside_deviation, 2.2844926133964893);
  EXPECT_EQ(model.global_statistics.count(), 146);
  EXPECT_EQ(model.feet.legs.size(), 2U);
  EXPECT_TRUE(model.edits.empty());
  check_clip(dance(model, 300));
}

TEST(MotionTextureFile, ReadsVersionTwo) {
  const auto path = std::filesystem::path(MOTEX_TEST_DATA) / "../old_files/motion_texture_v2.motex";
  const MotionTexture learned = load_learned_motion_texture(path);
  EXPECT_TRUE(motion_texture_bytes(learned) == read_file(path));
  EXPECT_DOUBLE_EQ(learned.features.reference_height, 84.000000000000043);
  std::string edits;
  for (const ModelEdit& edit : learned.edits) edits += edit_text(edit) + '\n';
  EXPECT_EQ(edits, "name 1 long step\nmerge 1 3\nweight any 2 0.25\ndrop 0\n");
  const MotionTexture model = load_motion_texture(path);
  EXPECT_EQ(find_texton(model, "long step"), 1);
  EXPECT_EQ(model.textons[3].merged_into, 1);
  EXPECT_TRUE(model.textons[0].is_dropped);
  EXPECT_EQ(model.textons[1].instances.size(), 5U);
  EXPECT_EQ(model.textons[1].statistics.count(), 98);
  EXPECT_NEAR(model.textons[1].dynamics.transition(0, 0), 1.8078100115377602, 1e-9);
  EXPECT_FLOAT_EQ(model.corpus(10, 2), -1.46722138F);
  EXPECT_NEAR(model.transitions.count(1, 1), 3.5, 1e-12);
  EXPECT_NEAR(model.transitions.count(1, 2), 0.4, 1e-12);
  EXPECT_NEAR(model.transitions.count(2, 1), 2.6, 1e-12);
  check_clip(dance(model, 300));
}

}  // namespace
}  // namespace motex
