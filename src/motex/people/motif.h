// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace motex {

/// Stretch of frames: start … start + length − 1.
struct FrameSpan {
  int start = 0;
  int length = 0;
  int end() const { return start + length; }
  friend bool operator==(const FrameSpan&, const FrameSpan&) = default;
};

/// One time that a motif is performed.
struct Occurrence {
  int start = 0;        ///< first frame
  int length = 0;       ///< frames
  double distance = 0;  ///< to the exemplar: Euclidean between z-normalised windows / √window
};

/// An action that is repeated. [PT04] section 2.2
struct Motif {
  std::string letter;                   ///< "A", "B", … "Z", "AA": by rank, the most often performed first
  std::string name;                     ///< "high kick"; empty until someone names it
  int window = 0;                       ///< frames compared
  double distance = 0;                  ///< of its closest pair, / √window
  double radius = 0;                    ///< R, / √window: occurrences lie within it
  int exemplar = 0;                     ///< first frame of the occurrence that the others are compared with
  std::vector<Occurrence> occurrences;  ///< rising, apart from one another
};

/// What repeats in a series: the action alphabet.
struct MotifSet {
  std::vector<Motif> motifs;    ///< what passes the test of significance, by number of occurrences
  std::vector<FrameSpan> idle;  ///< where nothing happens
};

}  // namespace motex
