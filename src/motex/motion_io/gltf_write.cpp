// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "motex/core/files.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/stick_mesh.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr int kFloat = 5126, kU16 = 5123, kU32 = 5125;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
constexpr double kStill = 1e-7;  // metres, or parts of a quaternion
constexpr std::size_t kMaxJoints = 65'535;

class GlbWriter {
 public:
  explicit GlbWriter(const Clip& clip)
      : clip_(clip), joints_(clip.skeleton.joints), scale_(metres_per_unit_or_guess(clip.skeleton)) {
    check_clip(clip);
    if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": a clip without frames cannot be written as GLB");
    if (joints_.size() > kMaxJoints) throw InvalidInput(clip.name + ": GLB holds at most 65,535 joints");
  }

  std::string write() {
    write_head();
    write_nodes();
    write_mesh();
    write_skin();
    write_animation();
    return container();
  }

 private:
  template <typename T>
  int add_accessor(std::span<const T> values, int component_type, const char* type, std::size_t count, int target);
  int time_accessor(std::size_t num_keys);
  void write_head();
  void write_nodes();
  void write_mesh();
  void write_skin();
  void write_animation();
  void add_channel(int joint, const char* path, const std::vector<float>& values, std::size_t num_components,
                   bool keep_all);
  std::vector<float> translations(int joint) const;
  std::vector<float> rotations(int joint) const;
  std::string container();

  const Clip& clip_;
  const std::vector<Joint>& joints_;
  double scale_;
  Json root_, animation_;
  std::string binary_;
  int times_ = -1, first_time_ = -1;
};

Json numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

template <typename T>
int GlbWriter::add_accessor(std::span<const T> values, int component_type, const char* type, std::size_t count,
                            int target) {
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size_bytes()}};
  if (target != 0) view["target"] = target;
  binary_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  root_["bufferViews"].push_back(std::move(view));
  root_["accessors"].push_back({{"bufferView", root_["bufferViews"].size() - 1},
                                {"componentType", component_type},
                                {"count", count},
                                {"type", type}});
  return static_cast<int>(root_["accessors"].size()) - 1;
}

void GlbWriter::write_head() {
  root_["asset"] = {{"version", "2.0"},
                    {"generator", "motex"},
                    {"extras",
                     {{"metres_per_unit", scale_},
                      {"unit_is_guessed", !(clip_.skeleton.metres_per_unit > 0)},
                      {"frame_time_secs", clip_.frame_time_secs}}}};
  root_["scene"] = 0;
}

// Nodes 0 … joints − 1 are the joints, then the armature above them and the mesh beside it.
void GlbWriter::write_nodes() {
  const auto num_joints = joints_.size();
  Json nodes = Json::array(), roots = Json::array();
  for (const Joint& joint : joints_)
    nodes.push_back({{"name", joint.name}, {"translation", numbers(joint.offset * scale_)}});
  for (std::size_t j = 0; j < num_joints; ++j) {
    const int parent = joints_[j].parent_idx;
    (parent < 0 ? roots : nodes[static_cast<std::size_t>(parent)]["children"]).push_back(j);
  }
  for (const EndSite& site : clip_.skeleton.end_sites)
    nodes[static_cast<std::size_t>(site.parent_idx)]["extras"]["end_sites"].push_back(numbers(site.offset * scale_));
  nodes.push_back({{"name", "armature"}, {"children", roots}});
  nodes.push_back({{"name", "sticks"}, {"mesh", 0}, {"skin", 0}});
  root_["nodes"] = std::move(nodes);
  root_["scenes"] = {{{"name", clip_.name.empty() ? "scene" : clip_.name}, {"nodes", {num_joints, num_joints + 1}}}};
}

