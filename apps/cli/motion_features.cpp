// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "model_clips.h"
#include "motex/core/files.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/npz.h"
#include "motex/motion_texture/features.h"
#include "motex/project/motion_texture_file.h"
#include "output_file.h"

namespace motex::cli {
namespace {

/// Of the columns of encode(), in order.
std::vector<std::string> channel_names(const FeatureSpace& space) {
  std::vector<std::string> names{"step_x", "step_z", "height", "turn", "tilt_x", "tilt_z"};
  for (const int joint : space.joints)
    for (const char* axis : {".x", ".y", ".z"})
      names.push_back(space.skeleton.joints[static_cast<std::size_t>(joint)].name + axis);
  return names;
}

std::string features_npz(const FeatureSpace& space, const FrameMatrix& features) {
  NpzWriter npz;
  npz.add("features", features);
  npz.add("weights", std::span<const double>(space.weights.data(), static_cast<std::size_t>(space.weights.size())));
  const std::vector<std::string> names = channel_names(space);
  npz.add("names", std::span<const std::string>(names));
  npz.add("references", space.references);
  npz.add("frame_time", space.frame_time_secs);
  npz.add("cm_per_unit", space.cm_per_unit);
  return npz.bytes();
}

struct Features {
  std::string clip_path, output, model_path;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("CLIP", "clip to encode", clip_path);
    arguments.value("-o,--output", "F.npz", "arrays for numpy.load: features, weights, names, …", output).required =
        true;
    arguments.value("--model", "MODEL", "with the weights and references of this model, not the clip's own",
                    model_path);
    arguments.section("Reading the clip");
    arguments.options(read);
  }

  void run(Session& session) {
    check_output(output, {".npz"}, session);
    FeatureSpace space;
    Clip clip;
    if (model_path.empty()) {
      clip = read_clip(clip_path, read, session.job(0, 0.5));
      space = make_feature_space({&clip, 1}, session.job(0.5, 0.7));
    } else {
      const MotionTexture model = load_motion_texture(model_path);
      clip = load_clips_for(model, {clip_path}, read, session).at(0);
      space = model.features;
    }
    const FrameMatrix features = encode(space, clip, session.job(0.7, 0.9));
    if (!session.flags.dry_run) {
      write_file(output, features_npz(space, features));
      session.say("wrote " + output);
    }
    Value object;
    object["frames"] = std::int64_t{features.rows()};
    object["channels"] = std::int64_t{features.cols()};
    object["output"] = output;
    session.result(object, "");
  }
};

}  // namespace

Command motion_features() {
  return make_command<Features>(
      {"motion features", "the numbers that learning sees: weighted channels in the heading frame, in centimetres",
       "Rows are frames, columns channels: steps, height and turn of the body, its tilt, then three a joint.",
       "motex motion features walk.bvh -o walk.npz\n"
       "motex motion features walk.bvh -o walk.npz --model dance.motex"});
}

}  // namespace motex::cli
