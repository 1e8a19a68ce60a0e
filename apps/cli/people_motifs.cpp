// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/motifs.h"
#include "motex/project/series_csv.h"
#include "options_value.h"
#include "output_file.h"
#include "people_motifs_footage.h"
#include "text_table.h"

namespace motex::cli {
namespace {

std::string profile_csv(const MatrixProfile& profile) {
  std::string text = "start,distance,nearest\n";
  char word[40];
  for (std::size_t k = 0; k < profile.distance.size(); ++k) {
    text += std::to_string(k) + ',';
    text.append(word, std::to_chars(word, word + sizeof word, profile.distance[k]).ptr);
    text += ',' + std::to_string(profile.nearest[k]) + '\n';
  }
  return text;
}

Value motif_value(const Motif& motif) {
  std::vector<int> starts, lengths;
  std::vector<double> distances;
  for (const Occurrence& occurrence : motif.occurrences) {
    starts.push_back(occurrence.start);
    lengths.push_back(occurrence.length);
    distances.push_back(occurrence.distance);
  }
  Value value;
  value["letter"] = motif.letter;
  value["window"] = motif.window;
  value["distance"] = motif.distance;
  value["radius"] = motif.radius;
  value["count"] = static_cast<std::int64_t>(starts.size());
  value["exemplar"] = motif.exemplar;
  value["starts"] = starts;
  value["lengths"] = lengths;
  value["distances"] = distances;
  return value;
}

Value idle_value(const std::vector<FrameSpan>& spans) {
  Value::List list;
  for (const FrameSpan& span : spans) {
    Value value;
    value["start"] = span.start;
    value["length"] = span.length;
    list.push_back(value);
  }
  return list;
}

Value candidates_value(const std::vector<MotifCandidate>& candidates) {
  Value::List list;
  for (const MotifCandidate& candidate : candidates) {
    Value value;
    value["window"] = candidate.window;
    value["distance"] = candidate.distance;
    value["count"] = static_cast<std::int64_t>(candidate.starts.size());
    value["starts"] = candidate.starts;
    value["reason"] = candidate.reason;
    list.push_back(value);
  }
  return list;
}

std::string list_of(const std::vector<Occurrence>& occurrences) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, occurrences.size()); ++k)
    text += (k > 0 ? " " : "") + std::to_string(occurrences[k].start);
  return occurrences.size() > kMost ? text + " …" : text;
}

struct Motifs {
  std::string input, profile_path;
  std::vector<std::string> columns;
  FindMotifsOptions options;
  FootageMotifs footage;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO|MODEL|SERIES",
                         "footage of a fixed camera, a model (.motex), or a table of numbers (.csv), a frame a line, a "
                         "signal a column, heading optional",
                         input);
    arguments.value("--column", "NAME", "use this column (name, or number from 1); may be repeated (default: all)",
                    columns);
    arguments.value("--profile", "CSV", "write the exact matrix profile: start, distance, nearest", profile_path);
    arguments.value("--fps", "RATE", "frames a second of the series (default 30)", options.frames_per_sec);
    arguments.section("Finding motifs");
    arguments.options(options);
    footage.declare(arguments);
  }

  void run(Session& session) {
    if (!is_series_file(input)) {
      if (!profile_path.empty() || !columns.empty())
        throw InvalidInput("--profile and --column go with a SERIES (.csv); motex people signals writes one");
      return footage.run(input, options, session);
    }
    if (footage.is_asked_for()) throw InvalidInput("--picture goes with VIDEO|MODEL");
    if (!profile_path.empty()) check_output(profile_path, {".csv"}, session);
    if (!(options.frames_per_sec > 0 && options.frames_per_sec <= 1e4))
      throw InvalidInput("--fps: frames a second, above 0");
    const SeriesTable table = parse_series_csv(read_file(input), input, columns);
    if (session.flags.dry_run)
      return would_write(profile_path.empty() ? std::vector<std::string>{} : std::vector<std::string>{profile_path},
                         table.values.rows(), session);
    const MotifReport report = find_motifs(table.values, options, {}, session.job(0, profile_path.empty() ? 1 : 0.9));
    Value object;
    object["input"] = input;
    object["frames"] = static_cast<std::int64_t>(table.values.rows());
    object["signals"] = table.names;
    if (!profile_path.empty()) write_profile(table.values, report, object, session);
    describe(report, object, session);
  }

 private:
  void write_profile(const FrameMatrix& series, const MotifReport& report, Value& object, Session& session) const {
    int window = options.window;
    if (window == 0 && !report.set.motifs.empty()) window = report.set.motifs[0].window;
    if (window == 0 && !report.windows.empty()) window = report.windows[report.windows.size() / 2];
    if (window == 0) throw InvalidInput("--profile: say a --window of at most half of the series");
    const MatrixProfile profile = matrix_profile(series_windows(series, window), -1, session.job(0.9, 1));
    write_file(profile_path, profile_csv(profile));
    object["profile"] = profile_path;
    object["profile_window"] = window;
    object["profile_exclusion"] = profile.exclusion;
    session.say("wrote " + profile_path);
  }

  void describe(const MotifReport& report, Value& object, Session& session) const {
    Value::List motifs;
    std::vector<std::vector<std::string>> rows{{"motif", "times", "frames", "closest", "R", "begins at"}};
    for (const Motif& motif : report.set.motifs) {
      motifs.push_back(motif_value(motif));
      rows.push_back({motif.letter, std::to_string(motif.occurrences.size()), std::to_string(motif.window),
                      fixed(motif.distance, 3), fixed(motif.radius, 3), list_of(motif.occurrences)});
    }
    object["motifs"] = motifs;
    object["idle"] = idle_value(report.set.idle);
    object["candidates"] = candidates_value(report.candidates);
    object["options"] = options_value(options);
    std::string text = report.set.motifs.empty() ? "nothing repeats more often than by chance\n" : text_table(rows);
    int idle_frames = 0;
    for (const FrameSpan& span : report.set.idle) idle_frames += span.length;
    text += "idle: " + std::to_string(idle_frames) + " frames in " + std::to_string(report.set.idle.size()) +
            " stretches\n";
    for (const MotifCandidate& candidate : report.candidates)
      text += "no motif: " + std::to_string(candidate.starts.size()) + " × " + std::to_string(candidate.window) +
              " frames at " + std::to_string(candidate.starts[0]) + ": " + candidate.reason + "\n";
    session.result(object, text);
  }
};

}  // namespace

Command people_motifs() {
  return make_command<Motifs>(
      {"people motifs", "the actions that repeat in footage, or in a series of measurements",
       "Every length from --min-secs to --max-secs is tried unless --window says one. Distances are Euclidean between "
       "z-normalised windows (root mean square over signals), divided by √window; those of --profile are not divided, "
       "and windows up to a quarter of the window apart are not compared there. Frames count from 0.",
       "motex people motifs actor.mp4 --picture alphabet.png\n"
       "motex people motifs actor.motex --json\n"
       "motex people motifs aspect.csv\n"
       "motex people motifs signals.csv --column aspect --window 80 --profile profile.csv --json"});
}

}  // namespace motex::cli
