// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/motion_io/gltf_buffers.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

using Json = nlohmann::json;
constexpr double kLargestNumber = 1e12;

class GltfParser {
 public:
  GltfParser(std::string_view bytes, const std::string& name, const std::filesystem::path& folder)
      : name_(name), folder_(folder), parts_(split_glb(bytes, name)) {}

  GltfDocument parse() {
    try {
      root_ = Json::parse(parts_.json);
    } catch (const Json::parse_error& e) {
      throw ParseError(name_, ParseError::Unit::kByte, static_cast<std::int64_t>(e.byte), "the JSON is broken");
    } catch (const Json::exception&) {
      fail("the JSON is broken: it holds a number beyond any range");
    }
    try {
      check_kind();
      read_nodes();
      order_nodes();
      read_skins();
      read_animation();
    } catch (const Json::exception& e) {
      fail(std::string("the JSON does not follow the glTF standard: ") + e.what());
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InvalidInput(name_ + ": " + message); }
  const Json& list(const char* key) const;
  const Json& item(const char* key, const Json& idx) const;
  std::size_t index(const Json& value, std::size_t size, const char* what) const;
  static std::uint64_t size_of(const Json& object, const char* key, std::uint64_t otherwise);
  void numbers(const Json& values, double* out, std::size_t count) const;

  void check_kind();
  void read_nodes();
  void read_transform(const Json& from, GltfNode& node) const;
  void order_nodes();
  void read_skins();
  void read_animation();
  GltfTrack read_track(const Json& channel, const Json& samplers, GltfPath path);
  std::vector<double> read_accessor(const Json& idx, int num_components);
  std::string_view buffer(const Json& idx);

  std::string name_;
  std::filesystem::path folder_;
  GltfParts parts_;
  Json root_;
  std::vector<std::optional<std::string>> loaded_;
  std::size_t num_decoded_ = 0;
  GltfDocument out_;
};

const Json& GltfParser::list(const char* key) const {
  static const Json empty = Json::array();
  const auto found = root_.find(key);
  if (found == root_.end()) return empty;
  if (!found->is_array()) fail(std::string("'") + key + "' is not a list");
  return *found;
}

std::size_t GltfParser::index(const Json& value, std::size_t size, const char* what) const {
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::uint64_t>() >= size)
    fail(std::string("an index into '") + what + "' is wrong");
  return value.get<std::size_t>();
}

const Json& GltfParser::item(const char* key, const Json& idx) const {
  const Json& all = list(key);
  const Json& found = all[index(idx, all.size(), key)];
  if (!found.is_object()) fail(std::string("'") + key + "' holds what is no object");
  return found;
}

std::uint64_t GltfParser::size_of(const Json& object, const char* key, std::uint64_t otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  return found->is_number_unsigned() ? found->get<std::uint64_t>() : ~std::uint64_t{0};
}

void GltfParser::numbers(const Json& values, double* out, std::size_t count) const {
  if (!values.is_array() || values.size() != count) fail("a node's transform has the wrong number of values");
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = values[i].get<double>();
    if (!(std::abs(out[i]) <= kLargestNumber)) fail("a node's transform is not finite");
  }
}

void GltfParser::check_kind() {
  if (!root_.is_object() || root_.find("asset") == root_.end()) fail("the JSON is not a glTF file: it has no 'asset'");
  const Json version = root_["asset"].value("version", Json("2.0"));
  if (!version.is_string() || version.get<std::string>().substr(0, 1) != "2")
    throw UnsupportedFile(name_ + ": glTF version 2 is read, this is " + version.dump());
  for (const Json& extension : list("extensionsRequired"))
    if (extension == "EXT_meshopt_compression" || extension == "KHR_meshopt_compression")
      throw UnsupportedFile(name_ + ": its buffers are compressed (" + extension.get<std::string>() +
                            "); export it without compression");
}

void GltfParser::read_transform(const Json& from, GltfNode& node) const {
  if (const auto matrix = from.find("matrix"); matrix != from.end()) {
    Eigen::Matrix4d m;
    numbers(*matrix, m.data(), 16);
    node.translation = m.topRightCorner<3, 1>();
    Eigen::Matrix3d r = m.topLeftCorner<3, 3>();
    node.scale = r.colwise().norm().transpose();
    if (!(node.scale.minCoeff() > 1e-12)) fail("a node's matrix flattens space");
    if (r.determinant() < 0) node.scale.x() = -node.scale.x();
    for (int i = 0; i < 3; ++i) r.col(i) /= node.scale[i];
    node.rotation = Quat(r).normalized();
  }
  if (const auto t = from.find("translation"); t != from.end()) numbers(*t, node.translation.data(), 3);
  if (const auto s = from.find("scale"); s != from.end()) numbers(*s, node.scale.data(), 3);
  if (const auto r = from.find("rotation"); r != from.end()) numbers(*r, node.rotation.coeffs().data(), 4);
  if (!(node.rotation.norm() > 1e-6)) fail("a node's rotation is no rotation");
  node.rotation.normalize();
}

void GltfParser::read_nodes() {
  const Json& nodes = list("nodes");
  out_.nodes.resize(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Json& from = nodes[n];
    if (!from.is_object()) fail("a node is no object");
    GltfNode& node = out_.nodes[n];
    node.name = from.value("name", "");
    read_transform(from, node);
    if (const auto extras = from.find("extras"); extras != from.end() && extras->is_object())
      if (const auto sites = extras->find("end_sites"); sites != extras->end() && sites->is_array())
        for (const Json& site : *sites) numbers(site, node.end_sites.emplace_back().data(), 3);
    const auto children = from.find("children");
    if (children == from.end()) continue;
    for (const Json& child : *children) {
      const std::size_t c = index(child, nodes.size(), "nodes");
      if (out_.nodes[c].parent_idx >= 0) fail("node " + std::to_string(c) + " has two parents");
      out_.nodes[c].parent_idx = static_cast<int>(n);
      node.children.push_back(static_cast<int>(c));
    }
  }
}

