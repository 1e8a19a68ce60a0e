// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "motex/core/parallel.h"
#include "motex/motion_texture/initial_segments.h"

namespace motex {
namespace {

struct Group {
  PathStatistics path;
  double evidence = 0;
  int nearest = -1;  ///< group after this one with which merging gains most
  double gain = 0;
};

/// Merges the two groups most alike until there are few enough and no merge gains. Cost O(n² P) for n pieces.
class MoveMerger {
 public:
  MoveMerger(const MovePaths& paths, const Segmentation& pieces) : paths_(paths), alive_(pieces.size()) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Group group{paths.observe(pieces[i].row)};
      group.evidence = paths.evidence(group.path);
      groups_.push_back(std::move(group));
      alive_[i] = static_cast<int>(i);
    }
    group_of_ = alive_;
  }

  /// Group of each piece.
  std::vector<int> run(int most_groups, const JobContext& job) {
    parallel_for(job.jobs, static_cast<int>(groups_.size()), [&](int g) {
      job.check_cancelled();
      find_nearest(g);
    });
    while (alive_.size() > 1) {
      job.check_cancelled();
      const int a =
          *std::max_element(alive_.begin(), alive_.end(), [&](int x, int y) { return at(x).gain < at(y).gain; });
      if (at(a).gain <= 0 && alive_.size() <= static_cast<std::size_t>(most_groups)) break;
      merge(a, at(a).nearest);
    }
    return group_of_;
  }

 private:
  Group& at(int g) { return groups_[static_cast<std::size_t>(g)]; }

  double gain_of(const Group& a, const Group& b) const {
    return paths_.evidence(a.path, b.path) - a.evidence - b.evidence;
  }

  void find_nearest(int g) {
    Group& group = at(g);
    group.nearest = -1;
    group.gain = -std::numeric_limits<double>::infinity();
    for (const int h : alive_) {
      if (h <= g) continue;
      const double gain = gain_of(group, at(h));
      if (gain > group.gain) group.gain = gain, group.nearest = h;
    }
  }

  void merge(int a, int b) {
    at(a).path += at(b).path;
    at(a).evidence = paths_.evidence(at(a).path);
    alive_.erase(std::find(alive_.begin(), alive_.end(), b));
    for (int& group : group_of_)
      if (group == b) group = a;
    for (const int g : alive_) {
      if (g == a || at(g).nearest == a || at(g).nearest == b) {
        find_nearest(g);
      } else if (g < a) {
        const double gain = gain_of(at(g), at(a));
        if (gain > at(g).gain) at(g).gain = gain, at(g).nearest = a;
      }
    }
  }

  const MovePaths& paths_;
  std::vector<Group> groups_;
  std::vector<int> alive_;     ///< in order
  std::vector<int> group_of_;  ///< of each piece
};

}  // namespace

Segmentation merged_moves(const Corpus& corpus, const MovePaths& paths, double pieces_per_texton, Index min_frames,
                          const JobContext& job) {
  Segmentation pieces = chop(corpus, min_frames);
  job.progress("merging segments", 0.05);
  const double most = std::max(1.0, static_cast<double>(pieces.size()) / pieces_per_texton);
  name_in_order(MoveMerger(paths, pieces).run(static_cast<int>(most), job), pieces);
  return pieces;
}

}  // namespace motex
