// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/png.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

Image noise(int width, int height, bool opaque) {
  Rng rng(7);
  Image image(width, height);
  const auto byte = [&] { return static_cast<std::uint8_t>(rng.below(256)); };
  for (Rgba& p : image.pixels) p = {byte(), byte(), byte(), opaque ? std::uint8_t{255} : byte()};
  return image;
}

TEST(Png, RejectsWhatIsNoPng) {
  EXPECT_THROW(decode_png("", "x.png"), ParseError);
  EXPECT_THROW(decode_png("HIERARCHY ROOT hip, which is plain text and longer", "x.png"), ParseError);
  EXPECT_THROW(encode_png(Image()), InvalidInput);
}

TEST(Png, EveryTruncationAndAlteredByteIsNoticedOrHarmless) {
  const std::string good = encode_png(noise(9, 5, true));
  for (std::size_t n = 0; n < good.size(); ++n) EXPECT_THROW(decode_png(good.substr(0, n), "x.png"), Error) << n;
  for (std::size_t n = 0; n < good.size(); ++n) {
    std::string bad = good;
    bad[n] = static_cast<char>(bad[n] ^ 0x55);
    EXPECT_THROW(decode_png(bad, "x.png"), Error) << n;
  }
}

TEST(Png, WriteThenReadIsIdentity) {
  for (const bool opaque : {true, false}) {
    const Image image = noise(37, 23, opaque);
    const Image again = decode_png(encode_png(image), "x.png");
    EXPECT_EQ(again.width, 37);
    EXPECT_EQ(again.height, 23);
    EXPECT_EQ(again.pixels, image.pixels);
  }
}

TEST(Png, OpaquePicturesHaveThreeChannels) {
  EXPECT_EQ(encode_png(noise(4, 4, true))[25], 2);
  EXPECT_EQ(encode_png(noise(4, 4, false))[25], 6);
}

TEST(Png, GreyPicturesHaveOneChannel) {
  Image image(31, 17);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 31; ++x) {
      const auto level = static_cast<std::uint8_t>(x * x + 3 * y);
      image.at(x, y) = {level, level, level, 255};
    }
  const std::string file = encode_png(image);
  EXPECT_EQ(file[25], 0);
  EXPECT_EQ(decode_png(file, "grey.png").pixels, image.pixels);
}

TEST(Png, SmoothPicturesAreSmall) {  // no filter of rows but Paeth and Average see a slope both ways
  Image image(256, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>((x * x + y * y) / 600), static_cast<std::uint8_t>((x * y) / 300),
                        static_cast<std::uint8_t>((x + 2 * y) / 4), 255};
  EXPECT_LT(encode_png(image).size(), 24000U);
}

TEST(Png, FlatPicturesAreSmall) { EXPECT_LT(encode_png(Image(1000, 1000, {250, 250, 250, 255})).size(), 8000U); }

// 3 × 5 grey pixels whose rows use the filters none, sub, up, average and Paeth; made by hand and by zlib's own
// deflate.
TEST(Png, ReadsEveryRowFilter) {
  static constexpr unsigned char kFile[] = {
      137, 80,  78, 71,  13,  10,  26,  10,  0,  0,   0,   13,  73,  72,  68,  82,  0,  0,   0,   3,   0,   0,
      0,   5,   8,  0,   0,   0,   0,   165, 26, 9,   126, 0,   0,   0,   28,  73,  68, 65,  84,  120, 218, 99,
      224, 146, 51, 98,  212, 231, 230, 102, 82, 149, 17,  102, 246, 231, 102, 99,  81, 253, 240, 1,   0,   19,
      156, 3,   99, 159, 7,   89,  49,  0,   0,  0,   0,   73,  69,  78,  68,  174, 66, 96,  130};
  const Image image = decode_png({reinterpret_cast<const char*>(kFile), sizeof kFile}, "filters.png");
  ASSERT_EQ(image.pixels.size(), 15U);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(x, y).g, 10 + 20 * x + 37 * y - 9 * x * y) << x << ' ' << y;
}

}  // namespace
}  // namespace motex
