// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr int kMaxJoints = 10'000;
constexpr double kRadPerDeg = std::numbers::pi / 180;
// What may occur once or thousands of times and is said once.
struct Oddity {
  int count = 0;
  std::string first;
  void note(const std::string& name) {
    if (count++ == 0) first = name;
  }
};

class BvhReader {
 public:
  BvhReader(std::string_view bytes, const std::string& name, const ReadClipOptions& options, const JobContext& job)
      : scan_(bytes, name), num_bytes_(bytes.size()), options_(options), job_(job) {}

  Clip read() {
    read_hierarchy();
    read_motion_header();
    read_rows();
    return build_clip();
  }

 private:
  void read_hierarchy();
  void warn_of_oddities() const;
  void read_block(std::string_view keyword);
  void open_joint(bool root);
  void open_end_site();
  void read_channels(Joint& joint);
  void close();
  Vector3 read_offset();
  void expect_open_brace(const std::string& after);

  void read_motion_header();
  std::string_view value_after(std::string_view key);
  void read_rows();
  void check_row_count(Index rows);
  Clip build_clip();
  void fill_frame(const double* row, Index frame, Clip& clip) const;

  void warn(const std::string& message) const { job_.warn(scan_.file() + ": " + message); }
  Joint& joint(int idx) { return skeleton_.joints[static_cast<std::size_t>(idx)]; }

  struct Open {
    int joint_idx;   // −1: an End Site
    int parent_idx;  // of an End Site
    std::int64_t line;
    bool has_tip = false;
  };

  TextScanner scan_;
  std::size_t num_bytes_;
  const ReadClipOptions& options_;
  const JobContext& job_;
  Skeleton skeleton_;
  std::unordered_map<std::string, int> names_;  // how many joints are called so
  Oddity renamed_, nameless_, tipless_;
  std::vector<Open> open_;
  double stated_frames_ = 0, frame_time_secs_ = 0;
  std::size_t num_channels_ = 0;
  std::vector<double> values_;
  std::int64_t first_wrapped_line_ = 0;
};

void BvhReader::read_hierarchy() {
  if (scan_.at_end()) scan_.fail("the file is empty");
  if (!same_word(scan_.word(), "HIERARCHY")) scan_.fail("this is not a BVH file: it does not begin with HIERARCHY");
  for (;;) {
    if (scan_.at_end()) scan_.fail("the file ends before its MOTION section");
    const std::string_view keyword = scan_.word();
    if (same_word(keyword, "MOTION")) break;
    read_block(keyword);
  }
  if (!open_.empty())
    scan_.fail("MOTION begins, but the '{' of line " + std::to_string(open_.back().line) + " has no '}'");
  if (skeleton_.joints.empty()) scan_.fail("there is no ROOT before MOTION");
  if (num_channels_ == 0) scan_.fail("no joint has a channel, so that nothing can move");
  warn_of_oddities();
}

void BvhReader::warn_of_oddities() const {
  const auto say = [&](const Oddity& oddity, const std::string& what) {
    if (oddity.count > 0) warn(std::to_string(oddity.count) + " " + what + oddity.first);
  };
  say(renamed_, "joint(s) had the name of another and were renamed, the first to ");
  say(nameless_, "joint(s) had no name and were given one, the first ");
  say(tipless_, "joint(s) at the end of a limb have no End Site, so that their tips are unknown, the first ");
}

void BvhReader::read_block(std::string_view keyword) {
  const bool in_joint = !open_.empty() && open_.back().joint_idx >= 0;
  if (same_word(keyword, "ROOT") && open_.empty()) return open_joint(true);
  if (same_word(keyword, "JOINT") && in_joint) return open_joint(false);
  if ((same_word(keyword, "End") || same_word(keyword, "EndSite")) && in_joint) return open_end_site();
  if (same_word(keyword, "OFFSET") && !open_.empty()) {
    const Vector3 offset = read_offset();
    (in_joint ? joint(open_.back().joint_idx).offset : skeleton_.end_sites.back().offset) = offset;
    return;
  }
  if (same_word(keyword, "CHANNELS") && in_joint) return read_channels(joint(open_.back().joint_idx));
  if (keyword == "}" && !open_.empty()) return close();
  scan_.fail(in_quotes(keyword) + " has no place here" + (open_.empty() ? ", outside of any ROOT" : ""));
}

