// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/project/base_sketch.h"
#include "motex/project/decompose_video.h"
#include "motex/video_io/video_writer.h"
#include "options_value.h"
#include "output_file.h"
#include "output_folder.h"
#include "text_table.h"

namespace motex::cli {
namespace {

std::string decibels(double psnr) { return std::isfinite(psnr) ? fixed(psnr, 2) : "exact"; }

std::vector<int> parse_counts(const std::string& text) {
  std::vector<int> counts;
  for (const std::string& word : split_at_commas(text)) {
    parse_value("--counts", word, counts.emplace_back());
    if (counts.back() < 1 || counts.back() > 100000)
      throw InvalidInput("--counts: numbers of bases are 1 … 100000, not " + word);
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  if (counts.empty()) throw InvalidInput("--counts: name at least one number of bases");
  return counts;
}

/// "0100", so that names sort.
std::string padded(int count) {
  std::string digits = std::to_string(count);
  digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
  return digits;
}

Value frame_value(const FrameDecomposition& frame, const std::vector<int>& counts) {
  Value object;
  object["frame"] = frame.frame;
  object["time_secs"] = frame.time_secs;
  object["background"] = name_of(frame.background_kind);
  object["background_psnr"] = frame.background_psnr;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    Value stage;
    stage["bases"] = counts[k];
    stage["bases_found"] = static_cast<std::int64_t>(frame.maps[k].bases.size());
    stage["psnr"] = frame.psnr[k];
    object["stages"].append(std::move(stage));
  }
  return object;
}

void write_png(const std::filesystem::path& path, const Planes& planes) {
  write_file(path, encode_png(to_image(planes)));
}

struct Decompose {
  std::string video, output, counts_text = "100,200,400,800";
  std::int64_t frame = -1;
  bool all = false;
  DecomposeOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("VIDEO", "video file, folder of pictures, pattern (f_%04d.png) or TIFF stack", video);
    arguments.value("-o,--output", "DIR", "folder for the results", output).required = true;
    arguments.value("--frame", "K", "which frame, from 0 (default: the middle one)", frame);
    arguments.toggle("--all", "every frame: tables and videos instead of pictures", all);
    arguments.value("--counts", "N,…", "numbers of bases to stop at (default 100,200,400,800)", counts_text);
    arguments.section("Decomposition");
    arguments.options(options);
  }

  void run(Session& session) {
    const std::vector<int> counts = parse_counts(counts_text);
    if (all && frame >= 0) throw InvalidInput("--all and --frame exclude each other");
    if (frame < -1) throw InvalidInput("--frame: frames count from 0");
    check_output_folder(output, session);
    if (session.flags.dry_run) {
      const VideoReader reader(video, {}, session.job());
      Value object;
      object["width"] = reader.info().width;
      object["height"] = reader.info().height;
      object["output"] = output;
      session.result(object, "");
      return;
    }
    Value object;
    object["video"] = video;
    object["output"] = output;
    object["options"] = options_value(options);
    all ? run_all(counts, object, session) : run_one(counts, object, session);
    session.say("wrote " + output);
  }

 private:
  void run_one(const std::vector<int>& counts, Value& object, Session& session) const {
    const FrameDecomposition result = decompose_frame(video, frame, counts, options, session.job());
    OutputFolder folder(output);
    write_png(folder.file("observed.png"), result.observed);
    write_png(folder.file("background.png"), result.background);
    std::vector<std::vector<std::string>> rows{{"bases", "PSNR dB"}, {"0", decibels(result.background_psnr)}};
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const BaseMap& map = result.maps[k];
      write_file(folder.file("bases_" + padded(counts[k]) + ".csv"),
                 bases_csv_heading(map.num_planes) + bases_csv(map, result.frame));
      write_png(folder.file("reconstruction_" + padded(counts[k]) + ".png"), result.pictures[k]);
      write_picture(folder.file("sketch_" + padded(counts[k]) + ".png"), base_sketch(map));
      rows.push_back({std::to_string(map.bases.size()), decibels(result.psnr[k])});
    }
    write_picture(folder.file("figure.png"), decomposition_figure(result));
    object["frames"].append(frame_value(result, counts));
    write_file(folder.file("decomposition.json"), to_json(object) + "\n");
    folder.commit();
    session.result(object, "frame " + std::to_string(result.frame) + ", background " + name_of(result.background_kind) +
                               "\n" + text_table(rows));
  }

  void run_all(const std::vector<int>& counts, Value& object, Session& session) const {
    OutputFolder folder(output);
    const double rate = VideoReader(video).info().frames_per_sec;
    const WriteVideoOptions write{rate > 0.01 && rate <= 1000 ? rate : 25.0, false};
    AtomicFile bases(folder.file("bases.csv"));
    std::vector<VideoWriter> pictures;
    std::optional<VideoWriter> sketches;
    std::vector<double> sums(counts.size());
    std::int64_t num_frames = 0;
    Value frames = Value::List();
    const auto take = [&](const FrameDecomposition& one) {
      const int width = one.maps[0].width, height = one.maps[0].height;
      const Image sketch = render(base_sketch(one.maps[0]));
      if (num_frames++ == 0) {
        bases.write(bases_csv_heading(one.maps[0].num_planes));
        for (const int count : counts)
          pictures.emplace_back(folder.file("reconstruction_" + padded(count) + ".mp4"), width, height, write);
        sketches.emplace(folder.file("sketch_" + padded(counts[0]) + ".mp4"), sketch.width, sketch.height, write);
        write_png(folder.file("background.png"), one.background);
      }
      bases.write(bases_csv(one.maps.back(), one.frame));
      for (std::size_t k = 0; k < counts.size(); ++k) {
        pictures[k].write(to_image(one.pictures[k]), one.time_secs);
        sums[k] += std::min(one.psnr[k], 100.0);
      }
      sketches->write(sketch, one.time_secs);
      frames.append(frame_value(one, counts));
    };
    decompose_all(video, counts, options, take, session.job());
    bases.commit();
    for (VideoWriter& writer : pictures) writer.finish();
    sketches->finish();
    std::vector<std::vector<std::string>> rows{{"bases", "mean PSNR dB"}};
    for (std::size_t k = 0; k < counts.size(); ++k)
      rows.push_back({std::to_string(counts[k]), decibels(sums[k] / static_cast<double>(num_frames))});
    object["frames"] = std::move(frames);
    write_file(folder.file("decomposition.json"), to_json(object) + "\n");
    folder.commit();
    session.result(object, std::to_string(num_frames) + " frames\n" + text_table(rows));
  }
};

}  // namespace

Command particles_decompose() {
  return make_command<Decompose>(
      {"particles decompose", "a frame as a few hundred blobs, bars and edges on a background",
       "Writes for each number of bases the table of bases, the reconstruction and a sketch of symbols, and says how "
       "near "
       "the reconstruction comes (PSNR over all colours; bases 0 = the background alone).",
       "motex particles decompose snow.mp4 -o snow_bases\n"
       "motex particles decompose snow.mp4 -o snow_bases --frame 40 --counts 100,1000\n"
       "motex particles decompose birds.mp4 -o bird_bases --all --background median\n"
       "motex particles decompose f_%04d.png -o paper --dictionary paper --background flat"});
}

}  // namespace motex::cli
