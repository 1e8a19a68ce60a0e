// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/planes.h"
#include "motex/image/png.h"
#include "motex/video_io/video_reader.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed afterwards.
class VideoIo : public testing::Test {
 protected:
  VideoIo() {
    folder_ = fs::temp_directory_path() /
              ("motex_video_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    job_.on_warning = [this](const std::string& warning) { warnings_.push_back(warning); };
  }
  ~VideoIo() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::vector<Image>& frames, WriteVideoOptions options = {},
                 const std::vector<double>& times = {}) {
    const fs::path path = folder_ / name;
    VideoWriter writer(path, frames[0].width, frames[0].height, options);
    for (std::size_t i = 0; i < frames.size(); ++i)
      times.empty() ? writer.write(frames[i]) : writer.write(frames[i], times[i]);
    writer.finish();
    return path;
  }
  std::vector<VideoFrame> read(const fs::path& path) {
    VideoReader reader(path, {}, job_);
    std::vector<VideoFrame> frames;
    for (VideoFrame frame; reader.next(frame);) frames.push_back(frame);
    return frames;
  }
  std::string error_of(const fs::path& path) {
    try {
      read(path);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
  JobContext job_;
  std::vector<std::string> warnings_;
};

/// A coloured disc that moves over a gradient; alpha falls off from the disc's centre.
std::vector<Image> moving_disc(int num_frames, int width, int height) {
  std::vector<Image> frames;
  for (int t = 0; t < num_frames; ++t) {
    Image frame(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double distance = std::hypot(x - width * 0.3 - 2 * t, y - height * 0.5);
        const auto falling = static_cast<std::uint8_t>(std::max(0.0, 255 - 9 * distance));
        frame.at(x, y) = distance < height * 0.25 ? Rgba{220, 60, 40, falling}
                                                  : Rgba{static_cast<std::uint8_t>(x * 200 / width),
                                                         static_cast<std::uint8_t>(y * 200 / height), 90, falling};
      }
    frames.push_back(frame);
  }
  return frames;
}

Image opaque(Image image) {
  for (Rgba& pixel : image.pixels) pixel.a = 255;
  return image;
}

double worst_psnr(const std::vector<Image>& wanted, const std::vector<VideoFrame>& got) {
  double worst = 1e9;
  for (std::size_t i = 0; i < wanted.size(); ++i) worst = std::min(worst, psnr(wanted[i], got.at(i).image));
  return worst;
}

void expect_alpha_kept(const std::vector<Image>& wanted, const std::vector<VideoFrame>& got, int tolerance) {
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t k = 0; k < wanted[i].pixels.size(); ++k)
      ASSERT_NEAR(wanted[i].pixels[k].a, got.at(i).image.pixels[k].a, tolerance) << "frame " << i << " pixel " << k;
}

TEST_F(VideoIo, TextIsNoVideo) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "is empty"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "run git lfs pull"},
      {"<!DOCTYPE html><html></html>", "is a web page"},
      {"just words\n", "is a text file"},
      {std::string("\0\1\2\3 no video at all", 20), "is no video"},
  };
  for (const auto& [bytes, complaint] : cases) {
    write_file(folder_ / "x.mp4", bytes);
    EXPECT_NE(error_of(folder_ / "x.mp4").find(complaint), std::string::npos) << error_of(folder_ / "x.mp4");
  }
  EXPECT_NE(error_of(folder_ / "missing.mp4").find("cannot be read"), std::string::npos);
  fs::create_directory(folder_ / "no_pictures");
  EXPECT_NE(error_of(folder_ / "no_pictures").find("no pictures"), std::string::npos);
}

