// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/motif_pictures.h"

#include <gtest/gtest.h>

#include <variant>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Two windows, 100 and 700 of 901, that fell together three times.
PaperSearch one_cell() {
  PaperSearch search;
  search.window = 50;
  search.num_windows = 901;
  search.found.collisions = {{5, {}}, {20, {{100, 700, 3}}}};
  return search;
}

const Image& map_of(const Drawing& drawing, std::size_t idx) {
  std::vector<const Image*> maps;
  for (const Shape& shape : drawing.shapes)
    if (const auto* picture = std::get_if<Picture>(&shape); picture != nullptr && picture->image.width > 1)
      maps.push_back(&picture->image);
  return *maps.at(idx);
}

TEST(MotifPictures, CollisionsStandOnBothSidesOfTheDiagonal) {
  const Drawing drawing = draw_collisions({one_cell()});
  const Image &before = map_of(drawing, 0), &after = map_of(drawing, 1);
  ASSERT_EQ(after.width, 129);  // seven windows a cell
  for (int y = 0; y < after.height; ++y)
    for (int x = 0; x < after.width; ++x) {
      const bool is_cell = (x == 100 && y == 14) || (x == 14 && y == 100);
      EXPECT_EQ(after.at(x, y) == before.at(x, y), !is_cell) << x << " " << y;
    }
  EXPECT_THROW(draw_collisions({}), InvalidInput);
}

TEST(MotifPictures, ASeriesWithoutMotifsShowsItsCollisionsOnly) {
  const Signal signal{"1", "", std::vector<double>(950, 0)};
  EXPECT_THROW(draw_series_page({}, signal), InvalidInput);
  const double height = draw_series_page({}, signal, {one_cell()}).height;
  MotifSet set;
  set.motifs.resize(1);
  set.motifs[0].letter = "A";
  set.motifs[0].occurrences = {{100, 50, 0}, {700, 50, 0.1}};
  set.motifs[0].exemplar = 100;
  EXPECT_GT(draw_series_page(set, signal, {one_cell()}).height, height + 100);
}

}  // namespace
}  // namespace motex
