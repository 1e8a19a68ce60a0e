// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/response_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "motex/core/gemm.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr int kTileSide = 8;
constexpr int kTileArea = kTileSide * kTileSide;
constexpr int kTaps = kFilterWindow * kFilterWindow;
// Responses further than this from a base that was taken off change too little to be worth computing again.
constexpr int kInfluence = 5;

}  // namespace

ResponseTiles::ResponseTiles(Dictionary dictionary, int width, int height)
    : bank_(make_filter_bank(dictionary, width, height)), windows_(kTileArea * kTaps) {
  std::size_t most = 0;
  for (std::size_t k = 0; k < bank_.size(); ++k) {
    const int step = bank_[k].step;
    const int level_width = (width + step - 1) / step, level_height = (height + step - 1) / step;
    first_tile_.push_back(static_cast<int>(tiles_.size()));
    tiles_across_.push_back((level_width + kTileSide - 1) / kTileSide);
    for (int top = 0; top < level_height; top += kTileSide)
      for (int left = 0; left < level_width; left += kTileSide)
        tiles_.push_back({static_cast<int>(k), left, top, 0, 0, 0, 0, true, {}});
    most = std::max(most, bank_[k].bases.size());
  }
  first_tile_.push_back(static_cast<int>(tiles_.size()));
  responses_.resize(kTileArea * most);
}

void ResponseTiles::set_residual(const Plane& residual) {
  pyramid_ = gaussian_pyramid(residual, bank_.back().level + 1);
  for (Tile& tile : tiles_) {
    tile.stale = true;
    tile.rejected.clear();
    tile.response = 1e30F;
  }
}

void ResponseTiles::changed(const Plane& residual, const BasePatch& patch) {
  int left = patch.left, top = patch.top, right = patch.left + patch.width - 1, bottom = patch.top + patch.height - 1;
  for (int y = top; y <= bottom; ++y) std::copy_n(residual.row(y) + left, patch.width, pyramid_[0].row(y) + left);
  const int inset_x = patch.width / 6, inset_y = patch.height / 6;  // the outskirts of a base are faint
  for (std::size_t k = 0; k < pyramid_.size(); ++k) {
    if (k > 0) {
      left = (left - 2) / 2, top = (top - 2) / 2, right = (right + 3) / 2, bottom = (bottom + 3) / 2;
      update_half(pyramid_[k - 1], pyramid_[k], left, top, right, bottom);
    }
    for (std::size_t b = 0; b < bank_.size(); ++b) {
      if (bank_[b].level != static_cast<int>(k)) continue;
      const int step = bank_[b].step, across = tiles_across_[b];
      const int down = (first_tile_[b + 1] - first_tile_[b]) / across;
      const auto tile_of = [step](int pixel, int margin, int count) {
        return std::clamp((pixel / step + margin + kTileSide) / kTileSide - 1, 0, count - 1);
      };
      const int first_x = tile_of(patch.left + inset_x, -kInfluence, across);
      const int last_x = tile_of(patch.left + patch.width - inset_x, kInfluence, across);
      const int first_y = tile_of(patch.top + inset_y, -kInfluence, down);
      const int last_y = tile_of(patch.top + patch.height - inset_y, kInfluence, down);
      for (int y = first_y; y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) {
          Tile& tile = tiles_[static_cast<std::size_t>(first_tile_[b] + y * across + x)];
          tile.stale = true;
          tile.rejected.clear();
        }
    }
  }
}

void ResponseTiles::copy_windows(const Plane& plane, const Tile& tile) {
  float* out = windows_.data();
  for (int y = tile.top; y < tile.top + kTileSide; ++y)
    for (int x = tile.left; x < tile.left + kTileSide; ++x)
      for (int dy = -kFilterReach; dy <= kFilterReach; ++dy, out += kFilterWindow) {
        const int row = y + dy, first = std::max(0, x - kFilterReach),
                  end = std::min(plane.width, x + kFilterReach + 1);
        if (row < 0 || row >= plane.height || first >= end) {
          std::fill_n(out, kFilterWindow, 0.0F);
          continue;
        }
        if (end - first < kFilterWindow) std::fill_n(out, kFilterWindow, 0.0F);
        std::memcpy(out + (first - x + kFilterReach), plane.row(row) + first,
                    static_cast<std::size_t>(end - first) * sizeof(float));
      }
}

void ResponseTiles::compute(Tile& tile) {
  const LevelFilters& filters = bank_[static_cast<std::size_t>(tile.level_idx)];
  const Plane& plane = pyramid_[static_cast<std::size_t>(filters.level)];
  copy_windows(plane, tile);
  const auto num = static_cast<Index>(filters.bases.size());
  gemm(false, false, kTileArea, num, kTaps, 1.0F, windows_.data(), kTaps, filters.taps.data(), num, 0.0F,
       responses_.data(), num);
  tile.response = 0;
  tile.stale = false;
  const float* response = responses_.data();
  for (int k = 0; k < kTileArea; ++k) {
    const int x = tile.left + k % kTileSide, y = tile.top + k / kTileSide;
    const bool inside = x < plane.width && y < plane.height;
    for (int j = 0; j < num; ++j, ++response) {
      if (!inside || std::abs(*response) <= std::abs(tile.response)) continue;
      if (!tile.rejected.empty() &&
          std::find(tile.rejected.begin(), tile.rejected.end(), k * static_cast<int>(num) + j) != tile.rejected.end())
        continue;
      tile.response = *response;
      tile.x = x;
      tile.y = y;
      tile.filter = j;
    }
  }
}

Base ResponseTiles::strongest(float& response) {
  for (;;) {
    Tile* best = tiles_.data();
    for (Tile& tile : tiles_)
      if (std::abs(tile.response) > std::abs(best->response)) best = &tile;
    if (best->stale) {
      compute(*best);
      continue;
    }
    strongest_ = best;
    const LevelFilters& filters = bank_[static_cast<std::size_t>(best->level_idx)];
    Base base = filters.bases[static_cast<std::size_t>(best->filter)];
    base.x = best->x * filters.step;
    base.y = best->y * filters.step;
    response = best->response;
    return base;
  }
}

void ResponseTiles::reject_strongest() {
  Tile& tile = *strongest_;
  const auto num = static_cast<int>(bank_[static_cast<std::size_t>(tile.level_idx)].bases.size());
  tile.rejected.push_back((tile.x - tile.left + kTileSide * (tile.y - tile.top)) * num + tile.filter);
  tile.stale = true;
}

}  // namespace motex
