// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motex/core/options.h"
#include "motex/image/planes.h"
#include "motex/particles/cable.h"

namespace motex {

/// The first or last state of a cable.
struct CableEnd {
  double x = 0, y = 0;    ///< pixels
  double vx = 0, vy = 0;  ///< pixels a frame there
  std::int64_t frame = 0;
  std::int32_t cable = 0;  ///< index of the cable
};

/// Elements born together (a firework): births whose lines meet at one place and time.
struct Burst {
  double x = 0, y = 0;      ///< where the paths meet, pixels
  double frame = 0;         ///< when, fractional
  std::vector<int> cables;  ///< indices of its cables
};

/// Sources and sinks, P_B and P_D of [TM02] section 3.
struct BirthDeathMaps {
  int width = 0, height = 0;
  double births_per_frame = 0;  ///< those of bursts left out
  double bursts_per_frame = 0;
  std::vector<CableEnd> births;  ///< that were seen: not those of cables present in the first frame
  std::vector<CableEnd> deaths;  ///< that were seen: not those of cables present in the last frame
  std::vector<Burst> bursts;
  double bandwidth = 0;  ///< deviation of the Parzen window, pixels
  Plane source;          ///< density of births, a pixel; sums to 1 over the picture
  Plane sink;            ///< density of deaths, likewise
  Plane occupancy;       ///< mean number of elements a pixel and frame
  Plane hazard;          ///< probability that an element here dies before the next frame (leaving the picture included)
};

struct MapOptions {
  double bandwidth = 0;
  double prior_elements = 4;
  bool bridge_gaps = true;
  bool find_bursts = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"bandwidth", "pixels",
                "deviation of the Parzen window; auto = where each point is most likely given the others"},
          self.bandwidth, Range{0.5, 1000, true});
    visit(Field{"prior_elements", "elements",
                "weight that the hazard of the wider surroundings has where few elements pass"},
          self.prior_elements, Range{0.1, 1e6});
    visit(Field{"bridge_gaps", "", "births and deaths that only tracking made (gaps, flashes, crossings) are left out"},
          self.bridge_gaps, Range{});
    visit(Field{"find_bursts", "", "births that belong together are bursts, not births"}, self.find_bursts, Range{});
  }
};

/// Sources and sinks of the cables of a clip of num_frames frames ([TM02] section 3, P_B and P_D, projected to x, y).
///
/// Births in the first and deaths in the last frame of the clip are not seen (censored). Parzen window with boundary
/// correction, one bandwidth for all planes. Ends that tracking made (gaps, flashes, elements that cover one another;
/// false_ends.h) are left out.
/// hazard = (D + κ h′) / (O + κ): D, O = deaths and elements (the last frame's left out) within the window's area
/// 4π bandwidth², κ = prior_elements, h′ = the same with a window four times as wide, and so on up to the whole
/// picture. births_per_frame counts births in frames 1 … num_frames − 1. Throws InvalidInput unless sizes and
/// num_frames are positive.
BirthDeathMaps estimate_maps(std::span<const Cable> cables, int width, int height, std::int64_t num_frames,
                             const MapOptions& options = {});

/// The hazard without leaving: of elements whose next place would still lie in the picture.
Plane vanishing_hazard(const BirthDeathMaps& maps, std::span<const Cable> cables, std::int64_t num_frames,
                       double prior_elements = 4);

/// Maps as gray pictures that can be painted. A density (source, sink, occupancy) is scaled so that 255 is its largest
/// value; read back, only proportions count: values are divided by their sum (source, sink) or multiplied so that the
/// sum is `total` (occupancy). A hazard keeps its scale: 255 = certain death, square root in between (grey level
/// 255 √h), so that small hazards can be seen.
Image image_of_density(const Plane& density);
Image image_of_hazard(const Plane& hazard);
/// A picture of another size is resampled (area mean or linear). Colours: the luma. Throws InvalidInput when the
/// picture of a density is black all over, or width or height is not positive.
Plane density_of_image(const Image& picture, int width, int height, double total = 1);
Plane hazard_of_image(const Image& picture, int width, int height);

}  // namespace motex
