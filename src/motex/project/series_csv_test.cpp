// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/series_csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

void expect_error(std::string_view text, const std::string& message) {
  try {
    parse_series_csv(text, "x.csv");
    ADD_FAILURE() << "no error";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(SeriesCsv, WrongTextSaysTheLine) {
  expect_error("aspect\n1\n\n2\nthree\n", "x.csv:5: 'three' is no number");
  expect_error("1,2\n3\n", "x.csv:2: 1 cell where the first line has 2");
  expect_error("", "no number");
  expect_error("aspect\n", "no number");
  expect_error("nan\nnan\n", "no number");
  EXPECT_THROW(parse_series_csv("a,b\n1,2\n", "x.csv", {"c"}), InvalidInput);
}

TEST(SeriesCsv, OneColumnWithAndWithoutHeading) {
  for (const char* text :
       {"1\n2.5\n-3e-1\n", "aspect\r\n1\r\n\r\n2.5\r\n-0.3\r\n", "\xEF\xBB\xBF# made by hand\n+1\n2.5\n-0.3"}) {
    const SeriesTable table = parse_series_csv(text, "x.csv");
    ASSERT_EQ(table.values.rows(), 3) << text;
    EXPECT_EQ(table.values(1, 0), 2.5);
    EXPECT_EQ(table.values(2, 0), -0.3);
  }
}

TEST(SeriesCsv, ColumnsOfTextAreNoSignals) {
  const char* text = "frame,source,aspect\n0,a.mp4,0.5\n1,b.mp4,0.6\n";
  const SeriesTable table = parse_series_csv(text, "x.csv");
  EXPECT_EQ(table.names, std::vector<std::string>{"aspect"});
  EXPECT_EQ(table.values(1, 0), 0.6);
  EXPECT_EQ(parse_series_csv(text, "x.csv", {"aspect"}).values(0, 0), 0.5);
  EXPECT_THROW(parse_series_csv(text, "x.csv", {"source"}), InvalidInput);
  expect_error("aspect,b\n1,2\nthree,4\n", "x.csv:3: 'three' is no number");
}

TEST(SeriesCsv, GapsAreNaN) {
  const SeriesTable table = parse_series_csv("a;b\n1;\nNaN;2\ninf;NA\n", "x.csv");
  ASSERT_EQ(table.values.cols(), 2);
  EXPECT_TRUE(std::isnan(table.values(0, 1)) && std::isnan(table.values(1, 0)) && std::isnan(table.values(2, 0)));
  EXPECT_TRUE(std::isnan(table.values(2, 1)));
  EXPECT_EQ(table.values(1, 1), 2);
}

TEST(SeriesCsv, ColumnsByNameAndCountersLeftOut) {
  const std::string text = "frame,aspect,area\n0,1,10\n1,2,20\n";
  EXPECT_EQ(parse_series_csv(text, "x").names, (std::vector<std::string>{"aspect", "area"}));
  EXPECT_EQ(parse_series_csv(text, "x", {"area"}).values(1, 0), 20);
  EXPECT_EQ(parse_series_csv(text, "x", {"1"}).values(1, 0), 1);
  EXPECT_EQ(parse_series_csv("1 2\n3 4\n", "x").names, (std::vector<std::string>{"1", "2"}));
}

}  // namespace
}  // namespace motex
