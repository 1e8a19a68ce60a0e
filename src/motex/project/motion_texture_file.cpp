// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/motion_texture_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/motion_io/gltf_skin.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/project/model_chunks.h"

namespace motex {
namespace {

constexpr char kKind[] = "motion_texture";
constexpr std::uint32_t kNewestVersion = 2;
constexpr Index kMostStates = 100;
constexpr double kMostContactSecs = 10;  // the foot pass keeps so many frames in memory

/// Options as lines "name value", so that files show what made them and new options can join.
struct OptionWriter {
  std::ostringstream& out;
  template <typename T, typename Limits>
  void operator()(const Field& field, const T& value, const Limits&) const {
    out << field.name << ' ';
    if constexpr (std::is_enum_v<T>)
      out << static_cast<int>(value);
    else
      out << value;
    out << '\n';
  }
};

struct OptionReader {
  const std::string& text;
  const ArchiveReader& reader;
  template <typename T, typename Limits>
  void operator()(const Field& field, T& value, const Limits&) const {
    std::istringstream lines(text);
    std::string name;
    while (lines >> name) {
      if (name == field.name) {
        if constexpr (std::is_enum_v<T>) {
          int number = 0;
          lines >> number;
          value = static_cast<T>(number);
        } else {
          lines >> value;
        }
        if (!lines) reader.fail(std::string("the option '") + field.name + "' is not readable");
        return;
      }
      lines >> name;
    }
  }
};

using Ints = std::vector<std::int64_t>;

std::string join_lines(const std::vector<std::string>& lines) {
  std::string out;
  for (std::string line : lines) {
    for (char& c : line)
      if (c == '\n') c = ' ';
    out += line + '\n';
  }
  return out;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out.push_back(line);
  return out;
}

int checked(const ArchiveReader& in, std::int64_t value, std::int64_t least, std::int64_t below, const char* what) {
  if (value < least || value >= below) in.fail(std::string(what) + " is out of range");
  return static_cast<int>(value);
}

void write_skeleton(ArchiveWriter& out, const Skeleton& skeleton) {
  std::vector<std::string> names;
  Ints parents, channels, site_parents;
  FrameMatrix offsets(skeleton.num_joints(), 3), sites(static_cast<Index>(skeleton.end_sites.size()), 3);
  for (const Joint& joint : skeleton.joints) {
    offsets.row(static_cast<Index>(names.size())) = joint.offset.transpose();
    names.push_back(joint.name);
    parents.push_back(joint.parent_idx);
    channels.push_back(static_cast<std::int64_t>(joint.channels.size()));
    for (const Channel c : joint.channels) channels.push_back(static_cast<std::int64_t>(c));
  }
  for (const EndSite& site : skeleton.end_sites) {
    sites.row(static_cast<Index>(site_parents.size())) = site.offset.transpose();
    site_parents.push_back(site.parent_idx);
  }
  out.add("joint_names", join_lines(names));
  out.add("joint_parents", parents);
  out.add("joint_channels", channels);
  out.add("joint_offsets", offsets);
  out.add("end_site_parents", site_parents);
  out.add("end_site_offsets", sites);
  const double unit[] = {skeleton.metres_per_unit};
  out.add("metres_per_unit", unit);
  if (skeleton.skin) out.add("skin", skeleton.skin->glb);
}

Skeleton read_skeleton(const ArchiveReader& in) {
  Skeleton skeleton;
  const auto names = split_lines(in.text("joint_names"));
  const auto n = static_cast<Index>(names.size());
  const Ints parents = in.ints("joint_parents", n), channels = in.ints("joint_channels");
  const FrameMatrix offsets = in.matrix("joint_offsets", n, 3);
  std::size_t at = 0;
  const auto take = [&](std::int64_t below) {
    if (at >= channels.size()) in.fail("joint_channels ends too early");
    return checked(in, channels[at++], 0, below, "a channel");
  };
  for (Index j = 0; j < n; ++j) {
    Joint joint;
    joint.name = names[static_cast<std::size_t>(j)];
    joint.parent_idx = checked(in, parents[static_cast<std::size_t>(j)], -1, j, "a parent");
    joint.offset = offsets.row(j).transpose();
    for (int left = take(7); left > 0; --left) joint.channels.push_back(static_cast<Channel>(take(6)));
    skeleton.joints.push_back(std::move(joint));
  }
  const Ints site_parents = in.ints("end_site_parents");
  const FrameMatrix sites = in.matrix("end_site_offsets", static_cast<Index>(site_parents.size()), 3);
  for (std::size_t e = 0; e < site_parents.size(); ++e)
    skeleton.end_sites.push_back(
        {checked(in, site_parents[e], 0, n, "a parent"), sites.row(static_cast<Index>(e)).transpose()});
  skeleton.metres_per_unit = in.doubles("metres_per_unit", 1)[0];
  if (!(skeleton.metres_per_unit >= 0)) in.fail("metres_per_unit is negative");
  check_skeleton(skeleton);
  if (in.has("skin")) skeleton.skin = read_skin_bytes(in.text("skin"), "the model's skin");
  return skeleton;
}

void write_features(ArchiveWriter& out, const FeatureSpace& space) {
  write_skeleton(out, space.skeleton);
  const double scalars[] = {space.frame_time_secs, space.cm_per_unit};
  out.add("frame_time_and_cm_per_unit", scalars);
  Ints joints{space.travelling_joint};
  joints.insert(joints.end(), space.joints.begin(), space.joints.end());
  out.add("feature_joints", joints);
  out.add("feature_references", space.references);
  out.add("feature_held", space.held);
  out.add("feature_weights",
          std::span<const double>(space.weights.data(), static_cast<std::size_t>(space.weights.size())));
}

FeatureSpace read_features(const ArchiveReader& in) {
  FeatureSpace space;
  space.skeleton = read_skeleton(in);
  const auto scalars = in.doubles("frame_time_and_cm_per_unit", 2);
  space.frame_time_secs = scalars[0];
  space.cm_per_unit = scalars[1];
  if (!(scalars[0] >= kLeastFrameTimeSecs && scalars[0] <= kMostFrameTimeSecs && scalars[1] > 0))
    in.fail("the frame time or unit is out of range");
  const Ints joints = in.ints("feature_joints");
  if (joints.empty()) in.fail("feature_joints is empty");
  const int n = space.skeleton.num_joints();
  space.travelling_joint = checked(in, joints[0], 0, n, "the travelling joint");
  for (std::size_t i = 1; i < joints.size(); ++i) space.joints.push_back(checked(in, joints[i], 0, n, "a joint"));
  space.references = in.matrix("feature_references", n, 4);
  space.held = in.matrix("feature_held", n, 3);
  for (Index j = 0; j < n; ++j)
    if (std::abs(space.references.row(j).squaredNorm() - 1) > 1e-6) in.fail("a reference is no unit quaternion");
  const auto weights = in.doubles("feature_weights", 6 + 3 * static_cast<Index>(space.joints.size()));
  space.weights = Eigen::Map<const Vector>(weights.data(), static_cast<Index>(weights.size()));
  if (!(space.weights.minCoeff() > 0)) in.fail("a weight is not positive");
  return space;
}

void write_feet(ArchiveWriter& out, const FootModel& feet) {
  FrameMatrix legs(static_cast<Index>(feet.legs.size()), 13);
  for (Index i = 0; i < legs.rows(); ++i) {
    const Leg& leg = feet.legs[static_cast<std::size_t>(i)];
    legs.row(i) << leg.hip_idx, leg.knee_idx, leg.ankle_idx, leg.toe_offset.transpose(), leg.knee_axis.transpose(),
        leg.ankle_floor, leg.toe_floor, leg.ankle_height, leg.toe_height;
  }
  out.add("legs", legs);
  const double scalars[] = {static_cast<double>(feet.pelvis_idx),
                            feet.cm_per_unit,
                            feet.begin_speed,
                            feet.end_speed,
                            feet.height_margin,
                            feet.min_contact_secs};
  out.add("foot_thresholds", scalars);
}

FootModel read_feet(const ArchiveReader& in, int num_joints) {
  FootModel feet;
  const FrameMatrix legs = in.matrix("legs", -1, 13);
  const auto joint = [&](double value) {
    if (value != std::floor(value)) in.fail("a leg's joint is no whole number");
    return checked(in, static_cast<std::int64_t>(std::clamp(value, -1.0, 1e6)), 0, num_joints, "a leg's joint");
  };
  for (Index i = 0; i < legs.rows(); ++i) {
    Leg leg;
    leg.hip_idx = joint(legs(i, 0)), leg.knee_idx = joint(legs(i, 1)), leg.ankle_idx = joint(legs(i, 2));
    leg.toe_offset = legs.row(i).segment<3>(3).transpose();
    leg.knee_axis = legs.row(i).segment<3>(6).transpose();
    leg.ankle_floor = legs(i, 9), leg.toe_floor = legs(i, 10), leg.ankle_height = legs(i, 11),
    leg.toe_height = legs(i, 12);
    feet.legs.push_back(leg);
  }
  const auto scalars = in.doubles("foot_thresholds", 6);
  feet.pelvis_idx = joint(scalars[0]);
  feet.cm_per_unit = scalars[1], feet.begin_speed = scalars[2], feet.end_speed = scalars[3];
  feet.height_margin = scalars[4], feet.min_contact_secs = scalars[5];
  if (!(feet.cm_per_unit > 0 && feet.begin_speed >= 0 && feet.end_speed >= 0 && feet.min_contact_secs >= 0 &&
        feet.min_contact_secs <= kMostContactSecs))
    in.fail("a foot threshold is out of range");
  return feet;
}

std::string numbered(const char* name, std::size_t i) { return std::string(name) + "/" + std::to_string(i); }

void write_subspace(ArchiveWriter& out, const std::string& name, const Subspace& space) {
  FrameMatrix rows(space.mean.size(), space.basis.cols() + 1);
  rows << space.mean, space.basis;
  out.add(name, rows);
}

Subspace read_subspace(const ArchiveReader& in, const std::string& name, Index dims) {
  const FrameMatrix rows = in.matrix(name, dims);
  if (rows.cols() < 2 || rows.cols() - 1 > kMostStates) in.fail(name + " has no usable size");
  return {rows.col(0), rows.rightCols(rows.cols() - 1)};
}

LdsStatistics read_statistics(const ArchiveReader& in, const std::string& name, Index d) {
  LdsStatistics out;
  out.moments = in.matrix(name, 3 * d + 1, 3 * d + 1);
  return out;
}

/// [A₁ A₂ | D | B Bᵀ].
void write_texton(ArchiveWriter& out, std::size_t i, const Texton& texton) {
  const Lds& lds = texton.dynamics;
  FrameMatrix rows(lds.state_size(), 3 * lds.state_size() + 1);
  rows << lds.transition, lds.offset, lds.noise_cov;
  out.add(numbered("dynamics", i), rows);
  out.add(numbered("statistics", i), FrameMatrix(texton.statistics.moments));
}

Texton read_texton(const ArchiveReader& in, std::size_t i, Index d) {
  Texton texton;
  const FrameMatrix rows = in.matrix(numbered("dynamics", i), d, 3 * d + 1);
  texton.dynamics.transition = rows.leftCols(2 * d);
  texton.dynamics.offset = rows.col(2 * d);
  texton.dynamics.set_noise(rows.rightCols(d));
  texton.statistics = read_statistics(in, numbered("statistics", i), d);
  return texton;
}

void write_examples(ArchiveWriter& out, const MotionTexture& model) {
  out.add("clip_names", join_lines(model.clip_names));
  out.add("clip_lengths", Ints(model.clip_lengths.begin(), model.clip_lengths.end()));
  out.add("corpus", model.corpus);
  if (model.heights.size() > 0)
    out.add("corpus_heights",
            std::span<const double>(model.heights.data(), static_cast<std::size_t>(model.heights.size())));
  Ints runs, instances;
  for (const Run& run : model.runs) runs.insert(runs.end(), {run.clip_idx, run.clip_start, run.length});
  for (const Instance& x : model.instances) instances.insert(instances.end(), {x.texton, x.run_idx, x.row, x.length});
  FrameMatrix places(static_cast<Index>(model.instances.size()), 3);
  for (Index k = 0; k < places.rows(); ++k) {
    const RootPlace& place = model.instances[static_cast<std::size_t>(k)].place;
    places.row(k) << place.x, place.z, place.heading;
  }
  out.add("places", places);
  out.add("runs", runs);
  out.add("instances", instances);
}

void read_runs(const ArchiveReader& in, MotionTexture& model) {
  const Ints runs = in.ints("runs");
  const auto clips = static_cast<std::int64_t>(model.clip_names.size());
  Index row = 0;
  if (runs.size() % 3 != 0 || runs.empty()) in.fail("runs has no usable size");
  for (std::size_t r = 0; r < runs.size(); r += 3) {
    Run run;
    run.clip_idx = checked(in, runs[r], 0, clips, "the clip of a run");
    const Index frames = model.clip_lengths[static_cast<std::size_t>(run.clip_idx)];
    if (runs[r + 1] < 0 || runs[r + 2] < 4 || runs[r + 1] > frames - runs[r + 2])
      in.fail("a run lies outside its clip");
    run.clip_start = runs[r + 1], run.length = runs[r + 2], run.row = row;
    row += run.length;
    if (row > model.corpus.rows()) in.fail("the runs are longer than the corpus");
    model.runs.push_back(run);
  }
  if (row != model.corpus.rows()) in.fail("the runs do not add up to the corpus");
}

void read_instances(const ArchiveReader& in, MotionTexture& model) {
  const Ints values = in.ints("instances");
  if (values.size() % 4 != 0 || values.empty()) in.fail("instances has no usable size");
  const auto textons = static_cast<std::int64_t>(model.textons.size());
  const FrameMatrix places = in.matrix("places", static_cast<Index>(values.size() / 4), 3);
  for (std::size_t k = 0; k < values.size(); k += 4) {
    Instance x;
    x.texton = checked(in, values[k], 0, textons, "the texton of an instance");
    x.run_idx = checked(in, values[k + 1], 0, static_cast<std::int64_t>(model.runs.size()), "the run of an instance");
    const Run& run = model.runs[static_cast<std::size_t>(x.run_idx)];
    x.row = values[k + 2], x.length = values[k + 3];
    const auto place = places.row(static_cast<Index>(k / 4));
    x.place = {place[0], place[1], place[2]};
    if (x.row < run.row || x.length < 4 || x.length > run.length || x.row - run.row > run.length - x.length)
      in.fail("an instance lies outside its run");
    model.textons[static_cast<std::size_t>(x.texton)].instances.push_back(static_cast<int>(model.instances.size()));
    model.instances.push_back(x);
  }
  for (const Texton& texton : model.textons)
    if (texton.instances.empty()) in.fail("a texton has no instance");
}

void read_examples(const ArchiveReader& in, MotionTexture& model) {
  model.clip_names = split_lines(in.text("clip_names"));
  for (const auto n : in.ints("clip_lengths", static_cast<Index>(model.clip_names.size()))) {
    if (n < 0 || n > (std::int64_t{1} << 40)) in.fail("the length of a clip is out of range");
    model.clip_lengths.push_back(n);
  }
  model.corpus = in.matrix_f("corpus", -1, model.features.size());
  if (in.has("corpus_heights")) {
    const auto heights = in.doubles("corpus_heights", model.corpus.rows());
    model.heights = Eigen::Map<const Vector>(heights.data(), static_cast<Index>(heights.size()));
  }
  read_runs(in, model);
}

void write_transitions(ArchiveWriter& out, const TransitionMatrix& transitions) {
  const auto counts = transitions.counts();
  FrameMatrix rows(static_cast<Index>(counts.size()), 3);
  for (Index k = 0; k < rows.rows(); ++k) {
    const TransitionCount& c = counts[static_cast<std::size_t>(k)];
    rows.row(k) << c.from, c.to, c.count;
  }
  out.add("transitions", rows);
}

TransitionMatrix read_transitions(const ArchiveReader& in, int num_textons) {
  TransitionMatrix out(num_textons);
  const FrameMatrix rows = in.matrix("transitions", -1, 3);
  for (Index k = 0; k < rows.rows(); ++k) {
    if (!(rows.row(k).minCoeff() >= 0 && rows(k, 0) < num_textons && rows(k, 1) < num_textons))
      in.fail("a transition is out of range");
    out.add_count(static_cast<int>(rows(k, 0)), static_cast<int>(rows(k, 1)), rows(k, 2));
  }
  return out;
}

}  // namespace

std::string motion_texture_bytes(const MotionTexture& model) {
  if (model.edits_applied && !model.edits.empty())
    throw InvalidInput("files hold models as they were learned; this one has its edits applied");
  ArchiveWriter out(kKind, model_version(model));
  std::ostringstream options;
  options.precision(17);
  LearnOptions::visit_fields(model.options, OptionWriter{options});
  out.add("options", options.str());
  write_features(out, model.features);
  write_examples(out, model);
  const Ints sizes{static_cast<std::int64_t>(model.textons.size()), static_cast<std::int64_t>(model.subspaces.size())};
  out.add("num_textons_and_subspaces", sizes);
  const double deviation[] = {model.outside_deviation};
  out.add("outside_deviation", deviation);
  for (std::size_t i = 0; i < model.subspaces.size(); ++i)
    write_subspace(out, numbered("subspace", i), model.subspaces[i]);
  for (std::size_t i = 0; i < model.textons.size(); ++i) write_texton(out, i, model.textons[i]);
  write_transitions(out, model.transitions);
  write_subspace(out, "global_subspace", model.global_subspace);
  out.add("global_statistics", FrameMatrix(model.global_statistics.moments));
  write_feet(out, model.feet);
  write_chunks(out, model);
  return out.bytes();
}

void save_motion_texture(const std::filesystem::path& path, const MotionTexture& model) {
  write_file(path, motion_texture_bytes(model));
}

MotionTexture parse_motion_texture(std::string bytes, const std::string& name) {
  const ArchiveReader in(std::move(bytes), name, kKind, kNewestVersion);
  MotionTexture model;
  const std::string options = in.text("options");
  model.options.path_weight = 0;  // of files from before there were paths of moves
  LearnOptions::visit_fields(model.options, OptionReader{options, in});
  check_options(model.options);
  model.features = read_features(in);
  const Index dims = model.features.size();
  read_examples(in, model);
  const Ints sizes = in.ints("num_textons_and_subspaces", 2);
  const int textons = checked(in, sizes[0], 1, 1 << 24, "the number of textons");
  if (sizes[1] != 1 && sizes[1] != textons) in.fail("the number of subspaces is neither one nor that of textons");
  model.outside_deviation = in.doubles("outside_deviation", 1)[0];
  if (!(model.outside_deviation > 0)) in.fail("outside_deviation is not positive");
  for (std::size_t i = 0; i < static_cast<std::size_t>(sizes[1]); ++i)
    model.subspaces.push_back(read_subspace(in, numbered("subspace", i), dims));
  for (int i = 0; i < textons; ++i)
    model.textons.push_back(read_texton(in, static_cast<std::size_t>(i), model.subspace(i).basis.cols()));
  read_instances(in, model);
  model.transitions = read_transitions(in, textons);
  model.global_subspace = read_subspace(in, "global_subspace", dims);
  model.global_statistics = read_statistics(in, "global_statistics", model.global_subspace.basis.cols());
  model.feet = read_feet(in, model.features.skeleton.num_joints());
  read_chunks(in, model);
  return model;
}

MotionTexture load_learned_motion_texture(const std::filesystem::path& path) {
  return parse_motion_texture(read_file(path), path.filename().string());
}

MotionTexture load_motion_texture(const std::filesystem::path& path) {
  MotionTexture learned = load_learned_motion_texture(path);
  try {
    return apply_edits(std::move(learned));
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.filename().string() + ": its edits cannot be applied: " + error.what());
  }
}

}  // namespace motex
