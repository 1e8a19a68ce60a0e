// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <numbers>

#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"

namespace motex {
namespace {

const std::filesystem::path kMocap = std::filesystem::path(MOTEX_TEST_DATA) / "mocap";

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  const std::size_t place = text.find(old);
  EXPECT_NE(place, text.npos) << old;
  return place == text.npos ? text : text.replace(place, old.size(), now);
}

std::string base64(const std::vector<float>& values) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes(values.size() * 4, '\0'), out;
  std::memcpy(bytes.data(), values.data(), bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (int k = 3; k >= 0; --k)
      out += i + static_cast<std::size_t>(3 - k) > bytes.size() ? '=' : kDigits[bits >> (6 * k) & 63];
  }
  return out;
}

// A fixed, turned and shrunk holder above two joints; keys of the lower one at 0, 1/4 and 1 s.
std::string small_gltf(const std::string& interpolation, const std::vector<float>& moves) {
  std::vector<float> data{0, 0.25F, 1};
  data.insert(data.end(), moves.begin(), moves.end());
  const std::string count = std::to_string(moves.size() / 3), bytes = std::to_string(data.size() * 4);
  return R"({"asset":{"version":"2.0"},"nodes":[{"name":"tip","translation":[0,2,0]},{"name":"base","children":[0]},
{"name":"holder","children":[1],"rotation":[0.70710678118,0,0,0.70710678118],"scale":[0.5,0.5,0.5]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},
{"sampler":1,"target":{"node":1,"path":"rotation"}}],
"samplers":[{"input":0,"output":1,"interpolation":")" +
         interpolation + R"("},{"input":2,"output":3}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
{"bufferView":0,"byteOffset":12,"componentType":5126,"count":)" +
         count + R"(,"type":"VEC3"},
{"bufferView":0,"componentType":5126,"count":1,"type":"SCALAR"},
{"bufferView":1,"componentType":5122,"normalized":true,"count":1,"type":"VEC4"}],
"bufferViews":[{"buffer":0,"byteLength":)" +
         bytes + R"(},{"buffer":1,"byteLength":8}],
"buffers":[{"byteLength":)" +
         bytes + R"(,"uri":"data:application/octet-stream;base64,)" + base64(data) +
         R"("},{"byteLength":8,"uri":"data:;base64,AAAAAAAA/38="}]})";
}

const std::vector<float> kMoves{0, 2, 0, 4, 2, 0, 1, 2, 0};

