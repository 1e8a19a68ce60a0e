// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_output.h"
#include "commands.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Convert {
  std::string clip_path, output;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP", "clip to read: .bvh, .glb, .gltf, .amc, or markers: .c3d, .trc", clip_path);
    arguments
        .value("-o,--output", "OUT", "clip to write: .bvh, .glb, .csv, .npz; markers: .trc, .c3d, .csv, .npz", output)
        .required = true;
    arguments.section("Reading the clip");
    arguments.options(read);
  }

  void run(Session& session) {
    if (holds_markers(std::filesystem::path(clip_path))) return convert_markers(session);
    check_output(output, clip_output_extensions(), session);
    const Clip clip = read_clip(clip_path, read, session.job(0, 0.5));
    if (!session.flags.dry_run) write_clip_output(output, clip, {}, session);
    session.say((session.flags.dry_run ? "would write " : "wrote ") + output + ": " +
                std::to_string(clip.num_frames()) + " frames at " + fixed(clip.frame_rate(), 2) + " Hz, " +
                std::to_string(clip.skeleton.num_joints()) + " joints");
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["frame_rate"] = clip.frame_rate();
    object["joints"] = clip.skeleton.num_joints();
    object["metres_per_unit"] = clip.skeleton.metres_per_unit > 0 ? Value(clip.skeleton.metres_per_unit) : Value();
    object["output"] = output;
    session.result(object, "");
  }

 private:
  void convert_markers(Session& session) const {
    check_output(output, marker_output_extensions(), session);
    const MarkerSet markers = read_markers(clip_path, read, session.job(0, 0.5));
    if (!session.flags.dry_run) write_marker_output(output, markers, {}, session);
    session.say((session.flags.dry_run ? "would write " : "wrote ") + output + ": " +
                std::to_string(markers.num_frames()) + " frames at " + fixed(markers.frame_rate(), 2) + " Hz, " +
                std::to_string(markers.num_markers()) + " markers");
    Value object;
    object["frames"] = std::int64_t{markers.num_frames()};
    object["frame_rate"] = markers.frame_rate();
    object["markers"] = markers.num_markers();
    object["missing_share"] = missing_share(markers);
    object["metres_per_unit"] = markers.metres_per_unit > 0 ? Value(markers.metres_per_unit) : Value();
    object["output"] = output;
    session.result(object, "");
  }
};

}  // namespace

Command motion_convert() {
  return make_command<Convert>({"motion convert", "any clip format that is read to any that is written", "",
                                "motex motion convert walk.bvh -o walk.glb\n"
                                "motex motion convert take3.c3d -o take3.trc\n"
                                "motex motion convert 07_01.amc -o walk.bvh --asf 07.asf --resample 30\n"
                                "motex motion convert odd.bvh -o right.bvh --fps 120 --up z --unit inch"});
}

}  // namespace motex::cli
