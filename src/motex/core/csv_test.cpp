// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/csv.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

using Cells = std::vector<std::string>;

Cells cells_of(const std::string& line, char separator) {
  Cells cells{"left from a longer line", "b", "c", "d", "e", "f"};
  csv_cells(line, separator, cells);
  return cells;
}

TEST(Csv, CellsOfALine) {
  EXPECT_EQ(cells_of("frame, \"x\" ,y", ','), (Cells{"frame", "x", "y"}));
  EXPECT_EQ(cells_of("1;;2,5;\r", ';'), (Cells{"1", "", "2,5", ""}));
  EXPECT_EQ(cells_of("  1   2 ", ' '), (Cells{"1", "2"}));
  EXPECT_EQ(cells_of("", ','), (Cells{""}));
  EXPECT_EQ(cells_of("\"a, \"\"b\"\"\",c", ','), (Cells{"a, \"b\"", "c"}));
  EXPECT_EQ(cells_of("\"never closed, c", ','), (Cells{"never closed, c"}));
}

TEST(Csv, WhatIsWrittenIsReadBack) {
  for (const std::string word : {"plain", "a,b", "say \"so\"", "#1", "\"", "a b"})
    EXPECT_EQ(cells_of(csv_cell(word) + "," + csv_cell(word), ','), (Cells{word, word})) << word;
  EXPECT_EQ(csv_cell("plain"), "plain");
  EXPECT_EQ(csv_cell("a\nb"), "\"a\nb\"");
}

TEST(Csv, Numbers) {
  EXPECT_EQ(rounded_text(0.123456789, 4), "0.1235");
  EXPECT_EQ(rounded_text(-1e-9, 4), "0");
  EXPECT_EQ(rounded_text(250, 6), "250");
  std::string text = "x=";
  append_number(text, 0.1);
  EXPECT_EQ(text, "x=0.1");
}

}  // namespace
}  // namespace motex
