// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"

#include "motex/core/files.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "motex/project/marker_figure.h"
#include "motex/project/viewer_page.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {

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

}  // namespace motex::cli
