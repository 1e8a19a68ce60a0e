// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/link_sights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "motex/particles/best_pairs.h"
#include "motex/particles/fit_element_model.h"

namespace motex {
namespace {

constexpr int kMemory = 10;           // sights before a cut that take part
constexpr int kForesight = 5;         // sights after it
constexpr double kGate = 25;          // squared deviations beyond which a join is not looked at
constexpr double kMostRivals = 6;     // sights by chance within two deviations: no join across so wide a gap
constexpr std::size_t kNearest = 10;  // joins looked at for each path and frame

class Linker {
 public:
  Linker(const std::vector<std::vector<Sight>>& frames, const ElementModel& model, const LinkSightsOptions& options,
         const JobContext& job)
      : options_(options), job_(job), num_frames_(static_cast<int>(frames.size())) {
    set_model(model);
    for (const std::vector<Sight>& frame : frames) {
      first_of_frame_.push_back(static_cast<int>(sights_.size()));
      sights_.insert(sights_.end(), frame.begin(), frame.end());
      std::vector<int> order(frame.size());
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = first_of_frame_.back() + static_cast<int>(k);
      std::sort(order.begin(), order.end(),
                [&](int a, int b) { return std::make_pair(at(a).y, a) < std::make_pair(at(b).y, b); });
      by_y_.insert(by_y_.end(), order.begin(), order.end());
    }
    first_of_frame_.push_back(static_cast<int>(sights_.size()));
    next_.assign(sights_.size(), -1);
    previous_.assign(sights_.size(), -1);
    edges_ = {static_cast<double>(options.width), static_cast<double>(options.height)};
    if (options.width <= 0 || options.height <= 0)
      for (const Sight& sight : sights_)
        edges_ = {std::max(edges_.width, sight.x + 1), std::max(edges_.height, sight.y + 1)};
  }

  LinkedSights run() {
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      // First only from a sight to the next frame: what comes later has not been offered its own past yet.
      foresees_gaps_ = sweep > 0;
      num_changes_ = 0;
      for (int k = 0; k + 1 < num_frames_; ++k) join_at(sweep % 2 == 0 ? k : num_frames_ - 2 - k);
      if (sweep > 0 && num_changes_ == 0) break;
      if (sweep + 1 < options_.sweeps) set_model(fit_element_model(paths(), edges_, num_frames_, model_));
    }
    // Once more with the model that will be reported, now counting how sure each link is.
    wrong_.assign(sights_.size(), 0);
    measures_doubt_ = true;
    for (int cut = 0; cut + 1 < num_frames_; ++cut) join_at(cut);
    return result();
  }

 private:
  const Sight& at(int id) const { return sights_[static_cast<std::size_t>(id)]; }
  int& next(int id) { return next_[static_cast<std::size_t>(id)]; }
  int& previous(int id) { return previous_[static_cast<std::size_t>(id)]; }
  int next(int id) const { return next_[static_cast<std::size_t>(id)]; }
  int previous(int id) const { return previous_[static_cast<std::size_t>(id)]; }

  void set_model(const ElementModel& model) {
    model_ = model;
    log_gaps_.clear();
    for (int gap = 0; gap <= options_.max_gap; ++gap) log_gaps_.push_back(log_of_gap(gap));
  }

  /// Ends of paths before the cut (after frame `cut`) and beginnings after it that are or may be joined across it.
  void collect(int cut) {
    heads_.clear();
    tails_.clear();
    for (int t = std::max(0, cut - options_.max_gap); t <= cut; ++t)
      for (int id = first_of_frame_[static_cast<std::size_t>(t)]; id < first_of_frame_[static_cast<std::size_t>(t) + 1];
           ++id)
        if (next(id) < 0 || at(next(id)).frame > cut) heads_.push_back(id);
    const int last = std::min(num_frames_ - 1, cut + 1 + (foresees_gaps_ ? options_.max_gap : 0));
    tail_idx_.assign(sights_.size(), -1);
    for (int t = cut + 1; t <= last; ++t)
      for (int id = first_of_frame_[static_cast<std::size_t>(t)]; id < first_of_frame_[static_cast<std::size_t>(t) + 1];
           ++id)
        if (previous(id) < 0 || at(previous(id)).frame <= cut) {
          tail_idx_[static_cast<std::size_t>(id)] = static_cast<int>(tails_.size());
          tails_.push_back(id);
        }
  }

  ElementFilter filter_of_head(int id) const {
    int first = id;
    for (int k = 1; k < kMemory && previous(first) >= 0; ++k) first = previous(first);
    ElementFilter filter(model_);
    filter.start(at(first));
    while (first != id) {
      first = next(first);
      filter.follow(at(first));
    }
    return filter;
  }

  /// ln probability of living on and not being seen for that many frames in between.
  double log_gap(int gap) const {
    const auto idx = static_cast<std::size_t>(gap);
    return idx < log_gaps_.size() ? log_gaps_[idx] : log_of_gap(gap);
  }
  double log_of_gap(int gap) const {
    const double alive = (gap + 1) * std::log(1 - model_.death);
    if (gap == 0) return alive + std::log(model_.seen);
    return alive + std::log(1 - model_.seen) + (gap - 1) * std::log(model_.hidden) + std::log(1 - model_.hidden);
  }

