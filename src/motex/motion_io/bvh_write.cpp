// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstring>
#include <numbers>

#include "motex/core/csv.h"
#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"
#include "motex/motion_io/euler_channels.h"

namespace motex {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;
constexpr double kLargestPositionError = 0.5e-6;  // from angles, and as much again from positions
constexpr int kMaxIndent = 40;

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

// A fixed number of decimals through integers: some ten times as fast as to_chars with a precision.
class FixedFormat {
 public:
  explicit FixedFormat(int decimals) : decimals_(decimals) {
    for (int i = 0; i < decimals; ++i) scale_ *= 10;
  }
  char* write(char* out, double value) const {
    const double scaled = std::nearbyint(value * static_cast<double>(scale_));
    if (!(std::abs(scaled) < 9e18)) return std::to_chars(out, out + 32, value).ptr;
    const auto whole = static_cast<std::int64_t>(scaled);
    if (whole < 0) *out++ = '-';
    const auto size = static_cast<std::uint64_t>(whole < 0 ? -whole : whole);
    out = std::to_chars(out, out + 24, size / scale_).ptr;
    std::uint64_t fraction = size % scale_;
    if (fraction == 0) return out;
    *out++ = '.';
    for (int i = decimals_ - 1; i >= 0; --i, fraction /= 10) out[i] = static_cast<char>('0' + fraction % 10);
    return out + decimals_;
  }

 private:
  int decimals_;
  std::uint64_t scale_ = 1;
};

int decimals_for(double error_at_zero_decimals) {
  return std::clamp(static_cast<int>(std::ceil(std::log10(error_at_zero_decimals / kLargestPositionError))), 6, 12);
}

class BvhWriter {
 public:
  explicit BvhWriter(const Clip& clip) : clip_(clip), joints_(clip.skeleton.joints) {
    check_clip(clip);
    if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": a clip without frames cannot be written as BVH");
    for (int j = 0; j < clip.skeleton.num_joints(); ++j) channels_.push_back(channels_for_motion(clip, j));
    if (std::all_of(channels_.begin(), channels_.end(), [](const auto& c) { return c.empty(); }))
      channels_[0] = {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition,
                      Channel::kZRotation, Channel::kXRotation, Channel::kYRotation};
  }

  std::string write() {
    write_hierarchy();
    write_rows();
    return std::move(text_);
  }

 private:
  void write_hierarchy();
  void open(int joint, int depth);
  void write_end_site(int site, int depth);
  void write_offset(const Vector3& offset, int depth);
  void indent(int depth) { text_.append(at(std::min(depth, kMaxIndent)), '\t'); }
  void write_rows();
  void choose_decimals(int& angle, int& position) const;

  const Clip& clip_;
  const std::vector<Joint>& joints_;
  std::vector<std::vector<Channel>> channels_;
  std::vector<int> order_;  // of the joints in the file: depth first
  std::string text_;
};

std::string safe_name(const Joint& joint, int idx) {
  std::string name = joint.name;
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '{' || c == '}') c = '_';
  if (name.find_first_not_of(' ') == name.npos) return "joint" + std::to_string(idx);
  return name;
}

void BvhWriter::write_offset(const Vector3& offset, int depth) {
  indent(depth);
  text_ += "OFFSET";
  for (const double x : offset) append_number(text_ += ' ', x);
  text_ += '\n';
}

void BvhWriter::open(int j, int depth) {
  const Joint& joint = joints_[at(j)];
  order_.push_back(j);
  indent(depth);
  text_ += (joint.parent_idx < 0 ? "ROOT " : "JOINT ") + safe_name(joint, j) + "\n";
  indent(depth);
  text_ += "{\n";
  const auto& channels = channels_[at(j)];
  const bool placed = std::count_if(channels.begin(), channels.end(), is_position) == 3;
  write_offset(joint.parent_idx < 0 && placed ? Vector3::Zero() : joint.offset, depth + 1);
  indent(depth + 1);
  text_ += "CHANNELS " + std::to_string(channels.size());
  for (const Channel channel : channels) (text_ += ' ') += channel_name(channel);
  text_ += '\n';
}

void BvhWriter::write_end_site(int site, int depth) {
  indent(depth);
  text_ += "End Site\n";
  indent(depth);
  text_ += "{\n";
  write_offset(clip_.skeleton.end_sites[at(site)].offset, depth + 1);
  indent(depth);
  text_ += "}\n";
}

