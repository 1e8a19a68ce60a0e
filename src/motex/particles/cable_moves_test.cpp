// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Detailed balance: on a toy of three frames, few places and at most two elements a frame, every state is enumerated;
// the moves, the same code as on pictures with proposals restricted to those places, must visit states as often as
// their posterior says.
#include "motex/particles/cable_moves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "motex/particles/toy_cables.h"

namespace motex {
namespace {

Cable cable_at(int first, const std::vector<int>& places) {
  Cable cable;
  cable.first_frame = first;
  for (const int i : places) cable.core.push_back(core_base(BaseKind::kGaussian, place(i)));
  return cable;
}

std::string name_of_state(const std::vector<Cable>& cables) {
  std::vector<std::string> parts;
  for (const Cable& cable : cables) {
    std::string part = std::to_string(cable.first_frame) + ":";
    for (const Base& base : cable.core) part += std::to_string(static_cast<int>(std::lround(base.x))) + " ";
    parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end());
  std::string name;
  for (const std::string& part : parts) name += part + ";";
  return name;
}

/// What states are compared by: how many elements each frame has and how many links there are; and the lengths of the
/// cables with the places in the middle frame.
std::array<std::string, 2> classes_of(const std::vector<Cable>& cables) {
  std::array<int, kToyFrames> num{}, lengths{};
  int middle = 0, links = 0;
  for (const Cable& cable : cables) {
    for (std::int64_t t = cable.first_frame; t < cable.end_frame(); ++t) ++num[static_cast<std::size_t>(t)];
    ++lengths[static_cast<std::size_t>(cable.num_frames() - 1)];
    links += static_cast<int>(cable.num_frames()) - 1;
    if (cable.covers(1)) middle += static_cast<int>(std::lround(cable.at(1).x));
  }
  std::string counts = "counts ", shapes = "lengths ";
  for (const int n : num) counts += std::to_string(n);
  counts += " links " + std::to_string(links);
  for (const int n : lengths) shapes += std::to_string(n);
  return {counts, shapes + " middle " + std::to_string(middle)};
}

/// Every state with its probability; the measure of two elements in one place is that of a Poisson process, 1/2!.
class Enumeration {
 public:
  Enumeration(const std::vector<Plane>& pictures, const CableLaw& law) : pictures_(pictures), law_(law) {
    std::vector<std::vector<int>> frames(kToyFrames);
    choose(frames, 0);
    double total = 0;
    for (const auto& [name, weight] : weights_) total += weight;
    for (auto& [name, weight] : weights_) weight /= total;
    for (const auto& [name, weight] : weights_)
      for (const std::string& of : class_names_[name]) classes_[of] += weight;
  }
  const std::map<std::string, double>& classes() const { return classes_; }
  /// One of the states, as often as its probability says.
  const std::vector<Cable>& draw(Rng& rng) const {
    const double level = rng.uniform() * cumulative_.back();
    const auto at = std::upper_bound(cumulative_.begin(), cumulative_.end(), level) - cumulative_.begin();
    return states_[std::min(static_cast<std::size_t>(at), states_.size() - 1)];
  }
  std::size_t num_states() const { return weights_.size(); }

 private:
  void choose(std::vector<std::vector<int>>& frames, int t) {
    if (t == kToyFrames) {
      std::vector<std::vector<int>> links(kToyFrames - 1);
      join(frames, links, 0);
      return;
    }
    const auto k = static_cast<std::size_t>(t);
    frames[k] = {};
    choose(frames, t + 1);
    for (int i = 0; i < kNumPlaces; ++i) {
      frames[k] = {i};
      choose(frames, t + 1);
      for (int j = 0; j < kNumPlaces; ++j) {
        frames[k] = {i, j};
        choose(frames, t + 1);
      }
    }
  }

  /// All ways to lead elements of frame t to elements of the next, each to at most one.
  void join(const std::vector<std::vector<int>>& frames, std::vector<std::vector<int>>& links, std::size_t t) {
    if (t + 1 == kToyFrames) {
      add(frames, links);
      return;
    }
    const std::size_t n = frames[t].size(), m = frames[t + 1].size();
    const auto options = static_cast<int>(m) + 1;
    for (int a = 0; a < (n > 0 ? options : 1); ++a)
      for (int b = 0; b < (n > 1 ? options : 1); ++b) {
        if (n > 1 && a == b && a > 0) continue;
        links[t].assign({a - 1, b - 1});
        join(frames, links, t + 1);
      }
  }

