// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The figures of [TM02], from real clips: particles_figures FOLDER OUT [FIGURE …]. FOLDER holds textured/ (or is
// ../shared/data/video); without it scenes are simulated and the waterfall is left out. What is learned, and for how
// long, is printed.
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "bench/figures/particle_scenes.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/bird_painter.h"
#include "motex/particles/pursuit.h"
#include "motex/particles/sample_moveton.h"
#include "motex/plot/frame.h"
#include "motex/plot/stroke_font.h"
#include "motex/project/base_sketch.h"
#include "motex/project/moveton_pictures.h"
#include "motex/project/particle_pictures.h"

namespace {

using motex::Drawing;
using motex::Image;
using motex::MovetonFrame;
using motex::bench::Scene;

constexpr double kGap = 12;

std::string number(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Panels side by side, a caption below each.
struct Panel {
  std::string caption;
  Drawing drawing;
};
Drawing side_by_side(const std::vector<Panel>& panels) {
  Drawing row{0, 0, {255, 255, 255, 255}, {}};
  for (const Panel& panel : panels) row.height = std::max(row.height, panel.drawing.height);
  for (const Panel& panel : panels) {
    motex::append(row, panel.drawing, {row.width, 0});
    row.add(
        motex::Text{{row.width, row.height + 18}, panel.caption, 13, motex::kInk, motex::Align::kLeft, false, false});
    row.width += std::max(panel.drawing.width, motex::text_width(panel.caption, 13)) + kGap;
  }
  row.width -= kGap;
  row.height += 22;
  return row;
}

/// Templates, the commonest first.
Drawing sketches_in_a_row(const motex::TexturedMotion& model) {
  std::vector<Panel> panels;
  for (const motex::MovetonTemplate& one : model.templates)
    if (panels.size() < 6) panels.push_back({"", motex::template_sketch(one, model.num_planes, 130)});
  if (panels.empty()) throw motex::InvalidInput("the model has no templates");
  return side_by_side(panels);
}

class Figures {
 public:
  Figures(std::filesystem::path data, std::filesystem::path folder, std::set<int> wanted)
      : data_(std::move(data)), folder_(std::move(folder)), wanted_(std::move(wanted)) {}

  void snow();
  void birds();
  void fireworks();
  void waterfall();

 private:
  bool wants(std::initializer_list<int> figures) const {
    for (const int figure : figures)
      if (wanted_.empty() || wanted_.contains(figure)) return true;
    return false;
  }
  void write(int figure, const std::string& title, const std::vector<Drawing>& parts) const;

  const Scene& snow_learned();
  const Scene& birds_learned();
  void dictionary_and_cable() const;                             ///< Figure 1
  void reconstructions(const Scene& snow) const;                 ///< Figure 2
  void wing_states(const Scene& birds) const;                    ///< Figure 5
  void birds_in_space(const Scene& birds) const;                 ///< Figure 6
  void paths_and_maps(int figure, const Scene& scene) const;     ///< Figures 4, 8, 11, 13
  void observed_and_synthesized(int figure, const Scene& scene,  ///< Figures 7, 10, 12
                                const motex::SynthesizeParticlesOptions& edits, const std::string& edited) const;

  std::filesystem::path data_, folder_;
  std::set<int> wanted_;
  std::optional<Scene> snow_, birds_;
};

void Figures::write(int figure, const std::string& title, const std::vector<Drawing>& parts) const {
  Drawing sheet{0, 40, {255, 255, 255, 255}, {}};
  for (const Drawing& part : parts) {
    motex::append(sheet, part, {kGap, sheet.height});
    sheet.width = std::max(sheet.width, part.width + 2 * kGap);
    sheet.height += part.height + kGap;
  }
  const std::string line = "Figure " + std::to_string(figure) + ": " + title;
  sheet.width = std::max(sheet.width, motex::text_width(line, 15) + 2 * kGap);
  sheet.add(motex::Text{{kGap, 26}, line, 15, motex::kInk, motex::Align::kLeft, true, false});
  const std::string name = "textured_motion_" + std::to_string(figure) + ".png";
  motex::write_file(folder_ / name, motex::to_png(sheet, 1));
  std::printf("%s: %s\n", name.c_str(), title.c_str());
}

// ---- Snow ----

const Scene& Figures::snow_learned() {
  if (!snow_) snow_ = motex::bench::snow_scene(data_);
  return *snow_;
}

const Scene& Figures::birds_learned() {
  if (!birds_) birds_ = motex::bench::bird_scene();
  return *birds_;
}

void Figures::snow() {
  if (wants({1})) snow_learned(), birds_learned(), dictionary_and_cable();
  if (wants({2})) reconstructions(snow_learned());
  if (wants({3})) {
    const motex::TexturedMotion& model = snow_learned().model;
    write(3, "templates of snow flakes, and 120 movetons drawn from them",
          {sketches_in_a_row(model), motex::sampled_movetons_picture(model, 120, 20, 1)});
  }
  if (wants({4})) paths_and_maps(4, snow_learned());
}

/// Of the cables with most coils one that lives about `frames` long, that part of it.
motex::Cable example_cable(const motex::TexturedMotion& model, std::int64_t frames) {
  const motex::Cable* best = nullptr;
  const auto worth = [&](const motex::Cable& cable) {
    return static_cast<double>(std::min(cable.num_frames(), frames)) * (1 + static_cast<double>(cable.coils.size()));
  };
  for (const motex::Cable& cable : model.cables)
    if (best == nullptr || worth(cable) > worth(*best)) best = &cable;
  if (best == nullptr) throw motex::InvalidInput("the model has no cables");
  motex::Cable part = *best;
  const auto length = static_cast<std::size_t>(std::min(frames, part.num_frames()));
  part.core.resize(length);
  for (std::vector<motex::Base>& coil : part.coils) coil.resize(length);
  return part;
}

/// Symbols of its commonest template: of the states the one with most coils.
Drawing moveton_sketch(const motex::TexturedMotion& model, double size) {
  if (model.templates.empty()) return {size, size, {255, 255, 255, 255}, {}};
  motex::MovetonTemplate shown = model.templates[0];
  const auto most = std::max_element(shown.poses.begin(), shown.poses.end(),
                                     [](const auto& a, const auto& b) { return a.coils.size() < b.coils.size(); });
  shown.poses = {*most};
  return motex::template_sketch(shown, model.num_planes, size);
}

void Figures::dictionary_and_cable() const {
  const motex::Cable cable = example_cable(birds_->model, 30);
  Drawing movetons{130, 284, {255, 255, 255, 255}, {}};
  motex::append(movetons, moveton_sketch(snow_->model, 124), {0, 0});
  motex::append(movetons, moveton_sketch(birds_->model, 124), {0, 146});
  write(1, "base functions with their symbols, movetons, and a cable",
        {side_by_side(
            {{"(a) base functions", motex::base_functions_picture(88)},
             {"(b) flake, bird", movetons},
             {"(c) a cable in x, y, t: the core of a bird and its " + std::to_string(cable.coils.size()) + " coils",
              motex::cable_picture(cable, 460, 284)}})});
}

void Figures::reconstructions(const Scene& snow) const {
  const std::vector<int> counts{100, 800};
  std::vector<motex::PictureRow> rows{{"(a) observed", {}}, {"", {}}, {"", {}}, {"(d) synthesized", {}}};
  std::vector<double> psnr(counts.size());
  for (int k = 0; k < snow.columns; ++k) {
    const int frame = snow.frame_of_column(k, snow.columns);
    const motex::Planes observed = motex::frame_planes(snow.clip, frame);
    motex::Planes rest = observed;
    for (std::size_t p = 0; p < rest.size(); ++p)
      for (std::size_t i = 0; i < rest[p].values.size(); ++i) rest[p].values[i] -= snow.model.background[p].values[i];
    const std::vector<motex::BaseMap> maps = motex::pursue_stages(rest, counts, {});
    rows[0].pictures.push_back(motex::to_image(observed));
    for (std::size_t c = 0; c < counts.size(); ++c) {
      const motex::Planes made = motex::reconstruct(maps[c], snow.model.background);
      psnr[c] += motex::psnr(motex::to_planes(motex::to_image(made), static_cast<int>(observed.size())), observed) /
                 snow.columns;
      rows[1 + c].pictures.push_back(motex::to_image(made));
    }
  }
  rows[1].caption = "(b) 100 bases: " + number(psnr[0], 1) + " dB";
  rows[2].caption = "(c) 800 bases: " + number(psnr[1], 1) + " dB";
  rows[3].pictures = motex::bench::synthesized_pictures(snow, {}, snow.columns);
  write(2, "snow: " + snow.name, {motex::picture_rows(rows, 148)});
}

// ---- Maps, synthesis ----

void Figures::paths_and_maps(int figure, const Scene& scene) const {
  const double scale = 270.0 / scene.model.width;
  const int middle = scene.clip.num_frames() / 2;
  Drawing observed{270, scene.model.height * scale, {255, 255, 255, 255}, {}};
  observed.add(motex::Picture{{0, 0}, 270, observed.height, motex::to_image(motex::frame_planes(scene.clip, middle))});
  const std::vector<Panel> top{
      {"(a) observed, frame " + std::to_string(middle), observed},
      {"(b) paths of " + std::to_string(scene.num_shown_paths()) + " movetons, births red",
       motex::paths_picture(scene.model.cables, scene.model.width, scene.model.height, scale, scene.least_path)}};
  const std::vector<Panel> below{
      {"(c) source map, dark = many", motex::density_picture(scene.model.maps.source, scale)},
      {"(d) sink map", motex::density_picture(scene.model.maps.sink, scale)}};
  write(figure, scene.what + ": paths, sources and sinks", {side_by_side(top), side_by_side(below)});
}

void Figures::observed_and_synthesized(int figure, const Scene& scene, const motex::SynthesizeParticlesOptions& edits,
                                       const std::string& edited) const {
  std::vector<motex::PictureRow> rows{{"(a) observed", {}}, {"(b) synthesized" + edited, {}}};
  for (int k = 0; k < scene.columns; ++k)
    rows[0].pictures.push_back(
        motex::to_image(motex::frame_planes(scene.clip, scene.frame_of_column(k, scene.columns))));
  rows[1].pictures = motex::bench::synthesized_pictures(scene, edits, scene.columns);
  write(figure, scene.what + ": " + scene.name,
        {motex::picture_rows(rows, (scene.model.water ? 740.0 : 840.0) / scene.columns)});
}

// ---- Birds ----

void Figures::birds() {
  if (wants({5, 6})) {
    const Scene flapping = motex::bench::flapping_scene();
    if (wants({5})) wing_states(flapping);
    if (wants({6})) birds_in_space(flapping);
  }
  if (wants({7})) observed_and_synthesized(7, birds_learned(), {}, "");
  if (wants({8})) paths_and_maps(8, birds_learned());
  if (wants({9}))
    write(9, "birds: templates, movetons drawn from them, and instances",
          {motex::movetons_figure(birds_learned().model, &birds_learned().clip, 60, 1)});
}

/// The template with most states.
const motex::MovetonTemplate* flapping(const motex::TexturedMotion& model) {
  const motex::MovetonTemplate* best = nullptr;
  for (const motex::MovetonTemplate& one : model.templates)
    if (best == nullptr || one.poses.size() > best->poses.size()) best = &one;
  return best;
}

void Figures::wing_states(const Scene& birds) const {
  const motex::MovetonTemplate* species = flapping(birds.model);
  if (species == nullptr) return;
  const int idx = static_cast<int>(species - birds.model.templates.data());
  std::vector<motex::PictureRow> rows;
  for (int state = 0; state < static_cast<int>(species->poses.size()); ++state)
    rows.push_back({"state " + std::to_string(state) + ": " +
                        number(100 * species->poses[static_cast<std::size_t>(state)].share, 0) + " % of the frames",
                    motex::bench::cut_outs(birds, idx, state, 10)});
  write(5, "states of flying birds, clustered", {motex::picture_rows(rows, 64)});
}

void Figures::birds_in_space(const Scene& birds) const {
  const motex::MovetonTemplate* species = flapping(birds.model);
  if (species == nullptr) return;
  std::vector<Drawing> portraits;
  for (const double angle : motex::wing_angles(*species, 0.75)) {
    Drawing cell{100, 100, {255, 255, 255, 0}, {}};
    cell.add(motex::Picture{{0, 0}, 100, 100, motex::bird_portrait({angle, -0.08, 0}, 200, {{110, 112, 120}, {}})});
    portraits.push_back(std::move(cell));
  }
  std::vector<Panel> panels{
      {"(a) states of the 3-D bird, learned transitions", motex::chain_picture(species->pose_transitions, portraits)}};
  Drawing flight{0, 0, {255, 255, 255, 255}, {}};
  const std::vector<Image> pictures = motex::bench::pictures_in_space(birds, 2, 3);
  for (const Image& picture : pictures) {
    const double width = 400, height = width * picture.height / picture.width;
    flight.add(motex::Picture{{0, flight.height}, width, height, picture});
    flight.width = width;
    flight.height += height + 6;
  }
  panels.push_back({"(b) synthesized paths flown in space, before another sky", flight});
  write(6, "3-D birds on learned paths, flapping as sampled", {side_by_side(panels)});
}

// ---- Fireworks, water ----

void Figures::fireworks() {
  if (!wants({10, 11})) return;
  const Scene scene = motex::bench::firework_scene(data_);
  motex::SynthesizeParticlesOptions edits;
  edits.uniform = true;
  edits.rate = 2;
  if (wants({10})) observed_and_synthesized(10, scene, edits, ", twice as many, anywhere in the picture");
  if (wants({11})) paths_and_maps(11, scene);
}

void Figures::waterfall() {
  if (!wants({12, 13, 14})) return;
  Scene scene;
  if (!motex::bench::waterfall_scene(data_, scene)) {
    std::printf("no waterfall in the data: Figures 12, 13, 14 are left out\n");
    return;
  }
  if (wants({12})) observed_and_synthesized(12, scene, {}, "");
  if (wants({13})) paths_and_maps(13, scene);
  if (!wants({14})) return;
  const Scene drops = motex::bench::drop_scene(data_);
  write(14, "ten drops of the waterfall: groups of bases, as light and as symbols",
        {motex::picture_rows(motex::bench::drop_pictures(drops.model, 10), 82)});
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const std::filesystem::path data = argc > 1 ? argv[1] : "", folder = argc > 2 ? argv[2] : "build/figures";
    std::set<int> wanted;
    for (int i = 3; i < argc; ++i) wanted.insert(std::atoi(argv[i]));
    std::filesystem::create_directories(folder);
    Figures figures(data, folder, wanted);
    figures.snow();
    figures.birds();
    figures.fireworks();
    figures.waterfall();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
