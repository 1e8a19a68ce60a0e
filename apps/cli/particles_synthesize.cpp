// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "closest.h"
#include "colour_argument.h"
#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/image/png.h"
#include "motex/particles/bird_painter.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/edit.h"
#include "motex/particles/stray_light.h"
#include "motex/particles/water_synthesis.h"
#include "motex/project/moveton_edits_file.h"
#include "motex/project/particle_styles.h"
#include "motex/project/synthesize_video.h"
#include "motex/video_io/video_writer.h"
#include "options_value.h"
#include "output_file.h"
#include "particles_model.h"
#include "text_table.h"
#include "video_output.h"

namespace motex::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxFrames = 2e7;

Image read_png(const std::string& path) { return decode_png(read_file(path), path); }

enum class From { kSynthesis, kLearned };
enum class Style { kPhoto, kSymbolic, kCartoon };

struct DrawOptions {
  From from = From::kSynthesis;
  Style style = Style::kPhoto;
  double scale = 1;
  bool three_d = false;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"from", "", "what is drawn: new movetons, or those of the clip (for --edits)"}, self.from,
          Choices{{"synthesis", "learned"}});
    visit(Field{"style", "", "as photographed, as symbols of bases, or as a cartoon"}, self.style,
          Choices{{"photo", "symbolic", "cartoon"}});
    visit(Field{"scale", "", "output pixels to one of the model"}, self.scale, Range{0.1, 16});
    visit(Field{"three_d", "", "movetons as birds in 3-D that flap by the model's states"}, self.three_d, Range{});
  }
};

