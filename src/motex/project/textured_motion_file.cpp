// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/textured_motion_file.h"

#include <algorithm>
#include <cmath>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/project/textured_motion_rows.h"
#include "motex/project/water_model_file.h"

namespace motex {
namespace {

constexpr char kKind[] = "textured_motion";
constexpr std::uint32_t kNewestVersion = 2;
using Ints = std::vector<std::int64_t>;

bool has_streaks(const std::vector<Cable>& cables) {
  const auto any = [](const std::vector<Base>& path) {
    return std::any_of(path.begin(), path.end(), [](const Base& base) { return base.kind == BaseKind::kStreak; });
  };
  return std::any_of(cables.begin(), cables.end(), [&](const Cable& cable) {
    return any(cable.core) || std::any_of(cable.coils.begin(), cable.coils.end(), any);
  });
}

/// Version 2 has streaks among the kinds of bases. What has none is version 1, which every motex reads.
std::uint32_t version_of(const TexturedMotion& model) {
  for (const MovetonTemplate& one : model.templates)
    for (const TemplatePose& pose : one.poses) {
      if (pose.core_kind == BaseKind::kStreak) return 2;
      for (const TemplateCoil& coil : pose.coils)
        if (coil.kind == BaseKind::kStreak) return 2;
    }
  return has_streaks(model.cables) ? 2 : 1;
}

void write_clip(ArchiveWriter& out, const TexturedMotion& model) {
  const double numbers[] = {static_cast<double>(model.width),
                            static_cast<double>(model.height),
                            static_cast<double>(model.num_planes),
                            model.frames_per_sec,
                            static_cast<double>(model.num_frames),
                            model.noise,
                            static_cast<double>(model.background_kind),
                            model.flow.vx,
                            model.flow.vy,
                            model.flow.peak_ratio};
  out.add("clip", numbers);
  out.add("source", model.source);
  const Ints seed{static_cast<std::int64_t>(model.seed)};
  out.add("seed", seed);
  out.add("background", encode_png(to_image(model.background)));
}

void read_clip(const ArchiveReader& in, TexturedMotion& model) {
  const auto numbers = in.doubles("clip", 10);
  const auto whole = [&](std::size_t k, double least, double most) {
    if (!(numbers[k] >= least && numbers[k] <= most) || numbers[k] != std::floor(numbers[k]))
      in.fail("the description of the clip is out of range");
    return static_cast<std::int64_t>(numbers[k]);
  };
  model.width = static_cast<int>(whole(0, 1, 32768));
  model.height = static_cast<int>(whole(1, 1, 32768));
  model.num_planes = static_cast<int>(whole(2, 1, 3));
  model.frames_per_sec = numbers[3];
  model.num_frames = whole(4, 1, 1e9);
  model.noise = numbers[5];
  model.background_kind = static_cast<BackgroundKind>(whole(6, 0, static_cast<double>(BackgroundKind::kFlat)));
  model.flow = {numbers[7], numbers[8], numbers[9]};
  if (model.num_planes == 2 || !(model.frames_per_sec >= 0.01 && model.frames_per_sec <= 1000) || !(model.noise >= 0))
    in.fail("the description of the clip is out of range");
  model.source = in.text("source");
  model.seed = static_cast<std::uint64_t>(in.ints("seed", 1)[0]);
  const Image background = decode_png(in.text("background"), "the model's background");
  if (background.width != model.width || background.height != model.height)
    in.fail("the background is of another size than the clip");
  model.background = to_planes(background, model.num_planes);
}

void write_templates(ArchiveWriter& out, const TexturedMotion& model) {
  TableWriter templates(15), poses(3), coils(16), transitions(4), dynamics(55);
  for (const MovetonTemplate& one : model.templates) {
    templates.row({static_cast<double>(one.poses.size()), one.share, one.pose_transitions.prior_count()});
    for (const Spread& spread : {one.log_scale, one.amplitude, one.angle, one.colour[0], one.colour[1], one.colour[2]})
      templates.append({spread.mean, spread.deviation});
    for (const TemplatePose& pose : one.poses) {
      poses.row({static_cast<double>(pose.core_kind), pose.share, static_cast<double>(pose.coils.size())});
      for (const TemplateCoil& coil : pose.coils) {
        coils.row({static_cast<double>(coil.kind), coil.presence});
        for (const Spread& spread : {coil.u, coil.v, coil.log_scale, coil.angle, coil.coefficient[0],
                                     coil.coefficient[1], coil.coefficient[2]})
          coils.append({spread.mean, spread.deviation});
      }
    }
    const auto idx = static_cast<double>(&one - model.templates.data());
    for (const TransitionCount& count : one.pose_transitions.counts())
      transitions.row({idx, static_cast<double>(count.from), static_cast<double>(count.to), count.count});
  }
  for (const MovetonDynamics& one : model.dynamics) {
    dynamics.row({});
    for (const CoordinateDynamics& z : {one.x, one.y, one.log_scale, one.angle, one.amplitude})
      dynamics.append({z.a, z.b, z.c, z.d, z.a0, z.c0, z.d0, z.c_spread, z.c_slope, z.start_mean, z.start_deviation});
  }
  out.add("templates", templates.matrix());
  out.add("template_poses", poses.matrix());
  out.add("template_coils", coils.matrix());
  out.add("pose_transitions", transitions.matrix());
  out.add("dynamics", dynamics.matrix());
}

BaseKind kind_of(const ArchiveReader& in, double number) {
  const BaseKind newest = in.version() < 2 ? BaseKind::kGaussian : BaseKind::kStreak;
  if (!(number >= 0 && number <= static_cast<double>(newest)) || number != std::floor(number))
    in.fail("a base is of no known kind");
  return static_cast<BaseKind>(static_cast<int>(number));
}

void read_pose(const ArchiveReader& in, TableReader& poses, TableReader& coils, TemplatePose& pose) {
  poses.next_row();
  pose.core_kind = kind_of(in, poses.take());
  pose.share = poses.take();
  for (int left = poses.take_count(100000); left > 0; --left) {
    coils.next_row();
    TemplateCoil& coil = pose.coils.emplace_back();
    coil.kind = kind_of(in, coils.take());
    coil.presence = coils.take();
    for (Spread* spread : {&coil.u, &coil.v, &coil.log_scale, &coil.angle, &coil.coefficient[0], &coil.coefficient[1],
                           &coil.coefficient[2]})
      *spread = coils.take_spread();
  }
}

void read_transitions(const ArchiveReader& in, TexturedMotion& model) {
  TableReader transitions(in, "pose_transitions", 4);
  while (transitions.next_row_if_any()) {
    const int idx = transitions.take_count(static_cast<double>(model.templates.size()) - 1);
    MovetonTemplate& one = model.templates[static_cast<std::size_t>(idx)];
    const double most = static_cast<double>(one.poses.size()) - 1;
    const int from = transitions.take_count(most), to = transitions.take_count(most);
    one.pose_transitions.add_count(from, to, transitions.take());
  }
}

void read_templates(const ArchiveReader& in, TexturedMotion& model) {
  TableReader templates(in, "templates", 15), poses(in, "template_poses", 3), coils(in, "template_coils", 16),
      dynamics(in, "dynamics", 55);
  while (templates.next_row_if_any()) {
    MovetonTemplate& one = model.templates.emplace_back();
    const int num_poses = templates.take_count(10000);
    one.share = templates.take();
    one.pose_transitions = TransitionMatrix(num_poses, templates.take());
    for (Spread* spread : {&one.log_scale, &one.amplitude, &one.angle, &one.colour[0], &one.colour[1], &one.colour[2]})
      *spread = templates.take_spread();
    for (int left = num_poses; left > 0; --left) read_pose(in, poses, coils, one.poses.emplace_back());
    if (one.poses.empty()) in.fail("a template has no pose");
  }
  read_transitions(in, model);
  while (dynamics.next_row_if_any()) {
    MovetonDynamics& one = model.dynamics.emplace_back();
    for (CoordinateDynamics* z : {&one.x, &one.y, &one.log_scale, &one.angle, &one.amplitude})
      for (double* field : {&z->a, &z->b, &z->c, &z->d, &z->a0, &z->c0, &z->d0, &z->c_spread, &z->c_slope,
                            &z->start_mean, &z->start_deviation})
        *field = dynamics.take();
  }
  if (model.dynamics.size() != model.templates.size()) in.fail("there must be as many dynamics as templates");
}

void write_cables(ArchiveWriter& out, const TexturedMotion& model) {
  Ints cables, poses;
  std::size_t num_bases = 0;
  for (const Cable& cable : model.cables) num_bases += cable.core.size() * (1 + cable.coils.size());
  FrameMatrixF bases(static_cast<Index>(num_bases), 5 + model.num_planes);
  Index at = 0;
  const auto write = [&](const std::vector<Base>& path) {
    for (const Base& base : path) {
      auto row = bases.row(at++);
      row(0) = static_cast<float>(base.kind);
      row(1) = static_cast<float>(base.x);
      row(2) = static_cast<float>(base.y);
      row(3) = static_cast<float>(base.scale);
      row(4) = static_cast<float>(base.angle);
      for (int k = 0; k < model.num_planes; ++k) row(5 + k) = base.coefficients[static_cast<std::size_t>(k)];
    }
  };
  for (const Cable& cable : model.cables) {
    for (const std::int64_t number :
         {cable.first_frame, cable.num_frames(), std::int64_t{cable.species},
          static_cast<std::int64_t>(cable.coils.size()), static_cast<std::int64_t>(cable.poses.empty() ? 0 : 1)})
      cables.push_back(number);
    write(cable.core);
    for (const std::vector<Base>& coil : cable.coils) write(coil);
    poses.insert(poses.end(), cable.poses.begin(), cable.poses.end());
  }
  out.add("cables", cables);
  out.add("cable_poses", poses);
  out.add("cable_bases", bases);
}

class CableReader {
 public:
  CableReader(const ArchiveReader& in, const TexturedMotion& model)
      : in_(in),
        model_(model),
        cables_(in.ints("cables")),
        poses_(in.ints("cable_poses")),
        bases_(in.matrix_f("cable_bases", -1, 5 + model.num_planes)) {
    if (cables_.size() % 5 != 0) in.fail("the table of cables is cut off");
  }

