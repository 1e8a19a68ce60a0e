// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion_io/gltf_container.h"
#include "motex/motion_io/gltf_materials.h"
#include "motex/motion_io/gltf_skin.h"

namespace motex {
namespace {

using Json = nlohmann::json;
using Numbers = std::vector<double>;
constexpr std::size_t kBaseBytes = 64'000'000, kBytesPerByte = 16;
constexpr std::size_t kMostSets = 4;  // of joints and weights, of texture coordinates, of colours
constexpr std::size_t kMostJoints = 65'535;
constexpr double kLargestNumber = 1e12;

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

/// Something that this reader does not keep; the file may still be a good one.
struct NotKept {
  std::string why;
};

struct World {
  Vector3 translation = Vector3::Zero();
  Quat rotation = Quat::Identity();
  double scale = 1;
};

class SkinReader {
 public:
  SkinReader(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
             const GltfDocument& document, const std::vector<std::string>& node_names, const JobContext& job)
      : name_(name),
        folder_(folder),
        parts_(split_glb(bytes, name)),
        root_(Json::parse(parts_.json)),
        most_bytes_(kBaseBytes + kBytesPerByte * bytes.size()),
        document_(document),
        node_names_(node_names),
        job_(job) {}

  std::shared_ptr<const Skin> read() {
    if (is_stick_figure()) return nullptr;
    place_nodes();
    read_materials();
    for (const Json& node : list("nodes"))
      if (node.contains("mesh") && node.contains("skin")) read_instance(node);
    if (!left_out_.empty())
      job_.warn(name_ + (instances_.empty() ? ": its skin is not kept: " : ": of its skin is left out: ") + left_out_);
    if (instances_.empty()) return nullptr;
    finish();
    return std::make_shared<const Skin>(std::move(skin_));
  }

 private:
  const Json& list(const char* key) const {
    static const Json empty = Json::array();
    const auto found = root_.find(key);
    return found != root_.end() && found->is_array() ? *found : empty;
  }
  const Json& item(const char* key, const Json& idx) const {
    const Json& all = list(key);
    if (!idx.is_number_unsigned() || idx.get<std::uint64_t>() >= all.size())
      throw NotKept{std::string("an index into '") + key + "' is wrong"};
    const Json& found = all[idx.get<std::size_t>()];
    if (!found.is_object()) throw NotKept{std::string("'") + key + "' holds what is no object"};
    return found;
  }
  /// What motex draws where there is no skin.
  bool is_stick_figure() const {
    const Json& meshes = list("meshes");
    return root_["asset"].value("generator", "") == "motex" && meshes.size() == 1 && meshes[0].is_object() &&
           meshes[0].value("name", "") == "sticks";
  }
  void leave_out(const std::string& what) {
    if (left_out_.find(what) == left_out_.npos) left_out_ += (left_out_.empty() ? "" : ", ") + what;
  }
  void place_nodes();
  void read_materials();
  void read_instance(const Json& node);
  int read_skin(const Json& idx);
  int read_mesh(const Json& idx, std::size_t num_joints);
  Json read_primitive(const Json& primitive, std::size_t num_joints);
  void read_vertices(const Json& attributes, std::size_t count, Json& out);
  void read_influences(const Json& attributes, std::size_t count, std::size_t num_joints, Json& out);
  int add_indices(const Json& primitive, std::size_t count);
  int joint_of(const Json& node);
  Numbers numbers(const Json& idx, int num_components, std::uint64_t count = ~0ULL);
  std::string_view buffer(const Json& idx);
  void finish();

