// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Movetons around cores that follow the true tracks of a scene: PSNR with cores alone and with coils, bases per
// element, species, poses and their transitions against the truth, processor seconds.
//   particles_movetons [VIDEO TRACKS.csv|MODEL.motex]...   cores of the tracks, or of a learned model
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/particle_clips.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/background.h"
#include "motex/particles/coils.h"
#include "motex/particles/pursuit.h"
#include "motex/particles/refine.h"
#include "motex/particles/regroup.h"
#include "motex/particles/templates.h"
#include "motex/project/load_video_clip.h"
#include "motex/project/textured_motion_file.h"
#include "motex/project/track_csv.h"

namespace motex {
namespace {

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Planes background_of(const ClipFrames& clip) {
  std::vector<Planes> frames;
  for (std::size_t i = 0; i < clip.luma.size(); i += std::max<std::size_t>(1, clip.luma.size() / 61))
    frames.push_back(clip.colour.empty() ? Planes{clip.luma[i]} : to_planes(clip.colour[i], 3));
  return quantile_over_time(frames, 0.5);
}

/// One Gaussian core a point, fitted to the picture; runs of consecutive frames. ids: of the tracks they are from.
std::vector<Cable> cables_of(const std::vector<Track>& tracks, const ClipFrames& clip, const Planes& background,
                             std::vector<std::int64_t>& ids) {
  std::vector<Plane> residuals = clip.luma;
  const Plane grey = luma(background);
  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < grey.values.size(); ++i) plane.values[i] -= grey.values[i];
  std::vector<Cable> out;
  for (const Track& track : tracks) {
    std::int64_t last = -2;
    std::vector<std::size_t> begins;
    for (const TrackPoint& point : track.points) {
      if (point.frame < 0 || point.frame >= clip.num_frames() || point.amplitude == 0) continue;
      if (point.x < 0 || point.y < 0 || point.x > clip.width - 1 || point.y > clip.height - 1) continue;
      if (point.frame != last + 1) {
        out.push_back({point.frame, {}, {}, -1, {}});
        ids.push_back(track.id);
      }
      last = point.frame;
      Base core{
          BaseKind::kGaussian, point.x, point.y, point.scale > 0 ? std::clamp(point.scale, 0.8, 8.0) : 1.5, 0, {}};
      const FittedBase fit = refine_base(residuals[static_cast<std::size_t>(point.frame)], core, 6);
      if (std::hypot(fit.base.x - core.x, fit.base.y - core.y) < core.scale) core = fit.base;
      core.coefficients[0] = fit.coefficient;
      out.back().core.push_back(core);
    }
  }
  return out;
}

/// Column `state` of a table of tracks by (id, frame); empty without one.
std::map<std::pair<std::int64_t, std::int64_t>, int> states_of(const std::string& text) {
  std::map<std::pair<std::int64_t, std::int64_t>, int> out;
  std::size_t begin = 0;
  std::vector<std::string> heading;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::vector<std::string> cells(1);
    for (std::size_t i = begin; i < end; ++i) {
      if (text[i] == ',')
        cells.emplace_back();
      else if (text[i] != '\r')
        cells.back() += text[i];
    }
    begin = end + 1;
    if (heading.empty()) {
      heading = cells;
      continue;
    }
    std::int64_t id = 0, frame = 0;
    int state = -1;
    for (std::size_t k = 0; k < std::min(heading.size(), cells.size()); ++k) {
      if (heading[k] == "id" || heading[k] == "track") id = std::strtoll(cells[k].c_str(), nullptr, 10);
      if (heading[k] == "frame") frame = std::strtoll(cells[k].c_str(), nullptr, 10);
      if (heading[k] == "state") state = static_cast<int>(std::strtol(cells[k].c_str(), nullptr, 10));
    }
    if (state >= 0) out[{id, frame}] = state;
  }
  return out;
}

