// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "commands.h"
#include "model_clips.h"
#include "motex/core/files.h"
#include "motex/motion_texture/learn.h"
#include "motex/project/motion_texture_file.h"
#include "motex/project/pose_pictures.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

Value segments_value(const std::vector<RecognisedSegment>& segments) {
  Value list = Value::List();
  for (const RecognisedSegment& segment : segments) {
    Value entry;
    entry["texton"] = segment.texton;
    entry["start"] = std::int64_t{segment.start};
    entry["length"] = std::int64_t{segment.length};
    entry["log_likelihood_per_frame"] = segment.log_likelihood_per_frame;
    list.append(std::move(entry));
  }
  return list;
}

std::string segments_csv(const std::vector<RecognisedSegment>& segments) {
  std::string csv = "texton,start,length,log_likelihood_per_frame\n";
  for (const RecognisedSegment& s : segments)
    csv += std::to_string(s.texton) + "," + std::to_string(s.start) + "," + std::to_string(s.length) + "," +
           fixed(s.log_likelihood_per_frame, 6) + "\n";
  return csv;
}

std::string segments_table(const std::vector<RecognisedSegment>& segments, double frame_time_secs) {
  std::vector<std::vector<std::string>> rows{{"texton", "start", "length", "secs", "nats per frame"}};
  for (const RecognisedSegment& s : segments)
    rows.push_back({std::to_string(s.texton), std::to_string(s.start), std::to_string(s.length),
                    fixed(static_cast<double>(s.length) * frame_time_secs, 2), fixed(s.log_likelihood_per_frame, 2)});
  return text_table(rows);
}

/// The whole clip, twelve poses a row, half a second apart or more.
Drawing segments_picture(const Clip& clip, const std::vector<RecognisedSegment>& segments) {
  std::vector<TextonSpan> spans;
  for (const RecognisedSegment& s : segments) spans.push_back({s.texton, s.start, s.length, ""});
  PoseStripOptions options;
  options.secs = static_cast<double>(clip.num_frames()) * clip.frame_time_secs;
  options.rows = std::clamp(static_cast<int>(std::ceil(options.secs / 6)), 1, 12);
  options.figure_height = 110;
  return pose_strip(clip, spans, options);
}

struct SegmentCall {
  std::string model_path, clip_path, output;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.positional("CLIP", "clip of the model's skeleton", clip_path);
    arguments.value("-o,--output", "OUT", "table (.csv) or picture (.png, .svg); default: a table on stdout", output);
    arguments.section("Reading the clip");
    arguments.options(read);
  }

  void run(Session& session) {
    if (!output.empty()) check_output(output, {".csv", ".png", ".svg"}, session);
    const MotionTexture model = load_motion_texture(model_path);
    const std::vector<Clip> clips = load_clips_for(model, {clip_path}, read, session);
    if (clips.size() != 1) throw InvalidInput(clip_path + ": name one clip");
    const auto segments = segment_clip(model, clips[0]);
    if (!output.empty() && !session.flags.dry_run) write(clips[0], segments, session);
    Value object;
    object["clip"] = clips[0].name;
    object["frames"] = std::int64_t{clips[0].num_frames()};
    object["segments"] = segments_value(segments);
    session.result(object, output.empty() ? segments_table(segments, model.frame_time_secs()) : "");
  }

 private:
  void write(const Clip& clip, const std::vector<RecognisedSegment>& segments, Session& session) const {
    if (extension_of(output) == ".csv")
      write_file(output, segments_csv(segments));
    else
      write_picture(output, segments_picture(clip, segments));
    session.say("wrote " + output);
  }
};

}  // namespace

Command motion_segment() {
  return make_command<SegmentCall>({"motion segment", "recognise a clip: which texton plays when, and how well it fits",
                                    "The most likely segmentation, found exactly. Frames count from 0.",
                                    "motex motion segment dance.motex clip.bvh\n"
                                    "motex motion segment dance.motex clip.bvh -o segments.csv\n"
                                    "motex motion segment dance.motex clip.bvh -o segments.png"});
}

}  // namespace motex::cli
