// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf_container.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/motion_io/gltf_buffers.h"

namespace motex {

using Json = nlohmann::json;

int GlbBuilder::add_view(const void* data, std::size_t num_bytes, int target) {
  views_.push_back({binary_.size(), num_bytes, target});
  binary_.append(static_cast<const char*>(data), num_bytes);
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  return static_cast<int>(views_.size()) - 1;
}

int GlbBuilder::add(const void* data, std::size_t num_bytes, const Kind& kind) {
  accessors_.push_back({add_view(data, num_bytes, kind.target), kind, {}, {}});
  return static_cast<int>(accessors_.size()) - 1;
}

void GlbBuilder::set_bounds(int accessor, const std::vector<float>& values, std::size_t num_components) {
  Accessor& a = accessors_[static_cast<std::size_t>(accessor)];
  a.low.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(num_components));
  a.high = a.low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    a.low[i % num_components] = std::min(a.low[i % num_components], values[i]);
    a.high[i % num_components] = std::max(a.high[i % num_components], values[i]);
  }
}

void GlbBuilder::import(std::string_view glb, const std::string& name) {
  static constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"};
  const GltfParts parts = split_glb(glb, name);
  if (!parts.binary) throw InvalidInput(name + ": its skin has no data");
  binary_ = *parts.binary;
  const Json root = Json::parse(parts.json);
  for (const Json& view : root.at("bufferViews")) {
    views_.push_back({view.at("byteOffset"), view.at("byteLength"), view.value("target", 0)});
    if (views_.back().offset > binary_.size() || views_.back().size > binary_.size() - views_.back().offset)
      throw InvalidInput(name + ": its skin is cut short");
  }
  for (const Json& from : root.at("accessors")) {
    const auto type = std::find(std::begin(kTypes), std::end(kTypes), from.at("type").get<std::string>());
    if (type == std::end(kTypes) || from.at("bufferView").get<std::size_t>() >= views_.size())
      throw InvalidInput(name + ": its skin is broken");
    const int view = from.at("bufferView");
    accessors_.push_back(
        {view,
         {from.at("componentType"), *type, from.at("count"), views_[static_cast<std::size_t>(view)].target},
         from.value("min", std::vector<float>()),
         from.value("max", std::vector<float>())});
  }
}

char* GlbBuilder::data(int accessor) {
  return binary_.data() + views_[static_cast<std::size_t>(accessors_[static_cast<std::size_t>(accessor)].view)].offset;
}

std::string GlbBuilder::file(std::string_view text, const std::string& name) const {
  Json root = Json::parse(text);
  for (const View& view : views_) {
    Json entry = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.size}};
    if (view.target != 0) entry["target"] = view.target;
    root["bufferViews"].push_back(std::move(entry));
  }
  for (const Accessor& a : accessors_) {
    Json entry = {{"bufferView", a.view},
                  {"componentType", a.kind.component_type},
                  {"count", a.kind.count},
                  {"type", a.kind.type}};
    if (!a.low.empty()) entry["min"] = a.low, entry["max"] = a.high;
    root["accessors"].push_back(std::move(entry));
  }
  root["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  if (binary_.size() + json.size() > 0xFFFFFF00U) throw InvalidInput(name + ": a GLB file holds at most 4 GiB");
  std::string out = "glTF";
  const auto u32 = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
  };
  u32(2), u32(12 + 8 + json.size() + 8 + binary_.size());
  u32(json.size()), out += "JSON", out += json;
  u32(binary_.size()), out.append("BIN\0", 4), out += binary_;
  return out;
}

}  // namespace motex
