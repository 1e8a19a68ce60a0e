// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/error.h"
#include "motex/motion_io/fbx.h"

#ifdef MOTEX_HAS_ASSIMP

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <set>

#include "motex/core/child_process.h"
#include "motex/motion/up_axis.h"
#include "motex/motion_io/gltf_document.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr std::size_t kMostNodes = 100'000;
constexpr double kSparse = 1.5;         // frames from key to key, at the file's rate
constexpr double kSameScale = 1e-3;     // of a scale that moves
constexpr int kScaleNotInherited = 2;   // FBX inherit type Rrs
constexpr double kLargestNumber = 1e9;  // of lengths and seconds
constexpr int kMostSecs = 60;           // of processor time in Assimp

Vector3 vector_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

template <typename T>
T metadata(const aiMetadata* data, const char* key, T otherwise) {
  T value{};
  return data != nullptr && data->Get(key, value) ? value : otherwise;
}

/// A scene as the nodes and tracks that make a clip.
class SceneToDocument {
 public:
  SceneToDocument(const aiScene& scene, const std::string& name, const JobContext& job)
      : scene_(scene), name_(name), job_(job) {}

  GltfDocument document() {
    add_nodes();
    document_.num_animations = static_cast<int>(scene_.mNumAnimations);
    if (scene_.mNumAnimations == 0) throw UnsupportedFile(name_ + ": holds no animation; motex reads moving skeletons");
    const aiAnimation& animation = *scene_.mAnimations[0];
    document_.animation_name = animation.mName.C_Str();
    ticks_per_sec_ = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 30;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) add_channel(*animation.mChannels[c]);
    mark_joints();
    if (num_sparse_ > 0)
      job_.warn(name_ + ": " + std::to_string(num_sparse_) + (num_sparse_ == 1 ? " joint has" : " joints have") +
                " keys more than a frame apart; between keys the motion is straight, not the editor's "
                "curve (baking the animation before export keeps it)");
    return std::move(document_);
  }

  /// Frames a second by which the file counts, or the density of its keys where that is higher.
  double frame_rate() const { return std::max(ticks_per_sec_, densest_); }

 private:
  void add_nodes();
  void add_node(const aiNode& node, int parent_idx);
  void add_channel(const aiNodeAnim& channel);
  template <typename Key, typename Put>
  bool add_track(int node_idx, GltfPath path, const Key* keys, unsigned count, Put put);
  void mark_joints();

  const aiScene& scene_;
  const std::string& name_;
  const JobContext& job_;
  GltfDocument document_;
  std::vector<double> accumulated_scale_;  ///< of a node's children, by node
  std::vector<double> own_scale_factor_;   ///< what a node's own scale is multiplied by
  std::vector<char> is_animated_, is_empty_;
  std::map<std::string, int> node_of_;
  double ticks_per_sec_ = 30, densest_ = 0;
  int num_sparse_ = 0;
};

void SceneToDocument::add_nodes() {
  std::vector<std::pair<const aiNode*, int>> open{{scene_.mRootNode, -1}};
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    const int idx = static_cast<int>(document_.nodes.size());
    if (document_.nodes.size() == kMostNodes) throw UnsupportedFile(name_ + ": has more than 100,000 nodes");
    add_node(*node, parent);
    for (unsigned k = node->mNumChildren; k-- > 0;) open.emplace_back(node->mChildren[k], idx);
  }
}

void SceneToDocument::add_node(const aiNode& node, int parent_idx) {
  aiVector3D scale, position;
  aiQuaternion rotation;
  node.mTransformation.Decompose(scale, rotation, position);
  GltfNode out;
  out.name = node.mName.C_Str();
  out.parent_idx = parent_idx;
  out.translation = vector_of(position);
  out.scale = vector_of(scale);
  out.rotation = Quat(static_cast<double>(rotation.w), static_cast<double>(rotation.x), static_cast<double>(rotation.y),
                      static_cast<double>(rotation.z));
  const bool usable = out.translation.allFinite() && out.scale.allFinite() && out.rotation.coeffs().allFinite() &&
                      out.translation.norm() < kLargestNumber && out.rotation.norm() > 0.1;
  if (!usable) throw InvalidInput(name_ + ": the place of node " + in_quotes(out.name) + " is not finite");
  out.rotation.normalize();
  const int idx = static_cast<int>(document_.nodes.size());
  double above = 1;
  if (parent_idx >= 0) {
    document_.nodes[static_cast<std::size_t>(parent_idx)].children.push_back(idx);
    above = accumulated_scale_[static_cast<std::size_t>(parent_idx)];
  }
  // A scale that is not inherited is what the children see, whatever stands above.
  const bool own = metadata<int>(node.mMetaData, "InheritType", 1) == kScaleNotInherited && above > 0;
  own_scale_factor_.push_back(own ? 1 / above : 1);
  out.scale *= own_scale_factor_.back();
  accumulated_scale_.push_back(above * std::cbrt(std::abs(out.scale.prod())));
  is_empty_.push_back(node.mNumMeshes == 0);
  node_of_.emplace(out.name, idx);
  document_.roots_first.push_back(idx);
  document_.nodes.push_back(std::move(out));
  is_animated_.push_back(0);
}

