// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <queue>

#include "motex/core/parallel.h"
#include "motex/motion_texture/initial_segments.h"

namespace motex {
namespace {

constexpr std::size_t kCandidates = 24;

struct Group {
  LdsStatistics statistics;
  double evidence = 0;
  Vector loudness;  ///< log mean square of the residuals under the global system, per whitened direction
  int generation = 0;
  bool alive = true;
};

struct Merge {
  double gain = 0;
  int a = 0, b = 0;
  int generation_a = 0, generation_b = 0;
  bool operator<(const Merge& other) const {
    if (gain != other.gain) return gain < other.gain;
    return std::pair(a, b) > std::pair(other.a, other.b);
  }
};

class Merger {
 public:
  Merger(const TextonFitter& fitter, std::vector<Group> groups, double threshold)
      : evidence_(fitter.shared_statistics(), fitter.prior_frames()),
        groups_(std::move(groups)),
        threshold_(threshold) {
    const LdsStatistics& corpus = fitter.shared_statistics();
    global_rows_ = whitening(fit_lds(corpus, make_prior(corpus, 1)));
  }

  /// Label of each of the first groups.
  std::vector<int> run(const JobContext& job) {
    const int pieces = static_cast<int>(groups_.size());
    parallel_for(job.jobs, pieces, [&](int g) { describe(groups_[static_cast<std::size_t>(g)]); });
    std::vector<std::vector<Merge>> found(groups_.size());
    parallel_for(job.jobs, pieces, [&](int g) {
      job.check_cancelled();
      found[static_cast<std::size_t>(g)] = candidates(g);
    });
    for (const auto& merges : found)
      for (const Merge& merge : merges) queue_.push(merge);
    parent_.resize(groups_.size());
    for (std::size_t g = 0; g < parent_.size(); ++g) parent_[g] = static_cast<int>(g);
    while (!queue_.empty() && queue_.top().gain > threshold_) {
      job.check_cancelled();
      const Merge merge = queue_.top();
      queue_.pop();
      if (is_current(merge)) apply(merge);
    }
    std::vector<int> labels(groups_.size());
    for (std::size_t g = 0; g < labels.size(); ++g) {
      int root = static_cast<int>(g);
      while (parent_[static_cast<std::size_t>(root)] != root) root = parent_[static_cast<std::size_t>(root)];
      labels[g] = root;
    }
    return labels;
  }

 private:
  void describe(Group& group) {
    group.evidence = evidence_(group.statistics);
    const Vector squares = (global_rows_ * group.statistics.moments).cwiseProduct(global_rows_).rowwise().sum();
    group.loudness = (squares / std::max(1.0, group.statistics.count())).array().max(1e-6).log();
  }

  bool is_current(const Merge& merge) const {
    const Group &a = groups_[static_cast<std::size_t>(merge.a)], &b = groups_[static_cast<std::size_t>(merge.b)];
    return a.alive && b.alive && a.generation == merge.generation_a && b.generation == merge.generation_b;
  }

  /// Merges of g that gain, with the groups most alike.
  std::vector<Merge> candidates(int g) const {
    const Group& group = groups_[static_cast<std::size_t>(g)];
    std::vector<std::pair<double, int>> near;
    for (std::size_t h = 0; h < groups_.size(); ++h)
      if (groups_[h].alive && static_cast<int>(h) != g)
        near.emplace_back((groups_[h].loudness - group.loudness).squaredNorm(), static_cast<int>(h));
    const std::size_t keep = std::min(near.size(), kCandidates);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(keep), near.end());
    near.resize(keep);
    std::vector<Merge> merges;
    for (const auto& [distance, h] : near) {
      const Group& other = groups_[static_cast<std::size_t>(h)];
      const double gain = evidence_(group.statistics, other.statistics) - group.evidence - other.evidence;
      if (gain > threshold_) merges.push_back({gain, g, h, group.generation, other.generation});
    }
    return merges;
  }

  void apply(const Merge& merge) {
    Group &a = groups_[static_cast<std::size_t>(merge.a)], &b = groups_[static_cast<std::size_t>(merge.b)];
    a.statistics += b.statistics;
    b.alive = false;
    b.statistics = LdsStatistics();
    parent_[static_cast<std::size_t>(merge.b)] = merge.a;
    ++a.generation;
    describe(a);
    for (const Merge& next : candidates(merge.a)) queue_.push(next);
  }

  LdsEvidence evidence_;
  std::vector<Group> groups_;
  double threshold_;
  Matrix global_rows_;
  std::priority_queue<Merge> queue_;
  std::vector<int> parent_;
};

}  // namespace

Segmentation chop(const Corpus& corpus, Index min_frames) {
  Segmentation pieces;
  for (std::size_t r = 0; r < corpus.runs.size(); ++r) {
    const Run& run = corpus.runs[r];
    const Index end = run.row + run.length;
    for (Index row = run.row; row < end;) {
      const Index length = end - row < 2 * min_frames ? end - row : min_frames;
      pieces.push_back({0, static_cast<int>(r), row, length});
      row += length;
    }
  }
  return pieces;
}

void name_in_order(const std::vector<int>& groups, Segmentation& pieces) {
  std::vector<int> name(groups.size(), -1);
  int used = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    int& texton = name[static_cast<std::size_t>(groups[i])];
    if (texton < 0) texton = used++;
    pieces[i].texton = texton;
  }
}

Segmentation merged_segments(const Corpus& corpus, const TextonFitter& fitter, double threshold, Index min_frames,
                             const JobContext& job) {
  Segmentation pieces = chop(corpus, min_frames);
  std::vector<Group> groups;
  for (const LabelledSegment& piece : pieces) {
    const Index counted = fitter.num_counted(piece);
    Group group;
    group.statistics = LdsStatistics(fitter.shared().basis.cols());
    group.statistics.add(fitter.shared_states(), piece.row + piece.length - counted, counted);
    groups.push_back(std::move(group));
  }
  job.progress("merging segments", 0.05);
  name_in_order(Merger(fitter, std::move(groups), threshold).run(job), pieces);
  return pieces;
}

}  // namespace motex
