// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/people_footage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/people/people_tracks.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

constexpr double kShortestTakeSecs = 0.5;
constexpr double kShareOfShots = 0.3;  // of the time: the first pass hardly does more than decode

std::string frame_list(const std::vector<int>& frames) {
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t k = 0; k < std::min(kMost, frames.size()); ++k)
    out += (k == 0 ? "" : ", ") + std::to_string(frames[k]);
  return frames.size() > kMost ? out + ", …" : out;
}

/// Reads one shot into takes, one a track.
class ShotOfPeople {
 public:
  ShotOfPeople(const std::string& source, const TakeSink& sink, int first_track)
      : source_(source), sink_(sink), first_track_(first_track) {}

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

/// Reads a video shot by shot.
class FootageOfPeople {
 public:
  FootageOfPeople(const std::string& source, const TakeSink& sink, int shortest, PeopleFootage& footage)
      : source_(source), sink_(sink), shortest_(shortest), footage_(footage) {}

  void add(const KeyedFrame& frame) {
    if (!shot_ || frame.shot != idx_) {
      finish_shot();
      idx_ = frame.shot;
      start_ = static_cast<int>(frame.idx);
      shot_.emplace(source_, sink_, num_tracks_);
    }
    shot_->add(frame.sprite, static_cast<int>(frame.idx));
  }

  void finish_shot() {
    if (!shot_) return;
    num_tracks_ += shot_->num_tracks();
    for (const TrackEvent& event : shot_->events())
      (event.kind == TrackEvent::Kind::kTouched ? notes.touched : notes.parted).push_back(start_ + event.frame);
    std::vector<FilmedTake> takes = shot_->finish(shortest_, notes.num_short);
    leave_out_things(takes, notes.num_things);
    for (std::size_t k = 0; k < takes.size(); ++k) {
      takes[k].take.person = static_cast<int>(k);
      footage_.takes.push_back(std::move(takes[k]));
    }
    shot_.reset();
  }

  Notes notes;

 private:
  std::string source_;
  const TakeSink& sink_;
  int shortest_, idx_ = 0, start_ = 0, num_tracks_ = 0;
  std::optional<ShotOfPeople> shot_;
  PeopleFootage& footage_;
};

void check_length(const std::string& name, int num_frames, int shortest) {
  if (num_frames < shortest)
    throw InvalidInput(name + ": has " + std::to_string(num_frames) + " frames; " + std::to_string(shortest) +
                       " at least (half a second) are needed");
}

}  // namespace

PeopleFootage read_people_footage(const std::filesystem::path& video, const PeopleFootageOptions& options,
                                  const TakeSink& sink, const JobContext& job) {
  const std::string name = video.string();
  PeopleFootage footage;
  int shortest = 0;
  {
    VideoReader reader(video, {}, job);
    const VideoInfo& info = reader.info();
    footage.width = info.width, footage.height = info.height;
    footage.frames_per_sec = info.frames_per_sec > 0 ? info.frames_per_sec : 25;
    shortest = std::max(3, static_cast<int>(std::lround(kShortestTakeSecs * footage.frames_per_sec)));
    check_length(name, static_cast<int>(reader.frame_times().size()), shortest);
  }
  KeyFootageOptions key = options.key;
  key.frames = {};
  key.cuts = options.cuts;
  key.shortest_shot = shortest;
  KeyedFootage keyed(video, key, job.part(0, kShareOfShots));
  warn_of_oblong_pixels(keyed.info(), job);
  footage.shots = keyed.shots().shots, footage.flashes = keyed.shots().flashes;
  check_length(name, footage.shots.empty() ? 0 : footage.shots.back().end(), shortest);
  FootageOfPeople people(video.filename().string(), sink, shortest, footage);
  const JobContext rest = job.part(kShareOfShots, 1);
  const double total = footage.shots.back().end();
  for (KeyedFrame frame; keyed.next(frame);) {
    job.check_cancelled();
    rest.progress("keying", static_cast<double>(frame.idx) / total);
    people.add(frame);
  }
  people.finish_shot();
  Notes& notes = people.notes;
  notes.num_short_shots = static_cast<int>(std::count_if(
      footage.shots.begin(), footage.shots.end(), [&](const FrameSpan& shot) { return shot.length < shortest; }));
  if (keyed.plate() != nullptr) footage.plate = keyed.plate()->picture;
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