  std::string name_;
  std::filesystem::path folder_;
  GltfParts parts_;
  Json root_;
  std::size_t most_bytes_, num_bytes_ = 0;
  const GltfDocument& document_;
  const std::vector<std::string>& node_names_;
  const JobContext& job_;
  std::vector<World> worlds_;  // by node
  std::map<std::size_t, std::string> loaded_;
  GltfMaterials materials_;
  std::map<std::uint64_t, int> skin_of_, joint_of_node_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> mesh_of_;  // (mesh, skin)
  GlbBuilder out_;
  Json skins_ = Json::array(), meshes_ = Json::array(), instances_ = Json::array();
  std::string left_out_;
  Skin skin_;
};

void SkinReader::place_nodes() {
  worlds_.resize(document_.nodes.size());
  for (const int n : document_.roots_first) {
    const GltfNode& node = document_.nodes[at(n)];
    World above;
    if (node.parent_idx >= 0) above = worlds_[at(node.parent_idx)];
    const double size = std::cbrt(node.scale.prod());
    // An uneven or mirrored scale is no number; only joints below it mind.
    const bool even = size > 0 && (node.scale.array() / size - 1).abs().maxCoeff() < 1e-3;
    worlds_[at(n)] = {above.translation + above.rotation * (above.scale * node.translation),
                      (above.rotation * node.rotation).normalized(), above.scale * (even ? size : NAN)};
  }
}

void SkinReader::read_materials() {
  materials_ = read_gltf_materials(parts_, name_, folder_, most_bytes_);
  for (const std::string& what : materials_.dropped) leave_out(what);
}

std::string_view SkinReader::buffer(const Json& idx) {
  const Json& found = item("buffers", idx);
  const std::size_t b = idx.get<std::size_t>();
  const auto uri = found.find("uri");
  if (uri == found.end()) {
    if (b != 0 || !parts_.binary) throw NotKept{"a buffer has no data"};
    return *parts_.binary;
  }
  auto loaded = loaded_.find(b);
  if (loaded == loaded_.end())
    loaded = loaded_.emplace(b, load_gltf_uri(uri->get<std::string>(), name_, folder_)).first;
  return loaded->second;
}

/// An accessor's numbers, integers mapped as decode_gltf_elements() does; all finite.
Numbers SkinReader::numbers(const Json& idx, int num_components, std::uint64_t count) {
  const Json& accessor = item("accessors", idx);
  if (accessor.contains("sparse")) throw NotKept{"sparse accessors"};
  const Json& view = item("bufferViews", accessor.value("bufferView", Json()));
  if (view.contains("extensions")) throw NotKept{"compressed buffers"};
  const std::string_view bytes = buffer(view.value("buffer", Json()));
  const auto size_of = [](const Json& object, const char* key, std::uint64_t otherwise) {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    return found->is_number_unsigned() ? found->get<std::uint64_t>() : ~std::uint64_t{0};
  };
  const std::uint64_t offset = size_of(view, "byteOffset", 0), size = size_of(view, "byteLength", ~0ULL);
  if (offset > bytes.size() || size > bytes.size() - offset) throw NotKept{"a buffer view beyond its buffer"};
  GltfElements elements;
  elements.component_type = accessor.value("componentType", 0);
  elements.num_components = num_components;
  elements.offset = size_of(accessor, "byteOffset", 0);
  elements.count = size_of(accessor, "count", 0);
  elements.stride = size_of(view, "byteStride",
                            gltf_component_size(elements.component_type) * static_cast<std::uint64_t>(num_components));
  if (count != ~0ULL && elements.count != count) throw NotKept{"vertices with attributes of different number"};
  if (elements.count > bytes.size()) throw NotKept{"an accessor beyond its buffer"};
  num_bytes_ += 4 * elements.count * static_cast<std::uint64_t>(num_components);
  if (num_bytes_ > most_bytes_) throw NotKept{"meshes that share data so often that they would fill the memory"};
  Numbers values = decode_gltf_elements(bytes.substr(offset, size), elements, name_);
  for (const double v : values)
    if (!(std::abs(v) <= kLargestNumber)) throw NotKept{"numbers that are not finite"};
  return values;
}

int component_type(const Json& accessor) { return accessor.value("componentType", 0); }

/// What the largest integer of the accessor's type was mapped to 1 from.
double full_scale(const Json& accessor) {
  const int type = component_type(accessor);
  return type == 5121 ? 255 : type == 5123 ? 65535 : 1;
}

void SkinReader::read_instance(const Json& node) {
  try {
    const int skin = read_skin(node.at("skin"));
    const int mesh = read_mesh(node.at("mesh"), skins_[at(skin)].at("joints").size());
    if (mesh < 0) return;
    Json instance = {{"mesh", mesh}, {"skin", skin}};
    if (const auto name = node.find("name"); name != node.end() && name->is_string()) instance["name"] = *name;
    instances_.push_back(std::move(instance));
  } catch (const NotKept& reason) {
    leave_out("a mesh (" + reason.why + ")");
  } catch (const Json::exception&) {
    leave_out("a mesh (it does not follow the glTF standard)");
  } catch (const InvalidInput& error) {
    leave_out(std::string("a mesh (") + error.what() + ")");
  }
}

int SkinReader::joint_of(const Json& node) {
  const std::uint64_t n = node.get<std::uint64_t>();
  if (!node.is_number_unsigned() || n >= worlds_.size()) throw NotKept{"a joint that does not exist"};
  const auto [found, is_new] = joint_of_node_.emplace(n, static_cast<int>(skin_.joints.size()));
  if (is_new) {
    if (skin_.joints.size() == kMostJoints) throw NotKept{"more than 65,535 joints"};
    skin_.joints.push_back({node_names_[n], worlds_[n].translation, worlds_[n].rotation});
  }
  return found->second;
}

int SkinReader::read_skin(const Json& idx) {
  const Json& from = item("skins", idx);
  if (const auto found = skin_of_.find(idx.get<std::uint64_t>()); found != skin_of_.end()) return found->second;
  const Json& nodes = from.at("joints");
  if (!nodes.is_array() || nodes.empty() || nodes.size() > kMostJoints) throw NotKept{"a skin without joints"};
  Numbers matrices;
  if (from.contains("inverseBindMatrices")) {
    if (item("accessors", from["inverseBindMatrices"]).value("type", "") != "MAT4") throw NotKept{"bind matrices"};
    matrices = numbers(from["inverseBindMatrices"], 16);
  }
  if (!matrices.empty() && matrices.size() < 16 * nodes.size()) throw NotKept{"too few bind matrices"};
  Json joints = Json::array();
  std::vector<float> bind;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    joints.push_back(joint_of(nodes[j]));
    const double scale = worlds_[nodes[j].get<std::size_t>()].scale;
    if (!std::isfinite(scale))
      throw NotKept{"joints that are mirrored or scaled by different amounts along their axes"};
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    if (!matrices.empty()) matrix = Eigen::Map<const Eigen::Matrix4d>(&matrices[16 * j]);
    matrix.topRows<3>() *= scale;
    matrix.row(3) << 0, 0, 0, 1;
    const Eigen::Matrix4f single = matrix.cast<float>();
    if (!single.allFinite()) throw NotKept{"bind matrices that are not finite"};
    bind.insert(bind.end(), single.data(), single.data() + 16);
  }
  std::vector<std::uint64_t> sorted;
  for (const Json& node : nodes) sorted.push_back(node.get<std::uint64_t>());
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) throw NotKept{"a joint that is listed twice"};
  const int accessor = out_.add(bind.data(), 4 * bind.size(), {5126, "MAT4", nodes.size(), 0});
  skins_.push_back({{"joints", std::move(joints)}, {"inverseBindMatrices", accessor}});
  return skin_of_[idx.get<std::uint64_t>()] = static_cast<int>(skins_.size()) - 1;
}

