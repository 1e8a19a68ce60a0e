// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "motex/motion/adapt_clip.h"
#include "motex/motion/clip.h"
#include "motex/motion/markers.h"
#include "motex/project/pose_pictures.h"
#include "session.h"

namespace motex::cli {

/// What a clip can be shown as: ".html", ".png", ".svg".
std::vector<std::string> picture_extensions();
/// The formats of clips and those.
std::vector<std::string> clip_output_extensions();

/// How a clip is shown where it is not written as motion.
struct ClipPicture {
  std::vector<TextonSpan> spans;
  std::string title;  ///< of a page; empty = the clip's name
  PoseStripOptions strip;
};

/// Writes the clip as the extension says.
void write_clip_output(const std::string& path, const Clip& clip, const ClipPicture& picture, Session& session);

/// The flags of AdaptClipOptions under a heading of their own.
void declare_adapt(Arguments& arguments, AdaptClipOptions& options);
/// To be called before long work: throws InvalidInput where a format cannot take an option.
void check_adapt(const AdaptClipOptions& options, const std::vector<std::string>& outputs);

/// -o OUT of commands that write a clip; the caller says whether it is required.
Argument& declare_clip_outputs(Arguments& arguments, std::vector<std::string>& outputs);
/// check_outputs() for the formats of clips, then check_adapt().
void check_clip_outputs(const std::vector<std::string>& outputs, const AdaptClipOptions& options,
                        const Session& session);
/// Adapts the clip and writes it to each path. Pages and pictures keep y up.
void write_clip_outputs(const std::vector<std::string>& outputs, Clip clip, ClipPicture picture,
                        const AdaptClipOptions& options, Session& session);

/// The formats of markers and what they can be shown as.
std::vector<std::string> marker_output_extensions();
/// Writes the markers as the extension says.
void write_marker_output(const std::string& path, const MarkerSet& markers, const ClipPicture& picture,
                         Session& session);
void write_marker_outputs(const std::vector<std::string>& outputs, MarkerSet markers, const AdaptClipOptions& options,
                          Session& session);

}  // namespace motex::cli
