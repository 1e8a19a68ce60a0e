// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/clip_io.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>

#include "motex/core/files.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/npz.h"
#include "motex/motion_io/tables.h"

namespace motex {
namespace {

namespace fs = std::filesystem;
const fs::path kMocap = fs::path(MOTEX_TEST_DATA) / "mocap";
const fs::path kReference = kMocap / "synthetic" / "ok_reference.bvh";

class ClipIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              (std::string("motex_clip_io_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

template <typename Error>
void expect_refused(const std::string& bytes, const std::string& name, const std::string& part) {
  try {
    read_clip_bytes(bytes, name);
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST_F(ClipIo, UnreadableKindsAreNamed) {
  expect_refused<InvalidInput>("Kaydara FBX Binary  ", "a.fbx", "a.fbx");
  expect_refused<InvalidInput>("; FBX 7.4.0 project file", "a.bvh", "FBX");
  expect_refused<UnsupportedFile>("anything", "a.C3D", "is a C3D file");
  expect_refused<UnsupportedFile>("PathFileType\t4", "a.txt", "is a TRC file");
  expect_refused<UnsupportedFile>("PK\x03\x04", "a.bvh", "is a zip or NPZ file");
  expect_refused<UnsupportedFile>("\x89MOTEX\r\n", "a.bvh", "is a motex model, not a clip");
  expect_refused<UnsupportedFile>(":version 1.1", "a.asf", "name the .amc");
  expect_refused<UnsupportedFile>("hello", "a.txt", "is of no known kind");
  expect_refused<ParseError>("hello", "a.bvh", "not a BVH file");
  expect_refused<ParseError>("{\"a\": 1}", "a.bvh", "not a BVH file");
  expect_refused<ParseError>("", "a.bvh", "empty");
  expect_refused<InvalidInput>(":DEGREES\n1\n", "a.amc", "--asf");
  EXPECT_THROW(read_clip(folder_ / "missing.bvh"), InvalidInput);
  EXPECT_THROW(read_clip(folder_), InvalidInput);
}

TEST_F(ClipIo, ContentCountsMoreThanTheName) {
  const Clip clip = read_clip(kReference);
  write_file(folder_ / "liar.bvh", write_glb_bytes(clip));
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  EXPECT_EQ(read_clip(folder_ / "liar.bvh", {}, job).num_frames(), 30);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("holds glTF"), std::string::npos);
  EXPECT_EQ(read_clip_bytes(read_file(kReference), "stdin").num_frames(), 30);  // no extension
}

TEST_F(ClipIo, Options) {
  ReadClipOptions options;
  options.fps = 30;
  options.skip_frames = 10;
  options.resample = 15;
  options.unit = LengthUnit::kInch;
  const Clip all = read_clip(kReference), clip = read_clip(kReference, options);
  EXPECT_EQ(all.name, "ok_reference");
  EXPECT_EQ(clip.num_frames(), 10);
  EXPECT_DOUBLE_EQ(clip.frame_time_secs, 1.0 / 15);
  EXPECT_EQ(clip.skeleton.metres_per_unit, 0.0254);
  EXPECT_EQ(clip.translation(1, 0), all.translation(12, 0));
  options.skip_frames = 30;
  EXPECT_THROW(read_clip(kReference, options), InvalidInput);
  options.skip_frames = -1;
  EXPECT_THROW(read_clip(kReference, options), InvalidInput);
}

TEST_F(ClipIo, ZUpTurnsTheWholeWorld) {
  ReadClipOptions z_up;
  z_up.up = UpAxis::kZ;
  const Clip clip = read_clip(kReference), turned = read_clip(kReference, z_up);
  const FrameMatrix before = world_positions(clip), after = world_positions(turned);
  for (Index t = 0; t < clip.num_frames(); ++t)
    for (Index p = 0; p < before.cols(); p += 3) {
      EXPECT_NEAR(after(t, p), before(t, p), 1e-9);
      EXPECT_NEAR(after(t, p + 1), before(t, p + 2), 1e-9);
      EXPECT_NEAR(after(t, p + 2), -before(t, p + 1), 1e-9);
    }
  const auto& channels = turned.skeleton.joints[1].channels;
  EXPECT_EQ(channels, (std::vector<Channel>{Channel::kYRotation, Channel::kXRotation, Channel::kZRotation}));
}

TEST_F(ClipIo, WritesByExtension) {
  const Clip clip = read_clip(kReference);
  for (const std::string& extension : writable_clip_extensions()) {
    const fs::path path = folder_ / ("clip" + extension);
    write_clip(path, clip);
    EXPECT_GT(fs::file_size(path), 100U) << extension;
  }
  for (const char* extension : {".bvh", ".glb"})
    EXPECT_EQ(read_clip(folder_ / (std::string("clip") + extension)).num_frames(), 30);
  write_clip(folder_ / "LOUD.BVH", clip);
  EXPECT_THROW(write_clip(folder_ / "clip.fbx", clip), UnsupportedFile);
  EXPECT_THROW(check_clip_extension("clip"), UnsupportedFile);
  EXPECT_THROW(write_clip(folder_ / "missing" / "clip.bvh", clip), InvalidInput);
  EXPECT_FALSE(fs::exists(folder_ / "clip.fbx"));
}

TEST_F(ClipIo, CsvColumns) {
  Clip clip = read_clip(kReference);
  clip.skeleton.joints[1].name = "a,\"b\"";
  const std::string text = write_csv_bytes(clip);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "frame,time,Hips.Xposition,Hips.Yposition,Hips.Zposition,Hips.Zrotation,Hips.Xrotation,Hips.Yrotation,"
            "\"a,\"\"b\"\".Zrotation\",\"a,\"\"b\"\".Xrotation\",\"a,\"\"b\"\".Yrotation\"");
  EXPECT_NE(text.find("\n2,0.0333334,2,90.3894,0,1.4092,0,2.204,0,7.1914,0\n"), std::string::npos)
      << text.substr(0, 600);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 31);
}

// The first array of a zip as its .npy header and its elements.
std::pair<std::string, std::string> first_npy(const std::string& zip) {
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    std::memcpy(&value, zip.data() + at, size);
    return value;
  };
  EXPECT_EQ(number(0, 4), 0x04034b50U);
  std::string npy(number(22, 4), '\0');
  const std::size_t start = 30 + number(26, 2);
  if (number(8, 2) == 0) {
    npy = zip.substr(start, npy.size());
  } else {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zip.data() + start));
    stream.avail_in = number(18, 4);
    stream.next_out = reinterpret_cast<Bytef*>(npy.data());
    stream.avail_out = static_cast<uInt>(npy.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    inflateEnd(&stream);
  }
  EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(npy.data()), static_cast<uInt>(npy.size())), number(14, 4));
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
  const std::size_t header = 10 + static_cast<unsigned char>(npy[8]) + 256U * static_cast<unsigned char>(npy[9]);
  EXPECT_EQ(header % 64, 0U);
  return {npy.substr(10, header - 10), npy.substr(header)};
}

