// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// What more examples are worth: models learned from 1, 2, 4, 8 … minutes, and how varied their dances are. Local and
// global diversity against the minutes learned from, coverage of clips that no model saw (both without heading, as the
// dances face all ways), speed against the whole source. A second argument names a PNG or SVG to plot to.
#include <numeric>

#include "bench/motion_data.h"
#include "motex/motion/measures.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/plot/charts.h"

namespace {

using motex::Clip;
using motex::Index;

constexpr Index kFrames = 7200;
constexpr std::uint64_t kSeeds = 2;

/// Clips that no model sees: every seventh.
bool is_held_out(std::size_t k) { return k % 7 == 3; }

/// About so many minutes: the first clips of a fixed shuffle, so that more minutes hold the fewer.
std::vector<Clip> minutes_of(const std::vector<Clip>& clips, double minutes) {
  const std::size_t n = clips.size();
  std::size_t stride = n / 2 + 1;
  while (std::gcd(stride, n) != 1) ++stride;
  std::vector<Clip> out;
  double secs = 0;
  for (std::size_t k = 0; k < n && secs < 59 * minutes; ++k) {
    out.push_back(clips[k * stride % n]);
    secs += static_cast<double>(out.back().num_frames()) * out.back().frame_time_secs;
  }
  return out;
}

std::vector<Clip> without_heading(const motex::FeatureSpace& space, const std::vector<Clip>& clips) {
  std::vector<Clip> out;
  for (const Clip& clip : clips) out.push_back(motex::bench::without_heading(space, clip));
  return out;
}

struct Row {
  double minutes = 0;
  int textons = 0;
  double local = 0, global = 0, coverage = 0, speed = 0;
};

Row measure_one(const std::vector<Clip>& learned_from, const std::vector<Clip>& held_out,
                const std::vector<Clip>& all) {
  Row row;
  row.minutes = static_cast<double>(motex::bench::total_frames(learned_from)) * all[0].frame_time_secs / 60;
  motex::LearnReport learned;
  const motex::MotionTexture model = motex::learn_motion_texture(learned_from, {}, learned);
  row.textons = learned.num_textons;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    motex::SynthesizeOptions options;
    options.seed = seed;
    motex::SynthesizeReport made;
    const Clip dance = motex::synthesize_motion(model, kFrames, {}, options, made);
    const Clip body = motex::bench::without_heading(model.features, dance);
    const motex::CompareReport own = motex::compare_motion(without_heading(model.features, learned_from), body);
    row.local += own.local_diversity / kSeeds;
    row.global += own.global_diversity / kSeeds;
    row.coverage += motex::compare_motion(without_heading(model.features, held_out), body).coverage / kSeeds;
    row.speed += motex::compare_motion(all, dance).speed_ratio / kSeeds;
  }
  return row;
}

void plot(const std::vector<Row>& rows, const std::filesystem::path& path) {
  const auto series = [&](const std::string& name, double Row::*field, double factor) {
    motex::Series out;
    out.name = name;
    out.mark = motex::Mark::kLineAndPoints;
    for (const Row& row : rows) out.x.push_back(row.minutes), out.y.push_back(factor * row.*field);
    return out;
  };
  motex::LinePlot diversity, coverage;
  diversity.title = "Variety of the dance";
  diversity.x_axis.label = coverage.x_axis.label = "minutes learned from";
  diversity.y_axis.label = "diversity per frame";
  diversity.series = {series("local", &Row::local, 1), series("global", &Row::global, 1)};
  coverage.title = "Of clips that were not learned from";
  coverage.y_axis.label = "%";
  coverage.series = {series("covered", &Row::coverage, 100), series("speed / source", &Row::speed, 100)};
  motex::write_picture(path, motex::grid({motex::draw(diversity), motex::draw(coverage)}, 2,
                                         "Two minutes of new dance against minutes of salsa learned from"));
}

void measure(const std::filesystem::path& folder, const std::filesystem::path& picture) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  std::vector<Clip> known, held_out;
  for (std::size_t k = 0; k < dance.clips.size(); ++k)
    (is_held_out(k) && dance.clips.size() > 4 ? held_out : known).push_back(dance.clips[k]);
  if (held_out.empty()) held_out = {known.back()}, known.pop_back();
  std::printf("%s, %zu clips held out: minutes, textons, local and global diversity, held-out coverage %%, speed\n",
              dance.name.c_str(), held_out.size());
  std::vector<Row> rows;
  const double all = static_cast<double>(motex::bench::total_frames(known)) * known[0].frame_time_secs / 60;
  for (double minutes = 1;; minutes *= 2) {
    const Row row = measure_one(minutes_of(known, minutes), held_out, dance.clips);
    std::printf("  %5.1f min  %4d textons   local %.3f   global %.3f   covers %5.1f   speed %.2f\n", row.minutes,
                row.textons, row.local, row.global, 100 * row.coverage, row.speed);
    rows.push_back(row);
    if (minutes >= all) break;
  }
  if (!picture.empty()) plot(rows, picture);
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path picture = argc > 2 ? argv[2] : "";
  return motex::bench::run(std::min(argc, 2), argv, [&](const auto& folder) { measure(folder, picture); });
}
