// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/crowd.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/core/rng.h"
#include "motex/people/direct.h"
#include "motex/people/script.h"
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

/// The film of one who has that many frames.
EditList film_of(const PeopleTexture& texture, const Cue& cue, int num_frames, const PlayOptions& playing) {
  if (cue.script.empty()) return play(texture, num_frames, playing);
  std::vector<Direction> script = parse_script(cue.script, texture.alphabet);
  Direction rest{Direction::Kind::kAny};
  rest.secs = num_frames / texture.frames_per_sec;
  script.push_back(rest);
  DirectOptions options;
  static_cast<ShotOptions&>(options) = playing;
  options.max_latency_secs = playing.max_latency_secs, options.seed = playing.seed;
  return direct(texture, script, options).edits;
}

}  // namespace

std::vector<Cue> parse_cues(std::string_view text, const std::string& name) {
  std::vector<Cue> cues;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line.erase(std::min(line.find('#'), line.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const std::size_t end = std::min(line.find_first_of(" \t\r", first), line.size());
    Cue cue;
    const auto [rest, error] = std::from_chars(&line[first], line.data() + end, cue.start_secs);
    if (error != std::errc{} || rest != line.data() + end || !(cue.start_secs >= 0 && cue.start_secs <= 36000))
      throw ParseError(name, ParseError::Unit::kLine, number,
                       "a line begins with the time in seconds at which somebody comes, 0 to 36000, not with '" +
                           line.substr(first, end - first) + "'");
    const std::size_t script = std::min(line.find_first_not_of(" \t\r", end), line.size());
    cue.script = line.substr(script, line.find_last_not_of(" \t\r") + 1 - script);
    cues.push_back(cue);
  }
  return cues;
}

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
             const PlayOptions& playing, const RenderFilmOptions& render, const JobContext& job,
             const std::vector<Cue>& cues)
    : num_frames_(num_frames), job_(job) {
  check_options(options);
  if (models.empty()) throw InvalidInput("a crowd needs a model");
  if (cues.size() > static_cast<std::size_t>(options.people))
    throw InvalidInput("there are " + std::to_string(cues.size()) + " cues for a crowd of " +
                       std::to_string(options.people));
  width_ = models[0].texture.width, height_ = models[0].texture.height;
  const double floor = stand_of(models[0].texture).floor, horizon = options.horizon * height_;
  Rng rng(options.seed);
  extras_.reserve(static_cast<std::size_t>(options.people));  // renderers keep hold of their edits
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
    const Cue cue = static_cast<std::size_t>(k) < cues.size() ? cues[static_cast<std::size_t>(k)] : Cue{};
    extra.start = static_cast<int>(std::lround(cue.start_secs * texture.frames_per_sec));
    extra.edits = film_of(texture, cue, std::max(1, num_frames - extra.start), own);
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
  if (time_ >= num_frames_) return false;
  parallel_for(job_.jobs, static_cast<int>(players_.size()), [&](int k) {
    Player& player = *players_[static_cast<std::size_t>(k)];
    if (time_ < extras_[static_cast<std::size_t>(k)].start || !player.advance()) player.shown = {};
  });
  ++time_;
  for (const auto& player : players_) paint(picture, player->shown);
  return true;
}

}  // namespace motex