  /// ln density of the tail's first sights after what the filter has seen, the last time in frame `last_seen`.
  double follow(ElementFilter filter, int last_seen, int tail) const {
    double sum = 0;
    for (int k = 0, id = tail; k < kForesight && id >= 0; ++k, id = next(id)) {
      const int gap = at(id).frame - last_seen - 1;
      sum += filter.follow(at(id)) + log_gap(gap);
      last_seen = at(id).frame;
    }
    return sum;
  }

  /// The same without anything before.
  double alone(int tail) const {
    ElementFilter filter(model_);
    const double first = filter.start(at(tail));
    const int second = next(tail);
    if (second < 0) return first;
    double sum = first;
    for (int k = 1, id = second; k < kForesight && id >= 0; ++k, id = next(id)) {
      const int gap = at(id).frame - filter.frame() - 1;
      sum += filter.follow(at(id)) + log_gap(gap);
    }
    return sum;
  }

  /// ln of how often paths begin, end, are a single sight.
  double log_begin(const Sight& sight) const {
    if (sight.frame == 0) return std::log(model_.births + model_.clutter + model_.entries);
    return std::log(edges_.is_entering(model_, sight.x, sight.y) ? model_.entries : model_.births);
  }
  double log_end(const Sight& sight) const {
    if (sight.frame == num_frames_ - 1) return 0;
    if (edges_.is_leaving(model_, sight.x, sight.y)) return std::log(0.5);
    return std::log(model_.death);
  }
  double log_ends(const Sight& first, const Sight& last, bool is_single) const {
    const double element = log_begin(first) + log_end(last);
    return is_single ? std::log(std::exp(element) + model_.clutter) : element;
  }

  void join_at(int cut) {
    job_.check_cancelled();
    collect(cut);
    gains_.clear();
    tail_values_.assign(tails_.size(), 0);
    tail_firsts_.resize(tails_.size());
    for (std::size_t k = 0; k < tails_.size(); ++k) {
      int last = tails_[k];
      while (next(last) >= 0) last = next(last);
      tail_firsts_[k] = last;
      tail_values_[k] = alone(tails_[k]) + log_ends(at(tails_[k]), at(last), last == tails_[k]);
    }
    for (std::size_t row = 0; row < heads_.size(); ++row) add_gains(static_cast<int>(row));
    const std::vector<int> column_of =
        best_pairs(static_cast<int>(heads_.size()), static_cast<int>(tails_.size()), gains_);
    if (measures_doubt_) measure_doubt(column_of);
    relink(column_of);
  }

  void add_gains(int row) {
    const int head = heads_[static_cast<std::size_t>(row)];
    const ElementFilter filter = filter_of_head(head);
    int first = head;
    while (previous(first) >= 0) first = previous(first);
    const double head_ends = log_ends(at(first), at(head), first == head);
    const int last_frame = std::min(
        {num_frames_ - 1, at(head).frame + 1 + options_.max_gap, tails_.empty() ? -1 : at(tails_.back()).frame});
    for (int t = std::max(at(head).frame + 1, tails_.empty() ? num_frames_ : at(tails_.front()).frame); t <= last_frame;
         ++t) {
      const ElementFilter here = filter.waited(t);
      const double variance_y = here.variance_y(t), y = here.expected_y(t), reach = std::sqrt(kGate * variance_y);
      const double density =
          (first_of_frame_[static_cast<std::size_t>(t) + 1] - first_of_frame_[static_cast<std::size_t>(t)]) /
          std::max(1.0, edges_.width * edges_.height);
      const double rivals = 4 * std::numbers::pi * std::sqrt(here.variance_x(t) * variance_y) * density;
      if (t > at(head).frame + 1 && rivals > kMostRivals) break;
      near_.clear();
      const auto begin = by_y_.begin() + first_of_frame_[static_cast<std::size_t>(t)],
                 end = by_y_.begin() + first_of_frame_[static_cast<std::size_t>(t) + 1];
      for (auto id = std::lower_bound(begin, end, y - reach, [&](int a, double value) { return at(a).y < value; });
           id != end && at(*id).y <= y + reach; ++id) {
        if (tail_idx_[static_cast<std::size_t>(*id)] < 0) continue;
        const double distance = here.distance(at(*id));
        if (distance <= kGate) near_.emplace_back(distance, *id);
      }
      if (near_.size() > kNearest) {
        std::nth_element(near_.begin(), near_.begin() + kNearest, near_.end());
        near_.resize(kNearest);
      }
      for (const auto& [distance, id] : near_) {
        const int column = tail_idx_[static_cast<std::size_t>(id)];
        const auto c = static_cast<std::size_t>(column);
        const double joined = follow(here, at(head).frame, id) + log_ends(at(first), at(tail_firsts_[c]), false);
        gains_.push_back({row, column, joined - head_ends - tail_values_[c]});
      }
    }
  }

