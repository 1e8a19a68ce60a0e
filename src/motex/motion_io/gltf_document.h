// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion/rotation.h"
#include "motex/motion_io/read_options.h"

namespace motex {

struct GltfNode {
  std::string name;
  int parent_idx = -1;
  std::vector<int> children;
  Vector3 translation = Vector3::Zero();
  Quat rotation = Quat::Identity();
  Vector3 scale = Vector3::Ones();
  bool is_joint = false;           ///< of some skin
  std::vector<Vector3> end_sites;  ///< as motex writes them
};

enum class GltfPath { kTranslation, kRotation, kScale };
enum class GltfInterpolation { kLinear, kStep, kCubicSpline };

/// How one property of a node moves.
struct GltfTrack {
  int node_idx = 0;
  GltfPath path = GltfPath::kTranslation;
  GltfInterpolation interpolation = GltfInterpolation::kLinear;
  std::vector<double> times;   ///< seconds, rising
  std::vector<double> values;  ///< keys × 3 or 4 (x, y, z, w); cubic: keys × (in-tangent, value, out-tangent)
};

/// What a clip needs of a glTF file, with every index and size checked.
struct GltfDocument {
  std::vector<GltfNode> nodes;
  std::vector<int> roots_first;  ///< all nodes, parents before children, depth first
  int num_animations = 0;
  std::string animation_name;     ///< of the first
  std::vector<GltfTrack> tracks;  ///< of the first
};

/// folder: where buffers in other files are looked for; empty = nowhere.
GltfDocument parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder);

/// The moving skeleton of the nodes: read_gltf after parsing, for other formats of nodes and tracks too. num_bytes: of
/// the file, bounds memory. Lengths are taken for metres.
Clip clip_of_nodes(const GltfDocument& document, const std::string& name, std::size_t num_bytes,
                   const ReadClipOptions& options, const JobContext& job);

}  // namespace motex
