// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"

#include <algorithm>
#include <cmath>

#include "motex/core/files.h"
#include "motex/motion/up_axis.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "motex/project/marker_figure.h"
#include "motex/project/viewer_page.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {

namespace {

bool is_picture(const std::string& extension) {
  const std::vector<std::string> pictures = picture_extensions();
  return std::find(pictures.begin(), pictures.end(), extension) != pictures.end();
}

/// For a clip at another rate: ratio new frames to one old.
void retime_spans(std::vector<TextonSpan>& spans, double ratio, Index num_frames) {
  if (ratio == 1) return;
  for (TextonSpan& span : spans) {
    const auto frame = [&](Index old) {
      return std::min(num_frames, static_cast<Index>(std::llround(static_cast<double>(old) * ratio)));
    };
    const Index start = frame(span.start);
    span.length = frame(span.start + span.length) - start;
    span.start = start;
  }
}

}  // namespace

std::vector<std::string> picture_extensions() { return {".html", ".png", ".svg"}; }

std::vector<std::string> clip_output_extensions() {
  std::vector<std::string> extensions = writable_clip_extensions();
  for (const std::string& extension : picture_extensions()) extensions.push_back(extension);
  return extensions;
}

void write_clip_output(const std::string& path, const Clip& clip, const ClipPicture& picture, Session& session) {
  const JobContext job = session.job(0.9, 1);
  job.check_cancelled();
  const std::string extension = extension_of(path);
  if (extension == ".html") {
    write_file(path, viewer_page(clip, picture.spans, {picture.title}));
  } else if (extension == ".png" || extension == ".svg") {
    write_picture(path, pose_strip(clip, picture.spans, picture.strip));
  } else {
    write_clip(path, clip, job);
  }
}

void declare_adapt(Arguments& arguments, AdaptClipOptions& options) {
  arguments.section("The written clip");
  arguments.options(options);
}

void check_adapt(const AdaptClipOptions& options, const std::vector<std::string>& outputs) {
  for (const std::string& path : outputs) {
    const std::string extension = extension_of(path);
    if (options.out_up == OutputUp::kZ && extension == ".glb")
      throw InvalidInput(path + ": glTF is always y up, and programs turn it when they read it; leave out --out-up z");
    if (options.out_up == OutputUp::kZ && extension == ".c3d")
      throw InvalidInput(path + ": a C3D file says itself which axis points up; leave out --out-up z");
    if (options.out_unit != LengthUnit::kAuto && options.out_unit != LengthUnit::kM && extension == ".glb")
      throw InvalidInput(path + ": glTF is always in metres; leave out --out-unit");
  }
}

Argument& declare_clip_outputs(Arguments& arguments, std::vector<std::string>& outputs) {
  return arguments.value("-o,--output", "OUT", "motion, page or picture to write; may be given several times", outputs);
}

void check_clip_outputs(const std::vector<std::string>& outputs, const AdaptClipOptions& options,
                        const Session& session) {
  check_outputs(outputs, clip_output_extensions(), session);
  check_adapt(options, outputs);
}

void write_clip_outputs(const std::vector<std::string>& outputs, Clip clip, ClipPicture picture,
                        const AdaptClipOptions& options, Session& session) {
  const double frame_time_secs = clip.frame_time_secs;
  clip = adapt_clip(std::move(clip), options, session.job(0.9, 0.9));
  retime_spans(picture.spans, frame_time_secs / clip.frame_time_secs, clip.num_frames());
  Clip turned;
  if (options.out_up == OutputUp::kZ) turn_y_up_to_z_up(turned = clip);
  for (const std::string& path : outputs) {
    const bool as_picture = is_picture(extension_of(path));
    write_clip_output(path, options.out_up == OutputUp::kZ && !as_picture ? turned : clip, picture, session);
  }
}

std::vector<std::string> marker_output_extensions() {
  std::vector<std::string> extensions = writable_marker_extensions();
  for (const std::string& extension : picture_extensions()) extensions.push_back(extension);
  return extensions;
}

void write_marker_output(const std::string& path, const MarkerSet& markers, const ClipPicture& picture,
                         Session& session) {
  const JobContext job = session.job(0.9, 1);
  job.check_cancelled();
  const std::string extension = extension_of(path);
  if (extension == ".html") {
    write_file(path, viewer_page(figure_motion(markers), picture.spans, {picture.title}));
  } else if (extension == ".png" || extension == ".svg") {
    write_picture(path, pose_strip(figure_motion(markers), picture.spans, picture.strip));
  } else {
    write_markers(path, markers, job);
  }
}

void write_marker_outputs(const std::vector<std::string>& outputs, MarkerSet markers, const AdaptClipOptions& options,
                          Session& session) {
  markers = adapt_markers(std::move(markers), options);
  MarkerSet turned;
  if (options.out_up == OutputUp::kZ) turn_y_up_to_z_up(turned = markers);
  for (const std::string& path : outputs) {
    const bool as_picture = is_picture(extension_of(path));
    write_marker_output(path, options.out_up == OutputUp::kZ && !as_picture ? turned : markers, {}, session);
  }
}

}  // namespace motex::cli