  void relink(const std::vector<int>& column_of) {
    for (std::size_t row = 0; row < heads_.size(); ++row) {
      const int head = heads_[row], tail = column_of[row] < 0 ? -1 : tails_[static_cast<std::size_t>(column_of[row])];
      // A link to a tail that was not offered this time stays when nothing better is found.
      const int before = next(head);
      if (before == tail) continue;
      if (before >= 0 && tail_idx_[static_cast<std::size_t>(before)] < 0 && tail < 0) continue;
      ++num_changes_;
      if (before >= 0 && previous(before) == head) previous(before) = -1;
      next(head) = -1;
      if (tail < 0) continue;
      if (previous(tail) >= 0 && next(previous(tail)) == tail) next(previous(tail)) = -1;
      previous(tail) = head;
      next(head) = tail;
    }
  }

  /// For each link the odds of the best other pairings of its head and tail.
  void measure_doubt(const std::vector<int>& column_of) {
    std::vector<int> row_of(tails_.size(), -1);
    for (std::size_t row = 0; row < column_of.size(); ++row)
      if (column_of[row] >= 0) row_of[static_cast<std::size_t>(column_of[row])] = static_cast<int>(row);
    std::vector<double> chosen(heads_.size(), 0), odds(heads_.size(), 0);
    for (const PairGain& g : gains_)
      if (column_of[static_cast<std::size_t>(g.row)] == g.column) chosen[static_cast<std::size_t>(g.row)] = g.gain;
    for (const PairGain& g : gains_) {
      const auto row = static_cast<std::size_t>(g.row);
      if (column_of[row] == g.column) {
        odds[row] += std::exp(-g.gain);
        continue;
      }
      const int rival = row_of[static_cast<std::size_t>(g.column)];
      double loss = chosen[row] - g.gain;
      if (rival >= 0) {
        const auto other = static_cast<std::size_t>(rival);
        loss += chosen[other] - (column_of[row] >= 0 ? std::max(0.0, gain_of(rival, column_of[row])) : 0);
        odds[other] += std::exp(-std::max(loss, -5.0));
      }
      if (column_of[row] >= 0) odds[row] += std::exp(-std::max(loss, -5.0));
    }
    for (std::size_t row = 0; row < heads_.size(); ++row)
      if (column_of[row] >= 0) wrong_[static_cast<std::size_t>(heads_[row])] = odds[row] / (1 + odds[row]);
  }

  double gain_of(int row, int column) const {
    auto g = std::lower_bound(gains_.begin(), gains_.end(), row, [](const PairGain& a, int r) { return a.row < r; });
    for (; g != gains_.end() && g->row == row; ++g)
      if (g->column == column) return g->gain;
    return -50;
  }

  std::vector<std::vector<Sight>> paths() const {
    std::vector<std::vector<Sight>> out;
    for (int id = 0; id < static_cast<int>(sights_.size()); ++id) {
      if (previous(id) >= 0) continue;
      out.emplace_back();
      for (int k = id; k >= 0; k = next(k)) out.back().push_back(at(k));
    }
    return out;
  }

  LinkedSights result() const {
    LinkedSights out;
    out.model = model_;
    double doubt = 0;
    for (int id = 0; id < static_cast<int>(sights_.size()); ++id) {
      if (previous(id) >= 0) continue;
      SightChain chain;
      for (int k = id; k >= 0; k = next(k)) {
        chain.sights.push_back(at(k));
        chain.idx.push_back(k - first_of_frame_[static_cast<std::size_t>(at(k).frame)]);
        if (next(k) < 0) continue;
        ++out.num_links;
        doubt += wrong_[static_cast<std::size_t>(k)];
        chain.confidence *= 1 - wrong_[static_cast<std::size_t>(k)];
      }
      out.chains.push_back(std::move(chain));
    }
    if (out.num_links > 0) out.expected_wrong_share = doubt / out.num_links;
    return out;
  }

  LinkSightsOptions options_;
  const JobContext& job_;
  ElementModel model_;
  PictureEdges edges_;
  int num_frames_;
  std::vector<Sight> sights_;
  std::vector<int> first_of_frame_, by_y_, next_, previous_;
  bool foresees_gaps_ = false, measures_doubt_ = false;
  int num_changes_ = 0;
  std::vector<double> log_gaps_;  // by the frames not seen
  std::vector<double> wrong_;     // of the link after each sight
  // of the cut at hand
  std::vector<int> heads_, tails_, tail_idx_, tail_firsts_;
  std::vector<double> tail_values_;
  std::vector<PairGain> gains_;
  std::vector<std::pair<double, int>> near_;
};

}  // namespace

LinkedSights link_sights(const std::vector<std::vector<Sight>>& frames, const ElementModel& start,
                         const LinkSightsOptions& options, const JobContext& job) {
  return Linker(frames, start, options, job).run();
}

}  // namespace motex
