// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "commands.h"
#include "motex/core/csv.h"
#include "motex/core/files.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/link_cores.h"
#include "motex/particles/track_score.h"
#include "motex/project/textured_motion_file.h"
#include "motex/project/track_csv.h"
#include "motex/project/track_overlay.h"
#include "motex/project/trackmate_xml.h"
#include "motex/video_io/video_reader.h"
#include "motex/video_io/video_writer.h"
#include "output_file.h"
#include "particles_model.h"
#include "text_table.h"

namespace motex::cli {
namespace {

bool is_video(const std::string& path) {
  const std::vector<std::string> extensions = writable_video_extensions();
  return std::find(extensions.begin(), extensions.end(), extension_of(path)) != extensions.end();
}

/// "snow_Tracks.xml": how TrackMate names its simple table.
bool is_simple_xml(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  constexpr std::string_view kEnd = "_Tracks";
  return stem.size() >= kEnd.size() && stem.compare(stem.size() - kEnd.size(), kEnd.size(), kEnd) == 0;
}

/// The table in micrometres: the columns of tracks_csv() multiplied, and two that say by what.
std::string physical_csv(const std::vector<Track>& tracks, const TrackedClip& clip) {
  std::string text = "track,frame,x,y,scale,angle,amplitude,um_per_pixel,time_secs\n";
  for (const Track& track : tracks)
    for (const TrackPoint& point : track.points) {
      const double size = clip.pixel_size;
      text += std::to_string(track.id) + "," + std::to_string(point.frame);
      for (const double value : {point.x * size, point.y * size, point.scale * size, point.angle, point.amplitude, size,
                                 static_cast<double>(point.frame) * clip.frame_interval})
        text += "," + rounded_text(value, 6);
      text += "\n";
    }
  return text;
}

/// What is written: paths, and what is known of the clip.
struct Followed {
  std::vector<Track> tracks;
  TexturedMotion model;  ///< without cables where points were linked; width 0 = nobody knows
};

/// Detections frame by frame from 0.
std::vector<std::vector<TrackPoint>> by_frame(const std::vector<TrackPoint>& points, const std::string& name) {
  constexpr std::int64_t kMostFrames = 1'000'000;
  std::vector<std::vector<TrackPoint>> frames;
  for (const TrackPoint& point : points) {
    if (point.frame < 0 || point.frame >= kMostFrames)
      throw InvalidInput(name + ": frame " + std::to_string(point.frame) + "; frames count from 0 to " +
                         std::to_string(kMostFrames - 1));
    const auto frame = static_cast<std::size_t>(point.frame);
    if (frames.size() <= frame) frames.resize(frame + 1);
    frames[frame].push_back(point);
  }
  if (frames.empty()) throw InvalidInput(name + ": has no point");
  return frames;
}

struct Tracks {
  std::string model_path, video, detections, size_text;
  std::vector<std::string> outputs;
  std::int64_t first_frame = 0;
  double pixel_size = 0, dt = 0;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "learned by `motex particles learn`; not needed with --detections", model_path)
        .required = false;
    Argument& output = arguments.value(
        "-o,--output", "FILE", "table .csv, TrackMate .xml, or a video of the tracks; may be repeated", outputs);
    output.required = true;
    arguments.section("Linking points");
    arguments.value("--detections", "CSV", "link these points (columns frame, x, y; amplitude, scale if known) instead",
                    detections);
    arguments.value("--size", "WxH", "of the picture that the points are from (default: the model's or the clip's)",
                    size_text);
    arguments.section("Overlay video");
    arguments.value("--video", "CLIP", "draw over this clip (default: over what the model makes of it)", video);
    arguments.value("--first-frame", "K", "frame of CLIP that is frame 0 of the tracks (default 0)", first_frame);
    arguments.section("Units");
    arguments.value("--pixel-size", "UM", "micrometres a pixel: lengths in micrometres (default: pixels)", pixel_size);
    arguments.value("--dt", "SECS", "seconds a frame (default: those of the video that was learned)", dt);
  }

