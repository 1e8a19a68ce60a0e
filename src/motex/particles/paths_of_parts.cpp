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
constexpr double kBeside = 4.5;           // core scales

class PathsOfParts {
 public:
  PathsOfParts(const BlobFrames& blobs, const ElementModel& model, int width, int height)
      : blobs_(blobs), model_(model), edges_{static_cast<double>(width), static_cast<double>(height)} {}

  void drop(std::vector<SightChain>& chains) const {
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

  const BlobFrames& blobs_;
  const ElementModel& model_;
  PictureEdges edges_;
};

}  // namespace

void drop_paths_of_parts(std::vector<SightChain>& chains, const BlobFrames& blobs, const ElementModel& model, int width,
                         int height) {
  PathsOfParts(blobs, model, width, height).drop(chains);
}

}  // namespace motex
