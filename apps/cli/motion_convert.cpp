// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <limits>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "options_value.h"
#include "output_file.h"
#include "skin_argument.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// Frames first … last, both included; last may lie beyond the end when it was not named.
struct FrameRange {
  std::int64_t first = 0, last = std::numeric_limits<std::int64_t>::max();
};

/// "120:359", "120:", ":359".
FrameRange parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.size() < 2) throw InvalidInput("--frames: '" + text + "' is not A:B");
  FrameRange range;
  if (colon > 0) parse_value("--frames", text.substr(0, colon), range.first);
  if (colon + 1 < text.size()) parse_value("--frames", text.substr(colon + 1), range.last);
  if (range.first < 0 || range.last < range.first)
    throw InvalidInput("--frames: '" + text + "' does not go from a frame to a later one");
  return range;
}

struct Convert {
  std::string clip_path, range_text, skin_path;
  std::vector<std::string> outputs;
  ReadClipOptions read;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP", "clip to read: .bvh, .glb, .gltf, .amc, .fbx, or markers: .c3d, .trc", clip_path);
    arguments
        .value("-o,--output", "OUT",
               "clip to write: .bvh, .glb, .csv, .npz; markers: .trc, .c3d, .csv, .npz; may be given several times",
               outputs)
        .required = true;
    arguments.value("--frames", "A:B", "frames A to B only, both included, counted from 0 after reading", range_text);
    declare_skin(arguments, skin_path);
    arguments.section("Reading the clip");
    arguments.options(read);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    const bool markers = holds_markers(std::filesystem::path(clip_path));
    check_outputs(outputs, markers ? marker_output_extensions() : clip_output_extensions(), session);
    check_adapt(adapt, outputs);
    const FrameRange range = range_text.empty() ? FrameRange{} : parse_range(range_text);
    if (markers)
      convert_markers(range, session);
    else
      convert_clip(range, session);
  }

 private:
  void convert_clip(const FrameRange& range, Session& session) const {
    Clip clip = cut(read_clip(clip_path, read, session.job(0, 0.5)), range);
    put_on_skin(skin_path, clip.skeleton, session);
    clip = adapt_clip(std::move(clip), adapt, session.job(0.5, 0.6));
    if (!session.flags.dry_run) write_clip_outputs(outputs, clip, {}, only_up(), session);
    Value object = common_value(clip.num_frames(), clip.frame_rate(), clip.skeleton.metres_per_unit);
    object["joints"] = clip.skeleton.num_joints();
    say(session, clip.num_frames(), clip.frame_rate(), std::to_string(clip.skeleton.num_joints()) + " joints");
    session.result(object, "");
  }

  void convert_markers(const FrameRange& range, Session& session) const {
    MarkerSet markers = cut(read_markers(clip_path, read, session.job(0, 0.5)), range);
    markers = adapt_markers(std::move(markers), adapt);
    if (!session.flags.dry_run) write_marker_outputs(outputs, markers, only_up(), session);
    Value object = common_value(markers.num_frames(), markers.frame_rate(), markers.metres_per_unit);
    object["markers"] = markers.num_markers();
    object["missing_share"] = missing_share(markers);
    say(session, markers.num_frames(), markers.frame_rate(), std::to_string(markers.num_markers()) + " markers");
    session.result(object, "");
  }

  /// What is left when the rest is applied.
  AdaptClipOptions only_up() const {
    AdaptClipOptions left;
    left.out_up = adapt.out_up;
    return left;
  }

  template <typename Motion>
  static Motion cut(Motion motion, const FrameRange& range) {
    if (range.first >= motion.num_frames())
      throw InvalidInput("--frames: " + motion.name + " has " + std::to_string(motion.num_frames()) + " frames");
    const std::int64_t last = range.last == FrameRange{}.last ? motion.num_frames() - 1 : range.last;
    return slice(motion, range.first, last - range.first + 1);
  }

  Value common_value(Index num_frames, double frame_rate, double metres_per_unit) const {
    Value object;
    object["frames"] = std::int64_t{num_frames};
    object["frame_rate"] = frame_rate;
    object["metres_per_unit"] = metres_per_unit > 0 ? Value(metres_per_unit) : Value();
    object["output"] = outputs;
    object["options"] = options_value(adapt);
    return object;
  }

  void say(Session& session, Index num_frames, double frame_rate, const std::string& parts) const {
    session.say((session.flags.dry_run ? "would write " : "wrote ") + enumerate(outputs) + ": " +
                std::to_string(num_frames) + " frames at " + fixed(frame_rate, 2) + " Hz, " + parts);
  }
};

}  // namespace

Command motion_convert() {
  return make_command<Convert>(
      {"motion convert", "any clip format that is read to any that is written",
       "Reading options say what the file holds, the others change what is written: "
       "--up z reads a file whose z points up, --out-up z writes one.",
       "motex motion convert walk.bvh -o walk.glb\n"
       "motex motion convert take3.c3d -o take3.trc\n"
       "motex motion convert 07_01.amc -o walk.bvh --asf 07.asf --resample 30\n"
       "motex motion convert odd.bvh -o right.bvh --fps 120 --up z --unit inch\n"
       "motex motion convert walk.bvh -o walk.glb --root bone --without '*Finger*' --frames 120:359"});
}

}  // namespace motex::cli