TEST_F(VideoIo, APlaylistOpensNothing) {
  write("seen.mkv", moving_disc(3, 32, 32));
  write_file(folder_ / "list.mp4", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nseen.mkv\n");
  write_file(folder_ / "list.avi", std::string("\x7f"
                                               "ffconcat version 1.0\nfile seen.mkv\n"));
  EXPECT_NE(error_of(folder_ / "list.mp4"), "");
  EXPECT_NE(error_of(folder_ / "list.avi"), "");
}

TEST_F(VideoIo, Ffv1IsExact) {
  for (const auto& [width, height] : {std::pair{64, 48}, {33, 17}, {1, 1}}) {
    const std::vector<Image> frames = moving_disc(5, width, height);
    const std::vector<VideoFrame> with_alpha = read(write("a.mkv", frames, {.alpha = true}));
    const std::vector<VideoFrame> without = read(write("b.mkv", frames));
    ASSERT_EQ(with_alpha.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(with_alpha[i].image.pixels, frames[i].pixels);
      EXPECT_EQ(without[i].image.pixels, opaque(frames[i]).pixels);
      EXPECT_NEAR(with_alpha[i].time_secs, static_cast<double>(i) / 25, 1e-9);
    }
  }
}

TEST_F(VideoIo, LossyFormatsComeClose) {
  const std::vector<Image> frames = moving_disc(12, 96, 64);
  const std::vector<std::pair<std::string, double>> floors{{"x.mp4", 30}, {"x.webm", 30}, {"x.mov", 40}, {"x.avi", 36}};
  for (const auto& [name, floor] : floors) {
    const std::vector<VideoFrame> got = read(write(name, frames));
    ASSERT_EQ(got.size(), frames.size()) << name;
    EXPECT_GT(worst_psnr(frames, got), floor) << name;
    EXPECT_TRUE(is_opaque(got[0].image)) << name;
    EXPECT_NEAR(got[11].time_secs, 11.0 / 25, 6e-4) << name;
  }
}

TEST_F(VideoIo, FlatColoursKeepTheirValue) {
  for (const Rgba colour :
       {Rgba{255, 0, 0, 255}, Rgba{0, 255, 0, 255}, Rgba{16, 16, 16, 255}, Rgba{255, 255, 255, 255}})
    for (const char* name : {"x.mp4", "x.webm", "x.mov", "x.avi"}) {
      const Rgba got = read(write(name, {3, Image(32, 32, colour)})).at(1).image.at(16, 16);
      EXPECT_NEAR(got.r, colour.r, 3) << name;
      EXPECT_NEAR(got.g, colour.g, 3) << name;
      EXPECT_NEAR(got.b, colour.b, 3) << name;
    }
}

/// Means over the middle of a picture of B less a ramp in x, and of R less a ramp in y.
std::array<double, 2> offsets_of_ramps(const Image& image, double per_pixel) {
  std::array<double, 2> beyond{};
  const int reach = image.width / 4;
  for (int i = -reach; i < reach; ++i)
    for (int k = -reach; k < reach; ++k) {
      const Rgba& p = image.at(image.width / 2 + i, image.height / 2 + k);
      beyond[0] += p.b - per_pixel * (image.width / 2 + i), beyond[1] += p.r - per_pixel * (image.height / 2 + k);
    }
  for (double& sum : beyond) sum /= 4.0 * reach * reach;
  return beyond;
}

TEST_F(VideoIo, SamplesOfColourLieWhereTheFileSays) {
  constexpr int kSize = 32;
  std::string ramps(kSize * kSize, '\x7d');
  for (int y = 0; y < kSize / 2; ++y)
    for (int x = 0; x < kSize / 2; ++x) ramps += static_cast<char>(96 + 4 * x);
  for (int y = 0; y < kSize / 2; ++y)
    for (int x = 0; x < kSize / 2; ++x) ramps += static_cast<char>(96 + 4 * y);
  const auto begin_of = [&](const std::string& colours, double of_blue, double of_red) {
    write_file(folder_ / "x.y4m", "YUV4MPEG2 W32 H32 F25:1 Ip A1:1 " + colours + "\nFRAME\n" + ramps);
    const Image image = read(folder_ / "x.y4m").at(0).image;
    return std::array{offsets_of_ramps(image, 2 * of_blue)[0], offsets_of_ramps(image, 2 * of_red)[1]};
  };
  constexpr double kOfBlue = 2.017, kOfRed = 1.596;  // levels of B and R a level of Cb and Cr, BT.601
  const std::array<double, 2> middle = begin_of("C420jpeg", kOfBlue, kOfRed),
                              left = begin_of("C420mpeg2", kOfBlue, kOfRed),
                              top_left = begin_of("C420paldv", kOfBlue, kOfRed);
  EXPECT_NEAR(left[0] - middle[0], kOfBlue, 0.3);  // half a pixel, two levels of Cb a pixel
  EXPECT_NEAR(left[1] - middle[1], 0, 0.3);
  EXPECT_NEAR(top_left[0] - middle[0], kOfBlue, 0.3);
  EXPECT_NEAR(top_left[1] - middle[1], kOfRed, 0.3);
}

TEST_F(VideoIo, ColoursStayInTheirPlace) {
  Image ramp(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      ramp.at(x, y) = {static_cast<std::uint8_t>(4 * y), 120, static_cast<std::uint8_t>(4 * x), 255};
  for (const char* name : {"x.mp4", "x.webm"}) {
    const std::array<double, 2> wanted = offsets_of_ramps(ramp, 4),
                                got = offsets_of_ramps(read(write(name, {3, ramp})).at(1).image, 4);
    EXPECT_NEAR(got[0], wanted[0], 0.7) << name;  // half a pixel is 2
    EXPECT_NEAR(got[1], wanted[1], 0.7) << name;
  }
}

TEST_F(VideoIo, TheShapeOfPixelsIsKept) {
  for (const char* name : {"x.mp4", "x.mov", "x.mkv", "x.webm"}) {
    write(name, moving_disc(3, 64, 48), {.pixel_aspect = 4.0 / 3});
    const VideoInfo info = VideoReader(folder_ / name).info();
    EXPECT_NEAR(info.pixel_aspect, 4.0 / 3, 0.01) << name;  // Matroska keeps whole pixels
    std::string warning;
    JobContext job;
    job.on_warning = [&](const std::string& text) { warning = text; };
    warn_of_oblong_pixels(info, job);
    EXPECT_NE(warning.find("85 × 48"), std::string::npos) << warning;
  }
  EXPECT_THROW(write("x.mp4", moving_disc(3, 64, 48), {.pixel_aspect = 0}), InvalidInput);
}

TEST_F(VideoIo, AlphaIsKept) {
  const std::vector<Image> frames = moving_disc(4, 64, 48);
  expect_alpha_kept(frames, read(write("x.mov", frames, {.alpha = true})), 0);
  expect_alpha_kept(frames, read(write("x.webm", frames, {.alpha = true})), 24);
  expect_alpha_kept(frames, read(write("pictures", frames, {.alpha = true})), 0);
  EXPECT_THROW(write("x.mp4", frames, {.alpha = true}), InvalidInput);
  EXPECT_THROW(write("x.avi", frames, {.alpha = true}), InvalidInput);
}

TEST_F(VideoIo, VariableFrameRatesAreRight) {
  const std::vector<double> times{0, 0.04, 0.08, 0.28, 0.32, 2.4, 2.44, 2.48};
  const std::vector<Image> frames = moving_disc(8, 48, 32);
  for (const char* name : {"x.mp4", "x.mkv", "x.webm", "x.mov", "x.avi"}) {
    const fs::path path = write(name, frames, {}, times);
    const std::vector<VideoFrame> got = read(path);
    const std::vector<double> listed = VideoReader(path).frame_times();
    ASSERT_EQ(got.size(), times.size()) << name;
    ASSERT_EQ(listed.size(), times.size()) << name;
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(got[i].time_secs, times[i], 1e-6) << name;
      EXPECT_NEAR(listed[i], times[i], 1e-6) << name;
    }
    VideoReader reader(path);
    VideoFrame frame;
    reader.seek_secs(1.0);
    ASSERT_TRUE(reader.next(frame));
    EXPECT_EQ(frame.idx, 4) << name;
  }
  EXPECT_THROW(write("x.avi", frames, {}, {0, 0.05, 0.08, 1, 2, 3, 4, 5}), InvalidInput);
  EXPECT_THROW(write("y.mkv", frames, {}, {0, 0.04, 0.04, 1, 2, 3, 4, 5}), InvalidInput);
}

TEST_F(VideoIo, SeekingGivesTheSameFrameAsReading) {
  const std::vector<Image> frames = moving_disc(40, 48, 32);
  for (const char* name : {"x.mp4", "x.mkv", "x.webm", "x.avi", "pictures"}) {
    const fs::path path = write(name, frames);
    const std::vector<VideoFrame> in_order = read(path);
    VideoReader reader(path);
    VideoFrame frame;
    for (const int idx : {39, 0, 17, 18, 25, 25, 39, 3, 5}) {
      reader.seek(idx);
      ASSERT_TRUE(reader.next(frame)) << name;
      EXPECT_EQ(frame.idx, idx) << name;
      EXPECT_EQ(frame.image.pixels, in_order[static_cast<std::size_t>(idx)].image.pixels) << name << " " << idx;
    }
    reader.seek(40);
    EXPECT_FALSE(reader.next(frame)) << name;
  }
}

TEST_F(VideoIo, PreviewsAreMeansOfTheFrame) {
  const std::vector<Image> frames = moving_disc(3, 96, 64);
  for (const char* name : {"x.mkv", "pictures"}) {
    VideoReader reader(write(name, frames));
    VideoFrame frame;
    Image preview;
    ASSERT_TRUE(reader.advance());
    ASSERT_TRUE(reader.advance());
    reader.read_preview(preview, 24, 16);
    reader.read(frame);
    EXPECT_EQ(frame.idx, 1) << name;
    EXPECT_EQ(frame.image.width, 96) << name;
    const auto mean_green = [](const Image& image) {
      double sum = 0;
      for (const Rgba& pixel : image.pixels) sum += pixel.g;
      return sum / static_cast<double>(image.pixels.size());
    };
    EXPECT_NEAR(mean_green(preview), mean_green(frames[1]), 1) << name;
    EXPECT_TRUE(preview.width == 96 || preview.width == 24) << name;
    ASSERT_TRUE(reader.next(frame));
    EXPECT_EQ(frame.idx, 2) << name;
  }
}

TEST_F(VideoIo, OddSizesAreWritten) {
  for (const char* name : {"x.mp4", "x.webm", "x.mov", "x.mkv", "x.avi"}) {
    const std::vector<VideoFrame> got = read(write(name, moving_disc(3, 33, 17)));
    ASSERT_EQ(got.size(), 3U) << name;
    EXPECT_EQ(got[0].image.width, 33) << name;
    EXPECT_EQ(got[0].image.height, 17) << name;
  }
}

TEST_F(VideoIo, WhatIsLeftOfATruncatedFileIsUsed) {
  const fs::path whole = write("whole.mkv", moving_disc(30, 64, 48));
  const std::string bytes = read_file(whole);
  write_file(folder_ / "cut.mkv", bytes.substr(0, bytes.size() / 2));
  warnings_.clear();
  const std::size_t num_read = read(folder_ / "cut.mkv").size();
  EXPECT_GT(num_read, 5U);
  EXPECT_LT(num_read, 25U);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find(std::to_string(num_read) + " "), std::string::npos) << warnings_[0];

  const std::string mp4 = read_file(write("whole.mp4", moving_disc(30, 64, 48)));
  write_file(folder_ / "cut.mp4", mp4.substr(0, mp4.size() / 2));
  EXPECT_NE(error_of(folder_ / "cut.mp4").find("moov"), std::string::npos);
}

