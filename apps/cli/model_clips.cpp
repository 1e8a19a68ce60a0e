// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "model_clips.h"

#include <cmath>

#include "motex/motion/length_unit.h"
#include "motex/project/load_clips.h"
#include "text_table.h"

namespace motex::cli {

std::vector<Clip> load_clips_for(const MotionTexture& model, const std::vector<std::string>& paths,
                                 const ReadClipOptions& read, Session& session) {
  std::vector<Clip> clips = load_clips({paths.begin(), paths.end()}, read, session.job(0, 0.2));
  const double wanted = model.frame_time_secs();
  for (Clip& clip : clips) {
    const std::string difference = skeleton_difference(model.features.skeleton, clip.skeleton);
    if (!difference.empty()) throw InvalidInput(clip.name + " is of another skeleton than the model: " + difference);
    match_unit(clip, model.features.skeleton, session.job(0, 0.2));
    if (std::abs(clip.frame_time_secs - wanted) <= 1e-3 * wanted) {
      clip.frame_time_secs = wanted;
      continue;
    }
    session.warn(clip.name + ": changed from " + fixed(clip.frame_rate(), 2) + " Hz to the model's " +
                 fixed(1 / wanted, 2) + " Hz");
    clip = resample(clip, wanted);
  }
  return clips;
}

}  // namespace motex::cli