int SkinReader::read_mesh(const Json& idx, std::size_t num_joints) {
  const Json& from = item("meshes", idx);
  const auto key = std::pair(idx.get<std::uint64_t>(), static_cast<std::uint64_t>(num_joints));
  if (const auto found = mesh_of_.find(key); found != mesh_of_.end()) return found->second;
  Json primitives = Json::array();
  for (const Json& primitive : from.at("primitives")) {
    if (primitive.contains("targets")) leave_out("morph targets");
    if (primitive.value("mode", 4) != 4) {
      leave_out("points, lines, strips and fans");
      continue;
    }
    Json kept = read_primitive(primitive, num_joints);
    if (!kept.is_null()) primitives.push_back(std::move(kept));
  }
  if (primitives.empty()) return mesh_of_[key] = -1;
  Json mesh = {{"primitives", std::move(primitives)}};
  if (const auto name = from.find("name"); name != from.end() && name->is_string()) mesh["name"] = *name;
  meshes_.push_back(std::move(mesh));
  return mesh_of_[key] = static_cast<int>(meshes_.size()) - 1;
}

std::vector<float> singles(const Numbers& values) { return {values.begin(), values.end()}; }

Json SkinReader::read_primitive(const Json& primitive, std::size_t num_joints) {
  if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression"))
    throw NotKept{"it is compressed"};
  const Json& attributes = primitive.at("attributes");
  if (!attributes.contains("POSITION") || !attributes.contains("JOINTS_0") || !attributes.contains("WEIGHTS_0")) {
    leave_out("parts that no joint moves");
    return {};
  }
  if (component_type(item("accessors", attributes["POSITION"])) != 5126) throw NotKept{"quantised positions"};
  const std::vector<float> positions = singles(numbers(attributes["POSITION"], 3));
  const std::size_t count = positions.size() / 3;
  Json out;
  const int indices = add_indices(primitive, count);
  if (count == 0 || indices == -2) return {};
  const int accessor = out_.add(positions.data(), 4 * positions.size(), {5126, "VEC3", count, 34962});
  out_.set_bounds(accessor, positions, 3);
  out["attributes"]["POSITION"] = accessor;
  read_vertices(attributes, count, out["attributes"]);
  read_influences(attributes, count, num_joints, out["attributes"]);
  if (indices >= 0) out["indices"] = indices;
  const Json material = primitive.value("material", Json());
  if (material.is_number_unsigned() && material.get<std::uint64_t>() < materials_.num_texcoords.size()) {
    const int needed = materials_.num_texcoords[material.get<std::size_t>()];
    if (needed == 0 || out["attributes"].contains("TEXCOORD_" + std::to_string(needed - 1)))
      out["material"] = material;
    else
      leave_out("materials without texture coordinates");
  }
  return out;
}

