// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

namespace fs = std::filesystem;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string decode_base64(std::string_view text, const std::string& name) {
  std::string out;
  std::uint32_t bits = 0;
  int num_bits = 0;
  for (const char c : text) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) throw InvalidInput(name + ": a buffer's base64 text is broken");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    num_bits += 6;
    if (num_bits < 8) continue;
    num_bits -= 8;
    out += static_cast<char>(bits >> num_bits & 0xFF);
  }
  return out;
}

std::string decode_percent(const std::string& uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto hex = [](char c) { return std::string_view("0123456789abcdef").find(static_cast<char>(c | 0x20)); };
    if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) < 16 && hex(uri[i + 2]) < 16) {
      out += static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2]));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

template <typename T>
double component(const char* at, double full_scale) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return full_scale == 0 ? static_cast<double>(value) : std::max(static_cast<double>(value) / full_scale, -1.0);
}

}  // namespace

GltfParts split_glb(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 4) != "glTF") return {bytes, std::nullopt};
  const auto fail = [&](std::size_t at, const std::string& message) {
    throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at), message);
  };
  if (bytes.size() < 20) fail(bytes.size(), "the file ends inside the header");
  if (u32(bytes, 4) != 2)
    throw UnsupportedFile(name + ": is glTF version " + std::to_string(u32(bytes, 4)) + "; 2 is read");
  GltfParts parts;
  for (std::size_t at = 12, chunk = 0; at < bytes.size(); ++chunk) {
    if (bytes.size() - at < 8) {
      if (chunk == 0) fail(at, "the file ends inside a chunk's header");
      break;  // stray bytes behind the last chunk
    }
    const std::size_t size = u32(bytes, at);
    const std::uint32_t kind = u32(bytes, at + 4);
    if (size > bytes.size() - at - 8) fail(at, "the chunk is larger than the file: the file is cut short");
    if (chunk == 0 && kind != kJsonChunk) fail(at, "the first chunk is not JSON");
    if (chunk == 0) parts.json = bytes.substr(at + 8, size);
    if (chunk == 1 && kind == kBinaryChunk) parts.binary = bytes.substr(at + 8, size);
    at += 8 + size + (4 - size % 4) % 4;
  }
  return parts;
}

std::string load_gltf_uri(const std::string& uri, const std::string& name, const fs::path& folder) {
  if (uri.compare(0, 5, "data:") == 0) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == uri.npos) throw UnsupportedFile(name + ": a buffer's data is not base64");
    return decode_base64(std::string_view(uri).substr(comma + 8), name);
  }
  if (folder.empty())
    throw UnsupportedFile(name + ": a buffer is in another file, " + in_quotes(uri) + "; give the path");
  const fs::path relative = decode_percent(uri);
  const bool outside = relative.is_absolute() || uri.find(':') != uri.npos ||
                       std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (outside) throw InvalidInput(name + ": the buffer " + in_quotes(uri) + " is not in the file's folder");
  return read_file(folder / relative);
}

std::uint64_t gltf_component_size(int component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::vector<double> decode_gltf_elements(std::string_view bytes, const GltfElements& elements,
                                         const std::string& name) {
  const std::uint64_t size = gltf_component_size(elements.component_type);
  const std::uint64_t element = size * static_cast<std::uint64_t>(elements.num_components);
  if (size == 0)
    throw UnsupportedFile(name + ": accessors of type " + std::to_string(elements.component_type) + " are not read");
  const bool fits =
      elements.stride >= element && elements.stride <= 255 && elements.offset <= bytes.size() &&
      elements.count <= bytes.size() &&
      (elements.count == 0 || (elements.count - 1) * elements.stride + element <= bytes.size() - elements.offset);
  if (!fits) throw InvalidInput(name + ": an accessor reaches beyond its buffer; the file is broken or cut short");
  std::vector<double> values;
  values.reserve(elements.count * static_cast<std::uint64_t>(elements.num_components));
  for (std::uint64_t i = 0; i < elements.count; ++i)
    for (int c = 0; c < elements.num_components; ++c) {
      const char* at = bytes.data() + elements.offset + i * elements.stride + static_cast<std::uint64_t>(c) * size;
      switch (elements.component_type) {
        case 5120:
          values.push_back(component<std::int8_t>(at, 127));
          break;
        case 5121:
          values.push_back(component<std::uint8_t>(at, 255));
          break;
        case 5122:
          values.push_back(component<std::int16_t>(at, 32767));
          break;
        case 5123:
          values.push_back(component<std::uint16_t>(at, 65535));
          break;
        case 5125:
          values.push_back(component<std::uint32_t>(at, 0));
          break;
        default:
          values.push_back(component<float>(at, 0));
      }
    }
  return values;
}

}  // namespace motex
