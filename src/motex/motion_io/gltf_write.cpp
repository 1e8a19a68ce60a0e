// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "motex/core/files.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/gltf_buffers.h"
#include "motex/motion_io/gltf_container.h"
#include "motex/motion_io/gltf_skin.h"
#include "motex/motion_io/stick_mesh.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr int kFloat = 5126, kU16 = 5123, kU32 = 5125;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
constexpr double kStill = 1e-7;  // metres, or parts of a quaternion
constexpr double kSameSize = 0.01;
constexpr std::size_t kMaxJoints = 65'535;

class GlbWriter {
 public:
  explicit GlbWriter(std::span<const Clip> clips)
      : clips_(clips),
        name_(clips.front().name),
        skeleton_(clips.front().skeleton),
        joints_(skeleton_.joints),
        scale_(metres_per_unit_or_guess(skeleton_)) {
    for (const Clip& clip : clips) {
      check_clip(clip);
      if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": a clip without frames cannot be written as GLB");
      if (const std::string difference = skeleton_difference(skeleton_, clip.skeleton); !difference.empty())
        throw InvalidInput(clip.name + ": one GLB file holds one skeleton, but " + difference);
    }
    if (joints_.size() > kMaxJoints) throw InvalidInput(name_ + ": GLB holds at most 65,535 joints");
  }

  std::string write(bool named) {
    write_head();
    write_nodes();
    if (skin_fits(skeleton_)) {
      write_own_skin(*skeleton_.skin);
    } else {
      write_stick_mesh();
      write_stick_skin();
    }
    root_["animations"] = Json::array();
    for (const Clip& clip : clips_) write_animation(clip, named ? clip.name : "motion");
    return out_.file(root_.dump(-1, ' ', false, Json::error_handler_t::replace), name_);
  }

 private:
  template <typename T>
  int add(const std::vector<T>& values, int component_type, const char* type, std::size_t count, int target = 0) {
    return out_.add(values.data(), values.size() * sizeof(T), {component_type, type, count, target});
  }
  int time_accessor(const Clip& clip, std::size_t num_keys);
  void write_head();
  void write_nodes();
  void write_stick_mesh();
  void write_stick_skin();
  void write_own_skin(const Skin& skin);
  void bind(const Json& skins, const Skin& skin);
  double growth(const Skin& skin) const;
  void write_animation(const Clip& clip, const std::string& name);
  void add_channel(const Clip& clip, int joint, const char* path, const std::vector<float>& values,
                   std::size_t num_components, bool keep_all, Json& animation);
  std::vector<float> translations(const Clip& clip, int joint) const;
  static std::vector<float> rotations(const Clip& clip, int joint);
  void add_mesh_node(Json node);

  std::span<const Clip> clips_;
  std::string name_;
  const Skeleton& skeleton_;
  const std::vector<Joint>& joints_;
  double scale_;
  Json root_;
  GlbBuilder out_;
  std::map<std::pair<std::size_t, double>, int> times_;  // by number of keys and frame time
};

Json numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

void GlbWriter::write_head() {
  root_["asset"] = {{"version", "2.0"},
                    {"generator", "motex"},
                    {"extras",
                     {{"metres_per_unit", scale_},
                      {"unit_is_guessed", !(skeleton_.metres_per_unit > 0)},
                      {"frame_time_secs", clips_.front().frame_time_secs}}}};
  root_["scene"] = 0;
}

// Nodes 0 … joints − 1 are the joints, then the armature above them and the meshes beside it.
void GlbWriter::write_nodes() {
  const auto num_joints = joints_.size();
  Json nodes = Json::array(), roots = Json::array();
  for (const Joint& joint : joints_)
    nodes.push_back({{"name", joint.name}, {"translation", numbers(joint.offset * scale_)}});
  for (std::size_t j = 0; j < num_joints; ++j) {
    const int parent = joints_[j].parent_idx;
    (parent < 0 ? roots : nodes[static_cast<std::size_t>(parent)]["children"]).push_back(j);
  }
  for (const EndSite& site : skeleton_.end_sites)
    nodes[static_cast<std::size_t>(site.parent_idx)]["extras"]["end_sites"].push_back(numbers(site.offset * scale_));
  nodes.push_back({{"name", "armature"}, {"children", roots}});
  root_["nodes"] = std::move(nodes);
  root_["scenes"] = Json::array({{{"name", name_.empty() ? "scene" : name_}, {"nodes", {num_joints}}}});
}

