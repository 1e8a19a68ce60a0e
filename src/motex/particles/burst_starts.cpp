// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/burst_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "motex/core/quantile.h"
#include "motex/particles/bursts.h"
#include "motex/particles/render.h"

namespace motex {
namespace {

constexpr std::size_t kFirstSights = 8;  // that tell how an element looked before
constexpr std::size_t kLeastSights = 4;
constexpr double kOriginVariance = 0.25;   // pixels², of the place of a burst
constexpr std::size_t kLongestPiece = 12;  // sights
constexpr double kBeside = 2;              // half lengths of an element
constexpr double kFaintest = 0.15;         // share of its amplitude that an element keeps where it shares the light

/// Places alone, gaps filled evenly.
Cable places_of(const SightChain& chain) {
  Cable cable;
  cable.first_frame = chain.sights.front().frame;
  for (std::size_t k = 0; k < chain.sights.size(); ++k) {
    const Sight& here = chain.sights[k];
    const Sight& next = chain.sights[std::min(k + 1, chain.sights.size() - 1)];
    for (int t = here.frame; t == here.frame || t < next.frame; ++t) {
      const double share = t == here.frame ? 0 : static_cast<double>(t - here.frame) / (next.frame - here.frame);
      cable.core.push_back({BaseKind::kGaussian,
                            (1 - share) * here.x + share * next.x,
                            (1 - share) * here.y + share * next.y,
                            1,
                            0,
                            {}});
    }
  }
  return cable;
}

std::vector<Burst> bursts_of(const std::vector<SightChain>& chains) {
  std::vector<Cable> cables;
  for (const SightChain& chain : chains) cables.push_back(places_of(chain));
  return find_bursts(cables);
}

/// How far an element of velocity 1 goes in so many frames.
double way(const AxisModel& axis, double frames) {
  return axis.persistence > 0.999 ? frames : (1 - std::pow(axis.persistence, frames)) / (1 - axis.persistence);
}

/// Between the burst and a place later on, so many frames after the burst.
double place_at(const AxisModel& axis, double origin, double later, double frames, double frames_later) {
  const double drift = axis.mean_velocity;
  const double velocity = (later - origin - drift * (frames_later - way(axis, frames_later))) / way(axis, frames_later);
  return origin + velocity * way(axis, frames) + drift * (frames - way(axis, frames));
}

Blob first_look(const SightChain& chain, const BlobFrames& blobs) {
  const std::size_t num = std::min(kFirstSights, chain.sights.size());
  Blob out = blob_at(blobs, chain, 0);
  for (double Blob::*field : {&Blob::log_scale, &Blob::e1, &Blob::e2, &Blob::amplitude}) {
    std::vector<double> values;
    for (std::size_t k = 0; k < num; ++k) values.push_back(blob_at(blobs, chain, k).*field);
    out.*field = median(std::move(values));
  }
  return out;
}

}  // namespace

std::vector<BurstStart> start_in_bursts(std::vector<SightChain>& chains, BlobFrames& blobs, const ElementModel& model) {
  std::vector<BurstStart> starts;
  int burst_idx = 0;
  for (const Burst& burst : bursts_of(chains)) {
    const int frame = std::max(0, static_cast<int>(std::ceil(burst.frame)));
    for (const int idx : burst.cables) {
      SightChain& chain = chains[static_cast<std::size_t>(idx)];
      const int first = chain.sights.front().frame;
      if (first <= frame || chain.sights.size() < kLeastSights) continue;
      const Sight& later = chain.sights[std::min(kFirstSights, chain.sights.size()) - 1];
      Blob blob = first_look(chain, blobs);
      blob.x = place_at(model.x, burst.x, later.x, frame - burst.frame, later.frame - burst.frame);
      blob.y = place_at(model.y, burst.y, later.y, frame - burst.frame, later.frame - burst.frame);
      blob.seen_spread = std::numeric_limits<double>::infinity();
      Sight sight = chain.sights.front();
      sight.x = blob.x;
      sight.y = blob.y;
      sight.place_variance = kOriginVariance;
      sight.frame = frame;
      std::vector<Blob>& found = blobs[static_cast<std::size_t>(frame)];
      chain.sights.insert(chain.sights.begin(), sight);
      chain.idx.insert(chain.idx.begin(), static_cast<int>(found.size()));
      found.push_back(blob);
      starts.push_back({static_cast<std::size_t>(idx), burst_idx, first});
    }
    ++burst_idx;
  }
  return starts;
}

void drop_pieces_of_bursts(std::vector<SightChain>& chains, const BlobFrames& blobs, std::vector<BurstStart>& starts) {
  std::vector<Cable> places;  // of paths that go on
  for (const BurstStart& start : starts)
    if (chains[start.chain].sights.size() > kLongestPiece) places.push_back(places_of(chains[start.chain]));
  const auto is_piece = [&](const SightChain& chain) {
    if (chain.sights.size() > kLongestPiece || chain.sights.back().frame + 1 == static_cast<int>(blobs.size()))
      return false;
    std::size_t num_beside = 0;
    for (std::size_t k = 0; k < chain.sights.size(); ++k) {
      const Sight& sight = chain.sights[k];
      const Blob& blob = blob_at(blobs, chain, k);
      const double reach = kBeside * blob.scale() * std::sqrt(blob.aspect());
      num_beside += std::any_of(places.begin(), places.end(), [&](const Cable& path) {
        return path.covers(sight.frame) &&
               std::hypot(path.at(sight.frame).x - sight.x, path.at(sight.frame).y - sight.y) < reach;
      });
    }
    return 2 * num_beside > chain.sights.size();
  };
  std::vector<std::size_t> new_idx(chains.size(), chains.size());
  std::vector<SightChain> kept;
  for (std::size_t k = 0; k < chains.size(); ++k) {
    if (is_piece(chains[k])) continue;
    new_idx[k] = kept.size();
    kept.push_back(std::move(chains[k]));
  }
  std::erase_if(starts, [&](const BurstStart& start) { return new_idx[start.chain] == chains.size(); });
  for (BurstStart& start : starts) start.chain = new_idx[start.chain];
  chains = std::move(kept);
}

void share_light(const std::vector<BurstStart>& starts, const std::vector<Plane>& left, std::vector<Cable>& cables) {
  std::map<std::pair<int, std::int64_t>, std::vector<Base*>> unseen;
  for (const BurstStart& start : starts) {
    Cable& cable = cables[start.chain];
    for (std::int64_t t = cable.first_frame; t < start.first_seen; ++t)
      unseen[{start.burst, t}].push_back(&cable.core[static_cast<std::size_t>(t - cable.first_frame)]);
  }
  BaseRenderer renderer(1, 1);
  for (auto& [where, bases] : unseen) {
    const Plane& light = left[static_cast<std::size_t>(where.second)];
    Planes sum{Plane(light.width, light.height, 0.0F)};
    for (const Base* base : bases) renderer.add(std::span<const Base>(base, 1), sum);
    double product = 0, energy = 0;
    for (std::size_t i = 0; i < light.values.size(); ++i) {
      product += static_cast<double>(sum[0].values[i]) * static_cast<double>(light.values[i]);
      energy += static_cast<double>(sum[0].values[i]) * static_cast<double>(sum[0].values[i]);
    }
    const double share = energy > 0 ? std::clamp(product / energy, kFaintest, 1.0) : 1;
    for (Base* base : bases) base->coefficients[0] *= static_cast<float>(share);
  }
}

}  // namespace motex
