// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <vector>

#include "closest.h"
#include "commands.h"
#include "film_output.h"
#include "motex/core/options_check.h"
#include "motex/project/key_video.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Key {
  std::string video, background;
  std::vector<std::string> outputs;
  std::string plate_picture, garbage_mask;
  KeyFootageOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO", "of a fixed camera: video file, folder of pictures or pattern (f_%04d.png)", video);
    declare_film_output(arguments, outputs);
    arguments.value("--background", "FILE|COLOUR",
                    "puts the actor before a picture, a video (which starts again at its end), #rrggbb, black, white, "
                    "gray, green or blue",
                    background);
    arguments.section("Background of the footage");
    arguments.options(options.plate);
    arguments.value("--plate", "PNG", "picture of the empty scene (default: estimated from the footage)",
                    plate_picture);
    arguments.value("--garbage-mask", "PNG", "what is bright (or opaque, where it has alpha) never is the actor",
                    garbage_mask);
    arguments.section("Matte");
    arguments.options(options.key);
  }

  void run(Session& session) {
    check_request(session);
    options.plate_picture = plate_picture;
    options.garbage_mask = garbage_mask;
    const VideoInfo info = VideoReader(video).info();
    std::optional<Backdrop> backdrop = backdrop_of(background, info.width, info.height, session.job());
    if (session.flags.dry_run)
      return would_write(outputs, info.num_frames_said > 0 ? info.num_frames_said : -1, session);
    const KeyVideoReport report =
        key_video(video, options, backdrop ? &*backdrop : nullptr, {outputs.begin(), outputs.end()}, session.job());
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(report.footage.num_frames) + " frames, " +
                seen_text(report));
    session.result(report_value(report), "");
  }

 private:
  void check_request(const Session& session) const {
    check_options(options.plate);
    check_options(options.key);
    check_film_output(outputs, background, session);
  }

  static std::string hex(Rgba colour) {
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text = "#";
    for (const int level : {colour.r, colour.g, colour.b}) text += {kDigits[level / 16], kDigits[level % 16]};
    return text;
  }

  static std::string seen_text(const KeyVideoReport& report) {
    if (report.had_alpha) return "its own alpha";
    return std::string(name_of(report.plate->kind)) + " background " + hex(report.plate->colour);
  }

  Value report_value(const KeyVideoReport& report) const {
    Value object;
    object["output"] = outputs;
    object["frames"] = report.footage.num_frames;
    object["width"] = report.width;
    object["height"] = report.height;
    object["own_alpha"] = report.had_alpha;
    object["frames_without_person"] = report.footage.num_empty;
    object["frames_with_covered_border"] = report.footage.num_crowded;
    object["mean_area"] = report.footage.mean_area;
    if (report.plate) {
      Value& plate = object["plate"];
      plate["kind"] = name_of(report.plate->kind);
      plate["colour"] = hex(report.plate->colour);
      plate["seen_share"] = report.plate->seen_share;
      plate["steady_share"] = report.plate->steady_share;
    }
    object["options"] = options_value(options.key);
    object["options"]["screen"] = options_value(options.plate)["screen"];
    object["secs"] = Session::secs();
    return object;
  }
};

}  // namespace

Command people_key() {
  return make_command<Key>(
      {"people key", "cut an actor out of a green, blue, plain or any other static background",
       "The empty scene is estimated from the footage, so light may be uneven; each pixel's alpha and colour follow "
       "from "
       "it, with the screen's light taken off the edges. Files with alpha hold colours that are not premultiplied, as "
       "PNG, ProRes 4444, VP9 and FFV1 want them. Footage with alpha of its own is taken as it is. Sound is left out.",
       "motex people key take.mp4 -o take.mov\n"
       "motex people key take.mp4 -o take.webm -o frames --json\n"
       "motex people key take.mp4 -o shown.mp4 --background beach.png\n"
       "motex people key take.mp4 -o take.mkv --plate empty.png --garbage-mask lamps.png\n"
       "motex people key street.mp4 -o walker.mov --screen natural"});
}

}  // namespace motex::cli