template <typename Key, typename Put>
bool SceneToDocument::add_track(int node_idx, GltfPath path, const Key* keys, unsigned count, Put put) {
  GltfTrack track;
  track.node_idx = node_idx;
  track.path = path;
  for (unsigned k = 0; k < count; ++k) {
    const double time = keys[k].mTime / ticks_per_sec_;
    if (!std::isfinite(time) || std::abs(time) > kLargestNumber)
      throw InvalidInput(name_ + ": a key's time is not finite");
    if (!track.times.empty() && time <= track.times.back()) continue;
    track.times.push_back(time);
    put(track.values, keys[k].mValue);
  }
  for (const double value : track.values)
    if (!std::isfinite(value) || std::abs(value) > kLargestNumber)
      throw InvalidInput(name_ + ": a key of the animation is not finite");
  if (track.times.empty()) return false;
  const std::size_t width = path == GltfPath::kRotation ? 4 : 3, last = track.times.size() - 1;
  bool moves = false;
  for (std::size_t i = width; i < track.values.size(); ++i)
    moves = moves || std::abs(track.values[i] - track.values[i - width]) > 1e-9;
  const double span = track.times.back() - track.times.front();
  if (span > 0) densest_ = std::max(densest_, std::round(static_cast<double>(last) / span * 1e4) / 1e4);
  const bool sparse = moves && static_cast<double>(last) * kSparse < span * ticks_per_sec_;
  document_.tracks.push_back(std::move(track));
  return sparse;
}

void SceneToDocument::add_channel(const aiNodeAnim& channel) {
  const auto found = node_of_.find(channel.mNodeName.C_Str());
  if (found == node_of_.end()) return;
  const int idx = found->second;
  const auto put_vector = [](std::vector<double>& out, const aiVector3D& v) {
    for (const double x : vector_of(v)) out.push_back(x);
  };
  const auto put_quat = [](std::vector<double>& out, const aiQuaternion& q) {
    for (const double x :
         {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z), static_cast<double>(q.w)})
      out.push_back(x);
  };
  bool sparse = add_track(idx, GltfPath::kTranslation, channel.mPositionKeys, channel.mNumPositionKeys, put_vector);
  sparse |= add_track(idx, GltfPath::kRotation, channel.mRotationKeys, channel.mNumRotationKeys, put_quat);
  num_sparse_ += sparse ? 1 : 0;
  is_animated_[static_cast<std::size_t>(idx)] = 1;
  for (unsigned k = 1; k < channel.mNumScalingKeys; ++k) {
    const Vector3 a = vector_of(channel.mScalingKeys[0].mValue), b = vector_of(channel.mScalingKeys[k].mValue);
    if ((a - b).norm() > kSameScale * a.norm()) {
      job_.warn(name_ + ": the scale of " + in_quotes(channel.mNodeName.C_Str()) +
                " is animated; it is kept as it stands at rest");
      break;
    }
  }
}

// Bones of meshes, and empty nodes below what moves: tips of limbs.
void SceneToDocument::mark_joints() {
  std::set<std::string> bones;
  for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
    for (unsigned b = 0; b < scene_.mMeshes[m]->mNumBones; ++b)
      bones.insert(scene_.mMeshes[m]->mBones[b]->mName.C_Str());
  std::vector<char> below(document_.nodes.size(), 0);
  for (std::size_t n = 0; n < document_.nodes.size(); ++n) {
    GltfNode& node = document_.nodes[n];
    if (node.parent_idx >= 0) {
      const auto p = static_cast<std::size_t>(node.parent_idx);
      below[n] = static_cast<char>(below[p] || is_animated_[p]);
    }
    node.is_joint = bones.count(node.name) > 0 || (below[n] && is_empty_[n]);
  }
}

const aiScene* import(Assimp::Importer& importer, std::string_view bytes, const std::string& name) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_MATERIALS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx");
  } catch (const std::exception& error) {
    throw InvalidInput(name + ": cannot be read as FBX: " + error.what());
  } catch (...) {
    throw InvalidInput(name + ": cannot be read as FBX");
  }
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InvalidInput(name + ": cannot be read as FBX: " + importer.GetErrorString());
  return scene;
}

/// Assimp overflows its stack and runs without end on some broken files. It reads each file in a child process first;
/// only what the child survives is read here.
void try_in_child(std::string_view bytes, const std::string& name) {
  const auto read = [&] {
    Assimp::Importer importer;
    import(importer, bytes, name);
  };
  if (!survives_in_child(read, kMostSecs))
    throw InvalidInput(name + ": libassimp, which reads FBX here, fails on this file; save the motion as BVH or GLB");
}

}  // namespace

bool reads_fbx() { return true; }

Clip read_fbx_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                    const JobContext& job) {
  check_fbx_records(bytes, name);
  try_in_child(bytes, name);
  Assimp::Importer importer;
  const aiScene* scene = import(importer, bytes, name);
  SceneToDocument converter(*scene, name, job);
  const GltfDocument document = converter.document();
  ReadClipOptions sampled = options;
  if (sampled.fps == 0) sampled.fps = converter.frame_rate();
  Clip clip = clip_of_nodes(document, name, bytes.size(), sampled, job);
  const double centimetres = static_cast<double>(metadata<float>(scene->mMetaData, "UnitScaleFactor", 1));
  const double factor = metadata<double>(scene->mMetaData, "UnitScaleFactor", centimetres);
  clip.skeleton.metres_per_unit = factor > 0 && std::isfinite(factor) ? 0.01 * factor : 0;
  const int up = metadata<int>(scene->mMetaData, "UpAxis", 1);
  if (options.up == UpAxis::kAuto && up == 2) turn_z_up_to_y_up(clip);
  if (options.up == UpAxis::kAuto && up == 0)
    job.warn(name + ": says that its x axis points up; the motion is left as it is");
  return clip;
}

}  // namespace motex

#else

namespace motex {

bool reads_fbx() { return false; }

Clip read_fbx_bytes(std::string_view, const std::string& name, const ReadClipOptions&, const JobContext&) {
  throw UnsupportedFile(name +
                        ": is an FBX file, and this build of motex reads none; build it where libassimp-dev is "
                        "installed, or save the motion as BVH or GLB (Blender does)");
}

}  // namespace motex

#endif
