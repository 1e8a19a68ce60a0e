// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The figures of [MT02] that show a result, from real data: motion_figures FOLDER OUT. The number that belongs to each
// is printed, and written above it. Examples: of about the length of the paper's, the liveliest.
#include <cmath>
#include <numbers>

#include "bench/motion_data.h"
#include "motex/core/files.h"
#include "motex/motion_texture/choreograph.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/segment_synthesis.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/texton_edit.h"
#include "motex/motion_texture/texton_stretch.h"
#include "motex/motion_texture/texton_vary.h"
#include "motex/plot/charts.h"
#include "motex/plot/frame.h"
#include "motex/plot/stroke_font.h"
#include "motex/project/figure.h"
#include "motex/project/pose_pictures.h"

namespace {

using motex::Clip;
using motex::Drawing;
using motex::FrameMatrix;
using motex::Index;
using motex::Instance;
using motex::MotionTexture;

constexpr double kWidth = 860;
constexpr Index kNear = 5;
constexpr double kFigureSecs = 0.25;  // from one figure of a strip to the next

class Figures {
 public:
  Figures(const MotionTexture& model, std::filesystem::path folder) : model_(model), folder_(std::move(folder)) {}

  void choreography() const;   ///< Figure 1
  void unconstrained() const;  ///< Figure 7
  void transition() const;     ///< Figure 8
  void variants() const;       ///< Figure 9
  void stretched() const;      ///< Figure 10
  void edited() const;         ///< Figure 11

 private:
  const Instance& at(int instance) const { return model_.instances[static_cast<std::size_t>(instance)]; }
  /// Of the examples of that length, within a few frames, the liveliest.
  int lively_of_length(Index length) const;
  /// A likely and near example of another texton that does not follow in the source.
  int follower_of(int instance) const;
  FrameMatrix features_of(const Clip& clip) const { return motex::encode(model_.features, clip); }
  void write(const char* name, const std::string& title, const std::vector<Drawing>& panels) const;

