// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"
#include "commands.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "output_file.h"

namespace motex::cli {
namespace {

struct View {
  std::string clip_path, output;
  PoseStripOptions strip;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP", "clip or markers (.c3d, .trc) to show", clip_path);
    arguments.value("-o,--output", "OUT", "a page that plays it (.html), or a strip of poses (.png, .svg)", output)
        .required = true;
    arguments.section("Strip of poses");
    arguments.options(strip);
    arguments.section("Reading the clip");
    arguments.options(read);
  }

  void run(Session& session) {
    check_output(output, picture_extensions(), session);
    const Index num_frames =
        holds_markers(std::filesystem::path(clip_path)) ? show_markers(session) : show_clip(session);
    session.say((session.flags.dry_run ? "would write " : "wrote ") + output);
    Value object;
    object["frames"] = std::int64_t{num_frames};
    object["output"] = output;
    session.result(object, "");
  }

 private:
  Index show_clip(Session& session) const {
    const Clip clip = read_clip(clip_path, read, session.job(0, 0.5));
    if (!session.flags.dry_run) write_clip_output(output, clip, {{}, "", strip}, session);
    return clip.num_frames();
  }
  Index show_markers(Session& session) const {
    const MarkerSet markers = read_markers(clip_path, read, session.job(0, 0.5));
    if (!session.flags.dry_run) write_marker_output(output, markers, {{}, "", strip}, session);
    return markers.num_frames();
  }
};

}  // namespace

Command motion_view() {
  return make_command<View>({"motion view", "a page that plays a clip, or a picture of its poses",
                             "The page needs nothing but a browser and works without a network. Markers are shown as "
                             "points, with sticks between those that keep their distance.",
                             "motex motion view walk.bvh -o walk.html\n"
                             "motex motion view walk.bvh -o walk.png --secs 4 --figures 16\n"
                             "motex motion view take3.c3d -o take3.html"});
}

}  // namespace motex::cli
