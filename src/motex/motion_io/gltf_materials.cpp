// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr std::uint64_t kMostTexcoords = 8;

/// Index of a list element, or −1.
int index_of(const Json& object, const char* key, std::size_t size) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() >= size) return -1;
  return found->get<int>();
}

std::uint64_t size_of(const Json& object, const char* key, std::uint64_t otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : otherwise;
}

class MaterialReader {
 public:
  MaterialReader(const GltfParts& parts, const std::string& name, const std::filesystem::path& folder,
                 std::size_t most_bytes)
      : parts_(parts), name_(name), folder_(folder), most_bytes_(most_bytes), root_(Json::parse(parts.json)) {}

  GltfMaterials read() {
    read_pictures();
    read_samplers();
    read_textures();
    Json materials = Json::array();
    for (const Json& from : list("materials")) materials.push_back(material(from));
    out_.materials = materials.dump(-1, ' ', false, Json::error_handler_t::replace);
    return std::move(out_);
  }

 private:
  const Json& list(const char* key) const {
    static const Json empty = Json::array();
    const auto found = root_.find(key);
    return found != root_.end() && found->is_array() ? *found : empty;
  }
  void drop(const std::string& what) {
    if (std::find(out_.dropped.begin(), out_.dropped.end(), what) == out_.dropped.end()) out_.dropped.push_back(what);
  }
  std::string picture_bytes(const Json& image) const;
  void read_pictures();
  void read_samplers();
  void read_textures();
  Json material(const Json& from);
  void add_texture(const Json& from, const char* key, const char* factor, Json& to);
  static void add_numbers(const Json& from, const char* key, std::size_t count, double low, double high, Json& to);

  const GltfParts& parts_;
  std::string name_;
  std::filesystem::path folder_;
  std::size_t most_bytes_;
  Json root_;
  std::vector<int> picture_of_, texture_of_;  // new index by old one, or −1
  int texcoords_ = 0;
  GltfMaterials out_;
};

std::string MaterialReader::picture_bytes(const Json& image) const {
  if (const auto uri = image.find("uri"); uri != image.end() && uri->is_string())
    return load_gltf_uri(uri->get<std::string>(), name_, folder_);
  const Json& views = list("bufferViews");
  const int v = index_of(image, "bufferView", views.size());
  if (v < 0) return "";
  const Json& view = views[static_cast<std::size_t>(v)];
  const int b = index_of(view, "buffer", list("buffers").size());
  if (b < 0) return "";
  std::string loaded;
  const Json& buffer = list("buffers")[static_cast<std::size_t>(b)];
  std::string_view bytes;
  if (const auto uri = buffer.find("uri"); uri != buffer.end() && uri->is_string()) {
    loaded = load_gltf_uri(uri->get<std::string>(), name_, folder_);
    bytes = loaded;
  } else if (b == 0 && parts_.binary) {
    bytes = *parts_.binary;
  }
  const std::uint64_t offset = size_of(view, "byteOffset", 0), size = size_of(view, "byteLength", 0);
  if (offset > bytes.size() || size > bytes.size() - offset) return "";
  return std::string(bytes.substr(offset, size));
}

void MaterialReader::read_pictures() {
  std::size_t total = 0;
  for (const Json& image : list("images")) {
    picture_of_.push_back(-1);
    std::string bytes;
    try {
      if (image.is_object()) bytes = picture_bytes(image);
    } catch (const Error&) {
      // said below
    }
    const bool png = bytes.starts_with("\x89PNG\r\n\x1a\n"), jpeg = bytes.starts_with("\xFF\xD8\xFF");
    total += bytes.size();
    if ((!png && !jpeg) || total > most_bytes_) {
      drop("pictures that are not PNG or JPEG, or cannot be read");
      continue;
    }
    picture_of_.back() = static_cast<int>(out_.pictures.size());
    out_.pictures.push_back(std::move(bytes));
    out_.picture_types.emplace_back(png ? "image/png" : "image/jpeg");
  }
}

