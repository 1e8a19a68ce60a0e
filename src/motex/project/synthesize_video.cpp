// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/synthesize_video.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/resize.h"
#include "motex/particles/cable_tracks.h"
#include "motex/project/staged_files.h"
#include "motex/project/track_csv.h"
#include "motex/project/video_outputs.h"
#include "motex/video_io/video_writer.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

/// Rows of a frame; counts what lies inside.
class TrackRows {
 public:
  explicit TrackRows(const ParticleVideoShape& shape)
      : table_(shape.width, shape.height), num_planes_(shape.num_base_planes) {}

  std::string of(const MovetonFrame& frame) {
    std::string text;
    for (const Moveton& moveton : frame.movetons) {
      Base core = frame.core_of(moveton);
      core.coefficients[0] = static_cast<float>(luma_coefficient(core, num_planes_));
      const std::int64_t before = table_.num_rows();
      table_.append(moveton.track, {frame.frame, core.x, core.y, core.scale, core.angle, peak_amplitude(core)}, text);
      if (table_.num_rows() > before) tracks_.insert(moveton.track);
    }
    return text;
  }
  std::int64_t num_rows() const { return table_.num_rows(); }
  std::int64_t num_tracks() const { return static_cast<std::int64_t>(tracks_.size()); }

 private:
  TrackCsv table_;
  int num_planes_;
  std::set<std::int64_t> tracks_;
};

Plane cut_to_shape(const Plane& plane, double shape) {
  int width = plane.width, height = plane.height;
  if (width > shape * height)
    width = std::max(1, static_cast<int>(std::lround(shape * height)));
  else
    height = std::max(1, static_cast<int>(std::lround(width / shape)));
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.at(x, y) = plane.at(x + (plane.width - width) / 2, y + (plane.height - height) / 2);
  return out;
}

}  // namespace

ParticleOutputs particle_outputs(const fs::path& video) {
  fs::path whole = video.has_filename() ? video : video.parent_path();
  std::string stem = writes_pictures(whole) ? whole.filename().string() : whole.stem().string();
  if (const std::size_t mark = stem.find('%'); mark != std::string::npos) {
    stem.resize(mark);
    while (!stem.empty() && (stem.back() == '_' || stem.back() == '-' || stem.back() == '.')) stem.pop_back();
    if (stem.empty()) stem = "frames";
  }
  return {video, whole.parent_path() / (stem + ".tracks.csv"), whole.parent_path() / (stem + ".layer.mov")};
}

Planes magnified_background(const TexturedMotion& model, double magnification, const Image* replacement) {
  if (!(magnification >= 1.0 / 64 && magnification <= 64))
    throw InvalidInput("the resolution can be magnified 1/64 to 64 times, not " + std::to_string(magnification));
  const auto side = [magnification](int pixels) {
    const double wanted = std::round(pixels * magnification);
    if (wanted < 1 || wanted > 16384)
      throw InvalidInput("a video has sides of 1 to 16384 pixels, not " + std::to_string(wanted));
    return static_cast<int>(wanted);
  };
  const int width = side(model.width), height = side(model.height);
  if (replacement == nullptr) return resized(model.background, width, height);
  Planes planes = to_planes(*replacement, is_grey(*replacement) && model.num_planes == 1 ? 1 : 3);
  for (Plane& plane : planes) {
    plane = cut_to_shape(plane, static_cast<double>(width) / height);
    plane = resized(plane, width, height);
  }
  return planes;
}

ParticleVideoReport write_particle_video(const ParticleVideoShape& shape, MovetonSource& source, FramePainter& painter,
                                         std::int64_t num_frames, const ParticleOutputs& outputs,
                                         const JobContext& job) {
  StagedFiles staged;
  const fs::path video_path = writes_pictures(outputs.video) ? outputs.video : staged.stage(outputs.video);
  const fs::path layer_path = staged.stage(outputs.layer);
  AtomicFile table(staged.stage(outputs.tracks));
  table.write(TrackCsv::heading());
  TrackRows rows(shape);
  std::optional<VideoWriter> video, layer;
  const JobContext saying = staged.naming_targets(job);
  ParticleVideoReport report;
  MovetonFrame frame;
  Image picture, alone;
  for (std::int64_t t = 0; t < num_frames && source.next_frame(frame); ++t) {
    job.check_cancelled();
    painter.paint(frame, picture, alone);
    if (!video) {
      report.width = picture.width;
      report.height = picture.height;
      video.emplace(video_path, picture.width, picture.height, WriteVideoOptions{shape.frames_per_sec, false}, saying);
      layer.emplace(layer_path, picture.width, picture.height, WriteVideoOptions{shape.frames_per_sec, true}, saying);
    }
    video->write(picture);
    layer->write(alone);
    table.write(rows.of(frame));
    report.bases_per_frame += static_cast<double>(frame.bases.size());
    ++report.num_frames;
    job.progress("drawing", static_cast<double>(t + 1) / static_cast<double>(num_frames));
  }
  if (!video) throw InvalidInput("there is no frame to write");
  table.commit();
  layer->finish();
  video->finish();
  staged.commit();
  report.num_tracks = rows.num_tracks();
  report.elements_per_frame = static_cast<double>(rows.num_rows()) / static_cast<double>(report.num_frames);
  report.bases_per_frame /= static_cast<double>(report.num_frames);
  return report;
}

}  // namespace motex
