// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "motex/core/files.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/clip_codec.h"
#include "motex/particles/compress_clip.h"
#include "motex/project/load_video_clip.h"
#include "motex/video_io/video_writer.h"
#include "options_value.h"
#include "output_file.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Compress {
  std::string video, model_path, output;
  int num_bases = 300;
  LoadVideoClipOptions load;
  CompressClipOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO", "video file, folder of pictures, pattern (f_%04d.png) or TIFF stack", video);
    arguments.value("-o,--output", "FILE", "compressed clip to write (.mtxc)", output).required = true;
    arguments.value("--model", "MODEL", "learned from this clip: its elements are stored as paths", model_path);
    arguments.value("--bases", "N", "bases in each frame: the model's, then free ones (default 300)", num_bases);
    arguments.section("Precision");
    arguments.options(options);
    arguments.section("Reading the clip");
    arguments.options(load);
  }

  void run(Session& session) {
    check_output(output, {".mtxc"}, session);
    if (num_bases < 0 || num_bases > 100000) throw InvalidInput("--bases: 0 … 100000 in each frame");
    TexturedMotion model;
    if (!model_path.empty()) model = load_particles_model(model_path);
    if (session.flags.dry_run) return would_write({output}, -1, session);
    const ClipFrames clip = load_video_clip(video, load, session.job(0, 0.05));
    if (model_path.empty()) {
      model.background = ClipBackground(clip, BackgroundKind::kMedian, session.job()).still();
    } else if (model.width != clip.width || model.height != clip.height || model.num_planes != clip.num_planes() ||
               model.num_frames != clip.num_frames()) {
      throw InvalidInput(model_path + ": was not learned from " + video +
                         " (another size, colour or number of frames)");
    }
    session.job().progress("bases", 0.1);
    const std::vector<Cable> cables =
        with_free_bases(clip, model.background, std::move(model.cables), num_bases, session.job(0.1, 0.8));
    CompressClipReport report;
    const std::string bytes = compress_clip(clip, model.background, cables, options, session.job(0.8, 1), &report);
    write_file(output, bytes);
    session.say("wrote " + output);
    Value object;
    object["video"] = video;
    object["output"] = output;
    object["raw_bytes"] = report.raw_bytes;
    object["bytes"] = report.bytes;
    object["background_bytes"] = report.background_bytes;
    object["ratio"] = report.ratio();
    object["psnr"] = report.psnr;
    object["bases_per_frame"] = report.bases_per_frame;
    object["bits_per_base"] = report.bits_per_base;
    object["options"] = options_value(options);
    session.result(object, text_pairs({{"bytes", std::to_string(report.bytes)},
                                       {"of raw", std::to_string(report.raw_bytes)},
                                       {"ratio", fixed(report.ratio(), 1)},
                                       {"PSNR dB", fixed(report.psnr, 2)},
                                       {"bases a frame", fixed(report.bases_per_frame, 1)},
                                       {"bits a base", fixed(report.bits_per_base, 1)}}));
  }
};

struct Decompress {
  std::string input, output;

  void declare(Arguments& arguments) {
    arguments.positional("FILE", "clip compressed by `motex particles compress` (.mtxc)", input);
    arguments.value("-o,--output", "VIDEO", "video to write; .mkv keeps every pixel", output).required = true;
  }

  void run(Session& session) {
    check_output(output, writable_video_extensions(), session);
    const QuantisedClip clip = read_clip_bytes(read_file(input), input);
    if (session.flags.dry_run) return would_write({output}, clip.num_frames, session);
    const std::vector<Cable> cables = dequantised_cables(clip);
    const JobContext job = session.job();
    VideoWriter writer(output, clip.width, clip.height, {static_cast<double>(clip.frames_per_sec), false}, job);
    for (std::int64_t frame = 0; frame < clip.num_frames; ++frame) {
      job.check_cancelled();
      writer.write(to_image(decoded_frame(clip, cables, frame)));
      job.progress("decoding", static_cast<double>(frame + 1) / static_cast<double>(clip.num_frames));
    }
    writer.finish();
    session.say("wrote " + output);
    Value object;
    object["output"] = output;
    object["frames"] = clip.num_frames;
    object["width"] = clip.width;
    object["height"] = clip.height;
    object["elements"] = static_cast<std::int64_t>(cables.size());
    session.result(object, std::to_string(clip.num_frames) + " frames\n");
  }
};

}  // namespace

Command particles_compress() {
  return make_command<Compress>(
      {"particles compress", "a clip as background and moving bases, entropy coded",
       "Everything is in the file: background, places, shapes and coefficients of all bases, quantised to what the eye "
       "misses least. The PSNR printed is that of the decoded clip.",
       "motex particles compress snow.mp4 -o snow.mtxc\n"
       "motex particles compress snow.mp4 -o snow.mtxc --model snow.motex --bases 400\n"
       "motex particles compress snow.mp4 -o fine.mtxc --coefficient-step 20 --json"});
}

Command particles_decompress() {
  return make_command<Decompress>({"particles decompress", "the video that a compressed clip stands for", "",
                                   "motex particles decompress snow.mtxc -o snow.mkv"});
}

}  // namespace motex::cli