void MaterialReader::read_samplers() {
  Json samplers = Json::array();
  for (const Json& from : list("samplers")) {
    Json to = Json::object();
    const auto keep = [&](const char* key, std::initializer_list<int> values) {
      if (!from.is_object()) return;
      const auto found = from.find(key);
      if (found != from.end() && found->is_number_integer() &&
          std::find(values.begin(), values.end(), found->get<std::int64_t>()) != values.end())
        to[key] = *found;
    };
    keep("magFilter", {9728, 9729});
    keep("minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    keep("wrapS", {33071, 33648, 10497});
    keep("wrapT", {33071, 33648, 10497});
    samplers.push_back(std::move(to));
  }
  out_.samplers = samplers.dump();
}

void MaterialReader::read_textures() {
  Json textures = Json::array();
  for (const Json& from : list("textures")) {
    texture_of_.push_back(-1);
    const int image = from.is_object() ? index_of(from, "source", picture_of_.size()) : -1;
    if (image < 0 || picture_of_[static_cast<std::size_t>(image)] < 0) {
      drop("textures without a PNG or JPEG picture");
      continue;
    }
    Json to = {{"source", picture_of_[static_cast<std::size_t>(image)]}};
    if (const int sampler = index_of(from, "sampler", list("samplers").size()); sampler >= 0) to["sampler"] = sampler;
    texture_of_.back() = static_cast<int>(textures.size());
    textures.push_back(std::move(to));
  }
  out_.textures = textures.dump();
}

void MaterialReader::add_numbers(const Json& from, const char* key, std::size_t count, double low, double high,
                                 Json& to) {
  const auto found = from.find(key);
  if (found == from.end()) return;
  const auto good = [&](const Json& value) {
    return value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
  };
  if (count == 1 ? good(*found)
                 : found->is_array() && found->size() == count && std::all_of(found->begin(), found->end(), good))
    to[key] = *found;
}

/// A texture's place in a material; its offset, turn and scale (KHR_texture_transform) are kept.
void MaterialReader::add_texture(const Json& from, const char* key, const char* factor, Json& to) {
  const auto found = from.find(key);
  if (found == from.end() || !found->is_object()) return;
  const int old = index_of(*found, "index", texture_of_.size());
  if (old < 0 || texture_of_[static_cast<std::size_t>(old)] < 0) return;
  Json info = {{"index", texture_of_[static_cast<std::size_t>(old)]}};
  const std::uint64_t set = size_of(*found, "texCoord", 0);
  if (set >= kMostTexcoords) return;
  if (set > 0) info["texCoord"] = set;
  if (factor != nullptr)
    add_numbers(*found, factor, 1, factor == std::string_view("strength") ? 0 : -1e6,
                factor == std::string_view("strength") ? 1 : 1e6, info);
  if (const auto extensions = found->find("extensions"); extensions != found->end() && extensions->is_object())
    if (const auto move = extensions->find("KHR_texture_transform"); move != extensions->end() && move->is_object()) {
      Json kept = Json::object();
      add_numbers(*move, "offset", 2, -1e6, 1e6, kept);
      add_numbers(*move, "scale", 2, -1e6, 1e6, kept);
      add_numbers(*move, "rotation", 1, -1e6, 1e6, kept);
      if (!kept.empty()) info["extensions"]["KHR_texture_transform"] = kept;
    }
  texcoords_ = std::max(texcoords_, static_cast<int>(set) + 1);
  to[key] = std::move(info);
}

Json MaterialReader::material(const Json& from) {
  Json to = Json::object();
  texcoords_ = 0;
  if (from.is_object()) {
    if (const auto name = from.find("name"); name != from.end() && name->is_string()) to["name"] = *name;
    if (const auto pbr = from.find("pbrMetallicRoughness"); pbr != from.end() && pbr->is_object()) {
      Json kept = Json::object();
      add_numbers(*pbr, "baseColorFactor", 4, 0, 1, kept);
      add_numbers(*pbr, "metallicFactor", 1, 0, 1, kept);
      add_numbers(*pbr, "roughnessFactor", 1, 0, 1, kept);
      add_texture(*pbr, "baseColorTexture", nullptr, kept);
      add_texture(*pbr, "metallicRoughnessTexture", nullptr, kept);
      to["pbrMetallicRoughness"] = std::move(kept);
    }
    add_texture(from, "normalTexture", "scale", to);
    add_texture(from, "occlusionTexture", "strength", to);
    add_texture(from, "emissiveTexture", nullptr, to);
    add_numbers(from, "emissiveFactor", 3, 0, 1, to);
    const Json mode = from.value("alphaMode", Json("OPAQUE"));
    if (mode == "MASK" || mode == "BLEND") to["alphaMode"] = mode;
    if (mode == "MASK") add_numbers(from, "alphaCutoff", 1, 0, 1e6, to);
    if (from.value("doubleSided", Json(false)) == true) to["doubleSided"] = true;
    if (const auto extensions = from.find("extensions"); extensions != from.end() && extensions->is_object()) {
      if (extensions->contains("KHR_materials_unlit")) to["extensions"]["KHR_materials_unlit"] = Json::object();
      if (extensions->size() > (extensions->contains("KHR_materials_unlit") ? 1U : 0U))
        drop("extensions of materials other than unlit");
    }
  }
  out_.num_texcoords.push_back(texcoords_);
  return to;
}

}  // namespace

GltfMaterials read_gltf_materials(const GltfParts& parts, const std::string& name, const std::filesystem::path& folder,
                                  std::size_t most_bytes) {
  return MaterialReader(parts, name, folder, most_bytes).read();
}

}  // namespace motex