void expect_error(const std::string& bytes, const std::string& part) {
  try {
    read_gltf_bytes(bytes, "x.gltf");
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(GltfRead, Errors) {
  const std::string good = small_gltf("LINEAR", kMoves);
  const auto broken = [&](const std::string& old, const std::string& now) { return replaced(good, old, now); };
  EXPECT_NO_THROW(read_gltf_bytes(good, "x.gltf"));
  expect_error("", "byte 1: the JSON is broken");
  expect_error("{\"a\":", "the JSON is broken");
  expect_error("[1]", "no 'asset'");
  expect_error(broken("[0,2,0]", "[0,2e999,0]"), "beyond any range");
  expect_error(broken("\"2.0\"", "\"1.0\""), "version 2 is read");
  expect_error(broken("\"children\":[1]", "\"children\":[7]"), "index into 'nodes'");
  expect_error(broken("\"children\":[1]", "\"children\":[0]"), "two parents");
  expect_error(broken("\"children\":[1]", "\"children\":[2]"), "own ancestors");
  expect_error(broken("\"sampler\":1", "\"sampler\":2"), "index into 'samplers'");
  expect_error(broken("\"node\":1", "\"node\":-1"), "index into 'nodes'");
  expect_error(broken("\"input\":0", "\"input\":9"), "index into 'accessors'");
  expect_error(broken("\"input\":0", "\"input\":\"a\""), "index into 'accessors'");
  expect_error(broken("\"byteOffset\":12", "\"byteOffset\":16"), "beyond its buffer");
  expect_error(broken("\"byteOffset\":12", "\"byteOffset\":18446744073709551600"), "beyond its buffer");
  expect_error(broken("\"count\":3", "\"count\":4294967295"), "beyond its buffer");
  expect_error(broken("\"count\":3", "\"count\":2"), "2 times and 3 values");
  expect_error(broken("\"byteOffset\":12", "\"sparse\":{}"), "sparse");
  expect_error(broken("\"type\":\"VEC3\"", "\"type\":\"VEC4\""), "not of type VEC3");
  expect_error(broken("\"componentType\":5122", "\"componentType\":5130"), "accessors of type 5130");
  expect_error(broken("base64,AAAA", "base64,*AAA"), "base64 text is broken");
  expect_error(broken("data:;base64,AAAAAAAA/38=", "a.bin"), "in another file, 'a.bin'");
  expect_error(broken("\"asset\"", "\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"asset\""), "compressed");
  expect_error(broken("\"animations\"", "\"no_animations\""), "holds no animation");
  expect_error(broken("[0,2,0]", "[0,2]"), "wrong number of values");
  expect_error(small_gltf("LINEAR", {0, 0, 0, 1, std::numeric_limits<float>::infinity(), 0, 0, 0, 0}), "not finite");
}

TEST(GltfRead, BrokenContainers) {
  const std::string glb = write_glb_bytes(read_bvh(kMocap / "synthetic" / "ok_reference.bvh"));
  for (const std::size_t size : {std::size_t{4}, std::size_t{19}, std::size_t{24}, glb.size() / 2, glb.size() - 1})
    EXPECT_THROW(read_gltf_bytes(glb.substr(0, size), "cut.glb"), InvalidInput) << size;
  expect_error(replaced(glb, std::string("\2\0\0\0", 4), std::string("\1\0\0\0", 4)), "glTF version 1");
}

TEST(GltfRead, BuffersStayInTheFolder) {
  const auto folder = std::filesystem::temp_directory_path() / "motex_gltf_test";
  std::filesystem::create_directories(folder / "in");
  const std::string good = small_gltf("LINEAR", kMoves);
  const auto with = [&](const std::string& uri) {
    write_file(folder / "in" / "x.gltf", replaced(good, "data:;base64,AAAAAAAA/38=", uri));
    return read_gltf(folder / "in" / "x.gltf");
  };
  write_file(folder / "in" / "a b.bin", std::string("\0\0\0\0\0\0\xff\x7f", 8));
  write_file(folder / "out.bin", std::string("\0\0\0\0\0\0\xff\x7f", 8));
  EXPECT_EQ(with("a%20b.bin").skeleton.num_joints(), 2);
  EXPECT_THROW(with("../out.bin"), InvalidInput);
  EXPECT_THROW(with("%2e%2e/out.bin"), InvalidInput);
  EXPECT_THROW(with((folder / "out.bin").string()), InvalidInput);
  EXPECT_THROW(with("missing.bin"), InvalidInput);
  std::filesystem::remove_all(folder);
}

// x of the lower joint at 0, 1/8, … 1 s, seen through the holder's scale of one half.
std::vector<double> sampled_x(const std::string& interpolation, const std::vector<float>& moves) {
  ReadClipOptions options;
  options.fps = 8;
  const Clip clip = read_gltf_bytes(small_gltf(interpolation, moves), "x.gltf", options);
  EXPECT_EQ(clip.num_frames(), 9);
  const FrameMatrix world = world_positions(clip);
  std::vector<double> x;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    x.push_back(2 * world(t, 3));
    EXPECT_NEAR(world(t, 5), 1, 1e-6);  // 2 up, halved, turned from y to z
  }
  return x;
}

TEST(GltfRead, Interpolations) {
  const std::vector<double> linear = sampled_x("LINEAR", kMoves), step = sampled_x("STEP", kMoves);
  const double expected_linear[] = {0, 2, 4, 3.5, 3, 2.5, 2, 1.5, 1}, expected_step[] = {0, 0, 4, 4, 4, 4, 4, 4, 1};
  // Tangents 8 out of the first key, 0 elsewhere: Hermite at u = 1/2 over 1/4 s: 4/2 + (1/4)·8/8 = 2.25.
  const std::vector<double> cubic =
      sampled_x("CUBICSPLINE", {0, 0, 0, 0, 2, 0, 8, 0, 0, 0, 0, 0, 4, 2, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0});
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(linear[i], expected_linear[i], 1e-6) << i;
    EXPECT_NEAR(step[i], expected_step[i], 1e-6) << i;
  }
  EXPECT_NEAR(cubic[1], 2.25, 1e-6);
  EXPECT_NEAR(cubic[2], 4, 1e-6);
  EXPECT_NEAR(cubic[5], 2.5, 1e-6);
}

