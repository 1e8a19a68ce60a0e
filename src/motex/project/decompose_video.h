// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/background.h"
#include "motex/particles/pursuit.h"
#include "motex/video_io/video_reader.h"

namespace motex {

struct DecomposeOptions {
  Dictionary dictionary = Dictionary::kExtended;
  BackgroundKind background = BackgroundKind::kAuto;
  int background_frames = 61;
  int refine_steps = 4;
  int refine_rounds = 1;
  double min_coefficient = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"dictionary", "", "paper: LoG, Gcos, Gsin, 200 filters; extended: 8 Gaussians too"}, self.dictionary,
          Choices{{"paper", "extended"}});
    visit(Field{"background", "",
                "what bases are added to: median over time, low (20 % quantile, for fire), smooth (the frame blurred, "
                "for a moving camera), flat (one level, as in the paper); auto: median or smooth"},
          self.background, Choices{{"auto", "median", "low", "smooth", "flat"}});
    visit(
        Field{"background_frames", "frames", "most frames around the one in question that the background is made from"},
        self.background_frames, Range{1, 1001});
    visit(Field{"refine_steps", "", "steps that fit place, scale and angle of each base continuously; 0: on the grid"},
          self.refine_steps, Range{0, 50});
    visit(Field{"refine_rounds", "", "times that all bases are fitted again against what the others leave"},
          self.refine_rounds, Range{0, 20});
    visit(Field{"min_coefficient", "grey levels", "a base whose coefficient is smaller ends the search"},
          self.min_coefficient, Range{0, 1e6});
  }
};

/// One frame as bases on a background.
struct FrameDecomposition {
  std::int64_t frame = 0;
  double time_secs = 0;
  Planes observed;  ///< 1 or 3 planes; alpha is left out
  Planes background;
  BackgroundKind background_kind = BackgroundKind::kMedian;
  std::vector<BaseMap> maps;     ///< one per count
  std::vector<Planes> pictures;  ///< their reconstructions
  std::vector<double> psnr;      ///< of those, dB; infinite when exact
  double background_psnr = 0;    ///< of the background alone
};

/// Frame `frame` (−1 = the middle one) for each number of bases in counts (rising). Only the frames that the background
/// is made from are decoded, besides what a key frame asks for. Throws InvalidInput when there is no such frame.
FrameDecomposition decompose_frame(const std::filesystem::path& video, std::int64_t frame,
                                   const std::vector<int>& counts, const DecomposeOptions& options,
                                   const JobContext& job = {});

/// Every frame in order, on one background made from frames of the whole video; `take` is called from this thread.
/// Returns the number of frames. Memory does not grow with the length.
std::int64_t decompose_all(const std::filesystem::path& video, const std::vector<int>& counts,
                           const DecomposeOptions& options, const std::function<void(const FrameDecomposition&)>& take,
                           const JobContext& job = {});

/// "frame,idx,kind,x,y,scale,angle,coefficient" lines (three coefficients for colour), heading by bases_csv_heading().
std::string bases_csv_heading(int num_planes);
std::string bases_csv(const BaseMap& map, std::int64_t frame);

}  // namespace motex
