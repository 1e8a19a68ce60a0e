// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "motex/core/files.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/gltf_document.h"
#include "motex/motion_io/gltf_skin.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr std::size_t kMaxJoints = 10'000;
constexpr double kBaseBytes = 256e6, kBytesPerByte = 64;
// Times are stored in single precision.
constexpr double kTimePrecision = 3e-7;

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

double rounded_rate(double rate) {
  for (const double nice : {std::round(rate), std::round(rate * 1.001) / 1.001})
    if (nice > 0 && std::abs(rate / nice - 1) < kTimePrecision) return nice;
  return rate;
}

// Value of a track at a time, as 3 or 4 numbers.
class Sampler {
 public:
  explicit Sampler(const GltfTrack& track) : track_(track), size_(track.path == GltfPath::kRotation ? 4 : 3) {}

  Eigen::Vector4d at_time(double time) {
    const auto& times = track_.times;
    const double slack = kTimePrecision * std::abs(time) + 1e-9;
    while (key_ + 1 < times.size() && times[key_ + 1] <= time + slack) ++key_;
    const bool on_key = time <= times[key_] + slack || key_ + 1 == times.size();
    if (on_key || track_.interpolation == GltfInterpolation::kStep) return value(key_);
    const double span = times[key_ + 1] - times[key_];
    const double u = (time - times[key_]) / span;
    if (track_.interpolation == GltfInterpolation::kCubicSpline) return spline(u, span);
    if (size_ == 3) return (1 - u) * value(key_) + u * value(key_ + 1);
    return rotation(key_).slerp(u, rotation(key_ + 1)).coeffs();
  }

 private:
  Eigen::Vector4d part(std::size_t idx) const {
    Eigen::Vector4d v = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < size_; ++i) v[static_cast<Index>(i)] = track_.values[idx * size_ + i];
    return v;
  }
  bool cubic() const { return track_.interpolation == GltfInterpolation::kCubicSpline; }
  Eigen::Vector4d value(std::size_t key) const { return part(cubic() ? 3 * key + 1 : key); }
  Quat rotation(std::size_t key) const {
    const Quat q(value(key));
    return q.norm() > 1e-6 ? q.normalized() : Quat::Identity();
  }
  Eigen::Vector4d spline(double u, double span) const {
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * value(key_) + span * (u3 - 2 * u2 + u) * part(3 * key_ + 2) +
           (3 * u2 - 2 * u3) * value(key_ + 1) + span * (u3 - u2) * part(3 * key_ + 3);
  }

  const GltfTrack& track_;
  std::size_t size_, key_ = 0;
};

class GltfToClip {
 public:
  GltfToClip(const GltfDocument& document, std::string name, std::size_t num_bytes, const ReadClipOptions& options,
             const JobContext& job)
      : document_(document), name_(std::move(name)), num_bytes_(num_bytes), options_(options), job_(job) {}

  Clip convert() {
    if (document_.tracks.empty())
      throw UnsupportedFile(name_ + ": holds no animation of nodes; motex reads moving skeletons");
    if (document_.num_animations > 1)
      warn("it holds " + std::to_string(document_.num_animations) + " animations; the first, " +
           in_quotes(document_.animation_name) + ", is read");
    choose_joints();
    build_skeleton();
    if (skeleton_.joints.empty())
      throw UnsupportedFile(name_ + ": only scales are animated; motex reads moving skeletons");
    choose_times();
    return build();
  }

  /// By node, as the joints of the skeleton are called.
  std::vector<std::string> node_names() const {
    std::vector<std::string> names(document_.nodes.size());
    for (std::size_t n = 0; n < names.size(); ++n)
      if (joint_of_[n] >= 0) names[n] = skeleton_.joints[at(joint_of_[n])].name;
    return names;
  }

 private:
  void warn(const std::string& message) const { job_.warn(name_ + ": " + message); }
  void choose_joints();
  void place_joint(int node);
  void build_skeleton();
  void choose_times();
  Clip build();
  void apply(const GltfTrack& track, Clip& clip);
  void set_channels(Clip& clip);
  double scale_of(const GltfNode& node);

  // The world of a node's children, or of what is folded into a root.
  struct Frame {
    Vector3 translation = Vector3::Zero();
    Quat rotation = Quat::Identity();
    double scale = 1;
  };