TEST(GltfRead, SkeletonOfMovingNodes) {
  const Clip clip = read_gltf_bytes(small_gltf("LINEAR", kMoves), "dir/walk.gltf");
  EXPECT_EQ(clip.name, "walk");
  ASSERT_EQ(clip.skeleton.num_joints(), 2);
  EXPECT_EQ(clip.skeleton.joints[0].name, "base");
  EXPECT_EQ(clip.skeleton.joints[1].name, "tip");
  EXPECT_EQ(clip.skeleton.metres_per_unit, 1);
  EXPECT_EQ(clip.num_frames(), 3);  // two spans in a second
  EXPECT_NEAR(angle_between(clip.rotation(2, 0), exp_map(Vector3(std::numbers::pi / 2, 0, 0))), 0, 1e-6);
}

TEST(GltfRead, TooDenseATrackIsRefused) {
  // Keys a hair apart in one track, a key at 2 s in the other: 10³⁰ frames.
  const std::string hair = replaced(small_gltf("LINEAR", kMoves), base64({0, 0.25F, 1, 0, 2, 0, 4, 2, 0, 1, 2, 0}),
                                    base64({0, 1e-30F, 2e-30F, 0, 2, 0, 4, 2, 0, 1, 2, 0}));
  EXPECT_EQ(read_gltf_bytes(hair, "x.gltf").num_frames(), 3);
  const std::string late =
      replaced(hair, "\"count\":1,\"type\":\"SCALAR\"", "\"byteOffset\":16,\"count\":1,\"type\":\"SCALAR\"");
  expect_error(late, "give the rate with --fps");
  ReadClipOptions options;
  options.fps = 30;
  EXPECT_EQ(read_gltf_bytes(late, "x.gltf", options).num_frames(), 61);
}

TEST(GltfWrite, ReadBackIsTheSame) {
  for (const auto& path :
       {kMocap / "quickstart" / "salsa_cmu61_10.bvh", kMocap / "wild" / "positions_everywhere_dance_24hz_12_frames.bvh",
        kMocap / "wild" / "root_without_channels.bvh", kMocap / "synthetic" / "all_frames_identical.bvh"}) {
    SCOPED_TRACE(path);
    const Clip clip = read_bvh(path);
    const Clip again = read_gltf_bytes(write_glb_bytes(clip), "again.glb");
    EXPECT_EQ(skeleton_difference(clip.skeleton, again.skeleton), "");
    ASSERT_EQ(clip.num_frames(), again.num_frames());
    EXPECT_NEAR(again.frame_time_secs / clip.frame_time_secs, 1, 1e-6);
    const double scale = metres_per_unit_or_guess(clip.skeleton);
    const FrameMatrix before = world_positions(clip) * scale, after = world_positions(again);
    ASSERT_EQ(before.cols(), after.cols());  // end sites too
    EXPECT_LT((before - after).cwiseAbs().maxCoeff(), 2e-6);
  }
}

TEST(GltfWrite, TracksThatStandStillAreShort) {
  Clip clip = read_bvh(kMocap / "quickstart" / "salsa_cmu61_10.bvh");
  const std::size_t size = write_glb_bytes(clip).size();
  for (Index t = 0; t < clip.num_frames(); ++t)
    for (int j = 1; j < clip.skeleton.num_joints(); ++j) clip.set_rotation(t, j, clip.rotation(0, j));
  EXPECT_LT(write_glb_bytes(clip).size(), size / 5);
}

TEST(GltfWrite, AwkwardClips) {
  Skeleton skeleton;
  skeleton.joints = {{"a\xFF", -1, Vector3::Zero(), {}}, {"b", -1, Vector3::Zero(), {}}};  // two roots, no length
  const Clip clip = make_clip(skeleton, 4, 0.5);
  const Clip again = read_gltf_bytes(write_glb_bytes(clip), "again.glb");
  EXPECT_EQ(again.num_frames(), 4);
  EXPECT_EQ(again.skeleton.num_joints(), 2);
  EXPECT_THROW(write_glb_bytes(make_clip(skeleton, 0, 1)), InvalidInput);
}

}  // namespace
}  // namespace motex
