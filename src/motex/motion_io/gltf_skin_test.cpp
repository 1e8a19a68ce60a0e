// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion/up_axis.h"
#include "motex/motion_io/bvh.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/gltf_buffers.h"
#include "motex/motion_io/gltf_container.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr int kRings = 9, kCorners = 6, kFrames = 7;

/// One white pixel.
const std::string kPng(
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\10\6\0\0\0\x1f\x15\xc4\x89\0\0\0\rIDATx\x9c"
    "c\xf8\xff\xff\xff\x7f\0\t\xfb\3\xfd\5\x43\x45\xca\0\0\0\0IEND\xae\x42\x60\x82",
    70);

/// A tube about three joints as exporters make them: an armature that is turned and in centimetres, joints with frames
/// of their own, a textured material, a morph target, weights in bytes that do not quite add up.
struct Tube {
  GlbBuilder data;
  Json root;

  Tube() {
    root["asset"] = {{"version", "2.0"}};
    root["scene"] = 0;
    root["scenes"] = {{{"nodes", {0, 4}}}};
    root["nodes"] = {
        {{"name", "Armature"},
         {"rotation", {-0.70710678118, 0, 0, 0.70710678118}},
         {"scale", {0.01, 0.01, 0.01}},
         {"children", {1}}},
        {{"name", "rig:Hips"}, {"translation", {0, 0, 90}}, {"rotation", {0.6, 0, 0, 0.8}}, {"children", {2}}},
        {{"name", "rig:Spine"}, {"translation", {0, 30, 0}}, {"rotation", {0, 0.28, 0, 0.96}}, {"children", {3}}},
        {{"name", "rig:Head"}, {"translation", {2, 25, 0}}, {"scale", {1.1, 1.1, 1.1}}},
        {{"name", "Body"}, {"mesh", 0}, {"skin", 0}}};
    add_mesh();
    add_skin();
    add_animation();
  }

