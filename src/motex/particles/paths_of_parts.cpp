// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/paths_of_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/particles/fit_element_model.h"

namespace motex {
namespace {

constexpr int kLeastInside = 2;           // sights of an element with parts that are whole inside the picture
constexpr std::size_t kLongestPart = 16;  // sights of a path that may be a part's
constexpr double kWithin = 0.5;           // core scales: closer no two elements stay
constexpr double kMostly = 0.7;           // share of its sights
constexpr double kBeside = 4.5;           // core scales

class PathsOfParts {
 public:
  PathsOfParts(BlobFrames& blobs, const ElementModel& model, int width, int height, bool are_turned)
      : are_turned_(are_turned),
        blobs_(blobs),
        model_(model),
        edges_{static_cast<double>(width), static_cast<double>(height)} {}

  void drop(std::vector<SightChain>& chains) const {
    if (are_turned_) drop_twins(chains);
    std::vector<SightChain> kept;
    for (const SightChain& chain : chains)
      if (num_inside(chain) >= kLeastInside && !goes_beside(chain, chains)) kept.push_back(chain);
    chains = std::move(kept);
  }

 private:
  int num_inside(const SightChain& chain) const {
    int num = 0;
    for (std::size_t k = 0; k < chain.sights.size(); ++k) {
      const Blob& blob = blob_at(blobs_, chain, k);
      const double rim = blob.scale();
      num +=
          blob.x > rim && blob.y > rim && blob.x < edges_.width - 1 - rim && blob.y < edges_.height - 1 - rim ? 1 : 0;
    }
    return num;
  }

  /// From a sight to where the path is in its frame, also where that is not seen.
  static double distance(const SightChain& path, const Sight& sight) {
    const auto after = std::lower_bound(path.sights.begin(), path.sights.end(), sight.frame,
                                        [](const Sight& one, int frame) { return one.frame < frame; });
    if (after == path.sights.end() || (after == path.sights.begin() && after->frame != sight.frame)) return 1e300;
    const auto before = after->frame == sight.frame ? after : after - 1;
    const double share =
        after == before ? 0 : static_cast<double>(sight.frame - before->frame) / (after->frame - before->frame);
    return std::hypot((1 - share) * before->x + share * after->x - sight.x,
                      (1 - share) * before->y + share * after->y - sight.y);
  }

  void drop_twins(std::vector<SightChain>& chains) const {
    std::stable_sort(chains.begin(), chains.end(),
                     [](const SightChain& a, const SightChain& b) { return a.sights.size() > b.sights.size(); });
    std::vector<SightChain> kept;
    for (const SightChain& chain : chains) {
      const auto longer =
          std::find_if(kept.begin(), kept.end(), [&](const SightChain& other) { return stays_within(chain, other); });
      if (longer == kept.end())
        kept.push_back(chain);
      else
        add_amplitudes(chain, *longer);
    }
    std::stable_sort(kept.begin(), kept.end(), [](const SightChain& a, const SightChain& b) {
      return a.sights.front().frame < b.sights.front().frame;
    });
    chains = std::move(kept);
  }

  bool stays_within(const SightChain& chain, const SightChain& other) const {
    std::size_t num_within = 0;
    for (const auto& sight : chain.sights)
      num_within += distance(other, sight) < kWithin * blob_at(blobs_, other, 0).scale() ? 1 : 0;
    return static_cast<double>(num_within) > kMostly * static_cast<double>(chain.sights.size());
  }

  void add_amplitudes(const SightChain& from, const SightChain& to) const {
    std::size_t k = 0;
    for (std::size_t i = 0; i < to.sights.size(); ++i) {
      while (k < from.sights.size() && from.sights[k].frame < to.sights[i].frame) ++k;
      if (k == from.sights.size() || from.sights[k].frame != to.sights[i].frame) continue;
      const auto place = static_cast<std::size_t>(to.idx[i]);
      blobs_[static_cast<std::size_t>(to.sights[i].frame)][place].amplitude += blob_at(blobs_, from, k).amplitude;
    }
  }

  bool goes_beside(const SightChain& chain, const std::vector<SightChain>& chains) const {
    const std::size_t num = chain.sights.size();
    if (num > kLongestPart) return false;
    const Sight &first = chain.sights.front(), &last = chain.sights.back();
    const bool comes_in = edges_.is_entering(model_, first.x, first.y) || first.frame == 0;
    const bool goes_out =
        edges_.is_leaving(model_, last.x, last.y) || last.frame + 1 == static_cast<int>(blobs_.size());
    if (comes_in && goes_out) return false;
    std::size_t num_beside = 0;
    for (std::size_t k = 0; k < num; ++k) {
      const double reach = kBeside * blob_at(blobs_, chain, k).scale();
      const bool is_beside = std::any_of(chains.begin(), chains.end(), [&](const SightChain& other) {
        return other.sights.size() > 2 * num && distance(other, chain.sights[k]) < reach;
      });
      num_beside += is_beside ? 1 : 0;
    }
    return 2 * num_beside > num;
  }

  bool are_turned_;
  BlobFrames& blobs_;
  const ElementModel& model_;
  PictureEdges edges_;
};

}  // namespace

void drop_paths_of_parts(std::vector<SightChain>& chains, BlobFrames& blobs, const ElementModel& model, int width,
                         int height, bool are_turned) {
  PathsOfParts(blobs, model, width, height, are_turned).drop(chains);
}

}  // namespace motex
