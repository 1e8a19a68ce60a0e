// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/motifs.h"
#include "motex/people/random_projection.h"
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
  bool paper = false;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO|MODEL|SERIES",
                         "footage of a fixed camera, a model (.motex), or a table of numbers (.csv), a frame a line, a "
                         "signal a column, heading optional",
                         input);
    arguments.value("--column", "NAME", "use this column (name, or number from 1); may be repeated (default: all)",
                    columns);
    arguments.value("--profile", "CSV", "write the exact matrix profile: start, distance, nearest", profile_path);
    arguments.value("--fps", "RATE", "frames a second of the series (default 30)", options.frames_per_sec);
    arguments.toggle("--paper", "as the paper: random projection of one signal, windows of 40, 80 and 160 frames",
                     paper);
    arguments.section("Finding motifs");
    arguments.options(options);
    footage.declare(arguments);
  }

  void run(Session& session) {
    if (!is_series_file(input)) {
      if (!profile_path.empty() || !columns.empty() || paper)
        throw InvalidInput("--profile, --column and --paper go with a SERIES (.csv); motex people signals writes one");
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
    Value object;
    MotifReport report;
    if (paper)
      report.set = paper_motifs(table, object, session);
    else
      report = find_motifs(table.values, options, {}, session.job(0, profile_path.empty() ? 1 : 0.9));
    object["input"] = input;
    object["frames"] = static_cast<std::int64_t>(table.values.rows());
    object["signals"] = table.names;
    if (!profile_path.empty()) write_profile(table.values, report, object, session);
    describe(report, object, session);
  }

 private:
  /// Random projection for each of the paper's lengths; the aspect ratio, else the first signal. What was found is told
  /// beside what is exact.
  MotifSet paper_motifs(const SeriesTable& table, Value& object, Session& session) const {
    const auto aspect = std::find(table.names.begin(), table.names.end(), "aspect");
    const Index column = aspect == table.names.end() ? 0 : aspect - table.names.begin();
    std::vector<int> lengths{40, 80, 160};
    if (options.window > 0) lengths = {options.window};
    MotifSet set;
    Value::List searches;
    for (const int window : lengths) {
      if (options.window == 0 && 2 * window > table.values.rows()) continue;
      const SeriesWindows windows = series_windows(table.values.col(column), window);
      RandomProjectionOptions projection;
      projection.radius = options.radius;
      projection.max_motifs = std::min(options.max_motifs, 10);
      const RandomProjectionReport found = random_projection_motifs(windows, projection, session.job());
      const MatrixProfile profile = matrix_profile(windows, window - 1, session.job());
      const double exact =
          *std::min_element(profile.distance.begin(), profile.distance.end()) / std::sqrt(static_cast<double>(window));
      Value search;
      search["window"] = window;
      search["distance_found"] = found.in_matrix.distance;
      search["distance_exact"] = exact;
      search["found_over_exact"] = found.in_matrix.distance / exact;
      search["radius"] = found.radius;
      search["collisions"] = static_cast<std::int64_t>(found.collisions.back().cells.size());
      searches.push_back(search);
      session.say(std::to_string(window) + " frames: closest pair found " + fixed(found.in_matrix.distance, 4) + ", exact " +
                  fixed(exact, 4) + ", ratio " + fixed(found.in_matrix.distance / exact, 3) + ", R " + fixed(found.radius, 4));
      set.motifs.insert(set.motifs.end(), found.motifs.begin(), found.motifs.end());
    }
    if (searches.empty()) throw InvalidInput(input + ": too short for windows of 40 frames: say a --window");
    std::stable_sort(set.motifs.begin(), set.motifs.end(),
                     [](const Motif& a, const Motif& b) { return a.occurrences.size() > b.occurrences.size(); });
    for (std::size_t k = 0; k < set.motifs.size(); ++k) set.motifs[k].letter = motif_letter(static_cast<int>(k));
    object["searches"] = searches;
    return set;
  }

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
       "z-normalised windows (several signals by one deviation), divided by √window; those of --profile are not "
       "divided, "
       "and windows up to a quarter of the window apart are not compared there. Frames count from 0.",
       "motex people motifs actor.mp4 --picture alphabet.png\n"
       "motex people motifs actor.motex --json\n"
       "motex people motifs aspect.csv\n"
       "motex people motifs aspect.csv --paper --json\n"
       "motex people motifs signals.csv --column aspect --window 80 --profile profile.csv --json"});
}

}  // namespace motex::cli