  void add_mesh() {
    std::vector<float> positions, normals, texcoords;
    std::vector<std::uint8_t> joints, weights;
    for (int r = 0; r < kRings; ++r)
      for (int c = 0; c < kCorners; ++c) {
        const float angle = 6.2831853F * static_cast<float>(c) / kCorners, y = 0.9F + 0.1F * static_cast<float>(r);
        positions.insert(positions.end(), {0.1F * std::cos(angle), y, 0.1F * std::sin(angle)});
        normals.insert(normals.end(), {2 * std::cos(angle), 0, 2 * std::sin(angle)});
        texcoords.insert(texcoords.end(), {static_cast<float>(c) / kCorners, static_cast<float>(r) / kRings});
        const int along = r * 255 / (kRings - 1);
        joints.insert(joints.end(),
                      {static_cast<std::uint8_t>(r < 5 ? 0 : 1), static_cast<std::uint8_t>(r < 5 ? 1 : 2), 1, 7});
        weights.insert(weights.end(), {static_cast<std::uint8_t>(255 - along), static_cast<std::uint8_t>(along / 2),
                                       static_cast<std::uint8_t>(along / 3), 0});
      }
    std::vector<std::uint16_t> triangles;
    for (int r = 0; r + 1 < kRings; ++r)
      for (int c = 0; c < kCorners; ++c) {
        const int a = r * kCorners + c, b = r * kCorners + (c + 1) % kCorners;
        for (const int i : {a, b, a + kCorners, b, b + kCorners, a + kCorners})
          triangles.push_back(static_cast<std::uint16_t>(i));
      }
    const std::size_t n = kRings * kCorners;
    const auto floats = [&](const std::vector<float>& v, const char* type) {
      return data.add(v.data(), 4 * v.size(), {5126, type, n, 34962});
    };
    Json attributes;
    attributes["POSITION"] = floats(positions, "VEC3");
    data.set_bounds(0, positions, 3);
    attributes["NORMAL"] = floats(normals, "VEC3");
    attributes["TEXCOORD_0"] = floats(texcoords, "VEC2");
    attributes["JOINTS_0"] = data.add(joints.data(), joints.size(), {5121, "VEC4", n, 34962});
    attributes["WEIGHTS_0"] = data.add(weights.data(), weights.size(), {5121, "VEC4", n, 34962});
    const int indices = data.add(triangles.data(), 2 * triangles.size(), {5123, "SCALAR", triangles.size(), 34963});
    root["meshes"] = {
        {{"name", "tube"},
         {"weights", {0.0}},
         {"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"targets", {{{"POSITION", 0}}}}}}}}};
    root["materials"] = {
        {{"name", "cloth"},
         {"doubleSided", true},
         {"alphaCutoff", 0.3},
         {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.2, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
    root["textures"] = {{{"source", 0}, {"sampler", 0}}};
    root["samplers"] = {{{"wrapS", 10497}, {"minFilter", 9987}, {"magFilter", 9729}}};
    root["images"] = {{{"mimeType", "image/png"}, {"bufferView", data.add_view(kPng.data(), kPng.size(), 0)}}};
  }

  void add_skin() {
    std::vector<float> bind;  // any invertible matrices
    for (int j = 0; j < 3; ++j) {
      Eigen::Affine3f m = Eigen::Affine3f::Identity();
      m.rotate(Eigen::AngleAxisf(0.3F * static_cast<float>(j) + 0.2F, Eigen::Vector3f(1, 2, 3).normalized()));
      m.scale(100);
      m.pretranslate(Eigen::Vector3f(1, -20.0F * static_cast<float>(j), 3));
      bind.insert(bind.end(), m.data(), m.data() + 16);
    }
    root["skins"] = {
        {{"joints", {1, 2, 3}}, {"inverseBindMatrices", data.add(bind.data(), 4 * bind.size(), {5126, "MAT4", 3, 0})}}};
  }

  void add_animation() {
    std::vector<float> times, turns, moves;
    for (int t = 0; t < kFrames; ++t) {
      const float x = 0.3F * static_cast<float>(t);
      times.push_back(static_cast<float>(t) / 30);
      const Eigen::Quaternionf q(Eigen::AngleAxisf(x, Eigen::Vector3f(1, static_cast<float>(t), 2).normalized()));
      turns.insert(turns.end(), {q.x(), q.y(), q.z(), q.w()});
      moves.insert(moves.end(), {x, 2 * x, 90 + x});
    }
    const int time = data.add(times.data(), 4 * times.size(), {5126, "SCALAR", kFrames, 0});
    data.set_bounds(time, times, 1);
    const int turn = data.add(turns.data(), 4 * turns.size(), {5126, "VEC4", kFrames, 0});
    const int move = data.add(moves.data(), 4 * moves.size(), {5126, "VEC3", kFrames, 0});
    const auto channel = [](int sampler, int node, const char* path) {
      return Json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    };
    root["animations"] = {{{"name", "wave"},
                           {"samplers", {{{"input", time}, {"output", turn}}, {{"input", time}, {"output", move}}}},
                           {"channels",
                            {channel(0, 1, "rotation"), channel(0, 2, "rotation"), channel(0, 3, "rotation"),
                             channel(1, 1, "translation")}}}};
  }

  std::string glb() const { return data.file(root.dump(), "tube"); }
};

/// What a player does, written plainly: vertices of all skinned meshes at a key of the first animation.
class Player {
 public:
  explicit Player(const std::string& glb) : parts_(split_glb(glb, "x")), root_(Json::parse(parts_.json)) {}

  const Json& json() const { return root_; }

  std::vector<Vector3> vertices(std::size_t key) const {
    const std::vector<Eigen::Affine3d> worlds = place_nodes(key);
    std::vector<Vector3> out;
    for (const Json& node : root_["nodes"]) {
      if (!node.contains("skin")) continue;
      const Json& skin = root_["skins"][node["skin"].get<std::size_t>()];
      const auto bind = numbers(skin["inverseBindMatrices"]);
      for (const Json& primitive : root_["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
        add_vertices(primitive["attributes"], skin["joints"], bind, worlds, out);
    }
    return out;
  }

 private:
  std::vector<double> numbers(const Json& idx) const {
    const Json& accessor = root_["accessors"][idx.get<std::size_t>()];
    const Json& view = root_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    static const std::map<std::string, std::size_t> kSizes{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const char* data = parts_.binary->data() + view["byteOffset"].get<std::size_t>();
    std::vector<double> out;
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>() * kSizes.at(accessor["type"]); ++i) {
      const int type = accessor["componentType"];
      float f = 0;
      std::uint16_t u = 0;
      if (type == 5126) std::memcpy(&f, data + 4 * i, 4), out.push_back(f);
      if (type == 5123) std::memcpy(&u, data + 2 * i, 2), out.push_back(u);
      if (type == 5121) out.push_back(static_cast<unsigned char>(data[i]));
    }
    return out;
  }

  std::vector<Eigen::Affine3d> place_nodes(std::size_t key) const {
    const Json& nodes = root_["nodes"];
    std::vector<Vector3> t(nodes.size(), Vector3::Zero()), s(nodes.size(), Vector3::Ones());
    std::vector<Quat> r(nodes.size(), Quat::Identity());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (Index c = 0; c < 3; ++c) {
        if (nodes[n].contains("translation")) t[n][c] = nodes[n]["translation"][static_cast<std::size_t>(c)];
        if (nodes[n].contains("scale")) s[n][c] = nodes[n]["scale"][static_cast<std::size_t>(c)];
      }
      for (Index c = 0; c < 4; ++c)
        if (nodes[n].contains("rotation")) r[n].coeffs()[c] = nodes[n]["rotation"][static_cast<std::size_t>(c)];
    }
    const Json& animation = root_["animations"][0];
    for (const Json& channel : animation["channels"]) {
      const auto values = numbers(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"]);
      const std::size_t node = channel["target"]["node"], size = channel["target"]["path"] == "rotation" ? 4 : 3;
      const double* v = &values[std::min(key, values.size() / size - 1) * size];
      if (size == 4)
        r[node] = Quat(v[3], v[0], v[1], v[2]);
      else
        t[node] = Vector3(v[0], v[1], v[2]);
    }
    std::vector<Eigen::Affine3d> worlds(nodes.size());
    const auto place = [&](const auto& self, std::size_t n, const Eigen::Affine3d& above) -> void {
      worlds[n] = above * Eigen::Translation3d(t[n]) * r[n].normalized() * Eigen::Scaling(s[n]);
      for (const Json& child : nodes[n].value("children", Json::array()))
        self(self, child.get<std::size_t>(), worlds[n]);
    };
    for (const Json& n : root_["scenes"][0]["nodes"]) place(place, n.get<std::size_t>(), Eigen::Affine3d::Identity());
    return worlds;
  }

  void add_vertices(const Json& attributes, const Json& joints, const std::vector<double>& bind,
                    const std::vector<Eigen::Affine3d>& worlds, std::vector<Vector3>& out) const {
    const auto positions = numbers(attributes["POSITION"]), idx = numbers(attributes["JOINTS_0"]),
               weights = numbers(attributes["WEIGHTS_0"]);
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      double total = 0;
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        if (weights[k] == 0) continue;
        const auto j = static_cast<std::size_t>(idx[k]);
        const Eigen::Matrix4d m =
            worlds[joints[j].get<std::size_t>()].matrix() * Eigen::Map<const Eigen::Matrix4d>(&bind[16 * j]);
        sum += weights[k] * m * Eigen::Vector4d(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1);
        total += weights[k];
      }
      out.emplace_back(sum.head<3>() / total);
    }
  }

  GltfParts parts_;
  Json root_;
};

double largest_difference(const std::string& a, const std::string& b, double scale = 1) {
  const Player one(a), other(b);
  double largest = 0;
  for (std::size_t t = 0; t < kFrames; ++t) {
    const auto x = one.vertices(t), y = other.vertices(t);
    EXPECT_EQ(x.size(), static_cast<std::size_t>(kRings * kCorners));
    if (x.size() != y.size()) return 1e9;
    for (std::size_t v = 0; v < x.size(); ++v) largest = std::max(largest, (scale * x[v] - y[v]).norm());
  }
  return largest;
}

Clip read(const std::string& glb, std::vector<std::string>* warnings = nullptr) {
  JobContext job;
  if (warnings != nullptr) job.on_warning = [warnings](const std::string& message) { warnings->push_back(message); };
  return read_gltf_bytes(glb, "tube.glb", {}, job);
}

TEST(GltfSkin, VerticesAreTheSameAtEveryFrame) {
  const std::string glb = Tube().glb();
  // How tests/data/mocap/synthetic/skinned_tube.glb was made, which the other tests use.
  if (const char* path = std::getenv("MOTEX_WRITE_TUBE")) write_file(path, glb);
  std::vector<std::string> warnings;
  const Clip clip = read(glb, &warnings);
  ASSERT_TRUE(clip.skeleton.skin);
  EXPECT_EQ(warnings, std::vector<std::string>{"tube.glb: of its skin is left out: morph targets"});
  EXPECT_EQ(clip.num_frames(), kFrames);
  const std::string again = write_glb_bytes(clip);
  // The vertices lie about a metre from the origin; the whole tube moves by much more than the bound.
  EXPECT_LT(largest_difference(glb, again), 1e-5);
  const Player before(glb);
  EXPECT_GT((before.vertices(0)[50] - before.vertices(6)[50]).norm(), 0.05);
  // And once more: nothing is lost or added.
  EXPECT_LT(largest_difference(again, write_glb_bytes(read(again))), 1e-5);
}

TEST(GltfSkin, MaterialAndPictureAreKept) {
  const Player player(write_glb_bytes(read(Tube().glb())));
  const Json& root = player.json();
  EXPECT_EQ(root["materials"][0]["name"], "cloth");
  EXPECT_EQ(root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1], 0.5);
  EXPECT_FALSE(root["materials"][0].contains("alphaCutoff"));  // only of masks
  EXPECT_EQ(root["meshes"][0]["primitives"][0]["material"], 0);
  EXPECT_EQ(root["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(root["bufferViews"][root["images"][0]["bufferView"].get<std::size_t>()]["byteLength"], kPng.size());
  EXPECT_EQ(root["samplers"][0]["minFilter"], 9987);
}

TEST(GltfSkin, AFileOfItsOwnCanBeReadAgain) {
  const Clip clip = read(Tube().glb());
  const auto again = read_skin_bytes(clip.skeleton.skin->glb, "skin");
  ASSERT_EQ(again->joints.size(), 3U);
  EXPECT_EQ(again->joints[1].name, "rig:Spine");
  EXPECT_LT((again->joints[2].position - clip.skeleton.skin->joints[2].position).norm(), 1e-12);
  Clip copy = clip;
  copy.skeleton.skin = again;
  EXPECT_EQ(write_glb_bytes(copy), write_glb_bytes(clip));
}

TEST(GltfSkin, GrowsWithTheSkeleton) {
  Clip clip = read(Tube().glb());
  const std::string before = write_glb_bytes(clip);
  clip.skeleton.metres_per_unit = 3;
  EXPECT_LT(largest_difference(before, write_glb_bytes(clip), 3), 3e-5);
}

TEST(GltfSkin, LeftOutWhereItDoesNotFit) {
  Clip clip = read(Tube().glb());
  clip.skeleton.joints[2].name = "Neck";
  EXPECT_FALSE(skin_fits(clip.skeleton));
  EXPECT_EQ(Player(write_glb_bytes(clip)).json()["meshes"][0]["name"], "sticks");
  clip = read(Tube().glb());
  turn_z_up_to_y_up(clip);
  EXPECT_FALSE(clip.skeleton.skin);
}

TEST(GltfSkin, LentToAnimationsOfTheSameRig) {
  const std::string glb = Tube().glb();
  Clip clip = read(glb);
  const std::string before = write_glb_bytes(clip);
  const auto skin = clip.skeleton.skin;
  clip.skeleton.skin = nullptr;
  clip.skeleton.joints[1].name = "spine";
  clip.skeleton.skin = lend_skin(*skin, clip.skeleton);
  EXPECT_LT(largest_difference(before, write_glb_bytes(clip)), 1e-5);
  Skeleton other = clip.skeleton;
  other.joints[2].name = "Tail";
  EXPECT_THROW(lend_skin(*skin, other), InvalidInput);
  other = clip.skeleton;
  other.joints[2].offset = Vector3(0, -3, 0);
  EXPECT_THROW(lend_skin(*skin, other), InvalidInput);
}

TEST(GltfSkin, LentToABodyWhoseFramesAreTheWorlds) {
  // The same bones as a BVH has them: no joint turned at rest.
  const std::string glb = Tube().glb();
  Clip clip = read(glb);
  const auto skin = clip.skeleton.skin;
  Clip plain = clip;
  plain.skeleton.skin = nullptr;
  Pose pose;
  for (int j = 1; j < 3; ++j)
    plain.skeleton.joints[static_cast<std::size_t>(j)].offset =
        skin->joints[static_cast<std::size_t>(j)].position - skin->joints[static_cast<std::size_t>(j - 1)].position;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    forward_kinematics(clip, t, pose);
    Quat above = Quat::Identity();
    for (int j = 0; j < 3; ++j) {
      const Quat world = pose.rotation(j) * skin->joints[static_cast<std::size_t>(j)].rotation.conjugate();
      plain.set_rotation(t, j, (above.conjugate() * world).normalized());
      if (j > 0) plain.set_translation(t, j, plain.skeleton.joints[static_cast<std::size_t>(j)].offset);
      above = world;
    }
  }
  plain.skeleton.skin = lend_skin(*skin, plain.skeleton);
  EXPECT_LT(largest_difference(glb, write_glb_bytes(plain)), 1e-5);
}

TEST(GltfSkin, WhatCannotBeKeptIsSaidAndTheMotionIsReadAllTheSame) {
  const auto skinless = [](const std::function<void(Json&)>& change, const std::string& says) {
    Tube tube;
    change(tube.root);
    std::vector<std::string> warnings;
    const Clip clip = read(tube.glb(), &warnings);
    EXPECT_FALSE(clip.skeleton.skin) << says;
    ASSERT_FALSE(warnings.empty()) << says;
    EXPECT_NE(warnings.back().find(says), std::string::npos) << "wanted: " << says << ", said: " << warnings.back();
  };
  const auto primitive = [](Json& root) -> Json& { return root["meshes"][0]["primitives"][0]; };
  skinless([&](Json& r) { primitive(r)["extensions"]["KHR_draco_mesh_compression"] = Json::object(); }, "compressed");
  skinless([&](Json& r) { primitive(r)["attributes"]["POSITION"] = 99; }, "an index into 'accessors'");
  skinless([&](Json& r) { primitive(r)["attributes"]["NORMAL"] = primitive(r)["indices"]; }, "different number");
  skinless([&](Json& r) { primitive(r)["attributes"] = 3; }, "no joint moves");
  skinless([](Json& r) { r["skins"][0]["joints"] = {1, 2}; }, "joints that do not exist");
  skinless([](Json& r) { r["skins"][0]["joints"] = {1, 2, 2}; }, "listed twice");
  skinless([](Json& r) { r["nodes"][0]["scale"] = {-1, 1, 1}; }, "mirrored");
}

TEST(GltfSkin, StickFiguresAreNoSkin) {
  Clip clip = read(Tube().glb());
  clip.skeleton.skin = nullptr;
  EXPECT_FALSE(read(write_glb_bytes(clip)).skeleton.skin);
}

TEST(GltfSkin, SeveralAnimationsOfOneSkeleton) {
  Clip a = read(Tube().glb()), b = slice(a, 1, 3);
  a.name = "first", b.name = "second";
  const Player player(write_glb_bytes(std::vector<Clip>{a, b}));
  ASSERT_EQ(player.json()["animations"].size(), 2U);
  EXPECT_EQ(player.json()["animations"][1]["name"], "second");
  b.skeleton.joints[1].name = "x";
  EXPECT_THROW(write_glb_bytes(std::vector<Clip>{a, b}), InvalidInput);
  EXPECT_THROW(write_glb_bytes(std::span<const Clip>()), InvalidInput);
}

}  // namespace
}  // namespace motex
