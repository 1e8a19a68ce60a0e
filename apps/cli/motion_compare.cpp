// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "closest.h"
#include "commands.h"
#include "motex/motion/length_unit.h"
#include "motex/motion/measures.h"
#include "motex/motion_io/clip_io.h"
#include "motex/project/load_clips.h"
#include "options_value.h"
#include "text_table.h"

namespace motex::cli {
namespace {

Value measures_value(const MotionMeasures& measures) {
  Value object;
  object["frames"] = std::int64_t{measures.num_frames};
  object["jerk"] = measures.jerk;
  object["contact_speed"] = measures.contact_speed;
  object["contact_share"] = measures.contact_share;
  object["pose_jump"] = measures.pose_jump;
  object["speed"] = measures.speed;
  object["height_min"] = measures.height_min;
  object["height_max"] = measures.height_max;
  return object;
}

Value report_value(const CompareReport& report) {
  Value object;
  object["coverage"] = report.coverage;
  object["global_diversity"] = report.global_diversity;
  object["local_diversity"] = report.local_diversity;
  object["jerk_ratio"] = report.jerk_ratio;
  object["contact_speed_ratio"] = report.contact_speed_ratio;
  object["pose_jump_ratio"] = report.pose_jump_ratio;
  object["speed_ratio"] = report.speed_ratio;
  object["reference"] = measures_value(report.reference);
  object["generated"] = measures_value(report.generated);
  object["body_height"] = report.body_height;
  object["feet"] = report.feet;
  object["glitch_frames"] = std::int64_t{report.num_glitch_frames};
  object["reference_windows"] = std::int64_t{report.num_reference_windows};
  return object;
}

std::string report_text(const CompareReport& report) {
  const MotionMeasures &source = report.reference, &made = report.generated;
  return text_pairs(
             {{"coverage", fixed(100 * report.coverage, 1) + " % of the reference appears in the generated clip"},
              {"global diversity", fixed(report.global_diversity, 3) + " per frame"},
              {"local diversity", fixed(report.local_diversity, 3) + " per frame"}}) +
         "\n" +
         text_table(
             {{"", "reference", "generated", "ratio"},
              {"jerk, 1/s³", fixed(source.jerk, 3), fixed(made.jerk, 3), fixed(report.jerk_ratio, 3)},
              {"contact foot speed, units/s", fixed(source.contact_speed, 3), fixed(made.contact_speed, 3),
               fixed(report.contact_speed_ratio, 3)},
              {"largest pose jump, units/s", fixed(source.pose_jump, 3), fixed(made.pose_jump, 3),
               fixed(report.pose_jump_ratio, 3)},
              {"mean joint speed, units/s", fixed(source.speed, 3), fixed(made.speed, 3), fixed(report.speed_ratio, 3)},
              {"lowest height, units", fixed(source.height_min, 3), fixed(made.height_min, 3), ""},
              {"highest height, units", fixed(source.height_max, 3), fixed(made.height_max, 3), ""}}) +
         "\nfeet: " + enumerate(report.feet) + "\n";
}

struct Compare {
  std::vector<std::string> reference_paths;
  std::string generated_path;
  CompareOptions options;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    Argument& reference =
        arguments.value("--reference", "CLIP...", "clips that were learned from, or folders of them", reference_paths);
    reference.required = true;
    reference.greedy = true;
    arguments.value("--generated", "CLIP", "clip to judge", generated_path).required = true;
    arguments.section("How");
    arguments.options(options);
    arguments.section("Reading clips");
    arguments.options(read);
  }

  void run(Session& session) {
    const std::vector<Clip> reference =
        load_clips({reference_paths.begin(), reference_paths.end()}, read, session.job(0, 0.1));
    Clip generated = read_clip(generated_path, read, session.job(0.1, 0.2));
    const Skeleton& skeleton = reference[0].skeleton;
    if (skeleton_difference(generated.skeleton, skeleton).empty()) match_unit(generated, skeleton, session.job(0, 0.2));
    const CompareReport report = compare_motion(reference, generated, options, session.job(0.2, 1));
    Value object = report_value(report);
    object["options"] = options_value(options);
    session.result(object, report_text(report));
  }
};

}  // namespace

Command motion_compare() {
  return make_command<Compare>(
      {"motion compare", "how complete, new, smooth and grounded generated motion is against its source",
       "Coverage and diversity at 30 Hz by joint rotations; the rest relative to the source, seams included "
       "(1 = as the source).",
       "motex motion compare --reference clips/*.bvh --generated new.bvh\n"
       "motex motion compare --reference clips/ --generated new.bvh --json"});
}

}  // namespace motex::cli
