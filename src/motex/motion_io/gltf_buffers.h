// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motex {

/// The two parts of a .glb file, or a .gltf text as it is.
struct GltfParts {
  std::string_view json;
  std::optional<std::string_view> binary;
};
GltfParts split_glb(std::string_view bytes, const std::string& name);

/// The bytes behind a buffer's URI: base64 data or a file below folder. Throws InvalidInput, UnsupportedFile.
std::string load_gltf_uri(const std::string& uri, const std::string& name, const std::filesystem::path& folder);

/// Elements of `num_components` numbers, `stride` bytes apart.
struct GltfElements {
  std::uint64_t offset = 0, count = 0, stride = 0;
  int component_type = 5126, num_components = 1;
};
/// Bytes of a component, 0 for unknown types.
std::uint64_t gltf_component_size(int component_type);
/// All numbers as double; integers of 8 and 16 bits are mapped to 0 … 1 or −1 … 1. Throws InvalidInput when the bytes
/// do not hold them.
std::vector<double> decode_gltf_elements(std::string_view bytes, const GltfElements& elements, const std::string& name);

}  // namespace motex