  std::vector<Cable> read() {
    std::vector<Cable> out;
    for (std::size_t row = 0; row + 5 <= cables_.size(); row += 5) out.push_back(read_cable(&cables_[row]));
    if (next_base_ != bases_.rows() || next_pose_ != poses_.size()) in_.fail("bases belong to no cable");
    return out;
  }

 private:
  Cable read_cable(const std::int64_t* numbers) {
    Cable cable;
    cable.first_frame = numbers[0];
    const std::int64_t length = numbers[1], num_coils = numbers[3];
    if (std::abs(cable.first_frame) > 1000000000 || length < 1 || length > bases_.rows() || num_coils < 0 ||
        num_coils > bases_.rows() || (numbers[4] != 0 && numbers[4] != 1))
      in_.fail("a cable is out of range");
    if (numbers[2] < -1 || numbers[2] >= static_cast<std::int64_t>(model_.templates.size()))
      in_.fail("a cable is of a species that is not there");
    cable.species = static_cast<int>(numbers[2]);
    cable.core = read_path(length);
    for (std::int64_t k = 0; k < num_coils; ++k) cable.coils.push_back(read_path(length));
    if (numbers[4] == 1) read_poses(cable);
    return cable;
  }

  std::vector<Base> read_path(std::int64_t length) {
    if (length > bases_.rows() - next_base_) in_.fail("a cable has fewer bases than it says");
    std::vector<Base> path(static_cast<std::size_t>(length));
    for (Base& base : path) {
      const auto row = bases_.row(next_base_++);
      base.kind = kind_of(in_, static_cast<double>(row(0)));
      base.x = static_cast<double>(row(1));
      base.y = static_cast<double>(row(2));
      base.scale = static_cast<double>(row(3));
      base.angle = static_cast<double>(row(4));
      for (int k = 0; k < model_.num_planes; ++k) base.coefficients[static_cast<std::size_t>(k)] = row(5 + k);
      if (!(base.scale > 0.01 && base.scale < 1000) || std::abs(base.x) > 1e6 || std::abs(base.y) > 1e6)
        in_.fail("a base is out of range");
    }
    return path;
  }