  void run(Session& session) {
    check_request(session);
    Value object;
    const Followed followed = detections.empty() ? of_model() : of_points(object, session.job());
    const TrackedClip clip = described(followed.model);
    if (session.flags.dry_run) return would_write(outputs, followed.model.num_frames, session);
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(outputs.size());
      write(outputs[k], followed, clip, session.job(share, share + 1.0 / static_cast<double>(outputs.size())));
      session.say("wrote " + outputs[k]);
    }
    report(followed.tracks, clip, object, session);
  }

 private:
  void check_request(const Session& session) const {
    std::vector<std::string> extensions{".csv", ".xml"};
    for (const std::string& extension : writable_video_extensions()) extensions.push_back(extension);
    check_outputs(outputs, extensions, session);
    const bool draws = std::any_of(outputs.begin(), outputs.end(), is_video);
    if (model_path.empty() && detections.empty()) throw InvalidInput("name a MODEL, or points by --detections");
    if (!video.empty() && !draws) throw InvalidInput("--video: only for an overlay video, such as -o tracks.mp4");
    if (draws && video.empty() && !detections.empty())
      throw InvalidInput("linked points are drawn over a clip: name it by --video");
    if (!size_text.empty() && detections.empty()) throw InvalidInput("--size: only with --detections");
    if (first_frame < 0) throw InvalidInput("--first-frame: frames count from 0");
    if (pixel_size != 0 && !(pixel_size > 0 && pixel_size < 1e9))
      throw InvalidInput("--pixel-size: micrometres a pixel, above 0");
    if (dt != 0 && !(dt > 0 && dt < 1e9)) throw InvalidInput("--dt: seconds a frame, above 0");
  }

  Followed of_model() const {
    TexturedMotion model = load_particles_model(model_path);
    std::vector<Track> tracks = visible_part(tracks_of(model.cables, model.num_planes), model.width, model.height);
    return {std::move(tracks), std::move(model)};
  }

  Followed of_points(Value& object, const JobContext& job) const {
    Followed followed;
    TexturedMotion& model = followed.model;
    if (!model_path.empty()) model = load_particles_model(model_path);
    if (!video.empty()) {
      const VideoInfo info = VideoReader(video).info();
      model.width = info.width;
      model.height = info.height;
      if (info.frames_per_sec > 0) model.frames_per_sec = info.frames_per_sec;
    }
    if (!size_text.empty()) std::tie(model.width, model.height) = parse_picture_size(size_text);
    const auto frames = by_frame(parse_points_csv(read_file(detections), detections), detections);
    model.num_frames = static_cast<std::int64_t>(frames.size());
    LinkReport report;
    followed.tracks =
        visible_part(link_points(frames, model.width, model.height, {}, &report, job), model.width, model.height);
    object["detections"] = detections;
    object["dropped_detections"] = report.num_dropped;
    object["filled_points"] = report.num_filled;
    object["expected_wrong_share"] = report.expected_wrong_share;
    object["velocity"] = Value::List{report.model.x.mean_velocity, report.model.y.mean_velocity};
    object["persistence"] = Value::List{report.model.x.persistence, report.model.y.persistence};
    return followed;
  }

  bool is_physical() const { return pixel_size > 0 || dt > 0; }

  TrackedClip described(const TexturedMotion& model) const {
    TrackedClip clip;
    const std::filesystem::path source = video.empty() ? model.source : video;
    clip.file_name = source.filename().string();
    if (!source.parent_path().empty())
      clip.folder = std::filesystem::absolute(source).lexically_normal().parent_path().string();
    clip.width = model.width;
    clip.height = model.height;
    clip.num_frames = model.num_frames;
    if (pixel_size > 0) {
      clip.pixel_size = pixel_size;
      clip.length_unit = "micron";
    }
    if (is_physical()) {
      clip.frame_interval = dt > 0 ? dt : 1 / model.frames_per_sec;
      clip.time_unit = "sec";
    }
    return clip;
  }

  void write(const std::string& path, const Followed& followed, const TrackedClip& clip, const JobContext& job) const {
    const std::vector<Track>& tracks = followed.tracks;
    if (is_video(path)) return write_overlay(path, followed.model, tracks, job);
    if (extension_of(path) == ".xml")
      return write_file(path, is_simple_xml(path) ? trackmate_simple_xml(tracks, clip) : trackmate_xml(tracks, clip));
    constexpr int kAnySize = 1 << 30;  // the tracks are cut to the picture already
    write_file(path, is_physical() ? physical_csv(tracks, clip) : tracks_csv(tracks, kAnySize, kAnySize));
  }

  void write_overlay(const std::string& path, const TexturedMotion& model, const std::vector<Track>& tracks,
                     const JobContext& job) const {
    const TrackOverlay overlay(tracks, model.width, model.height);
    VideoWriter writer(path, overlay.width(), overlay.height(), {model.frames_per_sec, false}, job);
    const auto draw = [&](const Image& picture, std::int64_t frame) {
      job.check_cancelled();
      writer.write(overlay.draw(picture, frame));
      job.progress("drawing", static_cast<double>(frame + 1) / static_cast<double>(model.num_frames));
    };
    if (video.empty()) {
      for (std::int64_t frame = 0; frame < model.num_frames; ++frame)
        draw(to_image(reconstructed_frame(model, frame)), frame);
    } else {
      VideoReader reader(video, {}, job);
      reader.seek(first_frame);
      VideoFrame picture;
      std::int64_t frame = 0;
      for (; frame < model.num_frames && reader.next(picture); ++frame) draw(picture.image, frame);
      if (frame == 0) throw InvalidInput(video + ": has no frame " + std::to_string(first_frame));
      if (frame < model.num_frames)
        job.warn(video + " ends " + std::to_string(model.num_frames - frame) + " frames before the tracks do");
    }
    writer.finish();
  }

  void report(const std::vector<Track>& tracks, const TrackedClip& clip, Value& object, Session& session) const {
    std::int64_t num_points = 0;
    for (const Track& track : tracks) num_points += static_cast<std::int64_t>(track.points.size());
    const double per_frame =
        static_cast<double>(num_points) / static_cast<double>(std::max<std::int64_t>(1, clip.num_frames));
    if (!model_path.empty()) object["model"] = model_path;
    object["output"] = outputs;
    object["tracks"] = static_cast<std::int64_t>(tracks.size());
    object["points"] = num_points;
    object["frames"] = clip.num_frames;
    object["points_per_frame"] = per_frame;
    object["length_unit"] = pixel_size > 0 ? "um" : "pixel";
    object["um_per_pixel"] = pixel_size > 0 ? Value(pixel_size) : Value();
    object["secs_per_frame"] = is_physical() ? Value(clip.frame_interval) : Value();
    session.result(object, text_pairs({{"tracks", std::to_string(tracks.size())},
                                       {"points", std::to_string(num_points)},
                                       {"points a frame", fixed(per_frame, 1)},
                                       {"lengths in", pixel_size > 0 ? "micrometres" : "pixels"}}));
  }
};

}  // namespace

Command particles_tracks() {
  return make_command<Tracks>(
      {"particles tracks", "the paths of a model's elements as a table, for TrackMate, or drawn over the clip",
       "Columns of the table: track, frame, x, y, scale, angle, amplitude; pixels, origin at the centre of the top "
       "left "
       "pixel, frames from 0; only points inside the picture. With --pixel-size or --dt lengths are micrometres, and "
       "two "
       "columns more say um_per_pixel and time_secs. NAME.xml opens in TrackMate (ImageJ), NAME_Tracks.xml is its "
       "simple "
       "table.",
       "motex particles tracks snow.motex -o snow.tracks.csv\n"
       "motex particles tracks snow.motex -o snow.csv -o snow.xml -o snow_tracks.mp4 --video snow.mp4\n"
       "motex particles tracks cells.motex -o cells.xml --pixel-size 0.65 --dt 2\n"
       "motex particles tracks --detections spots.csv --size 320x240 -o spots.tracks.csv"});
}

}  // namespace motex::cli
