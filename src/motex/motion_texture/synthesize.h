// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"
#include "motex/motion/foot_fix.h"
#include "motex/motion_texture/model.h"
#include "motex/motion_texture/play_options.h"

namespace motex {

enum class KeyPoses { kNearest, kRandom };

struct SynthesizeOptions : PlayOptions {
  KeyPoses key_poses = KeyPoses::kNearest;
  double stretch = 0.15;
  std::vector<double> beats;  ///< s, rising: textons begin there (BeatGrid)

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    PlayOptions::visit_fields(self, visit);
    visit(Field{"key_poses", "",
                "next example by nearness of its first poses to the present ones, or at random (the paper)"},
          self.key_poses, Choices{{"nearest", "random"}});
    visit(Field{"stretch", "", "with beats: how much longer or shorter than itself an example is usually played"},
          self.stretch, Range{0, 1});
  }
};

/// One texton that was played: output frames start … start + length − 1, made from that example.
struct PlayedTexton {
  int texton = 0;
  int instance = 0;
  Index start = 0, length = 0;
};

/// Endless dance, frame after frame, in constant memory [MT02 5.1, 5.4]. The model must outlive it.
class Synthesizer {
 public:
  /// path: textons to play first, in order; then (endless == true) the dance goes on at random in the largest connected
  /// part. Empty path: random from the start. Throws InvalidInput for a texton that does not exist.
  Synthesizer(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path = {},
              bool endless = true);
  ~Synthesizer();
  Synthesizer(Synthesizer&&) noexcept;

  /// Writes the next frame into row `frame` of a clip made with make_output_clip. False when a path that is not endless
  /// is over. Amortised cost: one constrained texton per segment.
  bool next(Clip& out, Index frame);
  /// Textons begun since the last call; with planted feet held above the floor, frames come out up to 0.7 s after their
  /// texton began.
  std::vector<PlayedTexton> take_played();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A clip of that many rest-pose frames with the model's skeleton and rate.
Clip make_output_clip(const MotionTexture& model, Index num_frames);

struct SynthesizeReport {
  std::vector<PlayedTexton> played;
  Index longest_copy = 0;  ///< longest run of output frames whose examples follow one another in the source
};

/// num_frames of new dance (0: as long as the path lasts).
Clip synthesize_motion(const MotionTexture& model, Index num_frames, const std::vector<int>& path,
                       const SynthesizeOptions& options, SynthesizeReport& report, const JobContext& job = {});

/// One texton by its dynamics and white noise alone, without end constraint [MT02 5.3, Figure 4].
Clip synthesize_unconstrained(const MotionTexture& model, int texton, Index num_frames,
                              const SynthesizeOptions& options, SynthesizeReport& report);

}  // namespace motex
