// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <deque>

#include "commands.h"
#include "interrupt.h"
#include "motex/core/csv.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "steer_input.h"
#include "text_table.h"

namespace motex::cli {
namespace {

constexpr double kLongestWaitSecs = 0.25;

/// Frames as lines on standard output (docs/formats.md).
class FrameLines {
 public:
  FrameLines(const MotionTexture& model, bool csv) : model_(model), csv_(csv) {}

  std::string head() const {
    const FeatureSpace& space = model_.features;
    if (csv_) {
      std::string line = "frame,time,texton,root.x,root.y,root.z";
      for (const Joint& joint : space.skeleton.joints)
        for (const char* part : {".w", ".x", ".y", ".z"}) line += "," + csv_cell(joint.name + part);
      return line + "\n";
    }
    Value joints = Value(Value::List{}), object;
    for (int j = 0; j < space.skeleton.num_joints(); ++j) {
      const Joint& joint = space.skeleton.joints[static_cast<std::size_t>(j)];
      Value entry;
      entry["name"] = joint.name;
      entry["parent"] = joint.parent_idx;
      entry["translation"] = std::vector<double>{space.held(j, 0), space.held(j, 1), space.held(j, 2)};
      joints.append(entry);
    }
    object["motex_stream"] = 1;
    object["frame_time_secs"] = space.frame_time_secs;
    object["metres_per_unit"] = space.cm_per_unit / 100;
    object["root"] = space.travelling_joint;
    object["joints"] = joints;
    return to_json(object) + "\n";
  }

  std::string frame(const Clip& clip, std::int64_t number, int texton) const {
    const Vector3 root = clip.translation(0, model_.features.travelling_joint);
    std::string line;
    const auto number_text = [&](double value) {
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", value);
      line += text;
    };
    const double time = static_cast<double>(number) * model_.frame_time_secs();
    line = (csv_ ? "" : "{\"frame\":") + std::to_string(number) + (csv_ ? "," : ",\"time\":");
    line += fixed(time, 6) + (csv_ ? "," : ",\"texton\":") + std::to_string(texton) + (csv_ ? "," : ",\"root\":[");
    for (int c = 0; c < 3; ++c) line += c > 0 ? "," : "", number_text(root[c]);
    line += csv_ ? "" : "],\"rotations\":[";
    for (Index j = 0; j < clip.rotations.cols() / 4; ++j) {
      if (!csv_) line += j > 0 ? ",[" : "[";
      for (Index c = 0; c < 4; ++c) line += csv_ || c > 0 ? "," : "", number_text(clip.rotations(0, 4 * j + c));
      if (!csv_) line += "]";
    }
    return line + (csv_ ? "\n" : "]}\n");
  }

 private:
  const MotionTexture& model_;
  bool csv_;
};

struct Play {
  std::string model_path;
  bool with_steering = false;
  enum class Format { kJson, kCsv } format = Format::kJson;
  std::int64_t frames = 0;
  double secs = 0;
  SynthesizeOptions options;
  SteerOptions steer;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.toggle("--steer",
                     "read commands from standard input, a line each: direction DEG, facing DEG, speed M/S, "
                     "pace X, texton T, free, stop",
                     with_steering);
    Argument& lines =
        arguments.value("--format", "FORMAT", "lines on standard output: json or csv (default json)", format_text_);
    lines.choices = {"json", "csv"};
    lines.set = [this](const std::string& text) {
      format = static_cast<Format>(parse_choice("--format", text, {"json", "csv"}));
    };
    arguments.toggle("--no-pacing",
                     "as fast as it goes, instead of in real time; the commands are then read first, to their end",
                     unpaced_);
    arguments.value("--frames", "N", "stop after so many frames (default: at stop, end of input or Ctrl-C)", frames)
        .set = [this](const std::string& text) {
      parse_value("--frames", text, frames);
      if (frames < 1) throw InvalidInput("--frames: " + text + " is below 1");
    };
    arguments.value("--secs", "S", "the same in seconds", secs).set = [this](const std::string& text) {
      parse_value("--secs", text, secs);
      if (!(secs > 0 && secs < 1e9)) throw InvalidInput("--secs: " + text + " is outside 0 … 1e9");
    };
    arguments.section("How");
    arguments.options(options);
    arguments.options(steer);
  }