void GltfParser::order_nodes() {
  std::vector<int> open;
  for (std::size_t n = out_.nodes.size(); n-- > 0;)
    if (out_.nodes[n].parent_idx < 0) open.push_back(static_cast<int>(n));
  while (!open.empty()) {
    const int n = open.back();
    open.pop_back();
    out_.roots_first.push_back(n);
    const auto& children = out_.nodes[static_cast<std::size_t>(n)].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  if (out_.roots_first.size() != out_.nodes.size()) fail("nodes are their own ancestors");
}

void GltfParser::read_skins() {
  for (const Json& skin : list("skins"))
    for (const Json& joint : skin.at("joints")) out_.nodes[index(joint, out_.nodes.size(), "nodes")].is_joint = true;
}

void GltfParser::read_animation() {
  const Json& animations = list("animations");
  out_.num_animations = static_cast<int>(animations.size());
  if (animations.empty()) return;
  const Json& first = animations[0];
  out_.animation_name = first.value("name", "");
  for (const Json& channel : first.at("channels")) {
    const Json& target = channel.at("target");
    if (target.find("node") == target.end()) continue;
    const std::string path = target.at("path").get<std::string>();
    if (path == "translation") out_.tracks.push_back(read_track(channel, first.at("samplers"), GltfPath::kTranslation));
    if (path == "rotation") out_.tracks.push_back(read_track(channel, first.at("samplers"), GltfPath::kRotation));
    if (path == "scale") out_.tracks.push_back(read_track(channel, first.at("samplers"), GltfPath::kScale));
  }
}

GltfTrack GltfParser::read_track(const Json& channel, const Json& samplers, GltfPath path) {
  const Json& sampler = samplers.at(index(channel.at("sampler"), samplers.size(), "samplers"));
  GltfTrack track;
  track.node_idx = static_cast<int>(index(channel.at("target").at("node"), out_.nodes.size(), "nodes"));
  track.path = path;
  const std::string way = sampler.value("interpolation", "LINEAR");
  if (way == "STEP") track.interpolation = GltfInterpolation::kStep;
  if (way == "CUBICSPLINE") track.interpolation = GltfInterpolation::kCubicSpline;
  const std::size_t num_components = path == GltfPath::kRotation ? 4 : 3;
  const std::size_t per_key = track.interpolation == GltfInterpolation::kCubicSpline ? 3 : 1;
  track.times = read_accessor(sampler.at("input"), 1);
  track.values = read_accessor(sampler.at("output"), static_cast<int>(num_components));
  if (track.times.empty() || track.values.size() != track.times.size() * num_components * per_key)
    fail("an animation track has " + std::to_string(track.times.size()) + " times and " +
         std::to_string(track.values.size() / num_components) + " values");
  for (std::size_t i = 0; i < track.times.size(); ++i)
    if (!(std::abs(track.times[i]) <= 1e9) || (i > 0 && !(track.times[i] > track.times[i - 1])))
      fail("the times of an animation track do not rise");
  for (const double x : track.values)
    if (!(std::abs(x) <= kLargestNumber)) fail("an animation track holds a number that is not finite");
  return track;
}

std::vector<double> GltfParser::read_accessor(const Json& idx, int num_components) {
  const Json& accessor = item("accessors", idx);
  if (accessor.find("sparse") != accessor.end())
    throw UnsupportedFile(name_ + ": an animation uses sparse accessors; export it without them");
  static constexpr const char* kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
  if (accessor.at("type") != kTypes[num_components])
    fail("an animation's accessor is not of type " + std::string(kTypes[num_components]));
  const Json& view = item("bufferViews", accessor.at("bufferView"));
  const std::string_view bytes = buffer(view.at("buffer"));
  const std::uint64_t view_offset = size_of(view, "byteOffset", 0), view_size = size_of(view, "byteLength", ~0ULL);
  if (view_offset > bytes.size() || view_size > bytes.size() - view_offset)
    fail("a buffer view reaches beyond its buffer; the file is broken or cut short");
  GltfElements elements;
  elements.component_type = accessor.at("componentType").get<int>();
  elements.num_components = num_components;
  elements.offset = size_of(accessor, "byteOffset", 0);
  elements.count = size_of(accessor, "count", 0);
  const std::uint64_t packed =
      gltf_component_size(elements.component_type) * static_cast<std::uint64_t>(num_components);
  elements.stride = size_of(view, "byteStride", packed);
  // Thousands of tracks may share one accessor: what is decoded is bounded by the file's own size.
  std::vector<double> values = decode_gltf_elements(bytes.substr(view_offset, view_size), elements, name_);
  num_decoded_ += values.size();
  if (num_decoded_ > 30'000'000 + 16 * (parts_.json.size() + bytes.size()))
    fail("its tracks share accessors so often that they would fill the memory");
  return values;
}

std::string_view GltfParser::buffer(const Json& idx) {
  const Json& buffers = list("buffers");
  const std::size_t b = index(idx, buffers.size(), "buffers");
  loaded_.resize(buffers.size());
  const auto uri = buffers[b].find("uri");
  if (uri == buffers[b].end()) {
    if (b != 0 || !parts_.binary) fail("a buffer has no data");
    return *parts_.binary;
  }
  if (!loaded_[b]) loaded_[b] = load_gltf_uri(uri->get<std::string>(), name_, folder_);
  return *loaded_[b];
}

}  // namespace

GltfDocument parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder) {
  return GltfParser(bytes, name, folder).parse();
}

}  // namespace motex
