// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/people/measure_silhouette.h"
#include "motex/people/people_texture.h"
#include "motex/project/simulate_actor.h"

namespace motex::bench {

/// The silhouettes of a simulated actor from his true sprites, as footage of one take.
inline PeopleTexture texture_of(const ActorSimulation& scene, const SimulateActorOptions& options) {
  PeopleTexture texture;
  texture.width = options.width, texture.height = options.height, texture.frames_per_sec = options.frames_per_sec;
  texture.takes = {{"simulated", 0, 0, false, {0, options.frames}}};
  SilhouetteParts parts;
  for (int t = 0; t < options.frames; ++t) texture.silhouettes.push_back(measure_silhouette(scene.sprite(t, 0), parts));
  return texture;
}

}  // namespace motex::bench
