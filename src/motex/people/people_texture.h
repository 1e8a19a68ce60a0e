// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/people/edit_list.h"
#include "motex/people/motif.h"
#include "motex/people/silhouette.h"

namespace motex {

/// An unbroken view of one person: no hard cut inside. Matching windows, playing film and morphs stay inside a take or
/// go from one to another by a cut.
struct Take {
  std::string source;     ///< file name of the clip
  int source_start = 0;   ///< frame of the clip that is the first of the take
  int person = 0;         ///< of the clip, from the left, from 0
  bool mirrored = false;  ///< seen in a mirror: left and right changed (of another take's frames)
  FrameSpan frames;       ///< in the people texture: takes follow one another without gaps
};

/// What is learned from footage of an actor: who is where in every frame, and what repeats. The pictures come from a
/// SpriteSource with the same frame numbers. [PT04]
struct PeopleTexture {
  int width = 0, height = 0;  ///< of the film, pixels
  double frames_per_sec = 0;
  std::vector<Take> takes;
  std::vector<Silhouette> silhouettes;  ///< one a frame of all takes
  MotifSet alphabet;
  CutSet cuts;  ///< what films are cut at; empty = not looked for (find_cuts)

  int num_frames() const { return static_cast<int>(silhouettes.size()); }
};

}  // namespace motex
