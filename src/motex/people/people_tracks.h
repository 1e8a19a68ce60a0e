// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/silhouette.h"
#include "motex/people/silhouette_parts.h"
#include "motex/people/sprite.h"

namespace motex {

/// One person of a frame.
struct TrackedPerson {
  int track = 0;  ///< the same number while the person is followed, from 0 in the order of appearance
  Sprite sprite;
  Silhouette silhouette;
};

/// Why a track begins or ends in the middle of footage.
struct TrackEvent {
  enum class Kind { kTouched, kParted };
  Kind kind = Kind::kTouched;
  int frame = 0;    ///< the first in which it is so
  int first = -1;   ///< track that ends there
  int second = -1;  ///< the other that ends (kTouched), −1 for kParted
};

/// Tells apart several people who stand apart from one another in the frames of one shot.
///
/// Connected parts of the matte with at least 15 % of the area of the largest are people, save that parts one above the
/// other (half of the narrower one's columns) are one person; smaller parts, hands and props, belong to the nearest.
/// From frame to frame people are paired by the distance of their centroids, at most 0.6 body heights, nearest first.
/// Where two people become one part, both tracks end, and nobody is followed there until they have been apart for five
/// frames: kTouched. Where one who was followed falls into two for as long, that track ends and two begin: kParted. A
/// track ends when nobody was seen for five frames.
class PeopleTracker {
 public:
  /// Who is in the next frame; from the left. Memory of `people` is used again.
  void add(const Sprite& frame, std::vector<TrackedPerson>& people);
  const std::vector<TrackEvent>& events() const { return events_; }
  int num_tracks() const { return num_tracks_; }

 private:
  struct Group {  // parts that are one person
    BoundingBox box;
    double area = 0, x = 0, y = 0;
    int track = -1;  // index in tracks_
  };
  struct Track {
    int number = -1;  // −1: several people in one part
    Group last;
    int unseen = 0, apart = 0;
  };
  void find_groups();
  void attach_small_parts();
  void pair_with_tracks();
  void end_those_who_touch();
  void place_the_rest();
  bool part_if_long_apart(std::size_t track, std::size_t first, std::size_t second);
  void follow();
  void cut_out(const Sprite& frame, std::vector<TrackedPerson>& people);

  SilhouetteParts parts_, scratch_;
  std::vector<int> group_of_part_;
  std::vector<Group> groups_;
  std::vector<Track> tracks_;
  std::vector<TrackEvent> events_;
  std::vector<short> labels_;
  int frame_ = 0, num_tracks_ = 0;
};

}  // namespace motex