void GlbWriter::add_mesh_node(Json node) {
  root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
  root_["nodes"].push_back(std::move(node));
}

void GlbWriter::write_stick_mesh() {
  const StickMesh mesh = make_stick_mesh(skeleton_, scale_);
  const std::size_t count = mesh.positions.size();
  std::vector<std::uint16_t> joints;
  std::vector<float> weights, corners;
  for (std::size_t i = 0; i < count; ++i) {
    joints.insert(joints.end(), {mesh.joints[i], 0, 0, 0});
    weights.insert(weights.end(), {1, 0, 0, 0});
    corners.insert(corners.end(), mesh.positions[i].begin(), mesh.positions[i].end());
  }
  const int positions = add(corners, kFloat, "VEC3", count, kVertexBuffer);
  out_.set_bounds(positions, corners, 3);
  Json attributes = {{"POSITION", positions}};
  attributes["JOINTS_0"] = add(joints, kU16, "VEC4", count, kVertexBuffer);
  attributes["WEIGHTS_0"] = add(weights, kFloat, "VEC4", count, kVertexBuffer);
  const int indices = add(mesh.triangles, kU32, "SCALAR", mesh.triangles.size(), kIndexBuffer);
  root_["meshes"] = {{{"name", "sticks"}, {"primitives", {{{"attributes", attributes}, {"indices", indices}}}}}};
  add_mesh_node({{"name", "sticks"}, {"mesh", 0}, {"skin", 0}});
}

void GlbWriter::write_stick_skin() {
  std::vector<float> inverse_bind;
  Json joints = Json::array();
  for (const Vector3& rest : rest_positions(skeleton_)) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topRightCorner<3, 1>() = (-rest * scale_).cast<float>();
    inverse_bind.insert(inverse_bind.end(), matrix.data(), matrix.data() + 16);
    joints.push_back(joints.size());
  }
  const int accessor = add(inverse_bind, kFloat, "MAT4", joints_.size());
  root_["skins"] = {{{"joints", joints}, {"inverseBindMatrices", accessor}, {"skeleton", joints_.size()}}};
}

void GlbWriter::write_own_skin(const Skin& skin) {
  try {
    out_.import(skin.glb, name_);
    const Json from = Json::parse(split_glb(skin.glb, name_).json);
    for (const char* key : {"meshes", "materials", "textures", "samplers", "images"})
      if (from.contains(key)) root_[key] = from[key];
    std::vector<std::string> extensions;
    for (const char* extension : {"KHR_materials_unlit", "KHR_texture_transform"})
      if (root_.value("materials", Json()).dump().find(extension) != std::string::npos)
        extensions.emplace_back(extension);
    if (!extensions.empty()) root_["extensionsUsed"] = extensions;
    bind(from.at("skins"), skin);
    for (const Json& node : from.at("nodes"))
      if (node.contains("mesh")) add_mesh_node(node);
  } catch (const Json::exception&) {
    throw InvalidInput(name_ + ": its skin is broken");
  }
}

/// How much larger the skeleton is than the one the skin was made for; small differences are kept as they are.
double GlbWriter::growth(const Skin& skin) const {
  std::map<std::string, const SkinJoint*> of_name;
  for (const SkinJoint& joint : skin.joints) of_name.emplace(joint.name, &joint);
  double before = 0, now = 0;
  for (const Joint& joint : joints_) {
    if (joint.parent_idx < 0) continue;
    const auto child = of_name.find(joint.name);
    const auto parent = of_name.find(joints_[static_cast<std::size_t>(joint.parent_idx)].name);
    if (child == of_name.end() || parent == of_name.end()) continue;
    before += (child->second->position - parent->second->position).norm();
    now += joint.offset.norm() * scale_;
  }
  const double ratio = before > 1e-9 ? now / before : 1;
  return std::abs(ratio - 1) < kSameSize || !(ratio > 1e-6 && ratio < 1e6) ? 1 : ratio;
}

