// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/engine_export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/steering.h"

namespace motex {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kSweeps = 20;
constexpr double kFarthest = 1.25;  // τ

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

/// Names that files, engines and programs can have.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (good || (!out.empty() && out.back() != '_')) out += good ? c : '_';
  }
  return out;
}

class PackMaker {
 public:
  PackMaker(const MotionTexture& model, const EngineExportOptions& options, const JobContext& job)
      : model_(model), options_(options), job_(job), tau_(usual_jump_distance(model)) {}

  EnginePack make(const std::string& name) {
    choose_examples();
    cut_clips();
    join_clips();
    write_graph(name);
    return std::move(pack_);
  }

 private:
  double distance(int from, int to) const {
    return key_pose_distance(model_.corpus, hand_over_row(model_, model_.instances[at(from)]),
                             model_.instances[at(to)].row);
  }
  double transition(int from, int to) const { return model_.transitions.probability(from, to); }
  void choose_examples();
  int best_example(int texton, const std::vector<int>& chosen) const;
  void cut_clips();
  void join_clips();
  void join(int from);
  void write_graph(const std::string& name);
  Json clip_entry(const EngineClip& clip) const;

  const MotionTexture& model_;
  const EngineExportOptions& options_;
  const JobContext& job_;
  double tau_;
  std::vector<int> instances_;  // that are exported, by rising texton
  EnginePack pack_;
};

void PackMaker::choose_examples() {
  const int textons = static_cast<int>(model_.textons.size());
  std::vector<int> chosen(at(textons), -1);
  for (int i = 0; i < textons; ++i) {
    const auto& among = model_.textons[at(i)].instances;
    if (options_.all_examples)
      instances_.insert(instances_.end(), among.begin(), among.end());
    else if (!among.empty())
      chosen[at(i)] = among.front();
  }
  bool changed = !options_.all_examples;
  for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
    changed = false;
    for (int i = 0; i < textons; ++i) {
      if (chosen[at(i)] < 0) continue;
      job_.check_cancelled();
      const int best = best_example(i, chosen);
      changed = changed || best != chosen[at(i)];
      chosen[at(i)] = best;
    }
  }
  for (const int instance : chosen)
    if (instance >= 0) instances_.push_back(instance);
  if (instances_.empty()) throw InvalidInput("the model has no texton that can be played");
}

int PackMaker::best_example(int texton, const std::vector<int>& chosen) const {
  double least = std::numeric_limits<double>::infinity();
  int best = chosen[at(texton)];
  for (const int e : model_.textons[at(texton)].instances) {
    double cost = 0;
    for (int j = 0; j < static_cast<int>(chosen.size()); ++j) {
      const int other = j == texton ? e : chosen[at(j)];
      if (other < 0) continue;
      if (const double m = transition(texton, j); m > 0) cost += m * distance(e, other);
      if (const double m = transition(j, texton); m > 0) cost += m * distance(other, e);
    }
    if (cost < least) least = cost, best = e;
  }
  return best;
}

void PackMaker::cut_clips() {
  std::map<std::string, int> used;
  std::map<int, int> num_of_texton;
  for (const int i : instances_) {
    const Instance& a = model_.instances[at(i)];
    const std::string own = plain(model_.textons[at(a.texton)].name);
    EngineClip out{own.empty() ? "texton_" + std::to_string(a.texton) : own, a.texton, i, {}};
    if (options_.all_examples) out.name += "_" + std::to_string(num_of_texton[a.texton]++);
    const std::string stated = out.name;
    while (used[out.name]++ > 0) out.name = stated + "_" + std::to_string(used[stated]);
    const Index length = hand_over_row(model_, a) + 2 - a.row;
    out.clip = decode(model_.features, model_.corpus.middleRows(a.row, length).cast<double>());
    out.clip.name = out.name;
    pack_.clips.push_back(std::move(out));
  }
}