  const GltfDocument& document_;
  std::string name_;
  std::size_t num_bytes_;
  const ReadClipOptions& options_;
  const JobContext& job_;
  std::vector<char> is_joint_;
  std::vector<int> joint_of_;   // of a node, or −1
  std::vector<Frame> outside_;  // for every node: what its local transform is seen through
  std::unordered_set<std::string> names_;
  Skeleton skeleton_;
  double start_secs_ = 0, frame_time_secs_ = 1;
  Index num_frames_ = 1;
  bool odd_scale_ = false;
};

// Animated nodes, joints of skins and what lies between two of them.
void GltfToClip::choose_joints() {
  const std::size_t num_nodes = document_.nodes.size();
  is_joint_.assign(num_nodes, 0);
  for (std::size_t n = 0; n < num_nodes; ++n) is_joint_[n] = document_.nodes[n].is_joint;
  for (const GltfTrack& track : document_.tracks)
    if (track.path != GltfPath::kScale) is_joint_[at(track.node_idx)] = 1;
  std::vector<char> above(num_nodes, 0), below(num_nodes, 0);
  const auto& order = document_.roots_first;
  for (const int n : order)
    if (const int p = document_.nodes[at(n)].parent_idx; p >= 0) above[at(n)] = above[at(p)] || is_joint_[at(p)];
  for (auto n = order.rbegin(); n != order.rend(); ++n)
    if (const int p = document_.nodes[at(*n)].parent_idx; p >= 0 && (is_joint_[at(*n)] || below[at(*n)]))
      below[at(p)] = 1;
  for (std::size_t n = 0; n < num_nodes; ++n) is_joint_[n] = is_joint_[n] || (above[n] && below[n]);
}

double GltfToClip::scale_of(const GltfNode& node) {
  const double size = std::cbrt(std::abs(node.scale.prod()));
  odd_scale_ = odd_scale_ || !((node.scale.array() / size - 1).abs().maxCoeff() < 1e-3);
  return size > 0 && std::isfinite(size) ? size : 1;
}

void GltfToClip::place_joint(int n) {
  const GltfNode& node = document_.nodes[at(n)];
  const Frame& outside = outside_[at(n)];
  Joint joint;
  joint.name = node.name.empty() ? "node" + std::to_string(n) : node.name;
  const std::string stated = joint.name;
  // The node's number makes it differ from all but contrived names.
  while (!names_.insert(joint.name).second) joint.name += "_" + std::to_string(n);
  if (joint.name != stated) warn("two joints are named " + in_quotes(stated) + "; one is now " + in_quotes(joint.name));
  joint.parent_idx = node.parent_idx >= 0 ? joint_of_[at(node.parent_idx)] : -1;
  joint.offset = outside.translation + outside.rotation * (outside.scale * node.translation);
  joint_of_[at(n)] = skeleton_.num_joints();
  const double scale = outside.scale * scale_of(node);
  for (const Vector3& site : node.end_sites) skeleton_.end_sites.push_back({skeleton_.num_joints(), site * scale});
  skeleton_.joints.push_back(std::move(joint));
}

void GltfToClip::build_skeleton() {
  joint_of_.assign(document_.nodes.size(), -1);
  outside_.resize(document_.nodes.size());
  skeleton_.metres_per_unit = 1;
  for (const int n : document_.roots_first) {
    const GltfNode& node = document_.nodes[at(n)];
    const Frame outside = outside_[at(n)];
    Frame inside;
    inside.scale = outside.scale * scale_of(node);
    if (is_joint_[at(n)]) {
      if (skeleton_.joints.size() == kMaxJoints) throw UnsupportedFile(name_ + ": has more than 10,000 joints");
      place_joint(n);
    } else {
      inside.translation = outside.translation + outside.rotation * (outside.scale * node.translation);
      inside.rotation = outside.rotation * node.rotation;
    }
    for (const int child : node.children) outside_[at(child)] = inside;
  }
  if (odd_scale_) warn("some nodes are scaled by different amounts along their axes; the mean is used");
}