/// Poses of the largest species against true states: the best pairing of both, share of frames that agree, and the
/// largest difference of the transition matrices.
void compare_poses(const std::vector<Cable>& cables, const MovetonTemplate& found, const std::vector<std::int64_t>& ids,
                   const std::string& text) {
  const auto truth = states_of(text);
  int num_states = 0;
  for (const auto& [where, state] : truth) num_states = std::max(num_states, state + 1);
  const auto num_poses = static_cast<int>(found.poses.size());
  std::printf("    %d poses, %d true states", num_poses, num_states);
  if (num_poses != num_states || num_states < 2) {
    std::puts("");
    return;
  }
  TransitionMatrix of_truth(num_states);
  std::vector<std::vector<double>> together(static_cast<std::size_t>(num_poses),
                                            std::vector<double>(static_cast<std::size_t>(num_states), 0));
  double num = 0;
  for (std::size_t c = 0; c < cables.size(); ++c)
    for (std::size_t at = 0; at < cables[c].poses.size(); ++at) {
      const auto here = truth.find({ids[c], cables[c].first_frame + static_cast<std::int64_t>(at)});
      if (here == truth.end()) continue;
      together[static_cast<std::size_t>(cables[c].poses[at])][static_cast<std::size_t>(here->second)] += 1;
      num += 1;
      const auto next = truth.find({ids[c], cables[c].first_frame + static_cast<std::int64_t>(at) + 1});
      if (at + 1 < cables[c].poses.size() && next != truth.end()) of_truth.add_count(here->second, next->second);
    }
  std::vector<int> order(static_cast<std::size_t>(num_states)), best;
  for (int k = 0; k < num_states; ++k) order[static_cast<std::size_t>(k)] = k;
  double most = -1;
  do {
    double agree = 0;
    for (std::size_t p = 0; p < order.size(); ++p) agree += together[p][static_cast<std::size_t>(order[p])];
    if (agree > most) {
      most = agree;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  double worst = 0, transitions = 0;
  for (int a = 0; a < num_states; ++a)
    for (int b = 0; b < num_states; ++b) {
      const int ta = best[static_cast<std::size_t>(a)], tb = best[static_cast<std::size_t>(b)];
      worst = std::max(worst, std::abs(found.pose_transitions.probability(a, b) - of_truth.probability(ta, tb)));
      transitions += of_truth.count(ta, tb);
    }
  std::printf("; %.1f %% of frames agree; largest error of a transition probability %.3f, from %.0f transitions\n",
              100 * most / std::max(1.0, num), worst, transitions);
}

/// The middle frame by movetons and by matching pursuit that knows of no movetons, luma.
void compare_pursuit(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables) {
  const int frame = clip.num_frames() / 2;
  const Plane& seen = clip.luma[static_cast<std::size_t>(frame)];
  const Plane grey = luma(background);
  BaseMap map{clip.width, clip.height, 1, {}};
  for (const Cable& cable : cables) {
    if (!cable.covers(frame)) continue;
    const auto at = static_cast<std::size_t>(frame - cable.first_frame);
    std::vector<Base> bases{cable.core[at]};
    for (const std::vector<Base>& coil : cable.coils) bases.push_back(coil[at]);
    for (Base& base : bases) {
      base.coefficients = {static_cast<float>(luma_coefficient(base, clip.num_planes())), 0, 0};
      if (base.coefficients[0] != 0) map.bases.push_back(base);
    }
  }
  Plane target = seen;
  for (std::size_t i = 0; i < target.values.size(); ++i) target.values[i] -= grey.values[i];
  std::printf("    frame %d: background %.2f dB, %zu bases of movetons %.2f dB; free pursuit", frame, psnr(grey, seen),
              map.bases.size(), psnr(reconstruct(map, {grey})[0], seen));
  std::vector<int> counts{static_cast<int>(map.bases.size()), 300};
  std::sort(counts.begin(), counts.end());
  for (const BaseMap& one : pursue_stages({target}, counts, {}))
    std::printf(" %zu bases %.2f dB", one.bases.size(), psnr(reconstruct(one, {grey})[0], seen));
  std::puts("");
}

void measure(const std::filesystem::path& video, const std::filesystem::path& truth) {
  const ClipFrames clip = load_video_clip(video);
  Planes background;
  std::vector<std::int64_t> ids;
  std::vector<Cable> cables;
  std::string text;
  if (truth.extension() == ".motex") {
    const TexturedMotion model = load_textured_motion(truth);
    background = model.background;
    cables = model.cables;
    ids.resize(cables.size(), 0);
  } else {
    text = read_file(truth);
    background = background_of(clip);
    cables = cables_of(parse_tracks_csv(text, truth.string()), clip, background, ids);
  }
  std::size_t elements = 0;
  for (const Cable& cable : cables) elements += cable.core.size();
  const double start = processor_secs();
  const GrowCoilsReport report = grow_coils(clip, background, cables);
  const double grown = processor_secs();
  std::printf(
      "%-24s %4zu cables, %5.1f a frame: PSNR background %.2f, cores %.2f, with coils %.2f dB; %.2f bases a "
      "moveton; isolated %.0f %%; noise %.2f; coils %.2f s\n",
      video.filename().string().c_str(), cables.size(), static_cast<double>(elements) / clip.num_frames(),
      report.background_psnr, report.cores_psnr, report.psnr, report.bases_per_moveton, 100 * report.isolated_share,
      report.noise, grown - start);
  double begin = processor_secs();
  learn_templates(cables, clip.num_planes());
  const double regrouping = processor_secs();
  const GrowCoilsReport again = regroup_coils(clip, background, {}, cables);
  std::printf("    templates %.2f s; regrouped %.2f dB in %.2f s\n", regrouping - begin, again.psnr,
              processor_secs() - regrouping);
  begin = processor_secs();
  const std::vector<MovetonTemplate> templates = learn_templates(cables, clip.num_planes());
  std::printf("    %zu species in %.2f s:", templates.size(), processor_secs() - begin);
  for (const MovetonTemplate& one : templates) {
    std::printf(" %.0f %%, poses of", 100 * one.share);
    for (const TemplatePose& pose : one.poses) {
      double coils = 0;
      for (const TemplateCoil& coil : pose.coils) coils += coil.presence;
      std::printf(" %.2f (%zu)", coils, pose.coils.size());
    }
    std::printf(" coils;");
  }
  std::puts("");
  compare_pursuit(clip, background, cables);
  if (!templates.empty() && !text.empty()) compare_poses(cables, templates[0], ids, text);
}

int run(int argc, char** argv) {
  std::vector<std::filesystem::path> files(argv + 1, argv + argc);
  if (files.empty())
    bench::for_each_clip({"synth/synth_birds.mkv", "synth/synth_snow.mkv", "synth/synth_fireworks.mkv"},
                         [&](const std::filesystem::path& path) {
                           files.push_back(path);
                           files.push_back(path.parent_path() / (path.stem().string() + "_tracks.csv"));
                         });
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    try {
      measure(files[i], files[i + 1]);
    } catch (const Error& error) {
      std::printf("%s\n", error.what());
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) { return motex::run(argc, argv); }
