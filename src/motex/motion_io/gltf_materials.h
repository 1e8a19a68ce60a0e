// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion_io/gltf_buffers.h"

namespace motex {

/// Materials of a glTF file with what they need, every value checked; unknown extensions are dropped.
struct GltfMaterials {
  std::string materials = "[]", textures = "[]", samplers = "[]";  ///< JSON lists
  std::vector<std::string> pictures;                               ///< PNG or JPEG, by texture's source
  std::vector<std::string> picture_types;                          ///< "image/png", "image/jpeg"
  std::vector<int> num_texcoords;    ///< by material: how many sets of texture coordinates it asks for
  std::vector<std::string> dropped;  ///< what could not be kept, for a person
};

/// most_bytes: bound of all pictures together.
GltfMaterials read_gltf_materials(const GltfParts& parts, const std::string& name, const std::filesystem::path& folder,
                                  std::size_t most_bytes);

}  // namespace motex
