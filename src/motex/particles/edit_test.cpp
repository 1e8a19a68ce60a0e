// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Three spots that move right by one pixel a frame, each with one coil.
TexturedMotion three_spots() {
  TexturedMotion model;
  model.width = 100;
  model.height = 60;
  model.num_frames = 20;
  for (int k = 0; k < 3; ++k) {
    Cable cable;
    cable.first_frame = k;
    cable.coils.resize(1);
    for (int t = 0; t < 10; ++t) {
      Base core{BaseKind::kGaussian, 20.0 + t, 15.0 * (k + 1), 2, 0, {100, 100, 100}};
      cable.core.push_back(core);
      core.x += 3;
      core.coefficients = {20, 20, 20};
      cable.coils[0].push_back(core);
    }
    model.cables.push_back(cable);
  }
  model.background = Planes(1, Plane(100, 60, 50));
  return model;
}

TEST(LearnedMovetons, ShowTheClip) {
  const TexturedMotion model = three_spots();
  LearnedMovetons learned(model);
  const std::vector<Cable> cables = collect_cables(learned, 100);
  ASSERT_EQ(cables.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(cables[k].first_frame, model.cables[k].first_frame);
    ASSERT_EQ(cables[k].core.size(), 10U);
    EXPECT_EQ(cables[k].core[4].x, model.cables[k].core[4].x);
    EXPECT_EQ(cables[k].coils[0][4].x, model.cables[k].coils[0][4].x);
  }
  MovetonFrame frame;
  EXPECT_FALSE(learned.next_frame(frame)) << "it ends with the clip";
}

TEST(EditedMovetons, MoveRemoveInsert) {
  const TexturedMotion model = three_spots();
  MovetonEdits edits;
  edits.displacements = {{0, 7, -2}};
  edits.removals = {1, 55};
  edits.insertions = {{5, {900, 50, 30, 0.5, 0, -1}}};
  LearnedMovetons learned(model);
  EditedMovetons edited(learned, edits, model, {});
  MovetonFrame frame;
  std::vector<std::int64_t> seen_first_frame;
  double inserted_x = 0;
  int inserted_frames = 0;
  for (std::int64_t t = 0; edited.next_frame(frame); ++t)
    for (const Moveton& moveton : frame.movetons) {
      const Base& core = frame.core_of(moveton);
      EXPECT_NE(moveton.track, 1);
      EXPECT_EQ(moveton.num_bases, 2U);
      if (moveton.track == 0) {
        EXPECT_EQ(core.x, 27.0 + static_cast<double>(t));
        EXPECT_EQ(core.y, 13);
        EXPECT_EQ(frame.bases_of(moveton)[1].x, core.x + 3);
      }
      if (moveton.track != 900) continue;
      if (inserted_frames++ == 0) {
        EXPECT_EQ(t, 5);
        EXPECT_EQ(core.x, 50);
        EXPECT_EQ(core.y, 30);
      }
      inserted_x = core.x;
    }
  EXPECT_GT(inserted_frames, 3);
  EXPECT_GT(inserted_x, 50) << "by its own velocity";
  EXPECT_EQ(edited.unseen(), std::vector<std::int64_t>{55});
}

TEST(EditedMovetons, RefusesNonsense) {
  const TexturedMotion model = three_spots();
  LearnedMovetons learned(model);
  MovetonEdits edits;
  edits.displacements = {{0, 1, 1}, {0, 2, 2}};
  EXPECT_THROW(EditedMovetons(learned, edits, model, {}), InvalidInput) << "twice";
  edits.displacements = {{0, std::nan(""), 1}};
  EXPECT_THROW(EditedMovetons(learned, edits, model, {}), InvalidInput);
  edits.displacements = {};
  edits.insertions = {{-1, {}}};
  EXPECT_THROW(EditedMovetons(learned, edits, model, {}), InvalidInput);
  edits.insertions = {{0, {1, 5, 5, 0, 0, 7}}};
  EXPECT_THROW(EditedMovetons(learned, edits, model, {}), InvalidInput) << "no such species";
  edits.insertions = {{0, {1, 5, 5, 0, 0, -1}}, {3, {1, 5, 5, 0, 0, -1}}};
  EXPECT_THROW(EditedMovetons(learned, edits, model, {}), InvalidInput) << "one number for two";
}

}  // namespace
}  // namespace motex
