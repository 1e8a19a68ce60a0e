// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <numbers>

#include "motex/core/files.h"
#include "motex/motion_io/asf.h"
#include "motex/motion_io/asf_amc.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

namespace fs = std::filesystem;
constexpr double kCmuRate = 120;

class AmcReader {
 public:
  AmcReader(AsfSkeleton asf, const NamedText& amc, const ReadClipOptions& options, const JobContext& job)
      : asf_(std::move(asf)), scan_(amc.bytes, amc.name), options_(options), job_(job), degrees_(asf_.degrees) {
    for (std::size_t b = 0; b < asf_.bones.size(); ++b) bone_of_[asf_.bones[b].name] = static_cast<int>(b);
    first_.resize(asf_.bones.size());
    for (const AsfBone& bone : asf_.bones) num_values_ += bone.dofs.size();
    std::size_t at = 0;
    for (std::size_t b = 0; b < asf_.bones.size(); at += asf_.bones[b++].dofs.size()) first_[b] = at;
    frame_of_.assign(asf_.bones.size(), -1);
  }
  Clip read();

 private:
  void read_setting(const std::vector<std::string_view>& words);
  void begin_frame(std::string_view number);
  void end_frame();
  void read_bone(const std::vector<std::string_view>& words);
  void choose_frame_time();
  Clip build();
  void fill_frame(const double* values, Index frame, Clip& clip) const;

  AsfSkeleton asf_;
  TextScanner scan_;
  const ReadClipOptions& options_;
  const JobContext& job_;
  bool degrees_;
  double rate_ = 0;
  std::map<std::string, int, std::less<>> bone_of_;
  std::vector<std::size_t> first_;  // of a bone's numbers in a frame
  std::size_t num_values_ = 0, num_seen_ = 0, num_seen_first_ = 0;
  std::vector<Index> frame_of_;  // in which a bone was last seen
  std::vector<double> values_;
  Index num_frames_ = 0;
  double last_number_ = 0;
  bool gap_ = false;
};

Clip AmcReader::read() {
  if (scan_.at_end()) scan_.fail("the file is empty");
  while (!scan_.at_end()) {
    const auto words = split_words(scan_.next_line());
    if (words[0][0] == '#') continue;
    if (words[0][0] == ':') {
      read_setting(words);
    } else if (words.size() == 1 && (words[0][0] >= '0' && words[0][0] <= '9')) {
      begin_frame(words[0]);
    } else {
      read_bone(words);
    }
  }
  if (num_frames_ == 0) scan_.fail("the file holds no frame");
  end_frame();
  scan_.check_clip_size(static_cast<double>(num_frames_), static_cast<double>(asf_.bones.size()));
  if (gap_) job_.warn(scan_.file() + ": frame numbers have gaps; the frames that are there are used one after another");
  choose_frame_time();
  return build();
}

void AmcReader::read_setting(const std::vector<std::string_view>& words) {
  if (same_word(words[0], ":DEGREES")) degrees_ = true;
  if (same_word(words[0], ":RADIANS")) degrees_ = false;
  if (same_word(words[0], ":SAMPLES-PER-SECOND") && words.size() > 1)
    rate_ = scan_.parse_number(words[1], "the number of samples per second");
}

void AmcReader::begin_frame(std::string_view number) {
  const double n = scan_.parse_number(number, "the frame number");
  if (num_frames_ > 0) end_frame();
  if (num_frames_ > 0 && n != last_number_ + 1) gap_ = true;
  last_number_ = n;
  if (num_frames_++ % 1024 == 0) job_.check_cancelled();
  num_seen_ = 0;
  // A frame takes a line a bone: a bound on what the values may cost.
  scan_.check_clip_size(static_cast<double>(num_frames_), static_cast<double>(num_values_) / 7);
  values_.resize(values_.size() + num_values_, 0.0);
}

void AmcReader::end_frame() {
  if (num_frames_ == 1) {
    num_seen_first_ = num_seen_;
    const auto moving =
        std::count_if(asf_.bones.begin(), asf_.bones.end(), [](const auto& b) { return !b.dofs.empty(); });
    if (static_cast<std::size_t>(moving) != num_seen_)
      job_.warn(scan_.file() + ": only " + std::to_string(num_seen_) + " of the skeleton's " + std::to_string(moving) +
                " moving bones are given; the others stay at rest");
  } else if (num_seen_ != num_seen_first_) {
    scan_.fail("frame " + std::to_string(num_frames_ - 1) + " gives " + std::to_string(num_seen_) +
               " bones, the first frame " + std::to_string(num_seen_first_));
  }
}