/// The transitions that leave a clip.
void PackMaker::join(int from) {
  const EngineClip& a = pack_.clips[at(from)];
  std::vector<EngineTransition> all;
  for (int b = 0; b < static_cast<int>(pack_.clips.size()); ++b) {
    const EngineClip& c = pack_.clips[at(b)];
    const double m = transition(a.texton, c.texton);
    if (m > 0) all.push_back({from, b, 0, m, distance(a.instance, c.instance), 0});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.distance_cm < y.distance_cm; });
  while (all.size() > 2 && all.back().distance_cm > kFarthest * tau_) all.pop_back();
  for (EngineTransition& t : all)
    t.probability = t.texton_probability * std::exp(-(t.distance_cm - all.front().distance_cm) / tau_);
  std::stable_sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.probability > y.probability; });
  if (all.size() > at(options_.most_transitions)) all.resize(at(options_.most_transitions));
  double sum = 0;
  for (const EngineTransition& t : all) sum += t.probability;
  const auto secs = [](const EngineClip& c) {
    return static_cast<double>(c.clip.num_frames() - 1) * c.clip.frame_time_secs;
  };
  for (EngineTransition& t : all) {
    t.probability /= sum;
    const double most = std::min({options_.blend, secs(a) / 2, secs(pack_.clips[at(t.to)]) / 2});
    t.blend_secs = most * std::min(1.0, t.distance_cm / tau_);
    pack_.transitions.push_back(t);
  }
}

void PackMaker::join_clips() {
  for (int a = 0; a < static_cast<int>(pack_.clips.size()); ++a) {
    job_.check_cancelled();
    join(a);
  }
}

Json PackMaker::clip_entry(const EngineClip& c) const {
  const Instance& a = model_.instances[at(c.instance)];
  const Run& run = model_.runs[at(a.run_idx)];
  const Excursion way = excursion(model_, c.instance);
  const double metres = model_.features.cm_per_unit / 100;
  return {{"name", c.name},
          {"texton", c.texton},
          {"frames", c.clip.num_frames()},
          {"secs", static_cast<double>(c.clip.num_frames() - 1) * c.clip.frame_time_secs},
          {"root_motion",
           {{"x", way.x * metres}, {"z", way.z * metres}, {"turn_degrees", way.turn * 180 / std::numbers::pi}}},
          {"source",
           {{"clip", model_.clip_names[at(run.clip_idx)]},
            {"start", run.clip_start + a.row - run.row},
            {"length", a.length}}}};
}

void PackMaker::write_graph(const std::string& name) {
  Json root = {{"motex_graph", 1},
               {"model", name},
               {"frame_rate", 1 / model_.frame_time_secs()},
               {"overlap_frames", 2},
               {"root_joint", model_.features.skeleton.joints[at(model_.features.travelling_joint)].name}};
  root["textons"] = Json::array();
  root["clips"] = Json::array();
  root["transitions"] = Json::array();
  for (std::size_t k = 0; k < pack_.clips.size(); ++k) {
    const EngineClip& c = pack_.clips[k];
    if (k == 0 || pack_.clips[k - 1].texton != c.texton)
      root["textons"].push_back(
          {{"texton", c.texton}, {"name", model_.textons[at(c.texton)].name}, {"clips", Json::array()}});
    root["textons"].back()["clips"].push_back(c.name);
    root["clips"].push_back(clip_entry(c));
  }
  for (const EngineTransition& t : pack_.transitions)
    root["transitions"].push_back({{"from", pack_.clips[at(t.from)].name},
                                   {"to", pack_.clips[at(t.to)].name},
                                   {"probability", t.probability},
                                   {"texton_probability", t.texton_probability},
                                   {"distance_cm", t.distance_cm},
                                   {"blend_secs", t.blend_secs}});
  pack_.graph = root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

EnginePack make_engine_pack(const MotionTexture& model, const std::string& name, const EngineExportOptions& options,
                            const JobContext& job) {
  check_options(options);
  return PackMaker(model, options, job).make(name);
}

std::string engine_glb(const EnginePack& pack) {
  std::vector<Clip> clips;
  for (const EngineClip& c : pack.clips) clips.push_back(c.clip);
  return write_glb_bytes(clips);
}

}  // namespace motex