void BvhReader::open_joint(bool root) {
  if (skeleton_.num_joints() == kMaxJoints) scan_.fail("there are more than 10,000 joints");
  Joint joint;
  const int idx = skeleton_.num_joints();
  joint.name = std::string(scan_.rest_of_line());
  if (joint.name.empty()) {
    joint.name = "joint" + std::to_string(idx);
    nameless_.note("'" + joint.name + "'");
  }
  const std::string stated = joint.name;
  for (int& n = names_[stated]; n++ > 0;) {
    joint.name = stated + "_" + std::to_string(n);
    if (names_.emplace(joint.name, 1).second) break;
  }
  if (joint.name != stated) renamed_.note("'" + joint.name + "'");
  joint.parent_idx = root ? -1 : open_.back().joint_idx;
  if (!root) open_.back().has_tip = true;
  expect_open_brace("joint " + in_quotes(stated));
  open_.push_back({idx, -1, scan_.line()});
  skeleton_.joints.push_back(std::move(joint));
}

void BvhReader::open_end_site() {
  scan_.rest_of_line();
  expect_open_brace("End Site");
  const int parent = open_.back().joint_idx;
  open_.back().has_tip = true;
  open_.push_back({-1, parent, scan_.line()});
  skeleton_.end_sites.push_back({parent, Vector3::Zero()});
}

void BvhReader::close() {
  const Open& closed = open_.back();
  if (closed.joint_idx >= 0 && !closed.has_tip) tipless_.note(in_quotes(joint(closed.joint_idx).name));
  open_.pop_back();
}

void BvhReader::expect_open_brace(const std::string& after) {
  const std::string_view found = scan_.word();
  if (found != "{")
    scan_.fail("expected '{' after " + after + ", found " + (found.empty() ? "the end" : in_quotes(found)));
}

Vector3 BvhReader::read_offset() {
  Vector3 offset;
  for (double& x : offset) x = scan_.number("a number of OFFSET");
  return offset;
}

void BvhReader::read_channels(Joint& joint) {
  const double count = scan_.number("the number of CHANNELS");
  if (!(count >= 0 && count <= 6) || count != std::floor(count)) scan_.fail("a joint has 0 to 6 CHANNELS");
  if (!joint.channels.empty()) scan_.fail("joint " + in_quotes(joint.name) + " has CHANNELS twice");
  int num_rotations = 0;
  for (int n = 0; n < static_cast<int>(count); ++n) {
    const std::string_view word = scan_.word();
    int found = 0;
    while (found < 6 && !same_word(word, channel_name(static_cast<Channel>(found)))) ++found;
    if (found == 6) scan_.fail(in_quotes(word) + " is no channel; known are Xposition … Zrotation");
    const auto channel = static_cast<Channel>(found);
    const auto& have = joint.channels;
    const bool rotation = channel >= Channel::kXRotation;
    num_rotations += rotation;
    const auto same = std::find(have.begin(), have.end(), channel);
    if ((!rotation && same != have.end()) || num_rotations > 3 || (!have.empty() && same == have.end() - 1))
      scan_.fail("the channels of joint " + in_quotes(joint.name) + " name " + std::string(channel_name(channel)) +
                 " once too often");
    joint.channels.push_back(channel);
  }
  num_channels_ += joint.channels.size();
}