void AmcReader::read_bone(const std::vector<std::string_view>& words) {
  if (num_frames_ == 0)
    scan_.fail("this is not an AMC file: " + in_quotes(words[0]) + " stands before the first frame");
  const auto found = bone_of_.find(words[0]);
  if (found == bone_of_.end()) scan_.fail("bone " + in_quotes(words[0]) + " is not in the .asf skeleton");
  const auto bone = static_cast<std::size_t>(found->second);
  const std::size_t count = asf_.bones[bone].dofs.size();
  if (words.size() - 1 != count)
    scan_.fail("bone " + in_quotes(words[0]) + " has " + std::to_string(words.size() - 1) + " numbers, the .asf says " +
               std::to_string(count));
  if (frame_of_[bone] == num_frames_) scan_.fail("bone " + in_quotes(words[0]) + " stands twice in the frame");
  frame_of_[bone] = num_frames_;
  ++num_seen_;
  double* out = values_.data() + values_.size() - num_values_ + first_[bone];
  for (std::size_t i = 0; i < count; ++i) out[i] = scan_.parse_number(words[i + 1], "a number");
}

void AmcReader::choose_frame_time() {
  if (options_.fps > 0) {
    rate_ = options_.fps;
  } else if (!(rate_ > 0)) {
    rate_ = kCmuRate;
    job_.warn(scan_.file() + ": the file states no frame rate; 120 Hz is assumed (give the true one with --fps)");
  }
}

Clip AmcReader::build() {
  Clip clip = make_clip(asf_.skeleton, num_frames_, 1 / rate_);
  clip.name = clip_name(scan_.file());
  for (Index t = 0; t < num_frames_; ++t)
    fill_frame(values_.data() + static_cast<std::size_t>(t) * num_values_, t, clip);
  return clip;
}

void AmcReader::fill_frame(const double* values, Index frame, Clip& clip) const {
  const double unit = degrees_ ? std::numbers::pi / 180 : 1;
  for (std::size_t b = 0; b < asf_.bones.size(); ++b) {
    const AsfBone& bone = asf_.bones[b];
    Vector3 angles = Vector3::Zero(), place = clip.skeleton.joints[b].offset;
    for (const AsfDof& dof : bone.dofs)
      (dof.rotation ? angles : place)[dof.axis] = *values++ * (dof.rotation ? unit : 1);
    const Quat motion = quat_from_axis_order(bone.axis_order, angles);
    clip.set_translation(frame, static_cast<int>(b), place);
    clip.set_rotation(frame, static_cast<int>(b), (bone.axis * motion * bone.axis.conjugate()).normalized());
  }
}

fs::path find_asf(const fs::path& amc, const ReadClipOptions& options) {
  if (!options.asf.empty()) return options.asf;
  const std::string stem = amc.stem().string();
  for (const std::string& name : {stem.substr(0, stem.find('_')), stem})
    for (const char* extension : {".asf", ".ASF"})
      if (const fs::path path = amc.parent_path() / (name + extension); fs::exists(path)) return path;
  std::vector<fs::path> found;
  const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder))
    if (same_word(entry.path().extension().string(), ".asf")) found.push_back(entry.path());
  if (found.size() == 1) return found[0];
  throw InvalidInput(amc.string() + ": " + (found.empty() ? "there is no" : "there is more than one") +
                     " .asf skeleton beside it; name it with --asf");
}

}  // namespace

Clip read_amc_bytes(const NamedText& asf, const NamedText& amc, const ReadClipOptions& options, const JobContext& job) {
  return AmcReader(read_asf_bytes(asf.bytes, asf.name), amc, options, job).read();
}

Clip read_amc(const fs::path& amc, const ReadClipOptions& options, const JobContext& job) {
  const std::string motion = read_file(amc);
  const fs::path asf = find_asf(amc, options);
  const std::string skeleton = read_file(asf);
  return read_amc_bytes({skeleton, asf.string()}, {motion, amc.string()}, options, job);
}

}  // namespace motex
