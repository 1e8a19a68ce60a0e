// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/crowd.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/core/rng.h"
#include "motex/people/warp_sprites.h"

namespace motex {
namespace {

/// Where an actor stands in the footage.
struct Stand {
  double x = 0, floor = 0;
};

Stand stand_of(const PeopleTexture& texture) {
  std::vector<double> xs, floors;
  for (const Silhouette& one : texture.silhouettes) {
    if (one.empty()) continue;
    xs.push_back(one.centroid_x);
    floors.push_back(one.box.bottom + 0.5);
  }
  if (xs.empty()) throw InvalidInput("a model in which nobody is seen makes no crowd");
  return {quantile(xs, 0.5), quantile(floors, 0.5)};
}

}  // namespace

struct Crowd::Player {
  Player(const PeopleModel& model, const EditList& edits, const RenderFilmOptions& render)
      : footage(model), renderer(model.texture, footage, edits, render, JobContext{{}, {}, nullptr, 1}) {}
  StoredFootage footage;
  FilmRenderer renderer;
  Placement placement;
  bool mirrored = false;
  int width = 0;
  Sprite own, shown;

  bool advance() {
    if (!renderer.next(own)) return false;
    shown = placed(mirrored ? motex::mirrored(own, width) : own, placement);
    return true;
  }
};

Crowd::Crowd(const std::vector<PeopleModel>& models, int num_frames, const CrowdOptions& options,
             const PlayOptions& playing, const RenderFilmOptions& render, const JobContext& job)
    : num_left_(num_frames), job_(job) {
  check_options(options);
  if (models.empty()) throw InvalidInput("a crowd needs a model");
  width_ = models[0].texture.width, height_ = models[0].texture.height;
  const double floor = stand_of(models[0].texture).floor, horizon = options.horizon * height_;
  Rng rng(options.seed);
  std::vector<int> places(static_cast<std::size_t>(options.people));
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = static_cast<int>(k);
  for (std::size_t k = places.size(); k > 1; --k) std::swap(places[k - 1], places[rng.below(k)]);
  for (int k = 0; k < options.people; ++k) {
    job.check_cancelled();
    // Evenly in depth and across, a little disturbed; the farthest first.
    Extra& extra = extras_.emplace_back();
    extra.model = k % static_cast<int>(models.size());
    const PeopleTexture& texture = models[static_cast<std::size_t>(extra.model)].texture;
    if (std::abs(texture.frames_per_sec / models[0].texture.frames_per_sec - 1) > 0.01)
      throw InvalidInput("the models of a crowd must have one frame rate");
    const double away = options.people == 1 ? 0 : 1 - (k + rng.uniform(0, 0.5)) / (options.people - 0.5);
    extra.scale = 1 - options.depth * std::clamp(away, 0.0, 1.0);
    extra.mirrored = options.mirror && places[static_cast<std::size_t>(k)] % 2 == 1;
    extra.x = width_ * (places[static_cast<std::size_t>(k)] + rng.uniform(0.25, 0.75)) / options.people;
    extra.feet = horizon + extra.scale * (floor - horizon);
    PlayOptions own = playing;
    own.seed = Rng(options.seed).fork(static_cast<std::uint64_t>(k) + 1).next_u64() >> 16;
    extra.edits = play(texture, num_frames, own);
    const Stand stand = stand_of(texture);
    auto player = std::make_unique<Player>(models[static_cast<std::size_t>(extra.model)], extra.edits, render);
    const double stand_x = extra.mirrored ? texture.width - 1 - stand.x : stand.x;
    player->placement = {extra.scale, extra.x - extra.scale * stand_x, extra.feet - extra.scale * stand.floor};
    player->mirrored = extra.mirrored;
    player->width = texture.width;
    players_.push_back(std::move(player));
  }
}

Crowd::~Crowd() = default;

bool Crowd::next(Image& picture) {
  if (num_left_ <= 0) return false;
  --num_left_;
  parallel_for(job_.jobs, static_cast<int>(players_.size()), [&](int k) {
    Player& player = *players_[static_cast<std::size_t>(k)];
    if (!player.advance()) player.shown = {};
  });
  for (const auto& player : players_) paint(picture, player->shown);
  return true;
}

}  // namespace motex