/// −1: drawn vertex by vertex; −2: nothing to draw.
int SkinReader::add_indices(const Json& primitive, std::size_t count) {
  if (!primitive.contains("indices")) return count < 3 || count % 3 != 0 ? -2 : -1;
  const double scale = full_scale(item("accessors", primitive["indices"]));
  std::vector<std::uint32_t> indices;
  for (const double v : numbers(primitive["indices"], 1)) {
    const double index = std::round(v * scale);
    if (!(index >= 0 && index < static_cast<double>(count))) throw NotKept{"triangles of vertices that do not exist"};
    indices.push_back(static_cast<std::uint32_t>(index));
  }
  indices.resize(indices.size() / 3 * 3);
  if (indices.empty()) return -2;
  return out_.add(indices.data(), 4 * indices.size(), {5125, "SCALAR", indices.size(), 34963});
}

/// Normals and tangents of unit length, or none; texture coordinates; colours within 0 … 1.
void SkinReader::read_vertices(const Json& attributes, std::size_t count, Json& out) {
  const auto add = [&](const std::string& key, const char* type, const Numbers& values) {
    const std::vector<float> data = singles(values);
    out[key] = out_.add(data.data(), 4 * data.size(), {5126, type, count, 34962});
  };
  const auto directions = [&](const char* key, int size) {
    Numbers values = numbers(attributes[key], size, count);
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(size)) {
      Eigen::Map<Vector3> v(&values[i]);
      v = v.norm() > 1e-6 ? Vector3(v.normalized()) : Vector3::UnitY();
      if (size == 4) values[i + 3] = values[i + 3] < 0 ? -1 : 1;
    }
    add(key, size == 3 ? "VEC3" : "VEC4", values);
  };
  if (attributes.contains("NORMAL")) directions("NORMAL", 3);
  if (attributes.contains("NORMAL") && attributes.contains("TANGENT")) directions("TANGENT", 4);
  for (std::size_t set = 0; set < kMostSets; ++set) {
    const std::string key = "TEXCOORD_" + std::to_string(set);
    if (!attributes.contains(key)) break;
    add(key, "VEC2", numbers(attributes[key], 2, count));
  }
  if (!attributes.contains("COLOR_0")) return;
  const bool rgb = item("accessors", attributes["COLOR_0"]).value("type", "") == "VEC3";
  Numbers colours = numbers(attributes["COLOR_0"], rgb ? 3 : 4, count);
  for (double& c : colours) c = std::clamp(c, 0.0, 1.0);
  add("COLOR_0", rgb ? "VEC3" : "VEC4", colours);
}

/// Weights that add up to 1, each joint once, joint 0 where a weight is 0.
void SkinReader::read_influences(const Json& attributes, std::size_t count, std::size_t num_joints, Json& out) {
  std::vector<Numbers> joints, weights;
  for (std::size_t set = 0; set < kMostSets; ++set) {
    const std::string n = std::to_string(set);
    if (!attributes.contains("JOINTS_" + n) || !attributes.contains("WEIGHTS_" + n)) break;
    joints.push_back(numbers(attributes["JOINTS_" + n], 4, count));
    for (double& j : joints.back()) j = std::round(j * full_scale(item("accessors", attributes["JOINTS_" + n])));
    weights.push_back(numbers(attributes["WEIGHTS_" + n], 4, count));
  }
  const auto each = [&](std::size_t v, auto&& visit) {
    for (std::size_t set = 0; set < joints.size(); ++set)
      for (std::size_t c = 4 * v; c < 4 * v + 4; ++c) visit(joints[set][c], weights[set][c]);
  };
  for (std::size_t v = 0; v < count; ++v) {
    double sum = 0;
    std::array<std::pair<double, double*>, 4 * kMostSets> seen;
    std::size_t num_seen = 0;
    each(v, [&](double& joint, double& weight) {
      if (!(weight > 0)) weight = 0;
      if (weight > 0 && !(joint >= 0 && joint < static_cast<double>(num_joints)))
        throw NotKept{"vertices of joints that do not exist"};
      sum += weight;
      for (std::size_t k = 0; k < num_seen && weight > 0; ++k)
        if (seen[k].first == joint) *seen[k].second += std::exchange(weight, 0);
      if (weight > 0) seen[num_seen++] = {joint, &weight};
    });
    if (!(sum > 0)) joints[0][4 * v] = 0, weights[0][4 * v] = sum = 1;
    each(v, [&](double& joint, double& weight) {
      weight = static_cast<float>(weight / sum);
      if (weight == 0) joint = 0;
    });
  }
  for (std::size_t set = 0; set < joints.size(); ++set) {
    const std::vector<std::uint16_t> idx(joints[set].begin(), joints[set].end());
    const std::vector<float> w = singles(weights[set]);
    out["JOINTS_" + std::to_string(set)] = out_.add(idx.data(), 2 * idx.size(), {5123, "VEC4", count, 34962});
    out["WEIGHTS_" + std::to_string(set)] = out_.add(w.data(), 4 * w.size(), {5126, "VEC4", count, 34962});
  }
}

