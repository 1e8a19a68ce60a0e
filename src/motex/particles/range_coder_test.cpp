// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/range_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

std::vector<std::int32_t> odd_numbers() {
  std::vector<std::int32_t> numbers{
      0, 1, -1, 2, -2, 3, 4, 7, 8, 255, -256, 65535, 65536, (1 << 29) + 5, -(1 << 29) - 9};
  Rng rng(3);
  for (int k = 0; k < 5000; ++k) numbers.push_back(static_cast<std::int32_t>(std::lround(4 * rng.normal())));
  for (int k = 0; k < 300; ++k) numbers.push_back(static_cast<std::int32_t>(rng.below(1U << 29U)));
  return numbers;
}

std::string written(const std::vector<std::int32_t>& numbers) {
  RangeWriter writer;
  NumberModel model;
  for (const std::int32_t number : numbers) {
    code_number(writer, model, number);
    writer.raw(static_cast<std::uint32_t>(number) & 0x1FFU, 9);
  }
  return writer.finish();
}

TEST(RangeCoder, ReadsWhatWasWritten) {
  const std::vector<std::int32_t> numbers = odd_numbers();
  const std::string bytes = written(numbers);
  RangeReader reader(bytes, "x");
  NumberModel model;
  for (const std::int32_t number : numbers) {
    ASSERT_EQ(code_number(reader, model), number);
    ASSERT_EQ(reader.raw(0, 9), static_cast<std::uint32_t>(number) & 0x1FFU);
  }
}

TEST(RangeCoder, ComesNearTheEntropy) {
  Rng rng(5);
  RangeWriter writer;
  BitModel model;
  constexpr int kNum = 100000;
  for (int k = 0; k < kNum; ++k) writer.bit(model, rng.uniform() < 0.03);
  const double entropy = -(0.03 * std::log2(0.03) + 0.97 * std::log2(0.97)) * kNum / 8;
  EXPECT_LT(static_cast<double>(writer.finish().size()), 1.06 * entropy);
  NumberModel numbers;
  RangeWriter normal;
  for (int k = 0; k < kNum; ++k) code_number(normal, numbers, static_cast<std::int32_t>(std::lround(3 * rng.normal())));
  EXPECT_LT(static_cast<double>(normal.finish().size()), 1.05 * (2.047 + std::log2(3)) * kNum / 8);
}

TEST(RangeCoder, LongRunsOfCarriesAreRight) {
  for (int tail = 0; tail < 40; ++tail) {
    RangeWriter writer;
    BitModel likely;
    for (int k = 0; k < 500; ++k) writer.bit(likely, true);
    for (int k = 0; k < tail; ++k) writer.raw(0xFFFF, 16);
    BitModel rare;
    writer.bit(rare, true);
    const std::string bytes = writer.finish();
    RangeReader reader(bytes, "x");
    BitModel same;
    for (int k = 0; k < 500; ++k) ASSERT_TRUE(reader.bit(same));
    for (int k = 0; k < tail; ++k) ASSERT_EQ(reader.raw(0, 16), 0xFFFFU);
    BitModel last;
    ASSERT_TRUE(reader.bit(last));
  }
}

TEST(RangeCoder, CutOffBytesAreSaid) {
  const std::vector<std::int32_t> numbers = odd_numbers();
  const std::string bytes = written(numbers);
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, bytes.size() / 2}) {
    const std::string cut = bytes.substr(0, size);
    const auto read_all = [&] {
      RangeReader reader(cut, "x.mtxc", 10);
      NumberModel model;
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        code_number(reader, model);
        reader.raw(0, 9);
      }
    };
    EXPECT_THROW(read_all(), ParseError);
  }
}

}  // namespace
}  // namespace motex
