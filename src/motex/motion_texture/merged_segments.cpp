// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "motex/core/parallel.h"
#include "motex/motion_texture/initial_segments.h"

namespace motex {
namespace {

constexpr std::size_t kCandidates = 24;

struct Group {
  LdsStatistics statistics;
  PathStatistics path;
  double evidence = 0, path_evidence = 0;
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

/// When merging ends: nothing gains threshold any more, and there are no more than most_groups.
struct MergeRules {
  double threshold = 0;
  int most_groups = std::numeric_limits<int>::max();
};

class Merger {
 public:
  /// Without paths groups are compared by their dynamics alone.
  Merger(const TextonFitter& fitter, const MovePaths* paths, std::vector<Group> groups, const MergeRules& rules)
      : evidence_(fitter.shared_statistics(), fitter.prior_frames()),
        paths_(paths),
        groups_(std::move(groups)),
        rules_(rules),
        alive_(static_cast<int>(groups_.size())) {
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
    while (!queue_.empty() && is_wanted(queue_.top().gain)) {
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
    if (paths_ != nullptr) group.path_evidence = paths_->evidence(group.path);
    group.loudness = (squares / std::max(1.0, group.statistics.count())).array().max(1e-6).log();
  }

  bool is_wanted(double gain) const { return gain > rules_.threshold || alive_ > rules_.most_groups; }

  double difference(const Group& a, const Group& b) const {
    if (paths_ == nullptr) return (a.loudness - b.loudness).squaredNorm();
    return a.path_evidence + b.path_evidence - paths_->evidence(a.path, b.path);
  }

  bool is_current(const Merge& merge) const {
    const Group &a = groups_[static_cast<std::size_t>(merge.a)], &b = groups_[static_cast<std::size_t>(merge.b)];
    return a.alive && b.alive && a.generation == merge.generation_a && b.generation == merge.generation_b;
  }

  /// Merges of g that are wanted, with the groups most alike.
  std::vector<Merge> candidates(int g) const {
    const Group& group = groups_[static_cast<std::size_t>(g)];
    std::vector<std::pair<double, int>> near;
    for (std::size_t h = 0; h < groups_.size(); ++h)
      if (groups_[h].alive && static_cast<int>(h) != g)
        near.emplace_back(difference(group, groups_[h]), static_cast<int>(h));
    const std::size_t keep = std::min(near.size(), kCandidates);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(keep), near.end());
    near.resize(keep);
    std::vector<Merge> merges;
    for (const auto& [different, h] : near) {
      const Group& other = groups_[static_cast<std::size_t>(h)];
      double gain = evidence_(group.statistics, other.statistics) - group.evidence - other.evidence;
      if (paths_ != nullptr) gain -= different;
      if (is_wanted(gain)) merges.push_back({gain, g, h, group.generation, other.generation});
    }
    return merges;
  }

  void apply(const Merge& merge) {
    Group &a = groups_[static_cast<std::size_t>(merge.a)], &b = groups_[static_cast<std::size_t>(merge.b)];
    a.statistics += b.statistics;
    if (paths_ != nullptr) a.path += b.path;
    b.alive = false;
    --alive_;
    b.statistics = LdsStatistics();
    parent_[static_cast<std::size_t>(merge.b)] = merge.a;
    ++a.generation;
    describe(a);
    for (const Merge& next : candidates(merge.a)) queue_.push(next);
  }

  LdsEvidence evidence_;
  const MovePaths* paths_;
  std::vector<Group> groups_;
  MergeRules rules_;
  int alive_;
  Matrix global_rows_;
  std::priority_queue<Merge> queue_;
  std::vector<int> parent_;
};

/// Pieces of min_frames; the last of a run takes what is left.
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

Segmentation merge(Segmentation pieces, const TextonFitter& fitter, const MovePaths* paths, const MergeRules& rules,
                   const JobContext& job) {
  std::vector<Group> groups;
  for (const LabelledSegment& piece : pieces) {
    const Index counted = fitter.num_counted(piece);
    Group group;
    group.statistics = LdsStatistics(fitter.shared().basis.cols());
    group.statistics.add(fitter.shared_states(), piece.row + piece.length - counted, counted);
    if (paths != nullptr) group.path = paths->observe(piece.row);
    groups.push_back(std::move(group));
  }
  job.progress("merging segments", 0.05);
  const std::vector<int> roots = Merger(fitter, paths, std::move(groups), rules).run(job);
  std::vector<int> label(roots.size(), -1);
  int used = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    int& name = label[static_cast<std::size_t>(roots[i])];
    if (name < 0) name = used++;
    pieces[i].texton = name;
  }
  return pieces;
}

}  // namespace

Segmentation merged_segments(const Corpus& corpus, const TextonFitter& fitter, double threshold, Index min_frames,
                             const JobContext& job) {
  return merge(chop(corpus, min_frames), fitter, nullptr, {threshold}, job);
}

Segmentation merged_moves(const Corpus& corpus, const TextonFitter& fitter, const MovePaths& paths,
                          double pieces_per_texton, Index min_frames, const JobContext& job) {
  Segmentation pieces = chop(corpus, min_frames);
  const double wanted = static_cast<double>(pieces.size()) / pieces_per_texton;
  const MergeRules rules{0, std::max(1, static_cast<int>(wanted))};
  return merge(std::move(pieces), fitter, &paths, rules, job);
}

}  // namespace motex