// "Frames: 12", "Frames : 12", "frame time:	0.01".
std::string_view BvhReader::value_after(std::string_view key) {
  if (scan_.at_end()) scan_.fail("the file ends where '" + std::string(key) + ":' should stand");
  std::string_view line = scan_.next_line();
  const bool matches = same_word(line.substr(0, key.size()), key);
  if (!matches) scan_.fail("expected '" + std::string(key) + ":', found " + in_quotes(line));
  line.remove_prefix(key.size());
  while (!line.empty() && (line.front() == ':' || line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  return line;
}

void BvhReader::read_motion_header() {
  stated_frames_ = scan_.parse_number(value_after("Frames"), "the number of frames");
  frame_time_secs_ = scan_.parse_number(value_after("Frame Time"), "the frame time");
  if (options_.fps > 0) {
    frame_time_secs_ = 1 / options_.fps;
  } else if (!(frame_time_secs_ > 0)) {
    scan_.fail("the Frame Time is not positive; give the true rate with --fps");
  }
}

// A frame starts at the start of a line; so a number too many or too few is found in the row where it happens.
void BvhReader::read_rows() {
  const std::size_t most = num_bytes_ / (2 * num_channels_) + 1;  // a number takes two bytes at least
  values_.reserve(static_cast<std::size_t>(std::clamp(stated_frames_, 0.0, static_cast<double>(most))) * num_channels_);
  std::int64_t last_line = scan_.line();
  Index row = 0;
  for (; !scan_.at_end(); ++row) {
    if (row % 1024 == 0) job_.check_cancelled();
    const std::int64_t start = scan_.line();
    if (start == last_line)
      scan_.fail("frame " + std::to_string(row - 1) +
                 " does not end where its line ends: its row has too many or too few"
                 " numbers, " +
                 std::to_string(num_channels_) + " are expected");
    for (std::size_t c = 0; c < num_channels_; ++c) {
      if (c > 0 && scan_.at_end())
        scan_.fail("the file ends inside frame " + std::to_string(row) + ", after " + std::to_string(c) + " of its " +
                   std::to_string(num_channels_) + " numbers");
      double value = 0;
      if (!scan_.plain_number(value)) value = scan_.number("a number of frame " + std::to_string(row));
      values_.push_back(value);
    }
    last_line = scan_.line();
    if (last_line != start && first_wrapped_line_ == 0) first_wrapped_line_ = start;
  }
  check_row_count(row);
}

void BvhReader::check_row_count(Index rows) {
  if (rows == 0) scan_.fail("the file holds no frame");
  if (static_cast<double>(rows) != stated_frames_)
    warn("the header states " + std::to_string(static_cast<std::int64_t>(stated_frames_)) + " frames, the file holds " +
         std::to_string(rows) + "; all that are there are used");
  if (first_wrapped_line_ > 0)
    warn("frames are wrapped over several lines, the first at line " + std::to_string(first_wrapped_line_));
  if (scan_.saw_decimal_comma()) warn("numbers have decimal commas; they are read as decimal points");
  scan_.check_clip_size(static_cast<double>(rows), skeleton_.num_joints());
}

Clip BvhReader::build_clip() {
  for (Joint& j : skeleton_.joints) {
    const auto moves =
        std::count_if(j.channels.begin(), j.channels.end(), [](Channel c) { return c <= Channel::kZPosition; });
    if (j.parent_idx < 0 && moves == 3) j.offset.setZero();
  }
  const auto rows = static_cast<Index>(values_.size() / num_channels_);
  Clip clip = make_clip(std::move(skeleton_), rows, frame_time_secs_);
  clip.name = clip_name(scan_.file());
  for (Index t = 0; t < rows; ++t) {
    if (t % 1024 == 0) job_.check_cancelled();
    fill_frame(values_.data() + static_cast<std::size_t>(t) * num_channels_, t, clip);
  }
  return clip;
}

void BvhReader::fill_frame(const double* row, Index frame, Clip& clip) const {
  for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
    const Joint& joint = clip.skeleton.joints[static_cast<std::size_t>(j)];
    Quat q = Quat::Identity();
    for (const Channel channel : joint.channels) {
      const double value = *row++;
      if (channel <= Channel::kZPosition) {
        clip.translations(frame, 3 * j + static_cast<int>(channel)) = value;
        continue;
      }
      const double sine = std::sin(value * kRadPerDeg / 2), cosine = std::cos(value * kRadPerDeg / 2);
      Quat factor(cosine, 0, 0, 0);
      factor.vec()[static_cast<int>(channel) - static_cast<int>(Channel::kXRotation)] = sine;
      q = q * factor;
    }
    if (!joint.channels.empty()) clip.set_rotation(frame, j, q);
  }
}

}  // namespace

Clip read_bvh_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                    const JobContext& job) {
  return BvhReader(bytes, name, options, job).read();
}

Clip read_bvh(const std::filesystem::path& path, const ReadClipOptions& options, const JobContext& job) {
  return read_bvh_bytes(read_file(path), path.string(), options, job);
}

}  // namespace motex