TEST_F(VideoIo, DamagedFilesNeverCrash) {
  const std::vector<Image> frames = moving_disc(6, 48, 32);
  for (const char* name : {"x.mp4", "x.mkv", "x.webm", "x.avi", "x.mov"}) {
    const std::string bytes = read_file(write(name, frames));
    for (std::size_t seed = 0; seed < 30; ++seed) {
      std::string damaged = bytes;
      for (std::size_t k = 0; k < 12; ++k)
        damaged[(seed * 7919 + k * 104729) % damaged.size()] ^= static_cast<char>(1 + k * 37);
      try {
        VideoReader reader = VideoReader::from_bytes(damaged, name);
        std::size_t num_read = 0;
        for (VideoFrame frame; num_read < 100 && reader.next(frame);) ++num_read;
      } catch (const Error&) {
      }
    }
  }
}

TEST_F(VideoIo, PicturesInTheOrderOfTheirNumbers) {
  const std::vector<Image> frames = moving_disc(12, 20, 10);
  for (std::size_t i = 0; i < frames.size(); ++i)
    write_file(folder_ / ("f_" + std::to_string(i + 1) + ".png"), encode_png(opaque(frames[i])));
  write_file(folder_ / "notes.txt", "not a picture");
  fs::remove(folder_ / "f_5.png");
  for (const fs::path& path : {folder_, folder_ / "f_%d.png", folder_ / "f_*.png"}) {
    warnings_.clear();
    const std::vector<VideoFrame> got = read(path);
    ASSERT_EQ(got.size(), 11U);
    EXPECT_EQ(got[10].image.pixels, opaque(frames[11]).pixels);
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_NE(warnings_[0].find("(the first is 5)"), std::string::npos) << warnings_[0];
  }
  write_file(folder_ / "f_5.png", encode_png(Image(3, 3)));
  EXPECT_NE(error_of(folder_).find("f_5.png"), std::string::npos);
  EXPECT_EQ(read(folder_ / "f_7.png").size(), 1U);
}