  void add(const std::vector<std::vector<int>>& frames, const std::vector<std::vector<int>>& links) {
    std::vector<Cable> cables;
    double measure = 1;
    for (int t = 0; t < kToyFrames; ++t) {
      const auto& here = frames[static_cast<std::size_t>(t)];
      if (here.size() == 2) measure /= 2;
      for (std::size_t i = 0; i < here.size(); ++i) {
        if (t > 0) {
          const auto& before = frames[static_cast<std::size_t>(t - 1)];
          bool is_followed = false;
          for (std::size_t k = 0; k < before.size(); ++k)
            is_followed |= links[static_cast<std::size_t>(t - 1)][k] == static_cast<int>(i);
          if (is_followed) continue;
        }
        std::vector<int> path;
        int at = static_cast<int>(i);
        for (int u = t; u < kToyFrames && at >= 0; ++u) {
          path.push_back(frames[static_cast<std::size_t>(u)][static_cast<std::size_t>(at)]);
          at = u + 1 < kToyFrames ? links[static_cast<std::size_t>(u)][static_cast<std::size_t>(at)] : -1;
        }
        cables.push_back(cable_at(t, path));
      }
    }
    const std::string name = name_of_state(cables);
    const double log_p = log_posterior(CableState(pictures_, cables, law_), law_);
    if (weights_.empty()) offset_ = log_p;
    weights_[name] += measure * std::exp(log_p - offset_);
    states_.push_back(cables);
    cumulative_.push_back((cumulative_.empty() ? 0 : cumulative_.back()) + measure * std::exp(log_p - offset_));
    class_names_[name] = classes_of(cables);
  }

  const std::vector<Plane>& pictures_;
  const CableLaw& law_;
  double offset_ = 0;
  std::vector<std::vector<Cable>> states_;
  std::vector<double> cumulative_;
  std::map<std::string, double> weights_, classes_;
  std::map<std::string, std::array<std::string, 2>> class_names_;
};

class CableMovesToy : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    toy_images = new std::vector<Plane>(toy_pictures());
    toy_law = new CableLaw(toy_prior(), kToyFrames);
    toy_truth = new Enumeration(*toy_images, *toy_law);
    toy_sparse_law = new CableLaw(toy_prior(false), kToyFrames);
    toy_sparse_truth = new Enumeration(*toy_images, *toy_sparse_law);
  }
  static void TearDownTestSuite() {
    delete toy_sparse_truth;
    delete toy_sparse_law;
    delete toy_truth;
    delete toy_law;
    delete toy_images;
  }

  /// Total variation between visits and posterior, of both kinds of classes together.
  static double distance_of(const std::vector<CableMove>& moves) {
    CableState state(*toy_images, {}, *toy_law);
    PlacesProposal proposal(toy_law->prior());
    CableMoves chain(state, *toy_law, proposal, {0, kToyFrames}, Rng(11));
    const double start = log_posterior(state, *toy_law);
    Rng rng(3);
    std::map<std::string, double> visits;
    constexpr int kSteps = 600000;
    for (int step = 0; step < kSteps; ++step) {
      chain.propose(moves[rng.below(moves.size())], static_cast<int>(rng.below(kToyFrames)));
      if (step % 2 != 0) continue;
      for (const std::string& of : classes_of(state.cables())) visits[of] += 2.0 / kSteps;
    }
    EXPECT_NEAR(chain.log_posterior_change(), log_posterior(state, *toy_law) - start, 1e-3);
    double distance = 0;
    for (const auto& [name, probability] : toy_truth->classes()) {
      distance += std::abs(probability - visits[name]);
      visits.erase(name);
    }
    for (const auto& [name, share] : visits) distance += share;
    return distance / 2;
  }

  /// How far the flows between states are from being the same in both directions, in deviations: states are drawn from
  /// the enumerated posterior, the move alone is made a few times, and every step is counted.
  static double imbalance(CableMove move, std::initializer_list<CableJump> jumps, const CableLaw& law,
                          const Enumeration& truth, int least) {
    PlacesProposal proposal(law.prior());
    Rng rng(17);
    std::map<std::pair<std::string, std::string>, double> flows, class_flows;
    std::array<std::int64_t, kNumCableJumps> accepted{};
    constexpr int kRestarts = 90000, kMoves = 2;
    for (int restart = 0; restart < kRestarts; ++restart) {
      CableState state(*toy_images, truth.draw(rng), law);
      CableMoves chain(state, law, proposal, {0, kToyFrames}, rng.fork(static_cast<std::uint64_t>(restart)));
      double before = chain.log_posterior_change();
      std::vector<Cable> cables = state.cables();
      for (int k = 0; k < kMoves; ++k) {
        chain.propose(move, static_cast<int>(rng.below(kToyFrames)));
        if (chain.log_posterior_change() == before) continue;
        before = chain.log_posterior_change();
        const std::vector<Cable> next = state.cables();
        ++flows[{name_of_state(cables), name_of_state(next)}];
        const auto from = classes_of(cables), to = classes_of(next);
        ++class_flows[{from[0] + from[1], to[0] + to[1]}];
        cables = next;
      }
      for (std::size_t k = 0; k < accepted.size(); ++k) accepted[k] += chain.counts()[k].accepted;
    }
    for (const CableJump jump : jumps) EXPECT_GE(accepted[static_cast<std::size_t>(jump)], least) << name_of(jump);
    // what one direction leads away, the other brings back
    for (auto jump = jumps.begin(); jump != jumps.end() && jump + 1 != jumps.end() && *jump != CableJump::kPairRedraw;
         jump += 2) {
      const auto there = static_cast<double>(accepted[static_cast<std::size_t>(*jump)]),
                 back = static_cast<double>(accepted[static_cast<std::size_t>(*(jump + 1))]);
      EXPECT_LT(std::abs(there - back), 4 * std::sqrt(there + back)) << name_of(*jump) << ": " << there << ", " << back;
    }
    return std::max(asymmetry(flows), asymmetry(class_flows));
  }

