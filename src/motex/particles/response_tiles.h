// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/base.h"
#include "motex/particles/filter_bank.h"

namespace motex {

/// Where the residual answers strongest to the dictionary, kept up to date as bases are taken off.
class ResponseTiles {
 public:
  ResponseTiles(Dictionary dictionary, int width, int height);

  /// Everything is computed again when it is next asked for.
  void set_residual(const Plane& residual);
  /// The residual changed on that patch.
  void changed(const Plane& residual, const BasePatch& patch);
  /// The base with the largest |response|; response = its coefficient, 0 when there is nothing left.
  Base strongest(float& response);
  /// The base just given is no good (responses of coarse levels are near the truth, not exact): leave it out until its
  /// surroundings change.
  void reject_strongest();

 private:
  struct Tile {
    int level_idx = 0, left = 0, top = 0;  ///< in tiles' own pixels
    float response = 0;                    ///< signed
    int x = 0, y = 0, filter = 0;
    bool stale = true;
    std::vector<int> rejected;  ///< place · filters + filter
  };
  void compute(Tile& tile);
  void copy_windows(const Plane& plane, const Tile& tile);

  std::vector<LevelFilters> bank_;
  std::vector<Plane> pyramid_;
  std::vector<Tile> tiles_;
  Tile* strongest_ = nullptr;
  std::vector<int> first_tile_, tiles_across_;
  std::vector<float> windows_, responses_;
};

}  // namespace motex