/// Uncompressed 16-bit grey pages, written by hand.
std::string tiff_of(const std::vector<std::vector<std::uint16_t>>& pages, std::uint16_t width, std::uint16_t height) {
  std::string bytes("II*\0\0\0\0\0", 8);
  const auto put = [&bytes](std::uint32_t value, int size) {
    for (int k = 0; k < size; ++k) bytes += static_cast<char>(value >> 8 * k & 255);
  };
  std::size_t link = 4;
  for (const auto& page : pages) {
    const auto data = static_cast<std::uint32_t>(bytes.size());
    for (const std::uint16_t value : page) put(value, 2);
    const auto directory = static_cast<std::uint32_t>(bytes.size());
    for (std::size_t k = 0; k < 4; ++k) bytes[link + k] = static_cast<char>(directory >> 8 * k & 255);
    const std::pair<int, std::uint32_t> tags[] = {
        {256, width}, {257, height}, {258, 16},
        {259, 1},     {262, 1},      {273, data},
        {277, 1},     {278, height}, {279, 2U * static_cast<std::uint32_t>(page.size())}};
    put(9, 2);
    for (const auto& [tag, value] : tags) put(static_cast<std::uint32_t>(tag), 2), put(4, 2), put(1, 4), put(value, 4);
    link = bytes.size();
    put(0, 4);
  }
  return bytes;
}

