// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/people_tracks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "motex/people/measure_silhouette.h"

namespace motex {
namespace {

constexpr double kPersonShare = 0.15;   // of the largest part's area
constexpr double kStackedShare = 0.5;   // of the narrower one's columns
constexpr double kLongestStep = 0.6;    // body heights a frame
constexpr double kNearShare = 0.25;     // gap in body heights that a part of a person may have
constexpr double kTouchedGrowth = 1.3;  // of the area when two become one
constexpr int kPatience = 5;            // frames

int overlap(int first_a, int last_a, int first_b, int last_b) {
  return std::min(last_a, last_b) - std::max(first_a, first_b) + 1;
}

double gap(const BoundingBox& a, const BoundingBox& b) {
  const int dx = std::max(0, -overlap(a.left, a.right, b.left, b.right) + 1);
  const int dy = std::max(0, -overlap(a.top, a.bottom, b.top, b.bottom) + 1);
  return std::hypot(dx, dy);
}

BoundingBox both(const BoundingBox& a, const BoundingBox& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

/// The pixels with that label, in the smallest rectangle.
Sprite labelled(const Sprite& frame, const std::vector<short>& labels, short label) {
  const auto stride = static_cast<std::size_t>(frame.width);
  BoundingBox box{frame.width, frame.height, -1, -1};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != label) continue;
    const int x = static_cast<int>(i % stride), y = static_cast<int>(i / stride);
    box = both(box, {x, y, x, y});
  }
  Sprite out;
  if (box.empty()) return out;
  out.left = frame.left + box.left, out.top = frame.top + box.top, out.width = box.width(), out.height = box.height();
  out.pixels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const std::size_t from = static_cast<std::size_t>(box.top + y) * stride + static_cast<std::size_t>(box.left + x);
      if (labels[from] == label) out.at(x, y) = frame.pixels[from];
    }
  return out;
}

}  // namespace

void PeopleTracker::find_groups() {
  groups_.clear();
  group_of_part_.assign(parts_.parts.size(), -1);
  for (std::size_t part = 0; part < parts_.parts.size(); ++part) {
    const SilhouettePart& one = parts_.parts[part];
    if (static_cast<double>(one.area) < kPersonShare * static_cast<double>(parts_.largest_area)) continue;
    group_of_part_[part] = static_cast<int>(groups_.size());
    groups_.push_back({one.box, 0, 0, 0, -1});
  }
  for (std::size_t a = 0; a < groups_.size(); ++a) {
    for (std::size_t b = a + 1; b < groups_.size();) {
      const BoundingBox &one = groups_[a].box, &other = groups_[b].box;
      const int columns = overlap(one.left, one.right, other.left, other.right);
      if (columns < kStackedShare * std::min(one.width(), other.width())) {
        ++b;
        continue;
      }
      groups_[a].box = both(one, other);
      groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(b));
      for (int& group : group_of_part_)
        group = group == static_cast<int>(b) ? static_cast<int>(a) : group > static_cast<int>(b) ? group - 1 : group;
      b = a + 1;
    }
  }
  for (const RegionRun& run : parts_.runs) {
    const int group = group_of_part_[static_cast<std::size_t>(run.region)];
    if (group < 0) continue;
    Group& one = groups_[static_cast<std::size_t>(group)];
    const double length = run.last - run.first + 1;
    one.area += length;
    one.x += length * (run.first + run.last) / 2;
    one.y += length * run.y;
  }
  for (Group& group : groups_) group.x /= group.area, group.y /= group.area;
}

void PeopleTracker::attach_small_parts() {
  for (std::size_t part = 0; part < parts_.parts.size(); ++part) {
    if (group_of_part_[part] >= 0) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < groups_.size(); ++k) {
      const double distance = gap(parts_.parts[part].box, groups_[k].box);
      if (distance < nearest) nearest = distance, group_of_part_[part] = static_cast<int>(k);
    }
  }
}

void PeopleTracker::pair_with_tracks() {
  while (true) {
    double nearest = kLongestStep;
    std::size_t best_track = 0, best_group = 0;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const bool taken =
          std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) { return g.track == static_cast<int>(t); });
      if (taken) continue;
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        if (groups_[g].track >= 0) continue;
        const Group& last = tracks_[t].last;
        const double height = std::max({last.box.height(), last.box.width(), groups_[g].box.height()});
        const double step = std::hypot(groups_[g].x - last.x, groups_[g].y - last.y) / height;
        if (step < nearest) nearest = step, best_track = t, best_group = g;
      }
    }
    if (nearest >= kLongestStep) return;
    groups_[best_group].track = static_cast<int>(best_track);
  }
}

void PeopleTracker::end_those_who_touch() {
  for (std::size_t lost = 0; lost < tracks_.size(); ++lost) {
    const bool seen =
        std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) { return g.track == static_cast<int>(lost); });
    if (seen || tracks_[lost].unseen > 0) continue;
    for (Group& group : groups_) {
      if (group.track < 0) continue;
      Track& other = tracks_[static_cast<std::size_t>(group.track)];
      const Group& before = tracks_[lost].last;
      if (gap(before.box, group.box) > 0 || group.area < kTouchedGrowth * other.last.area) continue;
      if (tracks_[lost].number >= 0 || other.number >= 0)
        events_.push_back({TrackEvent::Kind::kTouched, frame_, other.number, tracks_[lost].number});
      other.number = -1;
      tracks_[lost].unseen = kPatience;  // goes with follow()
      break;
    }
  }
}

