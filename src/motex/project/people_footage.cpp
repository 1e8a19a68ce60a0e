// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/people_footage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/people/people_tracks.h"
#include "motex/people/shots.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

constexpr double kShortestTakeSecs = 0.5;
constexpr double kShareOfShots = 0.3;  // of the time: the first pass only decodes

std::string frame_list(const std::vector<int>& frames) {
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t k = 0; k < std::min(kMost, frames.size()); ++k)
    out += (k == 0 ? "" : ", ") + std::to_string(frames[k]);
  return frames.size() > kMost ? out + ", …" : out;
}

ShotReport find_shots(const std::filesystem::path& video, const JobContext& job) {
  VideoReader reader(video, {}, job);
  const VideoInfo& info = reader.info();
  ShotFinder finder(info.frames_per_sec > 0 ? info.frames_per_sec : 25);
  const auto expected = static_cast<double>(std::max<std::int64_t>(1, info.num_frames_said));
  for (VideoFrame frame; reader.next(frame);) {
    job.check_cancelled();
    job.progress("looking for cuts", static_cast<double>(frame.idx) / expected);
    finder.add(frame.image);
  }
  return finder.finish();
}

ShotReport whole(const std::filesystem::path& video) {
  ShotReport report;
  const auto num_frames = static_cast<int>(VideoReader(video).frame_times().size());
  if (num_frames > 0) report.shots.push_back({0, num_frames});
  return report;
}

/// Reads one shot into takes, one a track.
class ShotOfPeople {
 public:
  ShotOfPeople(const std::string& source, const FrameSpan& shot, const TakeSink& sink, int first_track)
      : source_(source), shot_(shot), sink_(sink), first_track_(first_track) {}

  void add(const Sprite& sprite, int frame) {
    tracker_.add(sprite, people_);
    for (const TrackedPerson& person : people_) {
      FilmedTake& take = take_of(person.track, frame);
      const int gap = frame - take.take.source_start - static_cast<int>(take.silhouettes.size());
      for (int k = gap; k > 0; --k) put(take, frame - k, {}, {});
      put(take, frame, person.sprite, person.silhouette);
    }
  }
  const std::vector<TrackEvent>& events() const { return tracker_.events(); }
  int num_tracks() const { return static_cast<int>(takes_.size()); }

  /// Long enough, from the left.
  std::vector<FilmedTake> finish(int shortest, int& num_short) {
    std::vector<FilmedTake> kept;
    for (FilmedTake& take : takes_) {
      const bool is_long = static_cast<int>(take.silhouettes.size()) >= shortest;
      num_short += is_long ? 0 : 1;
      if (is_long) kept.push_back(std::move(take));
    }
    std::stable_sort(kept.begin(), kept.end(), [](const FilmedTake& a, const FilmedTake& b) {
      return a.silhouettes[0].centroid_x < b.silhouettes[0].centroid_x;
    });
    return kept;
  }

 private:
  FilmedTake& take_of(int track, int frame) {
    while (static_cast<int>(takes_.size()) <= track) {
      FilmedTake take;
      take.track = first_track_ + static_cast<int>(takes_.size());
      take.take.source = source_;
      take.take.source_start = frame;
      takes_.push_back(std::move(take));
    }
    return takes_[static_cast<std::size_t>(track)];
  }
  void put(FilmedTake& take, int frame, const Sprite& sprite, const Silhouette& silhouette) {
    take.silhouettes.push_back(silhouette);
    if (sink_) sink_(take.track, frame, sprite);
  }

  std::string source_;
  FrameSpan shot_;
  const TakeSink& sink_;
  int first_track_;
  PeopleTracker tracker_;
  std::vector<TrackedPerson> people_;
  std::vector<FilmedTake> takes_;
};