/// Inverse bind matrices of the grown skin, joints by name.
void GlbWriter::bind(const Json& skins, const Skin& skin) {
  const auto grown = static_cast<float>(growth(skin));
  root_["skins"] = Json::array();
  for (const Json& from : skins) {
    Json joints = Json::array();
    char* data = out_.data(from.at("inverseBindMatrices"));
    for (const Json& joint : from.at("joints")) {
      joints.push_back(skeleton_.find(skin.joints.at(joint.get<std::size_t>()).name));
      Eigen::Matrix4f matrix;
      std::memcpy(matrix.data(), data, sizeof matrix);
      matrix.topRows<3>() *= grown;
      std::memcpy(data, matrix.data(), sizeof matrix);
      data += sizeof matrix;
    }
    root_["skins"].push_back(
        {{"joints", joints}, {"inverseBindMatrices", from["inverseBindMatrices"]}, {"skeleton", joints_.size()}});
  }
}

std::vector<float> GlbWriter::translations(const Clip& clip, int joint) const {
  std::vector<float> values;
  for (Index t = 0; t < clip.num_frames(); ++t)
    for (const double x : clip.translation(t, joint)) values.push_back(static_cast<float>(x * scale_));
  return values;
}

// Of q and −q the nearer to the frame before: some viewers interpolate without looking at the sign.
std::vector<float> GlbWriter::rotations(const Clip& clip, int joint) {
  std::vector<float> values;
  Quat last = Quat::Identity();
  for (Index t = 0; t < clip.num_frames(); ++t) {
    Quat q = clip.rotation(t, joint).normalized();
    if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
    for (const double x : q.coeffs()) values.push_back(static_cast<float>(x));
    last = q;
  }
  return values;
}

void GlbWriter::add_channel(const Clip& clip, int joint, const char* path, const std::vector<float>& values,
                            std::size_t num_components, bool keep_all, Json& animation) {
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
  const int output = out_.add(values.data(), 4 * keys * num_components, {kFloat, rotation ? "VEC4" : "VEC3", keys, 0});
  animation["samplers"].push_back({{"input", time_accessor(clip, keys)}, {"output", output}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", joint}, {"path", path}}}});
}

int GlbWriter::time_accessor(const Clip& clip, std::size_t num_keys) {
  const auto [found, is_new] = times_.emplace(std::pair(num_keys, clip.frame_time_secs), -1);
  if (!is_new) return found->second;
  std::vector<float> times(num_keys);
  for (std::size_t t = 0; t < num_keys; ++t)
    times[t] = static_cast<float>(static_cast<double>(t) * clip.frame_time_secs);
  if (num_keys > 1 && !(times.back() > times[num_keys - 2]))
    throw InvalidInput(clip.name + ": its times do not fit the single precision of GLB");
  found->second = add(times, kFloat, "SCALAR", num_keys);
  out_.set_bounds(found->second, times, 1);
  return found->second;
}

// The first joint's translation keeps all its keys, so that a clip at rest keeps its length.
void GlbWriter::write_animation(const Clip& clip, const std::string& name) {
  Json animation = {{"name", name}};
  for (int j = 0; j < skeleton_.num_joints(); ++j) {
    add_channel(clip, j, "translation", translations(clip, j), 3, j == 0, animation);
    add_channel(clip, j, "rotation", rotations(clip, j), 4, false, animation);
  }
  root_["animations"].push_back(std::move(animation));
}

}  // namespace

std::string write_glb_bytes(const Clip& clip) { return GlbWriter(std::span(&clip, 1)).write(false); }

std::string write_glb_bytes(std::span<const Clip> clips) {
  if (clips.empty()) throw InvalidInput("there is no clip to write");
  return GlbWriter(clips).write(true);
}

void write_glb(const std::filesystem::path& path, const Clip& clip) { write_file(path, write_glb_bytes(clip)); }

}  // namespace motex
