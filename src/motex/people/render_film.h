// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/edit_list.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"
#include "motex/people/warp_sprites.h"

namespace motex {

/// How the frames of a transition are made; kAuto: by the least measured error of those that are smooth.
enum class TransitionRenderer { kAuto, kFieldMorph, kFlow, kCrossDissolve, kHardCut };
/// "auto", "morph", "flow", "dissolve", "cut".
const char* name_of(TransitionRenderer renderer);

/// Where the feature lines of the morph come from: pieces of the outline and limbs, or the paper's fixed edges of the
/// bounding box.
enum class MorphLines { kOutline, kEdges };

struct RenderFilmOptions {
  TransitionRenderer renderer = TransitionRenderer::kAuto;
  MorphLines lines = MorphLines::kOutline;
  bool align = true;
  double max_error = 60;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"renderer", "",
                "how the frames of a transition are made; auto: the one with the least error that is smooth"},
          self.renderer, Choices{{"auto", "morph", "flow", "dissolve", "cut"}});
    visit(
        Field{"lines", "", "feature lines of the morph: the outline and limbs, or the fixed edges of the bounding box"},
        self.lines, Choices{{"outline", "edges"}});
    visit(Field{"align", "", "put the second take where the first one is, and ease it back"}, self.align, Range{});
    visit(Field{"max_error", "grey levels",
                "with a larger error of every renderer there is a hard cut, where that is smooth"},
          self.max_error, Range{0, 255});
  }
};

/// What was done at a cut.
struct CutReport {
  int cut = 0;                ///< in the list of cuts
  int transition_frames = 0;  ///< that it really has
  TransitionRenderer renderer = TransitionRenderer::kHardCut;
  /// Root mean square between the two takes as each renderer brings them together half way (R, G, B, alpha, over the
  /// pixels of either, grey levels); −1: not tried. The last one is without any warp.
  double morph_error = -1, flow_error = -1, dissolve_error = -1;
  double flow_consistency = 0;  ///< share of the pixels from which flow there and back ends where it began
  Placement placement;          ///< of the take that is entered, in pixels of the film
  int num_lines = 0;            ///< of the morph in its middle frame
};

/// A film, frame by frame and in order; a few frames are in memory at a time.
///
///   FilmRenderer film(texture, sprites, edits);
///   for (Sprite sprite; film.next(sprite);) paint(frame, sprite);
///
/// At a cut the take that is entered is put where it lies best on the one that is left (align_sprites()), stays there
/// through the transition, and is eased back afterwards (CarriedPlacement); a loop ends where it began. texture,
/// sprites and edits must outlive it. [PT04] section 3.2
class FilmRenderer {
 public:
  /// Throws InvalidInput for an edit list that does not fit (film_frames()) or sprites of another number.
  FilmRenderer(const PeopleTexture& texture, SpriteSource& sprites, const EditList& edits,
               const RenderFilmOptions& options = {}, const JobContext& job = {});
  ~FilmRenderer();
  FilmRenderer(const FilmRenderer&) = delete;
  FilmRenderer& operator=(const FilmRenderer&) = delete;

  int num_frames() const;
  /// The next frame, at its place in the film; false after the last. Throws Cancelled, and what the sprites throw.
  bool next(Sprite& sprite);
  /// Of the cuts shown so far, in the order of the film; a loop's last cut comes first where it has a transition.
  const std::vector<CutReport>& cuts() const;

 private:
  class Playback;
  std::unique_ptr<Playback> playback_;
};

}  // namespace motex