  /// Σ (there − back)² / (there + back) is chi-square; as normal deviations above its mean.
  static double asymmetry(const std::map<std::pair<std::string, std::string>, double>& flows) {
    double square = 0, num = 0;
    for (const auto& [pair, there] : flows) {
      const auto found = flows.find({pair.second, pair.first});
      const double back = found == flows.end() ? 0 : found->second;
      const bool is_second_visit = pair.second < pair.first && found != flows.end();
      if (pair.first == pair.second || is_second_visit || there + back < 4) continue;
      square += (there - back) * (there - back) / (there + back);
      ++num;
    }
    if (num < 3) return 0;
    return (square - num) / std::sqrt(2 * num);
  }

  static void expect_balance(CableMove move, std::initializer_list<CableJump> jumps) {
    EXPECT_LT(imbalance(move, jumps, *toy_law, *toy_truth, 100), 4.5);
    EXPECT_LT(imbalance(move, jumps, *toy_sparse_law, *toy_sparse_truth, 0), 4.5);
  }

  static std::vector<Plane>* toy_images;
  static CableLaw *toy_law, *toy_sparse_law;
  static Enumeration *toy_truth, *toy_sparse_truth;
};
std::vector<Plane>* CableMovesToy::toy_images = nullptr;
CableLaw* CableMovesToy::toy_law = nullptr;
CableLaw* CableMovesToy::toy_sparse_law = nullptr;
Enumeration* CableMovesToy::toy_truth = nullptr;
Enumeration* CableMovesToy::toy_sparse_truth = nullptr;

TEST_F(CableMovesToy, HasManyStatesOfAllSizes) {
  EXPECT_GT(toy_truth->num_states(), 5000u);
  double empty = 0, full = 0;
  for (const auto& [name, share] : toy_truth->classes()) {
    if (name.starts_with("counts 000")) empty += share;
    if (name.starts_with("counts 222")) full += share;
  }
  EXPECT_GT(empty, 1e-5);
  EXPECT_GT(full, 1e-3);
}

/// All moves together, from an empty state, visit states as often as their posterior says.
TEST_F(CableMovesToy, AllMovesTogetherReachThePosterior) {
  std::vector<CableMove> moves(10, CableMove::kBirthDeath);
  for (int k = 0; k < kNumCableMoves; ++k)
    if (static_cast<CableMove>(k) != CableMove::kLevel) moves.push_back(static_cast<CableMove>(k));
  EXPECT_LT(distance_of(moves), 0.05);
}
TEST_F(CableMovesToy, BirthDeath) { expect_balance(CableMove::kBirthDeath, {CableJump::kBirth, CableJump::kDeath}); }
TEST_F(CableMovesToy, SplitMerge) { expect_balance(CableMove::kSplitMerge, {CableJump::kSplit, CableJump::kMerge}); }
TEST_F(CableMovesToy, ExtendShrink) {
  expect_balance(CableMove::kExtendShrink, {CableJump::kExtend, CableJump::kShrink});
}
TEST_F(CableMovesToy, ExtendShrinkBack) {
  expect_balance(CableMove::kExtendShrinkBack, {CableJump::kExtend, CableJump::kShrink});
}
TEST_F(CableMovesToy, Swap) { expect_balance(CableMove::kSwap, {CableJump::kSwap}); }
TEST_F(CableMovesToy, Exchange) { expect_balance(CableMove::kExchange, {CableJump::kExchange}); }
TEST_F(CableMovesToy, BridgeCut) { expect_balance(CableMove::kBridge, {CableJump::kBridge, CableJump::kCut}); }
TEST_F(CableMovesToy, WholeBirthKill) {
  expect_balance(CableMove::kWhole, {CableJump::kWholeBirth, CableJump::kWholeKill});
}
TEST_F(CableMovesToy, Refit) { expect_balance(CableMove::kRefit, {CableJump::kRefit}); }
TEST_F(CableMovesToy, Block) { expect_balance(CableMove::kBlock, {CableJump::kBlock}); }
TEST_F(CableMovesToy, Diffuse) { expect_balance(CableMove::kDiffuse, {CableJump::kDiffuse}); }
TEST_F(CableMovesToy, Pair) { expect_balance(CableMove::kPair, {CableJump::kPairRedraw, CableJump::kPairSwap}); }
TEST_F(CableMovesToy, PairFill) {
  expect_balance(CableMove::kPairFill,
                 {CableJump::kPairExtend, CableJump::kPairShrink, CableJump::kPairBridge, CableJump::kPairCut});
}
TEST_F(CableMovesToy, PairTie) { expect_balance(CableMove::kPairTie, {CableJump::kPairMerge, CableJump::kPairSplit}); }

}  // namespace
}  // namespace motex