/// The file of its own: joints as they stand, side by side.
void SkinReader::finish() {
  Json root, nodes = Json::array(), scene = Json::array();
  for (const SkinJoint& joint : skin_.joints) {
    const Vector3& p = joint.position;
    const Eigen::Vector4d q = joint.rotation.coeffs();
    scene.push_back(nodes.size());
    nodes.push_back(
        {{"name", joint.name}, {"translation", {p.x(), p.y(), p.z()}}, {"rotation", {q[0], q[1], q[2], q[3]}}});
  }
  for (Json& instance : instances_) nodes.push_back(std::move(instance));
  root["asset"] = {{"version", "2.0"}, {"generator", "motex"}};
  root["nodes"] = std::move(nodes);
  root["meshes"] = std::move(meshes_);
  root["skins"] = std::move(skins_);
  const auto add_list = [&](const char* key, Json values) {
    if (!values.empty()) root[key] = std::move(values);
  };
  add_list("materials", Json::parse(materials_.materials));
  add_list("textures", Json::parse(materials_.textures));
  add_list("samplers", Json::parse(materials_.samplers));
  Json images = Json::array();
  for (std::size_t i = 0; i < materials_.pictures.size(); ++i)
    images.push_back({{"bufferView", out_.add_view(materials_.pictures[i].data(), materials_.pictures[i].size(), 0)},
                      {"mimeType", materials_.picture_types[i]}});
  add_list("images", std::move(images));
  skin_.glb = out_.file(root.dump(-1, ' ', false, Json::error_handler_t::replace), name_);
}

std::vector<std::string> names_of(const GltfDocument& document) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < document.nodes.size(); ++n) {
    names.push_back(document.nodes[n].name);
    if (names.back().empty()) names.back() = "node" + std::to_string(n);
  }
  return names;
}

std::shared_ptr<const Skin> read_or_throw(std::string_view bytes, const std::string& name,
                                          const std::filesystem::path& folder, const JobContext& job) {
  const GltfDocument document = parse_gltf(bytes, name, folder);
  std::string why;
  JobContext noting = job;
  noting.on_warning = [&](const std::string& message) { why = message; };
  auto skin = extract_skin(bytes, name, folder, document, names_of(document), noting);
  if (!skin) throw InvalidInput(why.empty() ? name + ": has no skinned mesh" : why);
  if (!why.empty()) job.warn(why);
  return skin;
}

}  // namespace

std::shared_ptr<const Skin> extract_skin(std::string_view bytes, const std::string& name,
                                         const std::filesystem::path& folder, const GltfDocument& document,
                                         const std::vector<std::string>& node_names, const JobContext& job) {
  try {
    return SkinReader(bytes, name, folder, document, node_names, job).read();
  } catch (const Json::exception&) {
    job.warn(name + ": its skin is not kept: it does not follow the glTF standard");
  } catch (const NotKept& reason) {
    job.warn(name + ": its skin is not kept: " + reason.why);
  }
  return nullptr;
}

std::shared_ptr<const Skin> read_skin(const std::filesystem::path& path, const JobContext& job) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  return read_or_throw(read_file(path), path.string(), folder, job);
}

std::shared_ptr<const Skin> read_skin_bytes(std::string_view bytes, const std::string& name, const JobContext& job) {
  return read_or_throw(bytes, name, {}, job);
}

}  // namespace motex