  void run(Session& session) {
    if (session.flags.json) throw InvalidInput("--json: the frames themselves are the output; see --format");
    if (frames > 0 && secs > 0) throw InvalidInput("--frames and --secs say the same thing twice; name one");
    const MotionTexture model = load_motion_texture(model_path);
    if (secs > 0) frames = std::max<std::int64_t>(1, std::llround(secs / model.frame_time_secs()));
    if (unpaced_ && !with_steering && frames == 0)
      throw InvalidInput("--no-pacing without --steer has no end; give --frames N or --secs S");
    SteeredSynthesizer stream(model, options, steer);
    if (session.flags.dry_run) {
      session.say("would play " + (frames > 0 ? std::to_string(frames) + " frames" : std::string("until stopped")) +
                  ", seed " + std::to_string(options.seed));
      return;
    }
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is the end of the show, not an error
    Show show{*this, model, stream, session, SteerParser(model), {}, {}, {}, 0, false};
    show.run();
    session.say("played " + std::to_string(show.frame) + " frames, seed " + std::to_string(options.seed));
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The running stream.
  struct Show {
    const Play& play;
    const MotionTexture& model;
    SteeredSynthesizer& stream;
    Session& session;
    SteerParser parser;
    LineInput input;
    std::deque<SteerCommand> waiting;
    std::deque<PlayedTexton> textons;
    std::int64_t frame = 0;
    bool stopped = false;

    void run() {
      const FrameLines lines(model, play.format == Format::kCsv);
      Clip pose = make_output_clip(model, 1);
      const auto start = Clock::now();
      if (play.with_steering && play.unpaced_)
        while (!input.at_end() && !interrupted()) read_commands(kLongestWaitSecs);
      if (!print(lines.head())) return;
      while (!interrupted() && (play.frames == 0 || frame < play.frames)) {
        if (!play.unpaced_) wait_until(start, static_cast<double>(frame) * model.frame_time_secs());
        obey();
        if (stopped || interrupted() || is_deserted()) return;
        stream.next(pose, 0);
        if (!print(lines.frame(pose, frame, texton_now()))) return;
        ++frame;
      }
    }

    /// Nobody is left who could say stop.
    bool is_deserted() const { return play.with_steering && play.frames == 0 && input.at_end() && waiting.empty(); }

    /// False when nobody reads any more.
    bool print(const std::string& line) const {
      const bool written = std::fwrite(line.data(), 1, line.size(), stdout) == line.size() &&
                           (play.unpaced_ || std::fflush(stdout) == 0);
      if (written) return true;
      if (errno != EPIPE) throw WriteError("standard output does not take the frames; is the disk full?");
      if (std::freopen("/dev/null", "w", stdout) == nullptr) throw WriteError("standard output is closed");
      return false;
    }

    void wait_until(Clock::time_point start, double at_secs) {
      for (;;) {
        const double left = at_secs - std::chrono::duration<double>(Clock::now() - start).count();
        if (play.with_steering)
          read_commands(std::clamp(left, 0.0, kLongestWaitSecs));
        else if (left > 0)
          LineInput::sleep(std::min(left, kLongestWaitSecs));
        if (left <= 0.0005 || interrupted()) return;
      }
    }

    void read_commands(double wait_secs) {
      input.wait(wait_secs);
      for (std::string line; input.next(line);) {
        SteerCommand command;
        try {
          if (parser.parse(line, command)) waiting.push_back(command);
        } catch (const InvalidInput& error) {
          session.say(std::string("not understood: ") + error.what());
        }
      }
    }

    void obey() {
      while (!waiting.empty() && waiting.front().frame <= frame && !stopped) {
        const SteerCommand& command = waiting.front();
        if (command.kind == SteerCommand::Kind::kStop) stopped = true;
        if (command.kind == SteerCommand::Kind::kTexton) stream.request(command.texton);
        if (command.kind == SteerCommand::Kind::kSteer) stream.steer(command.steering);
        waiting.pop_front();
      }
    }

    int texton_now() {
      for (const PlayedTexton& played : stream.take_played()) textons.push_back(played);
      while (textons.size() > 1 && textons[1].start <= frame) textons.pop_front();
      return textons.empty() ? -1 : textons.front().texton;
    }
  };

  std::string format_text_;
  bool unpaced_ = false;
};

}  // namespace

Command motion_play() {
  return make_command<Play>(
      {"motion play", "stream an endless dance, frame by frame, steered while it plays",
       "Frames come in real time as lines of JSON or CSV (docs/formats.md). Angles are in degrees about the vertical: "
       "0 "
       "is +Z, 90 is +X. '@120 direction 90' waits for frame 120. It ends at stop, at the end of the commands, when "
       "nobody reads any more, or at Ctrl-C.",
       "motex motion play dance.motex --secs 10 --format csv\n"
       "printf 'direction 90\\n@300 speed 0.5\\n@600 stop\\n' | motex motion play dance.motex --steer --no-pacing\n"
       "my_controller | motex motion play dance.motex --steer | my_engine"});
}

}  // namespace motex::cli
