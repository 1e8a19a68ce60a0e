// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "commands.h"
#include "motex/core/csv.h"
#include "motex/core/files.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/explain.h"
#include "motex/particles/learn.h"
#include "motex/particles/traits.h"
#include "motex/project/abnormality_figure.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/textured_motion_file.h"
#include "output_file.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

/// tracks_csv() with one column more.
std::string surprise_csv(const TexturedMotion& observed, const Explanation& explanation) {
  std::string text = "track,frame,x,y,scale,angle,amplitude,surprise\n";
  const std::vector<Track> tracks = tracks_of(observed.cables, observed.num_planes);
  for (std::size_t c = 0; c < tracks.size(); ++c)
    for (std::size_t k = 0; k < tracks[c].points.size(); ++k) {
      const TrackPoint& point = tracks[c].points[k];
      if (point.x < -0.5 || point.y < -0.5 || point.x >= observed.width - 0.5 || point.y >= observed.height - 0.5)
        continue;
      text += std::to_string(tracks[c].id) + "," + std::to_string(point.frame);
      for (const double value :
           {point.x, point.y, point.scale, point.angle, point.amplitude, explanation.surprise[c][k]})
        text += "," + rounded_text(value, 6);
      text += "\n";
    }
  return text;
}

/// How near background + elements come to the clip; the same for every model.
struct ImageLikelihood {
  double psnr = 0, noise = 0, nats_per_pixel = 0;
};

ImageLikelihood image_likelihood(const ClipFrames& clip, const TexturedMotion& observed, const JobContext& job) {
  ImageLikelihood result;
  result.psnr = measure_cables(clip, observed.background, observed.cables, job.jobs).psnr;
  result.noise = std::max(0.3, 255 / std::pow(10, result.psnr / 20));
  result.nats_per_pixel = -0.5 * std::log(2 * std::numbers::pi * std::numbers::e * result.noise * result.noise);
  return result;
}

