// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "closest.h"
#include "commands.h"
#include "motex/core/csv.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/motifs.h"
#include "motex/people/paper_motifs.h"
#include "motex/people/signals.h"
#include "motex/project/motif_pictures.h"
#include "motex/project/series_csv.h"
#include "options_value.h"
#include "output_file.h"
#include "people_alphabet.h"
#include "people_motifs_footage.h"
#include "people_motifs_paper.h"

namespace motex::cli {
namespace {

std::string profile_csv(const MatrixProfile& profile) {
  std::string text = "start,distance,nearest\n";
  for (std::size_t k = 0; k < profile.distance.size(); ++k) {
    text += std::to_string(k) + ',';
    append_number(text, profile.distance[k]);
    text += ',' + std::to_string(profile.nearest[k]) + '\n';
  }
  return text;
}

/// The signal that is drawn and that --paper looks at: the aspect ratio, else the first.
Signal main_signal(const SeriesTable& table) {
  const auto aspect = std::find(table.names.begin(), table.names.end(), "aspect");
  const auto column = aspect == table.names.end() ? 0 : aspect - table.names.begin();
  const Vector values = table.values.col(column);
  return {table.names[static_cast<std::size_t>(column)], "", {values.begin(), values.end()}};
}

struct Motifs {
  std::string input, profile_path;
  std::vector<std::string> columns;
  MotifRequest request;
  FootageMotifs footage;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO|MODEL|SERIES",
                         "footage of a fixed camera, a model (.motex), or a table of numbers (.csv), a frame a line, a "
                         "signal a column, heading optional",
                         input);
    arguments.value("--column", "NAME", "use this column (name, or number from 1); may be repeated (default: all)",
                    columns);
    arguments.value("--profile", "CSV", "write the exact matrix profile: start, distance, nearest", profile_path);
    arguments.value("--fps", "RATE", "frames a second of the series (default 30)", request.options.frames_per_sec);
    arguments.toggle("--paper", "as the paper: random projection of one signal, windows of 40, 80 and 160 frames",
                     request.paper);
    arguments.value("--picture", "FILE",
                    "draw two occurrences of each motif as curves, of footage the alphabet and film strips too, with "
                    "--paper the collision matrix (.png or .svg); may be given several times",
                    request.pictures);
    arguments.section("Finding motifs");
    arguments.options(request.options);
    footage.source.declare_keying(arguments);
  }

  void run(Session& session) {
    check_options(request.options);
    if (is_series_file(input)) return run_series(session);
    if (!profile_path.empty() || !columns.empty())
      throw InvalidInput("--profile and --column go with a SERIES (.csv); motex people signals writes one");
    footage.run(input, request, session);
  }

 private:
  void run_series(Session& session) const {
    const FindMotifsOptions& options = request.options;
    std::vector<std::string> outputs = request.pictures;
    check_outputs(outputs, {".png", ".svg"}, session);
    if (!profile_path.empty()) {
      check_output(profile_path, {".csv"}, session);
      outputs.push_back(profile_path);
    }
    if (!(options.frames_per_sec > 0 && options.frames_per_sec <= 1e4))
      throw InvalidInput("--fps: frames a second, above 0");
    const SeriesTable table = parse_series_csv(read_file(input), input, columns);
    if (session.flags.dry_run) return would_write(outputs, table.values.rows(), session);
    Value object;
    object["input"] = input;
    object["frames"] = static_cast<std::int64_t>(table.values.rows());
    object["signals"] = table.names;
    MotifReport report;
    std::vector<PaperSearch> searches;
    const JobContext job = session.job(0, outputs.empty() ? 1 : 0.9);
    if (request.paper) {
      PaperMotifReport found = paper_motifs(table, object, job);
      report = {std::move(found.set), std::move(found.candidates), {}};
      searches = std::move(found.searches);
      say_searches(searches, session);
    } else {
      report = find_motifs(table.values, options, {}, job);
    }
    write_pictures(table, report.set, searches, session);
    if (!profile_path.empty()) write_profile(table.values, report, object, session);
    object["motifs"] = motifs_value(report.set);
    object["idle"] = spans_value(report.set.idle);
    object["candidates"] = candidates_value(report.candidates);
    if (request.paper) object["searches"] = searches_value(searches);
    object["options"] = options_value(options);
    session.result(object, alphabet_text(report.set, report.candidates, 0));
  }

  PaperMotifReport paper_motifs(const SeriesTable& table, Value& object, const JobContext& job) const {
    const Signal signal = main_signal(table);
    object["signal"] = signal.name;
    try {
      return find_paper_motifs(Eigen::Map<const Vector>(signal.values.data(), table.values.rows()), request.options, {},
                               job);
    } catch (const InvalidInput& error) {
      throw InvalidInput(input + ": " + error.what());
    }
  }

  void write_pictures(const SeriesTable& table, const MotifSet& set, const std::vector<PaperSearch>& searches,
                      Session& session) const {
    if (request.pictures.empty()) return;
    if (set.motifs.empty() && searches.empty())
      return session.warn("nothing repeats, so " + enumerate(request.pictures) + " is not written");
    const Drawing drawing = draw_series_page(set, main_signal(table), searches);
    for (const std::string& picture : request.pictures) write_picture(picture, drawing);
    session.say("wrote " + enumerate(request.pictures));
  }

  void write_profile(const FrameMatrix& series, const MotifReport& report, Value& object, Session& session) const {
    int window = request.options.window;
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
       "motex people motifs aspect.csv --paper --picture collisions.png\n"
       "motex people motifs signals.csv --column aspect --window 80 --profile profile.csv --json"});
}

}  // namespace motex::cli