bool PeopleTracker::part_if_long_apart(std::size_t track, std::size_t first, std::size_t second) {
  Track& old = tracks_[track];
  if (++old.apart <= kPatience) return false;
  if (old.number >= 0) events_.push_back({TrackEvent::Kind::kParted, frame_, old.number, -1});
  old.number = num_tracks_++, old.apart = 0, old.last = groups_[first];
  groups_[second].track = static_cast<int>(tracks_.size());
  tracks_.push_back({num_tracks_++, groups_[second], 0, 0});
  return true;
}

/// People whom no track explains: near to another they may be part of them, otherwise they are new.
void PeopleTracker::place_the_rest() {
  const bool first_frame = tracks_.empty();
  std::vector<char> apart(tracks_.size(), 0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g].track >= 0) continue;
    std::size_t near = groups_.size();
    for (std::size_t k = 0; k < groups_.size() && !first_frame; ++k) {
      if (k == g || groups_[k].track < 0 || static_cast<std::size_t>(groups_[k].track) >= apart.size()) continue;
      const double reach = kNearShare * std::max(groups_[k].box.height(), groups_[k].box.width());
      const BoundingBox& was = tracks_[static_cast<std::size_t>(groups_[k].track)].last.box;
      if (gap(groups_[g].box, groups_[k].box) <= reach && gap(groups_[g].box, was) == 0) near = k;
    }
    if (near == groups_.size()) {
      groups_[g].track = static_cast<int>(tracks_.size());
      tracks_.push_back({num_tracks_++, groups_[g], 0, 0});
      continue;
    }
    const auto track = static_cast<std::size_t>(groups_[near].track);
    apart[track] = 1;
    if (part_if_long_apart(track, near, g)) continue;
    groups_[near].box = both(groups_[near].box, groups_[g].box);
    const double area = groups_[near].area + groups_[g].area;
    groups_[near].x = (groups_[near].x * groups_[near].area + groups_[g].x * groups_[g].area) / area;
    groups_[near].y = (groups_[near].y * groups_[near].area + groups_[g].y * groups_[g].area) / area;
    groups_[near].area = area;
    for (int& group : group_of_part_)
      if (group == static_cast<int>(g)) group = static_cast<int>(near);
  }
  for (std::size_t t = 0; t < apart.size(); ++t)
    if (apart[t] == 0) tracks_[t].apart = 0;
}

void PeopleTracker::follow() {
  for (Track& track : tracks_) ++track.unseen;
  for (const Group& group : groups_) {
    if (group.track < 0) continue;
    Track& track = tracks_[static_cast<std::size_t>(group.track)];
    track.unseen = 0, track.last = group;
  }
}

/// Pixels below ½ belong to the part beside them.
void PeopleTracker::cut_out(const Sprite& frame, std::vector<TrackedPerson>& people) {
  const auto stride = static_cast<std::ptrdiff_t>(frame.width);
  labels_.assign(frame.pixels.size(), -1);
  for (const RegionRun& run : parts_.runs) {
    const auto row = labels_.begin() + run.y * stride;
    std::fill(row + run.first, row + run.last + 1,
              static_cast<short>(group_of_part_[static_cast<std::size_t>(run.region)]));
  }
  const auto take_from = [&](std::ptrdiff_t to, std::ptrdiff_t from, bool inside) {
    const auto i = static_cast<std::size_t>(to);
    if (inside && labels_[i] < 0 && frame.pixels[i][3] > 0) labels_[i] = labels_[static_cast<std::size_t>(from)];
  };
  const auto size = static_cast<std::ptrdiff_t>(labels_.size());
  for (std::ptrdiff_t i = 0; i < size; ++i) take_from(i, i - 1, i % stride > 0), take_from(i, i - stride, i >= stride);
  for (std::ptrdiff_t i = size - 1; i >= 0; --i)
    take_from(i, i + 1, i % stride + 1 < stride), take_from(i, i + stride, i + stride < size);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const int track = groups_[g].track;
    if (track < 0 || tracks_[static_cast<std::size_t>(track)].number < 0) continue;
    people.push_back(
        {tracks_[static_cast<std::size_t>(track)].number, labelled(frame, labels_, static_cast<short>(g)), {}});
  }
}

void PeopleTracker::add(const Sprite& frame, std::vector<TrackedPerson>& people) {
  people.clear();
  find_parts(frame, parts_);
  for (SilhouettePart& part : parts_.parts)
    part.box = {part.box.left + frame.left, part.box.top + frame.top, part.box.right + frame.left,
                part.box.bottom + frame.top};
  find_groups();
  for (Group& group : groups_) group.x += frame.left, group.y += frame.top;
  pair_with_tracks();
  end_those_who_touch();
  place_the_rest();
  attach_small_parts();
  follow();
  const auto followed = [&](const Group& g) {
    return g.track >= 0 && tracks_[static_cast<std::size_t>(g.track)].number >= 0;
  };
  const auto num_present = std::count_if(groups_.begin(), groups_.end(), [](const Group& g) { return g.track >= 0; });
  if (num_present == 1) {
    const auto only = std::find_if(groups_.begin(), groups_.end(), followed);
    if (only != groups_.end()) people.push_back({tracks_[static_cast<std::size_t>(only->track)].number, frame, {}});
  } else {
    cut_out(frame, people);
  }
  std::erase_if(tracks_, [](const Track& track) { return track.unseen >= kPatience; });
  for (TrackedPerson& person : people) person.silhouette = measure_silhouette(person.sprite, scratch_);
  std::sort(people.begin(), people.end(), [](const TrackedPerson& a, const TrackedPerson& b) {
    return a.silhouette.centroid_x < b.silhouette.centroid_x;
  });
  ++frame_;
}

}  // namespace motex
