// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "motex/core/files.h"
#include "motex/particles/track_score.h"
#include "motex/project/track_csv.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Score {
  std::string truth_path, tracks_path, size_text;
  double gate = 5;

  void declare(Arguments& arguments) {
    arguments.value("--truth", "CSV", "true tracks: columns frame, id (or track), x, y, …", truth_path).required = true;
    arguments.value("--tracks", "CSV", "tracks to score, the same columns", tracks_path).required = true;
    arguments.value("--gate", "PX", "distance at which a point counts as missed (default 5)", gate);
    arguments.value("--size", "WxH", "of the picture: points outside it are left out of both", size_text);
  }

  void run(Session& session) {
    const auto [width, height] = size_text.empty() ? std::pair(0, 0) : parse_picture_size(size_text);
    if (!(gate > 0 && gate < 1e6)) throw InvalidInput("--gate: a distance above 0 pixels");
    const auto read = [&, w = width, h = height](const std::string& path) {
      return visible_part(parse_tracks_csv(read_file(path), path), w, h);
    };
    const std::vector<Track> truth = read(truth_path);
    if (truth.empty()) throw InvalidInput(truth_path + ": has no visible point");
    const TrackingScore score = score_tracks(truth, read(tracks_path), gate);
    Value object;
    object["alpha"] = score.alpha;
    object["beta"] = score.beta;
    object["jsc"] = score.jsc;
    object["jsc_tracks"] = score.jsc_tracks;
    object["rmse"] = score.rmse;
    object["true_tracks"] = score.num_true;
    object["tracks"] = score.num_estimated;
    object["pairs"] = score.num_pairs;
    session.result(object, text_pairs({{"alpha", fixed(score.alpha, 4)},
                                       {"beta", fixed(score.beta, 4)},
                                       {"JSC of points", fixed(score.jsc, 4)},
                                       {"JSC of tracks", fixed(score.jsc_tracks, 4)},
                                       {"RMSE px", fixed(score.rmse, 3)},
                                       {"true tracks", std::to_string(score.num_true)},
                                       {"tracks", std::to_string(score.num_estimated)},
                                       {"pairs", std::to_string(score.num_pairs)}}));
  }
};

}  // namespace

Command particles_score() {
  return make_command<Score>(
      {"particles score", "how near tracks come to the true ones (measures of the particle tracking challenge)",
       "beta is the primary measure: 1 = the truth, 0 = nothing found. Points of amplitude 0 are left out of both.",
       "motex particles score --truth snow_gt.csv --tracks snow.tracks.csv --size 320x240\n"
       "motex particles score --truth snow_gt.csv --tracks snow.tracks.csv --gate 3 --json"});
}

}  // namespace motex::cli