TEST_F(VideoIo, PicturesWithoutCompression) {
  write_file(folder_ / "f_0.pgm", std::string("P5\n3 2\n255\n") + "ABCabc");
  write_file(folder_ / "f_1.pgm", std::string("P5\n3 2\n255\n") + "DEFdef");
  const std::vector<VideoFrame> got = read(folder_);
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[1].image.at(2, 0), (Rgba{'F', 'F', 'F', 255}));
}

TEST_F(VideoIo, TiffStacksKeepSixteenBits) {
  std::vector<std::vector<std::uint16_t>> pages(5, std::vector<std::uint16_t>(8 * 6));
  for (std::size_t t = 0; t < pages.size(); ++t)
    for (std::size_t i = 0; i < pages[t].size(); ++i) pages[t][i] = static_cast<std::uint16_t>(1000 * t + 257 * i + 3);
  write_file(folder_ / "stack.tif", tiff_of(pages, 8, 6));
  VideoReader reader(folder_ / "stack.tif");
  EXPECT_EQ(reader.info().num_channels, 1);
  EXPECT_EQ(reader.info().bit_depth, 16);
  DeepVideoFrame frame;
  for (std::size_t t = 0; t < pages.size(); ++t) {
    ASSERT_TRUE(reader.next(frame));
    ASSERT_EQ(frame.planes.size(), 1U);
    for (std::size_t i = 0; i < pages[t].size(); ++i)
      ASSERT_NEAR(frame.planes[0].values[i] * 257, pages[t][i], 0.01) << "page " << t;
  }
  EXPECT_FALSE(reader.next(frame));
  reader.seek(2);
  ASSERT_TRUE(reader.next(frame));
  EXPECT_NEAR(frame.planes[0].values[0] * 257, 2003, 0.01);
  const std::string bytes = read_file(folder_ / "stack.tif");
  write_file(folder_ / "cut.tif", bytes.substr(0, bytes.size() * 7 / 10));
  EXPECT_LT(read(folder_ / "cut.tif").size(), 5U);
}

TEST_F(VideoIo, NothingAppearsBeforeTheEnd) {
  const Image frame(32, 32, {10, 20, 30, 255});
  for (const char* name : {"x.mp4", "x.mkv", "pictures"}) {
    {
      VideoWriter writer(folder_ / name, 32, 32);
      writer.write(frame);
      EXPECT_THROW(writer.write(Image(16, 16)), InvalidInput);
    }
    EXPECT_TRUE(fs::is_empty(folder_)) << name;
  }
  std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(VideoWriter(folder_ / "x.mp4", 32, 32, {}, job).write(frame), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_THROW(VideoWriter(folder_ / "x.mp4", 32, 32).finish(), InvalidInput);
  EXPECT_THROW(VideoWriter(folder_ / "x.xyz", 32, 32), UnsupportedFile);
  EXPECT_THROW(VideoWriter(folder_ / "x.mp4", 0, 32), InvalidInput);
}

TEST_F(VideoIo, TheSameFramesGiveTheSameBytes) {
  const std::vector<Image> frames = moving_disc(8, 64, 48);
  for (const char* name : {"x.mp4", "x.webm", "x.mov", "x.mkv", "x.avi"}) {
    const std::string first = read_file(write(name, frames));
    EXPECT_EQ(first, read_file(write(name, frames))) << name;
  }
}

TEST_F(VideoIo, ReadingCanBeCancelled) {
  const fs::path path = write("x.mkv", moving_disc(10, 32, 32));
  std::atomic<bool> cancel{false};
  JobContext job;
  job.cancel = &cancel;
  VideoReader reader(path, {}, job);
  VideoFrame frame;
  ASSERT_TRUE(reader.next(frame));
  cancel = true;
  EXPECT_THROW(
      {
        while (reader.next(frame)) {
        }
      },
      Cancelled);
}

}  // namespace
}  // namespace motex