TEST(Npz, Arrays) {
  NpzWriter doubles, names, ints, scalar;
  FrameMatrix m(2, 3);
  m << 1, 2, 3, 4, 5, 6;
  doubles.add("m", m);
  auto [header, data] = first_npy(doubles.bytes());
  EXPECT_EQ(header.find("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,), }"), 0U) << header;
  double last = 0;
  std::memcpy(&last, data.data() + 40, 8);
  EXPECT_EQ(last, 6);
  names.add("n", std::vector<std::string>{"hip",
                                          "f\xC3\xBC\xC3\x9F"
                                          "e"});
  std::tie(header, data) = first_npy(names.bytes());
  EXPECT_EQ(header.find("{'descr': '<U4', 'fortran_order': False, 'shape': (2,), }"), 0U) << header;
  EXPECT_EQ(data.size(), 32U);
  EXPECT_EQ(data.substr(20, 4), std::string("\xFC\0\0\0", 4));
  scalar.add("s", 1.5);
  EXPECT_EQ(first_npy(scalar.bytes()).first.find("{'descr': '<f8', 'fortran_order': False, 'shape': (), }"), 0U);
  EXPECT_THROW(scalar.add("s", 2.0), InvalidInput);
  const Index wrong[] = {4};
  EXPECT_THROW(ints.add("i", std::vector<double>{1, 2, 3}, wrong), InvalidInput);
}

TEST(ReadClip, ABodyThatLiesAlongZGetsAHint) {
  const std::string folder = std::string(MOTEX_TEST_DATA) + "/mocap/quickstart/";
  const Clip standing = read_clip(folder + "salsa_cmu61_10.bvh", {}, {});
  EXPECT_FALSE(looks_z_up(standing));
  ReadClipOptions turn;
  turn.up = UpAxis::kZ;
  // Turned although it stood: now it lies along z.
  EXPECT_TRUE(looks_z_up(read_clip(folder + "salsa_cmu61_10.bvh", turn, {})));
}

}  // namespace
}  // namespace motex
