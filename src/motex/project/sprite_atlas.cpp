// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/sprite_atlas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex {
namespace {

struct Stretch {
  int motif = -1;
  FrameSpan span;
};

std::vector<Stretch> chosen(const PeopleTexture& texture, const SpriteAtlasOptions& options) {
  std::vector<Stretch> out;
  const auto& motifs = texture.alphabet.motifs;
  for (std::size_t k = 0; k < motifs.size(); ++k) {
    const auto& occurrences = motifs[k].occurrences;
    if (occurrences.empty()) continue;
    const auto best =
        std::min_element(occurrences.begin(), occurrences.end(),
                         [](const Occurrence& a, const Occurrence& b) { return a.distance < b.distance; });
    for (const Occurrence& one : occurrences)
      if (options.all || &one == &*best) out.push_back({static_cast<int>(k), {one.start, one.length}});
  }
  const auto& idle = texture.alphabet.idle;
  const auto longest = std::max_element(idle.begin(), idle.end(),
                                        [](const FrameSpan& a, const FrameSpan& b) { return a.length < b.length; });
  const int most = static_cast<int>(std::lround(options.idle_secs * texture.frames_per_sec));
  for (const FrameSpan& one : idle)
    if (most > 0 && (options.all || &one == &*longest))
      out.push_back({-1, {one.start, options.all ? one.length : std::min(one.length, most)}});
  if (out.empty() && options.all) out.push_back({-1, {0, texture.num_frames()}});
  if (out.empty()) throw InvalidInput("the model knows no action to export; --all takes every frame");
  return out;
}

/// Rows of frames, the tallest first.
void pack(SpriteAtlas& atlas, const SpriteAtlasOptions& options) {
  std::vector<std::size_t> order(atlas.frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return atlas.frames[a].height > atlas.frames[b].height; });
  int page = 0, x = 0, y = 0, row = 0;
  for (const std::size_t k : order) {
    AtlasFrame& frame = atlas.frames[k];
    const int width = frame.width + 2 * options.padding, height = frame.height + 2 * options.padding;
    if (width > options.page_size || height > options.page_size)
      throw InvalidInput("--page-size: frame " + std::to_string(frame.source) + " is of " +
                         std::to_string(frame.width) + " × " + std::to_string(frame.height) +
                         " pixels and does not fit on a page");
    if (x + width > options.page_size) x = 0, y += row, row = 0;
    if (y + height > options.page_size) ++page, x = 0, y = 0, row = 0;
    frame.page = page;
    frame.x = x + options.padding;
    frame.y = y + options.padding;
    x += width;
    row = std::max(row, height);
  }
  atlas.num_pages = page + 1;
}

Rgba straight(const PremultipliedRgba& pixel) {
  const int alpha = pixel[3];
  if (alpha == 0) return {0, 0, 0, 0};
  const auto full = [alpha](int value) {
    return static_cast<std::uint8_t>(std::min(255, (value * 255 + alpha / 2) / alpha));
  };
  return {full(pixel[0]), full(pixel[1]), full(pixel[2]), pixel[3]};
}

}  // namespace

SpriteAtlas plan_atlas(const PeopleTexture& texture, SpriteSource& sprites, const SpriteAtlasOptions& options,
                       const JobContext& job) {
  check_options(options);
  SpriteAtlas atlas;
  std::map<int, int> index_of;  // source → index
  const std::vector<Stretch> stretches = chosen(texture, options);
  for (const Stretch& one : stretches)
    for (int frame = one.span.start; frame < one.span.end(); frame += options.every) index_of[frame] = 0;
  for (auto& [source, index] : index_of) {
    job.check_cancelled();
    const auto sprite = sprites.sprite(source);
    index = sprite->empty() ? -1 : static_cast<int>(atlas.frames.size());
    if (sprite->empty()) continue;
    const Silhouette& silhouette = texture.silhouettes[static_cast<std::size_t>(source)];
    AtlasFrame& frame = atlas.frames.emplace_back();
    frame.source = source;
    frame.width = sprite->width, frame.height = sprite->height;
    frame.left = sprite->left, frame.top = sprite->top;
    frame.pivot_x = silhouette.centroid_x - sprite->left;
    frame.pivot_y = silhouette.box.bottom + 1 - sprite->top;
  }
  for (const Stretch& one : stretches) {
    AtlasAction& action = atlas.actions.emplace_back();
    action.motif = one.motif;
    for (int frame = one.span.start; frame < one.span.end(); frame += options.every)
      if (index_of[frame] >= 0) action.frames.push_back(index_of[frame]);
  }
  for (const Cut& cut : texture.cuts.cuts) {
    const auto from = index_of.find(cut.from), to = index_of.find(cut.to);
    if (from != index_of.end() && to != index_of.end() && from->second >= 0 && to->second >= 0)
      atlas.cuts.push_back({from->second, to->second, cut.difference});
  }
  pack(atlas, options);
  return atlas;
}

void draw_atlas(const SpriteAtlas& atlas, SpriteSource& sprites, int page_size,
                const std::function<void(int page, const Image& picture)>& use, const JobContext& job) {
  for (int page = 0; page < atlas.num_pages; ++page) {
    Image picture(page_size, page_size);
    for (const AtlasFrame& frame : atlas.frames) {
      if (frame.page != page) continue;
      job.check_cancelled();
      const auto sprite = sprites.sprite(frame.source);
      for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) picture.at(frame.x + x, frame.y + y) = straight(sprite->at(x, y));
    }
    job.progress("drawing pages", (page + 1.0) / atlas.num_pages);
    use(page, picture);
  }
}

}  // namespace motex
