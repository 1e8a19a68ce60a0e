// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/learn_people.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/measure_silhouette.h"
#include "motex/people/warp_sprites.h"

namespace motex {
namespace {

constexpr double kShareOfKeying = 0.8, kShareOfMotifs = 0.1;  // of the time

double now_secs() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string rate_text(double frames_per_sec) {
  char word[32];
  std::snprintf(word, sizeof word, "%.6g", frames_per_sec);
  return word;
}

std::string size_text(int width, int height) { return std::to_string(width) + " × " + std::to_string(height); }

void check_rate(const PeopleTexture& texture, double frames_per_sec, const std::filesystem::path& first,
                const std::filesystem::path& video) {
  if (std::abs(frames_per_sec / texture.frames_per_sec - 1) < 0.01) return;
  throw InvalidInput(video.string() + ": has " + rate_text(frames_per_sec) + " frames a second and " + first.string() +
                     " " + rate_text(texture.frames_per_sec) +
                     "; clips of one model must agree: convert one (ffmpeg -i IN -r " +
                     rate_text(texture.frames_per_sec) + " OUT) or learn two models");
}

/// A frame of that size put whole into the middle of the model's.
Placement fitted_whole(const VideoInfo& info, const PeopleTexture& texture) {
  const double across = static_cast<double>(texture.width) / info.width;
  const double scale = std::min(across, static_cast<double>(texture.height) / info.height);
  const auto offset = [&](int to, int from) { return (to - 1) / 2.0 - scale * (from - 1) / 2.0; };
  return {scale, offset(texture.width, info.width), offset(texture.height, info.height)};
}

/// Reads one clip; its takes are stored while they are keyed and added to the model.
LearnPeopleReport::Clip add_clip(const std::filesystem::path& video, const std::filesystem::path& first,
                                 const PeopleFootageOptions& options, bool lossless, PeopleModel& model,
                                 const JobContext& job) {
  const VideoInfo info = VideoReader(video, {}, job).info();
  const double rate = info.frames_per_sec > 0 ? info.frames_per_sec : 25;
  PeopleTexture& texture = model.texture;
  Placement placement;
  if (!texture.takes.empty()) {
    check_rate(texture, rate, first, video);
    placement = fitted_whole(info, texture);
    if (placement != Placement{})
      job.warn(video.string() + ": is " + size_text(info.width, info.height) + " and " + first.string() + " " +
               size_text(texture.width, texture.height) + "; its pictures are scaled by " + rate_text(placement.scale));
  }
  std::map<int, TakeFilmWriter> writers;
  std::map<int, std::vector<Silhouette>> scaled;  // of each track; none where nothing is scaled
  const auto store = [&](int track, int, const Sprite& sprite) {
    TakeFilmWriter& writer = writers.try_emplace(track, rate, lossless, job).first->second;
    if (placement == Placement{}) return writer.add(sprite);
    const Sprite fitted = placed(sprite, placement);
    scaled[track].push_back(measure_silhouette(fitted));
    writer.add(fitted);
  };
  const PeopleFootage footage = read_people_footage(video, options, store, job);
  if (texture.takes.empty())
    texture.width = footage.width, texture.height = footage.height, texture.frames_per_sec = footage.frames_per_sec;
  if (model.plate.pixels.empty()) model.plate = footage.plate;
  LearnPeopleReport::Clip clip{video, footage.shots.back().end(), static_cast<int>(footage.shots.size()),
                               static_cast<int>(footage.takes.size())};
  const int start = texture.num_frames();
  for (const FilmedTake& filmed : footage.takes) {
    Take take = filmed.take;
    take.frames.start += start;
    model.originals.push_back(static_cast<int>(texture.takes.size()));
    texture.takes.push_back(take);
    const std::vector<Silhouette>& seen = scaled.empty() ? filmed.silhouettes : scaled.at(filmed.track);
    texture.silhouettes.insert(texture.silhouettes.end(), seen.begin(), seen.end());
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
