// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/load_people.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/extension.h"
#include "motex/project/people_model_file.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

class VideoPictures : public FramePictures {
 public:
  VideoPictures(const std::filesystem::path& video, std::vector<Take> takes)
      : reader_(video, {}, {}), takes_(std::move(takes)) {}

  Image picture(int frame) override {
    const auto take = std::find_if(takes_.begin(), takes_.end(), [&](const Take& one) {
      return frame >= one.frames.start && frame < one.frames.end();
    });
    if (take == takes_.end()) throw InvalidInput("frame " + std::to_string(frame) + " does not exist");
    const std::int64_t wanted = take->source_start + frame - take->frames.start;
    if (wanted != next_) reader_.seek(wanted);
    VideoFrame read;
    if (!reader_.next(read)) throw InvalidInput("frame " + std::to_string(wanted) + " cannot be read a second time");
    next_ = wanted + 1;
    return std::move(read.image);
  }

 private:
  VideoReader reader_;
  std::vector<Take> takes_;
  std::int64_t next_ = 0;
};

class ModelPictures : public FramePictures {
 public:
  explicit ModelPictures(const PeopleModel& model)
      : footage_(model), width_(model.texture.width), height_(model.texture.height) {}

  Image picture(int frame) override {
    Image image(width_, height_, {255, 255, 255, 255});
    paint(image, *footage_.sprite(frame));
    return image;
  }

 private:
  StoredFootage footage_;
  int width_, height_;
};

}  // namespace

bool is_people_model(const std::filesystem::path& path) { return extension_of(path) == ".motex"; }

LoadedPeople load_people(const std::filesystem::path& path, const PeopleFootageOptions& options,
                         const JobContext& job) {
  LoadedPeople loaded;
  if (is_people_model(path)) {
    PeopleModel model = load_people_model(path);
    loaded.pictures = std::make_unique<ModelPictures>(model);
    loaded.texture = std::move(model.texture);
    return loaded;
  }
  loaded.texture = people_texture_of(read_people_footage(path, options, {}, job));
  loaded.pictures = std::make_unique<VideoPictures>(path, loaded.texture.takes);
  return loaded;
}

}  // namespace motex