void GlbWriter::write_mesh() {
  const StickMesh mesh = make_stick_mesh(clip_.skeleton, scale_);
  const std::size_t count = mesh.positions.size();
  std::vector<std::array<std::uint16_t, 4>> joints(count, {0, 0, 0, 0});
  const std::vector<std::array<float, 4>> weights(count, {1, 0, 0, 0});
  std::array<float, 3> low = mesh.positions[0], high = low;
  for (std::size_t i = 0; i < count; ++i) {
    joints[i][0] = mesh.joints[i];
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], mesh.positions[i][c]);
      high[c] = std::max(high[c], mesh.positions[i][c]);
    }
  }
  const int positions = add_accessor(std::span(mesh.positions), kFloat, "VEC3", count, kVertexBuffer);
  root_["accessors"].back()["min"] = low;
  root_["accessors"].back()["max"] = high;
  Json attributes = {{"POSITION", positions}};
  attributes["JOINTS_0"] = add_accessor(std::span(std::as_const(joints)), kU16, "VEC4", count, kVertexBuffer);
  attributes["WEIGHTS_0"] = add_accessor(std::span(weights), kFloat, "VEC4", count, kVertexBuffer);
  const int indices = add_accessor(std::span(mesh.triangles), kU32, "SCALAR", mesh.triangles.size(), kIndexBuffer);
  root_["meshes"] = {{{"name", "sticks"}, {"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
}

void GlbWriter::write_skin() {
  std::vector<float> inverse_bind;
  Json joints = Json::array();
  for (const Vector3& rest : rest_positions(clip_.skeleton)) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topRightCorner<3, 1>() = (-rest * scale_).cast<float>();
    inverse_bind.insert(inverse_bind.end(), matrix.data(), matrix.data() + 16);
    joints.push_back(joints.size());
  }
  const int accessor = add_accessor(std::span(std::as_const(inverse_bind)), kFloat, "MAT4", joints_.size(), 0);
  root_["skins"] = {{{"joints", joints}, {"inverseBindMatrices", accessor}, {"skeleton", joints_.size()}}};
}

std::vector<float> GlbWriter::translations(int joint) const {
  std::vector<float> values;
  for (Index t = 0; t < clip_.num_frames(); ++t)
    for (const double x : clip_.translation(t, joint)) values.push_back(static_cast<float>(x * scale_));
  return values;
}

// Of q and −q the nearer to the frame before: some viewers interpolate without looking at the sign.
std::vector<float> GlbWriter::rotations(int joint) const {
  std::vector<float> values;
  Quat last = Quat::Identity();
  for (Index t = 0; t < clip_.num_frames(); ++t) {
    Quat q = clip_.rotation(t, joint).normalized();
    if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
    for (const double x : q.coeffs()) values.push_back(static_cast<float>(x));
    last = q;
  }
  return values;
}

void GlbWriter::add_channel(int joint, const char* path, const std::vector<float>& values, std::size_t num_components,
                            bool keep_all) {
  const bool rotation = num_components == 4;
  bool still = !keep_all, at_rest = still;
  const Vector3 offset = joints_[static_cast<std::size_t>(joint)].offset * scale_;
  for (std::size_t i = 0; i < values.size() && (still || at_rest); ++i) {
    const std::size_t c = i % num_components;
    const double rest = rotation ? (c == 3 ? 1 : 0) : offset[static_cast<Index>(c)];
    still = still && std::abs(values[i] - values[c]) <= kStill;
    at_rest = at_rest && std::abs(values[i] - rest) <= kStill;
  }
  if (at_rest) return;
  const std::size_t keys = still ? 1 : values.size() / num_components;
  const int output =
      add_accessor(std::span(values).first(keys * num_components), kFloat, rotation ? "VEC4" : "VEC3", keys, 0);
  animation_["samplers"].push_back({{"input", time_accessor(keys)}, {"output", output}});
  animation_["channels"].push_back(
      {{"sampler", animation_["samplers"].size() - 1}, {"target", {{"node", joint}, {"path", path}}}});
}

int GlbWriter::time_accessor(std::size_t num_keys) {
  int& accessor = num_keys == 1 ? first_time_ : times_;
  if (accessor >= 0) return accessor;
  std::vector<float> times(num_keys);
  for (std::size_t t = 0; t < num_keys; ++t)
    times[t] = static_cast<float>(static_cast<double>(t) * clip_.frame_time_secs);
  if (num_keys > 1 && !(times.back() > times[num_keys - 2]))
    throw InvalidInput(clip_.name + ": its times do not fit the single precision of GLB");
  accessor = add_accessor(std::span(std::as_const(times)), kFloat, "SCALAR", num_keys, 0);
  root_["accessors"].back()["min"] = {times.front()};
  root_["accessors"].back()["max"] = {times.back()};
  return accessor;
}

// The first joint's translation keeps all its keys, so that a clip at rest keeps its length.
void GlbWriter::write_animation() {
  animation_["name"] = "motion";
  for (int j = 0; j < clip_.skeleton.num_joints(); ++j) {
    add_channel(j, "translation", translations(j), 3, j == 0);
    add_channel(j, "rotation", rotations(j), 4, false);
  }
  root_["animations"] = Json::array({animation_});  // braces alone: an array with g++, a copy with clang
}

std::string GlbWriter::container() {
  root_["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  if (binary_.size() + json.size() > 0xFFFFFF00U) throw InvalidInput(clip_.name + ": a GLB file holds at most 4 GiB");
  std::string out = "glTF";
  const auto u32 = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
  };
  u32(2), u32(12 + 8 + json.size() + 8 + binary_.size());
  u32(json.size()), out += "JSON", out += json;
  u32(binary_.size()), out.append("BIN\0", 4), out += binary_;
  return out;
}

}  // namespace

std::string write_glb_bytes(const Clip& clip) { return GlbWriter(clip).write(); }

void write_glb(const std::filesystem::path& path, const Clip& clip) { write_file(path, write_glb_bytes(clip)); }

}  // namespace motex
