// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "motex/core/job.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"
#include "motex/project/keyed_footage.h"

namespace motex {

struct PeopleFootageOptions {
  KeyFootageOptions key;  ///< its `frames`, `cuts` and `shortest_shot` are not looked at
  bool cuts = true;       ///< look for hard cuts; false = the footage is one shot
};

/// One person of a clip, unbroken.
struct FilmedTake {
  Take take;      ///< its `frames` are those of this footage's people texture
  int track = 0;  ///< as the sink was told
  std::vector<Silhouette> silhouettes;
};

/// Who is where in a video.
struct PeopleFootage {
  int width = 0, height = 0;
  double frames_per_sec = 0;
  std::vector<FrameSpan> shots;    ///< of the video
  std::vector<FrameSpan> flashes;  ///< of the video
  std::vector<FilmedTake> takes;   ///< by shot, then from the left, then by time; half a second at least
  Image plate;                     ///< the empty scene of the first shot; no pixels where the footage has alpha
};

/// Told the frames of each track, one after another from its first; a track may turn out to be no take. `sprite` is
/// empty where nobody was seen in between.
using TakeSink = std::function<void(int track, int frame_of_video, const Sprite& sprite)>;

/// Reads a video twice (KeyedFootage): for hard cuts, then shot by shot keyed and taken apart into people
/// (PeopleTracker). Cuts, flashes, people who touch and takes that are left out are told as warnings. Throws
/// InvalidInput: nobody is to be seen for half a second; people overlap throughout; and what KeyedFootage throws.
PeopleFootage read_people_footage(const std::filesystem::path& video, const PeopleFootageOptions& options = {},
                                  const TakeSink& sink = {}, const JobContext& job = {});

/// Takes and silhouettes without alphabet.
PeopleTexture people_texture_of(const PeopleFootage& footage);

}  // namespace motex