struct Synthesize {
  std::string model_path, output, wind, source_map, sink_map, hazard_map, looks, edits_path, background;
  std::int64_t frames = 0;
  double secs = 0;
  SynthesizeParticlesOptions options;
  DrawOptions draw;
  BirdFlightOptions flight;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex particles learn", model_path);
    arguments
        .value("-o,--output", "VIDEO",
               "video, folder of PNG files or pattern (f_%04d.png); beside it NAME.tracks.csv and NAME.layer.mov are "
               "always written",
               output)
        .required = true;
    arguments.value("--frames", "N", "length in frames", frames);
    arguments.value("--secs", "S", "length in seconds", secs);
    arguments.section("Motion");
    arguments.options(options);
    arguments.value("--wind", "X,Y", "added to the mean velocity, pixels a frame (default 0,0)", wind);
    arguments.value("--source-map", "PNG", "births where it is bright (any size; motex particles maps writes one)",
                    source_map);
    arguments.value("--sink-map", "PNG", "deaths where it is bright, as many as learned", sink_map);
    arguments.value("--hazard-map", "PNG",
                    "deaths by how bright it is: white = at once, gray level L = with probability (L/255)^2 a frame",
                    hazard_map);
    arguments.value("--edits", "JSON",
                    "elements put in, moved and taken out by hand: {\"insert\": [{\"frame\", \"x\", \"y\", \"vx\", "
                    "\"vy\", \"species\"}], \"move\": [{\"track\", \"dx\", \"dy\"}], \"remove\": [track]}",
                    edits_path);
    arguments.section("Looks");
    arguments.options(draw);
    arguments.value("--template", "K|MODEL", "all look like template K of this model, or like those of another model",
                    looks);
    arguments.value("--background", "PNG|COLOUR",
                    "another background: a picture, #rrggbb, black, white, gray, green, blue", background);
    arguments.section("Birds in space (--three-d)");
    arguments.options(flight);
  }

  void run(Session& session) {
    const ParticleOutputs outputs = particle_outputs(output);
    check_request(outputs, session);
    const TexturedMotion model = load_particles_model(model_path);
    const std::int64_t num_frames = wanted_frames(model);
    std::optional<TexturedMotion> other;
    read_options(model, other);
    const MovetonEdits edits =
        edits_path.empty() ? MovetonEdits{} : parse_moveton_edits(read_file(edits_path), edits_path);
    const std::unique_ptr<FramePainter> painter = make_painter(model);
    const JobContext job = session.job(0, 0.05);
    std::unique_ptr<CableSynthesizer> synthesizer;
    std::unique_ptr<MovetonSource> learned;
    if (draw.from == From::kSynthesis && model.water)
      learned = make_water(model, num_frames);
    else if (draw.from == From::kSynthesis)
      synthesizer = std::make_unique<CableSynthesizer>(model, options, num_frames, job);
    else
      learned = std::make_unique<LearnedMovetons>(model);
    MovetonSource& made = learned != nullptr ? *learned : *synthesizer;
    std::optional<EditedMovetons> edited;
    if (!edits.empty()) edited.emplace(made, edits, model, options);
    if (session.flags.dry_run) return would_write(paths_of(outputs), num_frames, session);

    const ParticleVideoShape shape{model.width, model.height, base_planes(model), model.frames_per_sec};
    const ParticleVideoReport report =
        write_particle_video(shape, edited ? *edited : made, *painter, num_frames, outputs, session.job(0.05, 1));
    if (edited)
      for (const std::int64_t track : edited->unseen())
        session.warn(edits_path + ": there is no track " + std::to_string(track) + " in these frames");
    if (report.num_tracks == 0) session.warn("nothing is in the picture: the video shows the background alone");
    session.say("wrote " + enumerate(paths_of(outputs)) + ": " + std::to_string(report.num_frames) + " frames, " +
                fixed(report.elements_per_frame, 1) + " elements a frame, seed " + std::to_string(options.seed));
    session.result(report_value(report, outputs, synthesizer.get()), "");
  }

 private:
  /// Water is born jointly: options that place elements one by one have no meaning there.
  std::unique_ptr<MovetonSource> make_water(const TexturedMotion& model, std::int64_t num_frames) const {
    const bool placed = options.rate != 1 || options.gravity != 0 || options.speed != 1 || options.uniform ||
                        options.appearance != ParticleAppearance::kReplay || !wind.empty() || !source_map.empty() ||
                        !sink_map.empty() || !hazard_map.empty() || !looks.empty();
    if (placed)
      throw InvalidInput(
          model_path +
          ": is a model of water, whose bases are born together; --rate, --gravity, --speed, --uniform, "
          "--appearance, --wind, --source-map, --sink-map, --hazard-map and --template go with elements (learn with "
          "--tracking cores)");
    return std::make_unique<WaterSource>(model, WaterReplayOptions{}, options.seed, options.loop ? num_frames : 0);
  }

  static std::vector<std::string> paths_of(const ParticleOutputs& outputs) {
    return {outputs.video.string(), outputs.tracks.string(), outputs.layer.string()};
  }

  void check_request(const ParticleOutputs& outputs, const Session& session) const {
    if (frames != 0 && secs != 0) throw InvalidInput("--frames and --secs say the same thing twice; name one");
    if (frames < 0 || static_cast<double>(frames) > kMaxFrames) throw InvalidInput("--frames: 1 to 2e7");
    if (!(secs >= 0 && secs < 1e7)) throw InvalidInput("--secs: 0 to 1e7");
    if (draw.from == From::kSynthesis && frames == 0 && secs == 0)
      throw InvalidInput("--frames N or --secs S missing; see --help");
    if (draw.from == From::kLearned && (options.loop || options.uniform || !source_map.empty() || !wind.empty()))
      throw InvalidInput(
          "--from learned shows the clip's movetons as they were; --loop, --uniform, --source-map and "
          "--wind go with new ones");
    check_options(draw);
    if (draw.three_d && draw.style != Style::kPhoto) throw InvalidInput("--three-d goes with --style photo");
    check_video_output(output, session);
    check_output(outputs.tracks.string(), {".csv"}, session);
    check_output(outputs.layer.string(), {".mov"}, session);
    if (outputs.layer == outputs.video) throw InvalidInput(output + ": is the name of the layer; choose another");
  }

  std::int64_t wanted_frames(const TexturedMotion& model) const {
    const double rate = model.frames_per_sec;
    const std::int64_t wanted =
        frames > 0 ? frames : std::max<std::int64_t>(1, std::llround(std::min(secs * rate, kMaxFrames)));
    if (draw.from == From::kSynthesis) return wanted;
    return frames == 0 && secs == 0 ? model.num_frames : std::min(wanted, model.num_frames);
  }

  void read_options(const TexturedMotion& model, std::optional<TexturedMotion>& other) {
    if (!wind.empty()) {
      const std::vector<std::string> words = split_at_commas(wind);
      if (words.size() != 2) throw InvalidInput("--wind: '" + wind + "' is not X,Y");
      parse_value("--wind", words[0], options.wind_x);
      parse_value("--wind", words[1], options.wind_y);
      if (!(std::abs(options.wind_x) <= 1000 && std::abs(options.wind_y) <= 1000))
        throw InvalidInput("--wind: at most 1000 pixels a frame");
    }
    if (!source_map.empty()) options.source_map = density_of_image(read_png(source_map), model.width, model.height);
    if (!sink_map.empty()) options.sink_map = density_of_image(read_png(sink_map), model.width, model.height);
    if (!hazard_map.empty()) options.hazard_map = hazard_of_image(read_png(hazard_map), model.width, model.height);
    if (!sink_map.empty() && !hazard_map.empty()) throw InvalidInput("--sink-map and --hazard-map exclude each other");
    if (options.uniform && !source_map.empty()) throw InvalidInput("--uniform and --source-map exclude each other");
    if (looks.empty()) return;
    const bool is_number =
        std::all_of(looks.begin(), looks.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_number) return parse_value("--template", looks, options.looks_of_species);
    other = load_particles_model(looks);
    if (other->cables.empty()) throw InvalidInput(looks + ": has no elements to look like");
    options.looks_of = &*other;
  }

  int base_planes(const TexturedMotion& model) const {
    return options.looks_of != nullptr ? options.looks_of->num_planes : model.num_planes;
  }

  std::unique_ptr<FramePainter> make_painter(const TexturedMotion& model) const {
    std::optional<Image> replaced;
    if (!background.empty()) {
      const std::optional<Rgba> colour = colour_of(background);
      replaced = colour ? Image(model.width, model.height, *colour) : read_png(background);
    }
    const Image* picture = replaced ? &*replaced : nullptr;
    if (draw.style == Style::kPhoto) {
      Planes planes = magnified_background(model, draw.scale, picture);
      if (planes.size() == 1 && base_planes(model) == 3) planes = Planes(3, planes[0]);
      if (draw.three_d) return std::make_unique<BirdPainter>(model, std::move(planes), draw.scale, flight);
      if (model.water) return std::make_unique<WaterPainter>(model, std::move(planes), draw.scale, options.seed);
      return std::make_unique<PhotoPainter>(std::move(planes), draw.scale, base_planes(model),
                                            element_light(options.looks_of != nullptr ? *options.looks_of : model));
    }
    const DrawnStyle drawn = draw.style == Style::kSymbolic ? DrawnStyle::kSymbolic : DrawnStyle::kCartoon;
    if (picture == nullptr) return std::make_unique<StylePainter>(model, drawn, draw.scale);
    TexturedMotion shown = model;
    shown.background = magnified_background(model, 1, picture);
    if (shown.num_planes == 1) shown.background = {luma(shown.background)};
    return std::make_unique<StylePainter>(shown, drawn, draw.scale);
  }

  Value report_value(const ParticleVideoReport& report, const ParticleOutputs& outputs,
                     const CableSynthesizer* synthesizer) const {
    Value object;
    object["output"] = paths_of(outputs);
    object["frames"] = report.num_frames;
    object["width"] = report.width;
    object["height"] = report.height;
    object["seed"] = options.seed;
    object["tracks"] = report.num_tracks;
    object["elements_per_frame"] = report.elements_per_frame;
    object["bases_per_frame"] = report.bases_per_frame;
    if (synthesizer != nullptr) {
      const SynthesizeParticlesReport& made = synthesizer->report();
      object["learned_elements_per_frame"] = made.learned_per_frame;
      object["births_per_frame"] = made.births_per_frame;
      object["bursts_per_frame"] = made.bursts_per_frame;
      object["deaths_by"] = made.deaths_by_age ? "age" : "place";
    }
    object["options"] = options_value(options);
    object["drawing"] = options_value(draw);
    object["options"]["wind"] = Value::List{options.wind_x, options.wind_y};
    object["secs"] = Session::secs();
    return object;
  }
};

}  // namespace

Command particles_synthesize() {
  return make_command<Synthesize>(
      {"particles synthesize", "make new textured motion from a model",
       "Writes three files: the video, the paths (NAME.tracks.csv: track, frame, x, y, scale, angle, amplitude, in the "
       "model's pixels, those inside the picture) and the movetons alone with alpha (NAME.layer.mov, ProRes 4444). The "
       "same seed gives the same bytes.",
       "motex particles synthesize snow.motex -o snow_new.mp4 --frames 250\n"
       "motex particles synthesize snow.motex -o storm.mp4 --secs 10 --rate 3 --wind 4,0 --scale 2\n"
       "motex particles synthesize snow.motex -o idle.webm --frames 100 --loop\n"
       "motex particles synthesize fireworks.motex -o everywhere.mp4 --frames 300 --uniform\n"
       "motex particles synthesize snow.motex -o painted.mp4 --frames 200 --source-map painted.png\n"
       "motex particles synthesize birds.motex -o drawn.mp4 --frames 200 --style cartoon --scale 3\n"
       "motex particles synthesize birds.motex -o edited.mp4 --from learned --edits edits.json"});
}

}  // namespace motex::cli