  const MotionTexture& model_;
  std::filesystem::path folder_;
};

std::string number(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// A strip with a figure every quarter of a second.
Drawing picture(Clip clip, const std::string& title, const std::vector<motex::TextonSpan>& spans = {}, int rows = 1) {
  clip.name = title;
  motex::PoseStripOptions options;
  options.secs = static_cast<double>(clip.num_frames()) * clip.frame_time_secs;
  options.figures = std::max(8, static_cast<int>(std::lround(options.secs / kFigureSecs / rows)));
  options.rows = rows;
  options.ghosts = 1;
  options.figure_height = 110;
  return motex::pose_strip(clip, spans, options);
}

motex::Series series(const std::string& name, const motex::Vector& values) {
  motex::Series out;
  out.name = name;
  for (Index t = 0; t < values.size(); ++t) {
    out.x.push_back(static_cast<double>(t));
    out.y.push_back(values[t]);
  }
  return out;
}

Drawing lines(const std::string& title, const std::string& y_label, std::vector<motex::Series> all) {
  motex::LinePlot plot;
  plot.title = title;
  plot.x_axis.label = "frame";
  plot.y_axis.label = y_label;
  plot.series = std::move(all);
  plot.size = {kWidth, 240};
  return motex::draw(plot);
}

/// How far the left hand is from the travelling joint, and in which direction most: its height above it, in cm.
motex::Vector hand_height(const MotionTexture& model, const Clip& clip) {
  const motex::Figure figure = motex::make_figure(clip.skeleton);
  const FrameMatrix points = motex::figure_points(figure, clip);
  const Index hand = figure.hands[0] >= 0 ? figure.hands[0] : clip.skeleton.num_joints() - 1;
  return model.features.cm_per_unit * (points.col(3 * hand + 1) - points.col(3 * model.features.travelling_joint + 1));
}

motex::Vector distances(const FrameMatrix& a, const FrameMatrix& b) {
  const Index n = std::min(a.rows(), b.rows());
  return (a.topRows(n) - b.topRows(n)).rowwise().norm();
}

motex::Vector steps(const FrameMatrix& y) {
  return (y.bottomRows(y.rows() - 1) - y.topRows(y.rows() - 1)).rowwise().norm();
}

double largest_turn(const Clip& a, Index row_a, const Clip& b, Index row_b, int but = -1) {
  double largest = 0;
  for (int j = 0; j < a.skeleton.num_joints(); ++j)
    if (j != but) largest = std::max(largest, motex::angle_between(a.rotation(row_a, j), b.rotation(row_b, j)));
  return largest;
}

int Figures::lively_of_length(Index length) const {
  int best = -1;
  double most = -1;
  for (int i = 0; i < static_cast<int>(model_.instances.size()); ++i) {
    if (std::abs(at(i).length - length) > kNear) continue;
    const double speed = motex::mean_joint_speed(motex::example_clip(model_, i));
    if (speed > most) most = speed, best = i;
  }
  if (best < 0) throw motex::InvalidInput("no example has about " + std::to_string(length) + " frames");
  return best;
}

int Figures::follower_of(int instance) const {
  const double tau = motex::usual_jump_distance(model_);
  int best = -1;
  double least = HUGE_VAL;
  for (int j = 0; j < static_cast<int>(model_.instances.size()); ++j) {
    if (j == instance + 1 || at(j).texton == at(instance).texton) continue;
    const double far = motex::key_pose_distance(model_.corpus, motex::hand_over_row(model_, at(instance)), at(j).row);
    const double cost = far / tau - std::log(model_.transitions.probability(at(instance).texton, at(j).texton) + 1e-9);
    if (cost < least) least = cost, best = j;
  }
  return best;
}

void Figures::write(const char* name, const std::string& title, const std::vector<Drawing>& panels) const {
  constexpr double kTop = 44, kGap = 14;
  Drawing figure{0, kTop, panels.at(0).background, {}};
  for (const Drawing& panel : panels) {
    motex::append(figure, panel, {kGap, figure.height});
    figure.width = std::max(figure.width, panel.width + 2 * kGap);
    figure.height += panel.height + kGap;
  }
  figure.width = std::max(figure.width, motex::text_width(title, 15) + 2 * kGap);
  figure.add(motex::Text{{kGap, 28}, title, 15, motex::kInk, motex::Align::kLeft, true, false});
  const std::filesystem::path path = folder_ / (std::string(name) + ".png");
  motex::write_file(path, motex::to_png(figure, 1));
  std::printf("%s: %s\n", path.filename().c_str(), title.c_str());
}

void Figures::choreography() const {
  const std::size_t last = model_.clip_names.size() - 1;
  motex::ChoreographyRequest request;
  request.start = {model_.clip_names[last / 2], model_.clip_lengths[last / 2] / 3};
  request.end = {model_.clip_names[last], model_.clip_lengths[last] / 2};
  request.num_frames = 320;
  motex::ChoreographyReport report;
  const Clip dance = motex::choreograph(model_, request, {}, report);
  std::vector<motex::TextonSpan> spans;
  for (const motex::ChoreographedTexton& played : report.played)
    spans.push_back({played.texton, played.start, played.length - 2, ""});
  double off = 0;
  for (const Index t : {Index{0}, Index{1}, Index{318}, Index{319}}) {
    const motex::ClipFrame& pose = t < 2 ? request.start : request.end;
    const Index row = motex::corpus_row(model_, pose) + (t < 2 ? t : t - 319);
    const Clip wanted = motex::decode(model_.features, model_.corpus.middleRows(row, 1).cast<double>());
    off = std::max(off, largest_turn(dance, t, wanted, 0, model_.features.travelling_joint));
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "Figure 1: 320 frames from pose to pose by %zu textons; the four given poses are met within %.0e rad",
                report.played.size(), std::max(off, 1e-6));
  write("motion_texture_1", text,
        {picture(dance,
                 request.start.clip + "@" + std::to_string(request.start.frame) + " to " + request.end.clip + "@" +
                     std::to_string(request.end.frame),
                 spans, 2)});
}

void Figures::unconstrained() const {
  const int i = lively_of_length(68);
  const Instance& a = at(i);
  motex::PlayOptions white;
  white.noise_source = motex::NoiseSource::kWhite;
  const Index end = a.row + a.length - 2;
  const FrameMatrix source = model_.corpus.middleRows(a.row, a.length).cast<double>();
  const motex::Subspace& space = model_.subspace(a.texton);
  FrameMatrix states(a.length, space.basis.cols());
  states.topRows(2) = (source.topRows(2).rowwise() - space.mean.transpose()) * space.basis;
  motex::Rng rng(1);
  motex::simulate(model_.textons[static_cast<std::size_t>(a.texton)].dynamics, states, &rng, 1);
  const FrameMatrix free = (states * space.basis.transpose()).rowwise() + space.mean.transpose();
  const FrameMatrix held =
      motex::SegmentSynthesis(model_, white).play({a.texton, a.row, a.length, a.row, end, a.length});
  const motex::Vector off_free = distances(source, free), off_held = distances(source, held);
  const auto shown = [&](const FrameMatrix& y) { return motex::decode(model_.features, y, a.place); };
  write(
      "motion_texture_7",
      "Figure 7: after " + std::to_string(a.length) + " frames the free run is " + number(off_free[a.length - 1], 0) +
          " cm from the example, the constrained one " + number(off_held[a.length - 1], 0) + " cm",
      {picture(shown(source), "(a) example"), picture(shown(free), "(b) two last frames not given"),
       picture(shown(held), "(c) two last frames given"),
       lines("Distance from the example", "cm", {series("(b) free", off_free), series("(c) constrained", off_held)})});
}

void Figures::transition() const {
  const int i = lively_of_length(90);
  const int texton = at(i).texton, next = follower_of(i);
  motex::SegmentSynthesis segments(model_, {});
  const FrameMatrix first = segments.play(i, -1), joined = segments.play(i, next), second = segments.play(next, -1);
  const auto together = [&](const FrameMatrix& head, Index head_rows) {
    FrameMatrix y(head_rows + second.rows(), second.cols());
    y << head.topRows(head_rows), second;
    return y;
  };
  const Index border = first.rows() - 2;
  const FrameMatrix apart = together(first, border), smooth = together(joined, border);
  const motex::Vector jumps = steps(apart), passes = steps(smooth);
  const auto shown = [&](const FrameMatrix& y) { return motex::decode(model_.features, y, at(i).place); };
  std::vector<double> usual(passes.data(), passes.data() + passes.size());
  write("motion_texture_8",
        "Figure 8: the step into texton " + std::to_string(at(next).texton) + " is " + number(jumps[border - 1], 1) +
            " cm synthesized apart, " + number(passes[border - 1], 1) + " cm joined; the median step is " +
            number(motex::bench::median(usual), 1) + " cm",
        {picture(shown(apart), "(a) two textons synthesized apart",
                 {{texton, 0, border, ""}, {at(next).texton, border, second.rows(), ""}}),
         picture(shown(smooth), "(b) the first leads to the key poses of the second",
                 {{texton, 0, border, ""}, {at(next).texton, border, second.rows(), ""}}),
         lines("Step from frame to frame", "cm", {series("(a) apart", jumps), series("(b) joined", passes)})});
}

void Figures::variants() const {
  const int i = lively_of_length(110);
  motex::VaryOptions options;
  motex::VaryReport first, second;
  const Clip example = motex::example_clip(model_, i), one = motex::vary_texton(model_, i, options, first);
  options.seed = 2;
  const Clip two = motex::vary_texton(model_, i, options, second);
  write("motion_texture_9",
        "Figure 9: noise of " + number(options.noise, 1) + " moves the variants " + number(first.mean_distance, 1) +
            " and " + number(second.mean_distance, 1) + " cm from the example, at " + number(first.speed_ratio, 2) +
            " and " + number(second.speed_ratio, 2) + " of its speed",
        {picture(example, "(a) example"), picture(one, "(b) variant, seed 1"), picture(two, "(c) variant, seed 2"),
         lines("Left hand above the hips", "cm",
               {series("(a)", hand_height(model_, example)), series("(b)", hand_height(model_, one)),
                series("(c)", hand_height(model_, two))})});
}

void Figures::stretched() const {
  const int i = lively_of_length(127);
  constexpr Index kLonger = 188;
  const auto made = [&](motex::StretchMethod method, Index frames, motex::StretchReport& report) {
    motex::StretchOptions options;
    options.method = method;
    return motex::stretch_texton(model_, i, frames, options, report);
  };
  motex::StretchReport white, warp, white_longer, report;
  const Clip example = motex::example_clip(model_, i);
  const Clip b = made(motex::StretchMethod::kWhite, at(i).length, white);
  const Clip c = made(motex::StretchMethod::kWarp, kLonger, warp);
  made(motex::StretchMethod::kWhite, kLonger, white_longer);
  const Clip d = made(motex::StretchMethod::kRevisit, kLonger, report);
  std::vector<motex::TextonSpan> spans;
  for (std::size_t k = 0; k < report.visits.size(); ++k)
    spans.push_back({static_cast<int>(k), report.visits[k].start, report.visits[k].length - 2, ""});
  write("motion_texture_10",
        "Figure 10: " + std::to_string(at(i).length) + " frames in " + std::to_string(kLonger) + " at " +
            number(report.speed_ratio, 2) + " of the example's speed (linear warp " + number(warp.speed_ratio, 2) +
            ", white noise " + number(white_longer.speed_ratio, 2) + ")",
        {picture(example, "(a) example, " + std::to_string(at(i).length) + " frames"),
         picture(b, "(b) white noise, speed " + number(white.speed_ratio, 2)),
         picture(c, "(c) linear warp, " + std::to_string(kLonger) + " frames"),
         picture(d, "(d) motex motion stretch, " + std::to_string(kLonger) + " frames; below: its visits", spans),
         lines("Left hand above the hips", "cm",
               {series("(a) example", hand_height(model_, example)), series("(c) warp", hand_height(model_, c)),
                series("(d) stretch", hand_height(model_, d))})});
}

void Figures::edited() const {
  const int i = lively_of_length(100);
  const motex::Figure figure = motex::make_figure(model_.features.skeleton);
  motex::PoseEdit edit;
  edit.frame = at(i).length / 2;
  edit.joint = std::max(figure.shoulders[0], 0);
  constexpr double kDegrees = 60;
  edit.rotation = motex::exp_map(motex::Vector3(0, 0, kDegrees * std::numbers::pi / 180));
  motex::EditReport report;
  motex::EditOptions options;
  const Clip base = motex::edit_texton(model_, i, {}, options, report);
  const Clip clip = motex::edit_texton(model_, i, {&edit, 1}, options, report);
  motex::Vector turn(base.num_frames()), others(base.num_frames());
  for (Index t = 0; t < base.num_frames(); ++t) {
    turn[t] = motex::angle_between(base.rotation(t, edit.joint), clip.rotation(t, edit.joint)) * 180 / std::numbers::pi;
    others[t] = largest_turn(base, t, clip, t, edit.joint) * 180 / std::numbers::pi;
  }
  write("motion_texture_11",
        "Figure 11: frame " + std::to_string(edit.frame) +
            " edited by 60°: " + number(100 * turn[edit.frame] / kDegrees, 1) + " % survives, other joints move " +
            number(100 * others.maxCoeff() / kDegrees, 1) + " %, ends " +
            number(std::max(turn[0], turn[base.num_frames() - 1]), 1) + "°",
        {picture(base, "(a) example"),
         picture(clip, "(b) left shoulder turned by 60° at frame " + std::to_string(edit.frame)),
         lines("Turned from the example", "°", {series("edited joint", turn), series("most of the others", others)})});
}

void make(const std::filesystem::path& data, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const motex::bench::Dance dance = motex::bench::all_dances(data).back();
  motex::LearnReport report;
  const MotionTexture model = motex::learn_motion_texture(dance.clips, {}, report);
  const Figures figures(model, folder);
  figures.choreography();
  figures.unconstrained();
  figures.transition();
  figures.variants();
  figures.stretched();
  figures.edited();
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 2 ? argv[2] : "build/figures";
  return motex::bench::run(argc > 1 && argv[1][0] != '\0' ? argc : 1, argv,
                           [&](const std::filesystem::path& data) { make(data, folder); });
}