struct Explain {
  std::vector<std::string> inputs;
  std::string map, tracks;
  LoadVideoClipOptions load;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL… VIDEO",
                         "models learned by `motex particles learn`, then the clip to explain (or a "
                         "model learned from it)",
                         inputs);
    arguments.value("--map", "PNG", "picture of where and when elements are unlikely under the best model (.png, .svg)",
                    map);
    arguments.value("--tracks", "CSV", "the clip's tracks, with the surprise of each point under the best model",
                    tracks);
    arguments.section("Reading the clip");
    arguments.options(load);
  }

  void run(Session& session) {
    if (inputs.size() < 2) throw InvalidInput("name at least one model, and the clip last");
    if (!map.empty()) check_output(map, {".png", ".svg"}, session);
    if (!tracks.empty()) check_output(tracks, {".csv"}, session);
    const std::string video = inputs.back();
    const std::vector<std::string> paths(inputs.begin(), inputs.end() - 1);
    std::vector<TexturedMotion> models;
    for (const std::string& path : paths) models.push_back(load_particles_model(path));
    std::vector<std::string> outputs;
    for (const std::string& path : {map, tracks})
      if (!path.empty()) outputs.push_back(path);
    if (session.flags.dry_run) return would_write(outputs, -1, session);

    Value object;
    object["video"] = video;
    const TexturedMotion observed = observe(video, object, session);
    std::vector<Explanation> explanations;
    for (const TexturedMotion& model : models) {
      session.job().check_cancelled();
      explanations.push_back(explain_cables(model, observed));
    }
    std::vector<std::size_t> order(paths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return explanations[a].total() > explanations[b].total(); });
    const std::size_t best = order[0];
    if (!map.empty())
      write_picture(map, abnormality_figure(observed, explanations[best], video + " under " + paths[best]));
    if (!tracks.empty()) write_file(tracks, surprise_csv(observed, explanations[best]));
    for (const std::string& path : outputs) session.say("wrote " + path);
    report(paths, order, explanations, distances_of(models, observed, paths, object), object, session);
  }

 private:
  TexturedMotion observe(const std::string& video, Value& object, Session& session) const {
    if (extension_of(video) == ".motex") return load_textured_motion(video);
    const ClipFrames clip = load_video_clip(video, load, session.job(0, 0.05));
    LearnTexturedMotionOptions options;
    options.coils = false;
    TexturedMotion observed = learn_textured_motion(clip, options, session.job(0.05, 0.9)).model;
    const ImageLikelihood image = image_likelihood(clip, observed, session.job());
    Value value;
    value["psnr"] = image.psnr;
    value["noise"] = image.noise;
    value["nats_per_pixel"] = image.nats_per_pixel;
    value["nats_per_frame"] = image.nats_per_pixel * clip.width * clip.height;
    object["image"] = std::move(value);
    return observed;
  }

  /// How far each model is from the clip in kind.
  static std::vector<double> distances_of(const std::vector<TexturedMotion>& models, const TexturedMotion& observed,
                                          const std::vector<std::string>& paths, Value& object) {
    const ClipTraits traits = traits_of(observed);
    for (std::size_t k = 0; k < traits.values.size(); ++k)
      object["traits"][name_of(static_cast<Trait>(k))] = traits.values[k];
    std::vector<double> distances;
    for (const TexturedMotion& model : models) distances.push_back(trait_distance(traits, traits_of(model)));
    const auto nearest = std::min_element(distances.begin(), distances.end()) - distances.begin();
    object["nearest_in_kind"] = paths[static_cast<std::size_t>(nearest)];
    return distances;
  }

  static void report(const std::vector<std::string>& paths, const std::vector<std::size_t>& order,
                     const std::vector<Explanation>& explanations, const std::vector<double>& distances, Value& object,
                     Session& session) {
    const Explanation& first = explanations[order[0]];
    object["frames"] = static_cast<std::int64_t>(first.num_frames);
    object["elements"] = static_cast<std::int64_t>(first.surprise.size());
    object["elements_per_frame"] = first.num_elements / std::max(1.0, first.num_frames);
    object["best"] = paths[order[0]];
    const std::vector<double> shares = model_probabilities(explanations);
    std::vector<std::vector<std::string>> rows{
        {"model", "nats an element", "a frame", "behind", "births", "places", "looks", "motion", "deaths", "in kind"}};
    for (const std::size_t k : order) {
      const Explanation& one = explanations[k];
      const double n = std::max(1.0, one.num_elements);
      Value model;
      model["model"] = paths[k];
      model["log_likelihood"] = one.total();
      model["nats_per_element"] = one.per_element();
      model["nats_per_frame"] = one.per_frame();
      model["probability"] = shares[k];
      model["trait_distance"] = distances[k];
      for (const auto& [name, nats] : {std::pair{"births", one.births},
                                       {"places", one.places},
                                       {"looks", one.looks},
                                       {"motion", one.motion},
                                       {"deaths", one.deaths}})
        model[name] = nats;
      object["models"].append(std::move(model));
      rows.push_back({paths[k], fixed(one.per_element(), 3), fixed(one.per_frame(), 1),
                      fixed(first.total() - one.total(), 0), fixed(one.births / n, 2), fixed(one.places / n, 2),
                      fixed(one.looks / n, 2), fixed(one.motion / n, 2), fixed(one.deaths / n, 2),
                      fixed(distances[k], 1)});
    }
    session.result(
        object,
        std::to_string(first.surprise.size()) + " elements in " +
            std::to_string(static_cast<std::int64_t>(first.num_frames)) + " frames\n" + text_table(rows) +
            "nearest in kind: " +
            paths[static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin())]);
  }
};

}  // namespace

Command particles_explain() {
  return make_command<Explain>(
      {"particles explain", "which model a new clip looks like, and what in it does not",
       "The clip's elements are followed once; each model then says how probable they are: how many are born, where, "
       "how they look and move, when they die. Nats are logarithms to base e; the largest sum is the best explanation. "
       "That knows the scale, contrast and wind of the clips learned from; 'in kind' compares what these do not change "
       "(lives, births, straightness, fall, fading, bursts, …): the smallest distance is the nearest kind of motion.",
       "motex particles explain snow.motex rain.motex birds.motex new.mp4\n"
       "motex particles explain snow.motex new.mp4 --map odd.png --tracks odd.csv\n"
       "motex particles explain snow.motex birds.motex new.mp4 --num-frames 60 --json"});
}

}  // namespace motex::cli
