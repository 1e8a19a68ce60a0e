// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/skeleton.h"
#include "motex/motion_io/gltf_document.h"

namespace motex {

/// The skinned meshes of a glTF file whose nodes are in `document`: triangles with positions, normals, tangents,
/// texture coordinates, colours, joints and weights; materials (metallic-roughness, unlit) and PNG or JPEG pictures.
/// Constant scale is folded into the inverse bind matrices. What is left out is said by job.warn: morph targets,
/// compressed or sparse data, meshes that no joint moves. node_names: by node, as the skeleton calls its joints. Null
/// when the file has no skinned mesh, or (with a warning) none that can be kept. Memory is bounded by the size of the
/// file.
std::shared_ptr<const Skin> extract_skin(std::string_view bytes, const std::string& name,
                                         const std::filesystem::path& folder, const GltfDocument& document,
                                         const std::vector<std::string>& node_names, const JobContext& job);

/// Of any glTF file, animated or not; also what Skin::glb holds, from strangers too. Throws InvalidInput when it has no
/// skinned mesh that can be kept.
std::shared_ptr<const Skin> read_skin(const std::filesystem::path& path, const JobContext& job = {});
std::shared_ptr<const Skin> read_skin_bytes(std::string_view bytes, const std::string& name,
                                            const JobContext& job = {});

/// Whether every joint of its skin is in the skeleton; false without skin.
bool skin_fits(const Skeleton& skeleton);

/// The skin for a skeleton of its own: joint names are equal but for case and prefix, and either the joints' frames are
/// those of the skin, or the skeleton at rest stands as the skin was bound (frames may differ, as in BVH). Throws
/// InvalidInput naming a joint that is missing, or when the bones differ.
std::shared_ptr<const Skin> lend_skin(const Skin& skin, const Skeleton& skeleton);

}  // namespace motex