double spread_of(const FilmedTake& take, double Silhouette::*value) {
  double sum = 0, squares = 0, count = 0;
  for (const Silhouette& one : take.silhouettes) {
    if (one.empty()) continue;
    sum += one.*value, squares += one.*value * (one.*value), count += 1;
  }
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

/// A logo, a chair: moves less than somebody who stands still.
bool is_thing(const FilmedTake& take) {
  constexpr double kStill = 0.002;  // of the size, and of the area
  const double area = take.silhouettes[0].area, size = kStill * std::sqrt(area);
  return spread_of(take, &Silhouette::centroid_x) < size && spread_of(take, &Silhouette::centroid_y) < size &&
         spread_of(take, &Silhouette::area) < kStill * area;
}

/// Leaves out what never moves, if somebody does.
void leave_out_things(std::vector<FilmedTake>& takes, int& num_things) {
  if (std::all_of(takes.begin(), takes.end(), is_thing)) return;
  num_things += static_cast<int>(std::erase_if(takes, is_thing));
}

/// What is worth telling about the footage.
struct Notes {
  std::vector<int> touched, parted;
  int num_short = 0, num_short_shots = 0, num_things = 0;

  void tell(const std::string& name, const PeopleFootage& footage, const JobContext& job) const {
    std::vector<int> cuts, lights;
    for (std::size_t k = 1; k < footage.shots.size(); ++k) cuts.push_back(footage.shots[k].start);
    for (const FrameSpan& flash : footage.flashes) lights.push_back(flash.start);
    if (!cuts.empty())
      job.warn(name + ": is cut at frame " + frame_list(cuts) + "; actions are not looked for across cuts");
    if (!lights.empty()) job.warn(name + ": flashes at frame " + frame_list(lights));
    if (!touched.empty())
      job.warn(name + ": people overlap from frame " + frame_list(touched) +
               " on; their takes end there and others begin when they are apart again");
    if (!parted.empty())
      job.warn(name + ": what looked like one person is two from frame " + frame_list(parted) + " on");
    if (num_short + num_short_shots > 0)
      job.warn(name + ": " + std::to_string(num_short + num_short_shots) +
               " views of less than half a second are left out");
    if (num_things > 0)
      job.warn(name + ": " + std::to_string(num_things) +
               " things that never move are left out; a --garbage-mask helps");
  }
};

void key_shot(const std::filesystem::path& video, const FrameSpan& shot, KeyFootageOptions options,
              const TakeSink& sink, int shortest, PeopleFootage& footage, Notes& notes, int& num_tracks,
              const JobContext& job) {
  options.frames = shot;
  KeyedFootage keyed(video, options, job);
  if (footage.plate.pixels.empty() && keyed.plate() != nullptr) footage.plate = keyed.plate()->picture;
  ShotOfPeople people(video.filename().string(), shot, sink, num_tracks);
  for (KeyedFrame frame; keyed.next(frame);) {
    job.check_cancelled();
    job.progress("keying", static_cast<double>(frame.idx - shot.start) / shot.length);
    people.add(frame.sprite, static_cast<int>(frame.idx));
  }
  num_tracks += people.num_tracks();
  for (const TrackEvent& event : people.events())
    (event.kind == TrackEvent::Kind::kTouched ? notes.touched : notes.parted).push_back(shot.start + event.frame);
  std::vector<FilmedTake> takes = people.finish(shortest, notes.num_short);
  leave_out_things(takes, notes.num_things);
  for (std::size_t k = 0; k < takes.size(); ++k) {
    takes[k].take.person = static_cast<int>(k);
    footage.takes.push_back(std::move(takes[k]));
  }
}

}  // namespace

PeopleFootage read_people_footage(const std::filesystem::path& video, const PeopleFootageOptions& options,
                                  const TakeSink& sink, const JobContext& job) {
  PeopleFootage footage;
  {
    const VideoInfo info = VideoReader(video, {}, job).info();
    footage.width = info.width, footage.height = info.height;
    footage.frames_per_sec = info.frames_per_sec > 0 ? info.frames_per_sec : 25;
  }
  ShotReport report = options.cuts ? find_shots(video, job.part(0, kShareOfShots)) : whole(video);
  footage.shots = std::move(report.shots), footage.flashes = std::move(report.flashes);
  const int shortest = std::max(3, static_cast<int>(std::lround(kShortestTakeSecs * footage.frames_per_sec)));
  const double total = std::max(1, footage.shots.empty() ? 1 : footage.shots.back().end());
  const int num_frames = footage.shots.empty() ? 0 : footage.shots.back().end();
  if (num_frames < shortest)
    throw InvalidInput(video.string() + ": has " + std::to_string(num_frames) + " frames; " + std::to_string(shortest) +
                       " at least (half a second) are needed");
  Notes notes;
  int num_tracks = 0;
  for (const FrameSpan& shot : footage.shots) {
    if (shot.length < shortest) {
      ++notes.num_short_shots;
      continue;
    }
    const auto place = [&](int frame) { return kShareOfShots + (1 - kShareOfShots) * frame / total; };
    key_shot(video, shot, options.key, sink, shortest, footage, notes, num_tracks,
             job.part(place(shot.start), place(shot.end())));
  }
  const std::string name = video.string();
  if (footage.takes.empty() && !notes.touched.empty())
    throw InvalidInput(name + ": the people in it overlap; film them apart from one another, or one at a time");
  if (footage.takes.empty())
    throw InvalidInput(name + ": nobody is to be seen for half a second before a background that stays as it is");
  notes.tell(name, footage, job);
  int start = 0;
  for (FilmedTake& take : footage.takes) {
    take.take.frames = {start, static_cast<int>(take.silhouettes.size())};
    start = take.take.frames.end();
  }
  return footage;
}

PeopleTexture people_texture_of(const PeopleFootage& footage) {
  PeopleTexture texture;
  texture.width = footage.width, texture.height = footage.height;
  texture.frames_per_sec = footage.frames_per_sec;
  for (const FilmedTake& take : footage.takes) {
    texture.takes.push_back(take.take);
    texture.silhouettes.insert(texture.silhouettes.end(), take.silhouettes.begin(), take.silhouettes.end());
  }
  return texture;
}

}  // namespace motex
