// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/image/image.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"

namespace motex {

struct SpriteAtlasOptions {
  int page_size = 2048;
  int padding = 2;
  int every = 1;
  double idle_secs = 2;
  bool all = false;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"page_size", "pixels", "side of a page"}, self.page_size, Range{64, 16384});
    visit(Field{"padding", "pixels", "empty rim about every frame"}, self.padding, Range{0, 64});
    visit(Field{"every", "", "take one frame in so many"}, self.every, Range{1, 60});
    visit(Field{"idle_secs", "s", "of standing that are exported"}, self.idle_secs, Range{0, 60});
    visit(Field{"all", "", "every time that an action is performed, and all standing, not just the best of each"},
          self.all, Range{});
  }
};

/// A frame on a page. Lengths in pixels.
struct AtlasFrame {
  int source = 0;              ///< frame of the people texture
  int page = 0, x = 0, y = 0;  ///< top left corner on its page
  int width = 0, height = 0;
  int left = 0, top = 0;            ///< of that corner in the film
  double pivot_x = 0, pivot_y = 0;  ///< from that corner: the middle of the body over the floor it stands on
};

struct AtlasAction {
  int motif = -1;           ///< in the alphabet; −1 = standing
  std::vector<int> frames;  ///< indices of frames, in the order of play
};

/// From the end of one exported frame straight to another.
struct AtlasCut {
  int from = 0, to = 0;   ///< indices of frames
  double difference = 0;  ///< as Cut::difference
};

struct SpriteAtlas {
  int num_pages = 0;
  std::vector<AtlasFrame> frames;  ///< by rising source
  std::vector<AtlasAction> actions;
  std::vector<AtlasCut> cuts;
};

/// Chooses frames, of each motif the time that lies nearest to its exemplar and the longest stretch of standing, and
/// packs them on square pages, tallest first, row after row. Throws InvalidInput when there is nothing to export or a
/// frame is larger than a page.
SpriteAtlas plan_atlas(const PeopleTexture& texture, SpriteSource& sprites, const SpriteAtlasOptions& options = {},
                       const JobContext& job = {});

/// Draws the pages one after another, colours not premultiplied, transparent between frames.
void draw_atlas(const SpriteAtlas& atlas, SpriteSource& sprites, int page_size,
                const std::function<void(int page, const Image& picture)>& use, const JobContext& job = {});

}  // namespace motex
