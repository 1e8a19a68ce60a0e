// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/learn_people.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

constexpr double kShareOfKeying = 0.8, kShareOfMotifs = 0.1;  // of the time

double now_secs() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string rate_text(double frames_per_sec) {
  char word[32];
  std::snprintf(word, sizeof word, "%.6g", frames_per_sec);
  return word;
}

void check_fits(const PeopleTexture& texture, const PeopleFootage& footage, const std::filesystem::path& first,
                const std::filesystem::path& video) {
  const bool same_size = footage.width == texture.width && footage.height == texture.height;
  const bool same_rate = std::abs(footage.frames_per_sec / texture.frames_per_sec - 1) < 0.01;
  if (same_size && same_rate) return;
  const auto shape = [](int width, int height, double rate) {
    return std::to_string(width) + " × " + std::to_string(height) + " at " + rate_text(rate) + " frames a second";
  };
  throw InvalidInput(
      video.string() + ": is " + shape(footage.width, footage.height, footage.frames_per_sec) + " and " +
      first.string() + " " + shape(texture.width, texture.height, texture.frames_per_sec) +
      "; clips of one model must agree: convert one (ffmpeg -i IN -vf scale=" + std::to_string(texture.width) + ":" +
      std::to_string(texture.height) + " -r " + rate_text(texture.frames_per_sec) + " OUT) or learn two models");
}

/// Reads one clip; its takes are stored while they are keyed and added to the model.
LearnPeopleReport::Clip add_clip(const std::filesystem::path& video, const std::filesystem::path& first,
                                 const PeopleFootageOptions& options, bool lossless, PeopleModel& model,
                                 const JobContext& job) {
  double rate = VideoReader(video, {}, job).info().frames_per_sec;
  if (!(rate > 0)) rate = 25;
  std::map<int, TakeFilmWriter> writers;
  const auto store = [&](int track, int, const Sprite& sprite) {
    writers.try_emplace(track, rate, lossless, job).first->second.add(sprite);
  };
  const PeopleFootage footage = read_people_footage(video, options, store, job);
  PeopleTexture& texture = model.texture;
  if (texture.takes.empty())
    texture.width = footage.width, texture.height = footage.height, texture.frames_per_sec = footage.frames_per_sec;
  check_fits(texture, footage, first, video);
  if (model.plate.pixels.empty()) model.plate = footage.plate;
  LearnPeopleReport::Clip clip{video, footage.shots.back().end(), static_cast<int>(footage.shots.size()),
                               static_cast<int>(footage.takes.size())};
  const int start = texture.num_frames();
  for (const FilmedTake& filmed : footage.takes) {
    Take take = filmed.take;
    take.frames.start += start;
    model.originals.push_back(static_cast<int>(texture.takes.size()));
    texture.takes.push_back(take);
    texture.silhouettes.insert(texture.silhouettes.end(), filmed.silhouettes.begin(), filmed.silhouettes.end());
    model.films.push_back(writers.at(filmed.track).finish());
  }
  return clip;
}

}  // namespace

void add_mirrored_takes(PeopleModel& model) {
  PeopleTexture& texture = model.texture;
  const std::vector<Take> takes = texture.takes;
  for (const Take& one : takes) {
    if (one.mirrored) continue;
    Take take = one;
    take.mirrored = true;
    take.frames.start = texture.num_frames();
    for (int frame = one.frames.start; frame < one.frames.end(); ++frame) {
      const Silhouette turned = mirrored(texture.silhouettes[static_cast<std::size_t>(frame)], texture.width);
      texture.silhouettes.push_back(turned);
    }
    texture.takes.push_back(take);
    model.films.emplace_back();
  }
  model.originals = original_takes(texture);
}

LearnedPeople learn_people(const std::vector<std::filesystem::path>& videos, const PeopleFootageOptions& footage,
                           const FindMotifsOptions& motifs, const FindCutsOptions& cuts,
                           const LearnPeopleOptions& options, const JobContext& job) {
  check_options(options);
  check_options(motifs);
  check_options(cuts);
  if (videos.empty()) throw InvalidInput("nothing to learn from: name a video");
  LearnedPeople out;
  LearnPeopleReport& report = out.report;
  PeopleModel& model = out.model;
  double begun = now_secs();
  const auto lap = [&begun] {
    const double before = begun;
    return (begun = now_secs()) - before;
  };
  for (std::size_t k = 0; k < videos.size(); ++k) {
    const auto share = [&](std::size_t done) {
      return kShareOfKeying * static_cast<double>(done) / static_cast<double>(videos.size());
    };
    report.clips.push_back(
        add_clip(videos[k], videos[0], footage, options.lossless, model, job.part(share(k), share(k + 1))));
  }
  report.footage_secs = model.texture.num_frames() / model.texture.frames_per_sec;
  report.keying_secs = lap();
  if (options.mirror) add_mirrored_takes(model);
  MotifReport found =
      find_footage_motifs(model.texture, motifs, job.part(kShareOfKeying, kShareOfKeying + kShareOfMotifs));
  model.texture.alphabet = std::move(found.set);
  report.candidates = std::move(found.candidates);
  report.motif_secs = lap();
  if (options.cuts) {
    StoredFootage stored(model);
    const JobContext rest = job.part(kShareOfKeying + kShareOfMotifs, 1);
    const ComparableFrames frames = comparable_frames(model.texture, stored, rest.part(0, 0.7));
    model.texture.cuts = find_cuts(model.texture, frames, cuts, rest.part(0.7, 1)).cuts;
  }
  report.cut_secs = lap();
  return out;
}

}  // namespace motex