void GltfToClip::choose_times() {
  double first = document_.tracks[0].times.front(), last = document_.tracks[0].times.back(), rate = 0;
  for (const GltfTrack& track : document_.tracks) {
    first = std::min(first, track.times.front());
    last = std::max(last, track.times.back());
    if (track.times.size() > 1)
      rate = std::max(rate, static_cast<double>(track.times.size() - 1) / (track.times.back() - track.times.front()));
  }
  if (options_.fps > 0) rate = options_.fps;
  start_secs_ = first;
  frame_time_secs_ = rate > 0 ? 1 / rounded_rate(rate) : 1.0 / 30;
  const double frames = std::floor((last - first) / frame_time_secs_ + 1e-3) + 1;
  const double needed = frames * static_cast<double>(skeleton_.joints.size()) * 7 * sizeof(double);
  if (!(needed <= kBaseBytes + kBytesPerByte * static_cast<double>(num_bytes_)))
    throw InvalidInput(name_ + ": its densest track has " + std::to_string(rate) +
                       " keys a second, too many for its length; give the rate with --fps");
  num_frames_ = static_cast<Index>(frames);
}

void GltfToClip::apply(const GltfTrack& track, Clip& clip) {
  if (track.path == GltfPath::kScale) {
    const GltfNode& node = document_.nodes[at(track.node_idx)];
    const Vector3 first(track.values[0], track.values[1], track.values[2]);
    if (track.times.size() > 1 || !first.isApprox(node.scale, 1e-3))
      warn("the scale of " + in_quotes(node.name) + " is animated; it is kept as it stands at rest");
    return;
  }
  const int joint = joint_of_[at(track.node_idx)];
  const Frame& outside = outside_[at(track.node_idx)];
  Sampler sampler(track);
  for (Index t = 0; t < num_frames_; ++t) {
    if (t % 1024 == 0) job_.check_cancelled();
    const Eigen::Vector4d v = sampler.at_time(start_secs_ + static_cast<double>(t) * frame_time_secs_);
    if (track.path == GltfPath::kTranslation) {
      clip.set_translation(t, joint, outside.translation + outside.rotation * (outside.scale * Vector3(v.head<3>())));
    } else {
      const Quat q = v.norm() > 1e-6 ? Quat(v).normalized() : Quat::Identity();
      clip.set_rotation(t, joint, (outside.rotation * q).normalized());
    }
  }
}

void GltfToClip::set_channels(Clip& clip) {
  for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
    Joint& joint = clip.skeleton.joints[at(j)];
    const auto block = clip.translations.middleCols<3>(3 * j);
    const bool moves = (block.rowwise() - block.row(0)).cwiseAbs().maxCoeff() > 1e-9;
    // A place that never changes, but is not the one at rest, is where the joint belongs.
    if (!moves && joint.parent_idx >= 0) joint.offset = block.row(0).transpose();
    if (joint.parent_idx < 0 || moves) joint.channels = {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition};
    if (joint.parent_idx < 0) joint.offset.setZero();
    for (const Channel c : {Channel::kZRotation, Channel::kXRotation, Channel::kYRotation}) joint.channels.push_back(c);
  }
}

Clip GltfToClip::build() {
  Clip clip = make_clip(skeleton_, num_frames_, frame_time_secs_);
  clip.name = clip_name(name_);
  for (std::size_t n = 0; n < document_.nodes.size(); ++n)
    if (joint_of_[n] >= 0) {
      const Quat rest = (outside_[n].rotation * document_.nodes[n].rotation).normalized();
      for (Index t = 0; t < num_frames_; ++t) clip.set_rotation(t, joint_of_[n], rest);
    }
  for (const GltfTrack& track : document_.tracks) apply(track, clip);
  set_channels(clip);
  return clip;
}

Clip convert(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
             const ReadClipOptions& options, const JobContext& job) {
  const GltfDocument document = parse_gltf(bytes, name, folder);
  GltfToClip converter(document, name, bytes.size(), options, job);
  Clip clip = converter.convert();
  if (std::any_of(document.nodes.begin(), document.nodes.end(), [](const GltfNode& node) { return node.is_joint; }))
    clip.skeleton.skin = extract_skin(bytes, name, folder, document, converter.node_names(), job);
  return clip;
}

}  // namespace

Clip clip_of_nodes(const GltfDocument& document, const std::string& name, std::size_t num_bytes,
                   const ReadClipOptions& options, const JobContext& job) {
  return GltfToClip(document, name, num_bytes, options, job).convert();
}

Clip read_gltf_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                     const JobContext& job) {
  return convert(bytes, name, {}, options, job);
}

Clip read_gltf(const std::filesystem::path& path, const ReadClipOptions& options, const JobContext& job) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  return convert(read_file(path), path.string(), folder, options, job);
}

}  // namespace motex