// End sites go where they keep their numbers when the file is read: a joint's own stand before those below a later
// child.
void BvhWriter::write_hierarchy() {
  const int num_joints = clip_.skeleton.num_joints();
  std::vector<std::vector<int>> children(joints_.size()), sites(joints_.size());
  std::vector<int> first_site(joints_.size(), INT_MAX), roots;
  for (int s = 0; s < static_cast<int>(clip_.skeleton.end_sites.size()); ++s) {
    const int parent = clip_.skeleton.end_sites[at(s)].parent_idx;
    sites[at(parent)].push_back(s);
    first_site[at(parent)] = std::min(first_site[at(parent)], s);
  }
  for (int j = num_joints - 1; j >= 0; --j) {
    const int parent = joints_[at(j)].parent_idx;
    (parent < 0 ? roots : children[at(parent)]).push_back(j);  // in descending order: taken from the back
    if (parent >= 0) first_site[at(parent)] = std::min(first_site[at(parent)], first_site[at(j)]);
  }
  for (auto& own : sites) std::reverse(own.begin(), own.end());
  text_ = "HIERARCHY\n";
  for (; !roots.empty(); roots.pop_back()) {
    std::vector<int> path{roots.back()};
    open(path.back(), 0);
    while (!path.empty()) {
      const int depth = static_cast<int>(path.size());
      auto &left = children[at(path.back())], &own = sites[at(path.back())];
      if (!own.empty() && (left.empty() || own.back() < first_site[at(left.back())])) {
        write_end_site(own.back(), depth);
        own.pop_back();
      } else if (!left.empty()) {
        path.push_back(left.back());
        left.pop_back();
        open(path.back(), depth);
      } else {
        indent(depth - 1);
        text_ += "}\n";
        path.pop_back();
      }
    }
  }
}

// A rounding of 10^-d in three angles moves a point at distance r by up to 1.5·10^-d·r degrees; joints add up along a
// limb.
void BvhWriter::choose_decimals(int& angle, int& position) const {
  std::vector<double> lever(joints_.size(), 0);
  std::vector<int> num_turning(joints_.size(), 0), num_moving(joints_.size(), 0);
  double worst_lever = 1e-9;
  int most_moving = 1;
  for (int j = 0; j < clip_.skeleton.num_joints(); ++j) {
    const Joint& joint = joints_[at(j)];
    const auto& channels = channels_[at(j)];
    const auto moving = std::count_if(channels.begin(), channels.end(), is_position);
    num_turning[at(j)] = static_cast<std::size_t>(moving) < channels.size();
    num_moving[at(j)] = moving > 0;
    if (joint.parent_idx >= 0) {
      const auto p = at(joint.parent_idx);
      const double length = std::sqrt(clip_.translations.middleCols<3>(3 * j).rowwise().squaredNorm().maxCoeff());
      lever[at(j)] = lever[p] + length * num_turning[p];
      num_turning[at(j)] += num_turning[p];
      num_moving[at(j)] += num_moving[p];
    }
    worst_lever = std::max(worst_lever, lever[at(j)]);
    most_moving = std::max(most_moving, num_moving[at(j)]);
  }
  for (const EndSite& site : clip_.skeleton.end_sites)
    worst_lever =
        std::max(worst_lever, lever[at(site.parent_idx)] + site.offset.norm() * num_turning[at(site.parent_idx)]);
  angle = decimals_for(1.5 / kDegPerRad * worst_lever);
  position = decimals_for(std::sqrt(3) / 2 * most_moving);
}

void BvhWriter::write_rows() {
  text_ += "MOTION\nFrames: " + std::to_string(clip_.num_frames()) + "\nFrame Time: ";
  append_number(text_, clip_.frame_time_secs);
  text_ += '\n';
  int angle_decimals = 0, position_decimals = 0;
  choose_decimals(angle_decimals, position_decimals);
  const FixedFormat angle_format(angle_decimals), position_format(position_decimals);
  std::vector<EulerTrack> tracks;
  std::size_t num_channels = 0;
  for (const auto& channels : channels_) {
    tracks.emplace_back(channels);
    num_channels += channels.size();
  }
  std::vector<char> row(num_channels * 40 + 1);
  text_.reserve(text_.size() + static_cast<std::size_t>(clip_.num_frames()) * num_channels * 12);
  for (Index t = 0; t < clip_.num_frames(); ++t) {
    char* out = row.data();
    for (const int j : order_) {
      const auto& channels = channels_[at(j)];
      if (channels.empty()) continue;
      const Vector3& angles = tracks[at(j)].next(clip_.rotation(t, j));
      int num_angles = 0;
      for (const Channel channel : channels) {
        out = is_position(channel)
                  ? position_format.write(out, clip_.translations(t, 3 * j + static_cast<int>(channel)))
                  : angle_format.write(out, angles[num_angles++] * kDegPerRad);
        *out++ = ' ';
      }
    }
    out[-1] = '\n';
    text_.append(row.data(), static_cast<std::size_t>(out - row.data()));
  }
}

}  // namespace

std::string write_bvh_bytes(const Clip& clip) { return BvhWriter(clip).write(); }

void write_bvh(const std::filesystem::path& path, const Clip& clip) { write_file(path, write_bvh_bytes(clip)); }

}  // namespace motex
