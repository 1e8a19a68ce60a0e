// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "motex/core/job.h"
#include "motex/image/image.h"
#include "motex/people/people_texture.h"
#include "motex/project/people_footage.h"

namespace motex {

/// Pictures of the frames of a people texture, for filmstrips and thumbnails; rising order is cheapest.
class FramePictures {
 public:
  virtual ~FramePictures() = default;
  /// The whole frame as it was filmed, or, where only the actor was kept, the actor on white.
  virtual Image picture(int frame) = 0;
};

struct LoadedPeople {
  PeopleTexture texture;
  std::unique_ptr<FramePictures> pictures;
};

/// Whether the name is that of a model (.motex), to be read as it is; anything else is a video.
bool is_people_model(const std::filesystem::path& path);

/// A model, or a video that is keyed and measured first (read_people_footage); then the alphabet is empty.
LoadedPeople load_people(const std::filesystem::path& path, const PeopleFootageOptions& options = {},
                         const JobContext& job = {});

}  // namespace motex
