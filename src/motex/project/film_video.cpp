// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/film_video.h"

#include "motex/project/key_video.h"
#include "motex/project/video_outputs.h"

namespace motex {

FilmVideoReport write_film_video(const PeopleModel& model, const EditList& edits, const RenderFilmOptions& options,
                                 Backdrop* backdrop, const std::vector<std::filesystem::path>& outputs,
                                 const JobContext& job) {
  const PeopleTexture& texture = model.texture;
  StoredFootage footage(model);
  FilmRenderer film(texture, footage, edits, options, job);
  VideoOutputs videos(outputs, texture.width, texture.height, {texture.frames_per_sec, backdrop == nullptr}, job);
  FilmVideoReport report;
  Image image;
  for (Sprite sprite; film.next(sprite); ++report.num_frames) {
    job.check_cancelled();
    if (backdrop != nullptr) {
      image = backdrop->frame(report.num_frames);
      paint(image, sprite);
    } else {
      to_straight_image(sprite, texture.width, texture.height, image);
    }
    videos.write(image);
    job.progress("drawing the film", static_cast<double>(report.num_frames + 1) / film.num_frames());
  }
  videos.finish();
  report.cuts = film.cuts();
  return report;
}

void complete_cuts(PeopleModel& model, const JobContext& job) {
  if (!model.texture.cuts.cuts.empty()) return;
  StoredFootage footage(model);
  const ComparableFrames frames = comparable_frames(model.texture, footage, job.part(0, 0.9));
  model.texture.cuts = find_cuts(model.texture, frames, {}, job.part(0.9, 1)).cuts;
}

}  // namespace motex
