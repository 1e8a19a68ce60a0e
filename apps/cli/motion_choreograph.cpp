// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "clip_beside.h"
#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "model_sources.h"
#include "motex/motion_texture/choreograph.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// "salsa_01@120:300".
ChoreographyRequest::Via parse_via(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || text.find('@') > colon)
    throw InvalidInput("--via: '" + text + "' is not CLIP@FRAME:N");
  std::int64_t frame = 0;
  parse_value("--via", text.substr(colon + 1), frame);
  return {parse_clip_frame("--via", text.substr(0, colon)), frame};
}

/// Finite numbers between commas, `least` to `most` of them.
std::vector<double> parse_numbers(const std::string& flag, const std::string& text, const std::string& form,
                                  std::size_t least, std::size_t most) {
  const std::vector<std::string> words = split_at_commas(text);
  if (words.size() < least || words.size() > most) throw InvalidInput(flag + ": '" + text + "' is not " + form);
  std::vector<double> numbers;
  for (const std::string& word : words) {
    parse_value(flag, word, numbers.emplace_back());
    if (!std::isfinite(numbers.back())) throw InvalidInput(flag + ": '" + text + "' is not finite");
  }
  return numbers;
}

constexpr double kRadians = std::numbers::pi / 180;

/// "x,z,heading", the heading in degrees.
RootPlace parse_place(const std::string& text) {
  const std::vector<double> numbers = parse_numbers("--place", text, "X,Z,HEADING", 3, 3);
  return {numbers[0], numbers[1], numbers[2] * kRadians};
}

/// "300:150,40" or "300:150,40,90", the heading in degrees.
RootTarget parse_at(const std::string& text) {
  const std::string form = "N:X,Z[,HEADING]";
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw InvalidInput("--at: '" + text + "' is not " + form);
  std::int64_t frame = 0;
  parse_value("--at", text.substr(0, colon), frame);
  const std::vector<double> numbers = parse_numbers("--at", text.substr(colon + 1), form, 2, 3);
  RootTarget target{frame, numbers[0], numbers[1], {}};
  if (numbers.size() == 3) target.heading = numbers[2] * kRadians;
  return target;
}