  void read_poses(Cable& cable) {
    if (cable.core.size() > poses_.size() - next_pose_) in_.fail("a cable has fewer poses than it says");
    const std::size_t num_poses =
        cable.species < 0 ? 1 : model_.templates[static_cast<std::size_t>(cable.species)].poses.size();
    for (std::size_t t = 0; t < cable.core.size(); ++t) {
      const std::int64_t pose = poses_[next_pose_++];
      if (pose < 0 || pose >= static_cast<std::int64_t>(num_poses)) in_.fail("a pose is out of range");
      cable.poses.push_back(static_cast<int>(pose));
    }
  }

  const ArchiveReader& in_;
  const TexturedMotion& model_;
  Ints cables_, poses_;
  FrameMatrixF bases_;
  Index next_base_ = 0;
  std::size_t next_pose_ = 0;
};

}  // namespace

std::string textured_motion_bytes(const TexturedMotion& model) {
  ArchiveWriter out(kKind, version_of(model));
  write_clip(out, model);
  write_templates(out, model);
  write_maps(out, model.maps);
  write_cables(out, model);
  write_water(out, model);
  return out.bytes();
}

void save_textured_motion(const std::filesystem::path& path, const TexturedMotion& model) {
  write_file(path, textured_motion_bytes(model));
}

TexturedMotion parse_textured_motion(std::string bytes, const std::string& name) {
  const ArchiveReader in(std::move(bytes), name, kKind, kNewestVersion);
  TexturedMotion model;
  read_clip(in, model);
  read_templates(in, model);
  model.cables = CableReader(in, model).read();
  read_maps(in, model);
  read_water(in, model);
  return model;
}

TexturedMotion load_textured_motion(const std::filesystem::path& path) {
  return parse_textured_motion(read_file(path), path.string());
}

}  // namespace motex