/// "x0,z0,x1,z1".
FloorBox parse_box(const std::string& text) {
  const std::vector<double> numbers = parse_numbers("--avoid", text, "X0,Z0,X1,Z1", 4, 4);
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

/// "LeftHand@200:10,120,30".
LimbTarget parse_reach(const std::string& text) {
  const std::string form = "JOINT@N:X,Y,Z";
  const std::size_t colon = text.rfind(':'), at = text.rfind('@', colon);
  if (colon == std::string::npos || at == std::string::npos || at == 0)
    throw InvalidInput("--reach: '" + text + "' is not " + form);
  std::int64_t frame = 0;
  parse_value("--reach", text.substr(at + 1, colon - at - 1), frame);
  const std::vector<double> numbers = parse_numbers("--reach", text.substr(colon + 1), form, 3, 3);
  return {text.substr(0, at), frame, Vector3(numbers[0], numbers[1], numbers[2])};
}

struct Choreograph {
  std::string model_path, start, end, place;
  std::vector<std::string> outputs, via, at, avoid, reach;
  std::int64_t frames = 0;
  ChoreographyOptions options;
  AdaptClipOptions adapt;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.value("--start", "CLIP@FRAME", "the first two frames are this one and the next", start).required = true;
    arguments.value("--end", "CLIP@FRAME", "the last two frames are the one before and this", end).required = true;
    arguments.value("--frames", "N", "length in frames", frames).required = true;
    declare_clip_outputs(arguments, outputs).required = true;
    arguments.value("--via", "CLIP@FRAME:N", "output frames N and N+1 are this one and the next; may be given again",
                    via);
    arguments.value("--place", "X,Z,HEADING",
                    "where the first frame stands and looks, heading in degrees (default: as in its clip)", place);
    arguments.value("--at", "N:X,Z[,HEADING]",
                    "the root stands there, and looks that way (degrees), at output frame N; may be given again", at);
    arguments.value("--avoid", "X0,Z0,X1,Z1", "a box on the floor that the root goes around; may be given again",
                    avoid);
    arguments.value("--reach", "JOINT@N:X,Y,Z", "that hand or foot is there at output frame N; may be given again",
                    reach);
    arguments.section("How");
    arguments.options(options);
    declare_adapt(arguments, adapt);
  }

  void run(Session& session) {
    const ChoreographyRequest request = parse_request();
    check_clip_outputs(outputs, adapt, session);
    const MotionTexture model = load_motion_texture(model_path);
    if (session.flags.dry_run) {
      corpus_row(model, request.start);
      corpus_row(model, request.end);
      return would_write(outputs, frames, session);
    }
    ChoreographyReport report;
    Clip clip = choreograph(model, request, options, report, session.job(0, 0.9));
    ClipPicture picture;
    picture.title = start + " → " + end;
    picture.spans = spans_of(model, report, clip.num_frames());
    write_clip_outputs(outputs, clip, picture, adapt, session);
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(clip.num_frames()) + " frames, " +
                std::to_string(report.played.size()) + " textons, seed " + std::to_string(options.seed));
    session.result(report_value(model, clip, report, session), table(model, report));
  }

 private:
  ChoreographyRequest parse_request() const {
    ChoreographyRequest request;
    request.start = parse_clip_frame("--start", start);
    request.end = parse_clip_frame("--end", end);
    request.num_frames = frames;
    for (const std::string& text : via) request.via.push_back(parse_via(text));
    for (const std::string& text : at) request.at.push_back(parse_at(text));
    for (const std::string& text : avoid) request.avoid.push_back(parse_box(text));
    for (const std::string& text : reach) request.reach.push_back(parse_reach(text));
    if (!place.empty()) request.place = parse_place(place);
    return request;
  }

  static InstanceSource source_of_played(const MotionTexture& model, const ChoreographedTexton& played) {
    InstanceSource source = source_of(model, played.instance);
    source.start += played.source_row - model.instances[static_cast<std::size_t>(played.instance)].row;
    source.length = played.source_length;
    return source;
  }

  static std::vector<TextonSpan> spans_of(const MotionTexture& model, const ChoreographyReport& report, Index frames) {
    std::vector<TextonSpan> spans;
    for (std::size_t k = 0; k < report.played.size(); ++k) {
      const ChoreographedTexton& played = report.played[k];
      const Index end = k + 1 < report.played.size() ? report.played[k + 1].start : frames;
      const InstanceSource source = source_of_played(model, played);
      spans.push_back({played.texton, played.start, end - played.start,
                       source.clip + ", frames " + std::to_string(source.start) + "–" +
                           std::to_string(source.start + source.length - 1)});
    }
    return spans;
  }

  Value report_value(const MotionTexture& model, const Clip& clip, const ChoreographyReport& report,
                     const Session& session) const {
    Value list = Value::List();
    std::vector<int> textons;
    for (const ChoreographedTexton& played : report.played) {
      const InstanceSource source = source_of_played(model, played);
      textons.push_back(played.texton);
      Value entry;
      entry["texton"] = played.texton;
      entry["instance"] = played.instance;
      entry["output_start"] = std::int64_t{played.start};
      entry["length"] = std::int64_t{played.length};
      entry["clip"] = source.clip;
      entry["start"] = std::int64_t{source.start};
      entry["source_length"] = std::int64_t{source.length};
      entry["first_distance_cm"] = played.first_distance;
      entry["last_distance_cm"] = played.last_distance;
      list.append(std::move(entry));
    }
    Value object;
    object["frames"] = std::int64_t{clip.num_frames()};
    object["frame_rate"] = clip.frame_rate();
    object["seed"] = options.seed;
    object["output"] = outputs;
    object["path"] = textons;
    object["played"] = std::move(list);
    object["log_probability"] = report.log_prob;
    object["cost"] = report.cost;
    object["start_distance_cm"] = report.start_distance;
    object["end_distance_cm"] = report.end_distance;
    if (!at.empty() || !avoid.empty()) object["root_path"] = path_value(report.path);
    if (!reach.empty()) object["reached"] = reached_value(report);
    object["frames_below_floor"] = std::int64_t{report.floor.num_below_after};
    object["options"] = options_value(options);
    object["secs"] = session.secs();
    return object;
  }

  static Value path_value(const BendPathReport& path) {
    Value object;
    object["cost"] = path.cost;
    object["largest_turn_degrees"] = path.largest_turn / kRadians;
    object["largest_shift"] = path.largest_shift;
    object["way_ratio"] = path.way;
    if (std::isfinite(path.clearance)) object["clearance"] = path.clearance;
    return object;
  }

  Value reached_value(const ChoreographyReport& report) const {
    Value list = Value::List();
    for (std::size_t k = 0; k < reach.size(); ++k) {
      Value entry;
      entry["target"] = reach[k];
      entry["distance_before"] = report.reached[k].distance_before;
      entry["distance_after"] = report.reached[k].distance_after;
      list.append(std::move(entry));
    }
    return list;
  }

  static std::string table(const MotionTexture& model, const ChoreographyReport& report) {
    std::vector<std::vector<std::string>> rows{
        {"frames", "texton", "example", "its frames", "bent at the start, cm", "at the end, cm"}};
    for (const ChoreographedTexton& played : report.played) {
      const InstanceSource source = source_of_played(model, played);
      rows.push_back({std::to_string(played.start) + "–" + std::to_string(played.start + played.length - 1),
                      std::to_string(played.texton), source.clip,
                      std::to_string(source.start) + "–" + std::to_string(source.start + source.length - 1),
                      fixed(played.first_distance, 1), fixed(played.last_distance, 1)});
    }
    return text_table(rows);
  }
};

}  // namespace

Command motion_choreograph() {
  return make_command<Choreograph>(
      {"motion choreograph", "a dance from pose to pose in so many frames",
       "Poses are frames of the clips that the model was learned from; CLIP is named as motex motion info lists it, "
       "frames "
       "count from 0. Which examples are played, and how long each, is chosen together, so that the length is exact.",
       "motex motion choreograph dance.motex --start salsa_01@100 --end salsa_05@200 --frames 320 -o new.bvh\n"
       "motex motion choreograph dance.motex --start a@10 --via b@50:200 --end a@400 --frames 500 -o new.glb\n"
       "motex motion choreograph dance.motex --start a@10 --end a@400 --frames 500 --place 0,0,0 --at 499:150,200,90 "
       "--avoid 50,50,80,120 --reach LeftHand@250:80,140,100 -o new.bvh"});
}

}  // namespace motex::cli
