// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/model_edits.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "motex/core/error.h"
#include "motex/markov/graph.h"
#include "motex/markov/stationary.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/texton_fitter.h"

namespace motex {
namespace {

std::size_t at(int texton) { return static_cast<std::size_t>(texton); }

std::string listed(const MotionTexture& model, const std::vector<int>& textons) {
  std::string text;
  for (std::size_t i = 0; i < textons.size(); ++i)
    text += (i == 0 ? "" : i + 1 == textons.size() ? " and " : ", ") + texton_label(model, textons[i]);
  return text;
}

/// Counts between the learned textons of these two kinds times factor.
struct PairWeight {
  std::vector<bool> from, to;
  double factor = 1;
};

/// What the edits make of each learned texton, before any count or fit is touched.
struct Relabelling {
  explicit Relabelling(MotionTexture& m) : model(m), owner(m.textons.size()) {
    std::iota(owner.begin(), owner.end(), 0);
  }
  void apply(const ModelEdit& edit);

  MotionTexture& model;    ///< its marks and names are set
  std::vector<int> owner;  ///< the texton that a learned one belongs to; −1: dropped
  std::vector<PairWeight> weights;
  bool has_dropped = false, has_merged = false;

 private:
  void check(int texton) const;
  void rename(int texton, const std::string& name);
  void drop(int texton);
  void merge(int into, int other);
  std::vector<bool> owned_by(int texton) const;
};

void check_number(const MotionTexture& model, int texton) {
  const auto count = static_cast<int>(model.textons.size());
  if (texton < 0 || texton >= count)
    throw InvalidInput("there is no texton " + std::to_string(texton) + "; the model has 0 … " +
                       std::to_string(count - 1));
}

void check_not_gone(const MotionTexture& model, int texton) {
  check_number(model, texton);
  const Texton& t = model.textons[at(texton)];
  if (t.merged_into >= 0)
    throw InvalidInput("texton " + texton_label(model, texton) + " was merged into " +
                       texton_label(model, t.merged_into) + "; name that one");
  if (t.is_dropped) throw InvalidInput("texton " + texton_label(model, texton) + " was dropped from the model");
}

void Relabelling::check(int texton) const { check_not_gone(model, texton); }

void Relabelling::rename(int texton, const std::string& name) {
  for (std::size_t i = 0; i < model.textons.size() && !name.empty(); ++i)
    if (model.textons[i].name == name && static_cast<int>(i) != texton)
      throw InvalidInput("texton " + std::to_string(i) + " is called '" + name + "' already");
  model.textons[at(texton)].name = name;
}

void Relabelling::drop(int texton) {
  std::replace(owner.begin(), owner.end(), texton, -1);
  model.textons[at(texton)].is_dropped = true;
  has_dropped = true;
}

void Relabelling::merge(int into, int other) {
  if (into == other)
    throw InvalidInput("texton " + texton_label(model, into) + " cannot be merged with itself; name two that differ");
  std::replace(owner.begin(), owner.end(), other, into);
  for (Texton& texton : model.textons)
    if (texton.merged_into == other) texton.merged_into = into;
  model.textons[at(other)].merged_into = into;
  has_merged = true;
}

std::vector<bool> Relabelling::owned_by(int texton) const {
  std::vector<bool> out;
  for (const int o : owner) out.push_back(texton < 0 || o == texton);
  return out;
}

void Relabelling::apply(const ModelEdit& edit) {
  const auto& named = edit.textons;
  const bool from_any = edit.kind == ModelEdit::Kind::kWeight && named[0] < 0;
  for (std::size_t i = from_any ? 1 : 0; i < named.size(); ++i) check(named[i]);
  switch (edit.kind) {
    case ModelEdit::Kind::kName:
      return rename(named[0], edit.name);
    case ModelEdit::Kind::kDrop:
      for (const int texton : named) drop(texton);
      return;
    case ModelEdit::Kind::kKeep:
      for (int i = 0; i < static_cast<int>(owner.size()); ++i)
        if (owner[at(i)] == i && std::find(named.begin(), named.end(), i) == named.end()) drop(i);
      return;
    case ModelEdit::Kind::kMerge:
      for (std::size_t i = 1; i < named.size(); ++i) {
        check(named[i]);  // named twice: gone by now
        merge(named[0], named[i]);
      }
      return;
    case ModelEdit::Kind::kWeight:
      weights.push_back({owned_by(named[0]), owned_by(named[1]), edit.factor});
  }
}

/// Takes the instances of dropped textons out and cuts the runs there, so that what is left follows on without gap in
/// each run. Labels stay those learned.
void cut_out_dropped(MotionTexture& model, const std::vector<int>& owner) {
  std::vector<Run> runs;
  std::vector<Instance> instances;
  for (std::size_t k = 0; k < model.instances.size(); ++k) {
    Instance x = model.instances[k];
    if (owner[at(x.texton)] < 0) continue;
    const Run& run = model.runs[static_cast<std::size_t>(x.run_idx)];
    const bool follows = !instances.empty() && k > 0 && owner[at(model.instances[k - 1].texton)] >= 0 &&
                         model.instances[k - 1].run_idx == x.run_idx;
    if (!follows) runs.push_back({run.clip_idx, run.clip_start + x.row - run.row, x.row, 0});
    runs.back().length += x.length;
    x.run_idx = static_cast<int>(runs.size()) - 1;
    instances.push_back(x);
  }
  model.runs = std::move(runs);
  model.instances = std::move(instances);
  for (Texton& texton : model.textons) texton.instances.clear();
  for (std::size_t k = 0; k < model.instances.size(); ++k)
    model.textons[at(model.instances[k].texton)].instances.push_back(static_cast<int>(k));
}

/// Learned counts, weighted, and added up by owner.
TransitionMatrix contracted(const TransitionMatrix& learned, const Relabelling& labels, bool weighted) {
  TransitionMatrix out(learned.num_states(), learned.prior_count());
  for (const TransitionCount& c : learned.counts()) {
    const int from = labels.owner[at(c.from)], to = labels.owner[at(c.to)];
    if (from < 0 || to < 0) continue;
    double count = c.count;
    if (weighted)
      for (const PairWeight& weight : labels.weights)
        if (weight.from[at(c.from)] && weight.to[at(c.to)]) count *= weight.factor;
    if (!std::isfinite(count)) throw InvalidInput("a transition's weights multiply to more than any number");
    if (count > 0) out.add_count(from, to, count);
  }
  return out;
}

Lds fitted(const MotionTexture& model, const LdsStatistics& statistics) {
  const LdsPrior prior = make_prior(model.global_statistics, prior_frames_of(model.options));
  if (!model.options.common_dynamics) return fit_lds(statistics, prior);
  const Lds common = fit_lds(model.global_statistics, make_prior(model.global_statistics, 1));
  return fit_noise(statistics, prior, common.transition);
}

/// Own basis: the subspace too is found anew, from the frames.
void refit_own(MotionTexture& model, const TextonFitter& fitter, int texton) {
  std::vector<LabelledSegment> segments;
  for (const int k : model.textons[at(texton)].instances) {
    const Instance& x = model.instances[static_cast<std::size_t>(k)];
    segments.push_back({texton, x.run_idx, x.row, x.length});
  }
  TextonFit fit = fitter.fit(segments, fitter.prior_frames());
  model.textons[at(texton)].dynamics = std::move(fit.dynamics);
  model.textons[at(texton)].statistics = std::move(fit.statistics);
  model.subspaces[at(texton)] = std::move(fit.subspace);
}

/// Hands instances and statistics to their owners and fits these anew. Must see the runs as they were learned.
void join_merged(MotionTexture& model, const std::vector<int>& owner) {
  std::vector<int> grown;
  for (int i = 0; i < static_cast<int>(owner.size()); ++i) {
    const int into = owner[at(i)];
    if (into < 0 || into == i) continue;
    if (model.subspaces.size() == 1) model.textons[at(into)].statistics += model.textons[at(i)].statistics;
    grown.push_back(into);
  }
  std::sort(grown.begin(), grown.end());
  grown.erase(std::unique(grown.begin(), grown.end()), grown.end());
  for (Texton& texton : model.textons) texton.instances.clear();
  for (std::size_t k = 0; k < model.instances.size(); ++k) {
    int& texton = model.instances[k].texton;
    if (owner[at(texton)] >= 0) texton = owner[at(texton)];
    model.textons[at(texton)].instances.push_back(static_cast<int>(k));
  }
  if (model.subspaces.size() == 1) {
    for (const int i : grown) model.textons[at(i)].dynamics = fitted(model, model.textons[at(i)].statistics);
  } else if (!grown.empty()) {
    const Corpus corpus{model.corpus.cast<double>(), model.runs, 0};
    const TextonFitter fitter(corpus, model.options);
    for (const int i : grown) refit_own(model, fitter, i);
  }
}

void check_ways_out(const MotionTexture& model, const TransitionMatrix& unweighted) {
  for (int i = 0; i < static_cast<int>(model.textons.size()); ++i) {
    if (!model.transitions.is_dead_end(i) || unweighted.is_dead_end(i)) continue;
    std::vector<int> followers;
    for (const TransitionCount& c : unweighted.counts_from(i)) followers.push_back(c.to);
    throw InvalidInput("nothing would follow texton " + texton_label(model, i) + ": " +
                       (followers.size() == 1 ? "its only way out (" : "all its ways out (") +
                       listed(model, followers) + ") would be forbidden; drop texton " + texton_label(model, i) +
                       " too, or use a small factor above 0");
  }
}

void find_visit_ratios(MotionTexture& model) {
  const std::vector<int> danced = danced_textons(model);
  const auto before = stationary_shares(model.unweighted, danced), after = stationary_shares(model.transitions, danced);
  model.visit_ratios.assign(model.textons.size(), 1);
  for (std::size_t k = 0; k < danced.size(); ++k) model.visit_ratios[at(danced[k])] = after[k] / before[k];
}

void check_dances(const MotionTexture& model) {
  const std::vector<int> danced = danced_textons(model);
  if (danced.empty())
    throw InvalidInput("nothing would be left to dance: of the textons that stay, none is followed by another again");
}

}  // namespace

std::vector<int> danced_textons(const MotionTexture& model) {
  const std::vector<std::vector<int>> components =
      strongly_connected_components(counted_graph(model.transitions)).members;
  const std::vector<int>* largest = nullptr;
  for (const auto& members : components) {
    const bool goes_on = members.size() > 1 || model.transitions.count(members[0], members[0]) > 0;
    if (goes_on && (largest == nullptr || members.size() > largest->size())) largest = &members;
  }
  return largest == nullptr ? std::vector<int>{} : *largest;
}

MotionTexture apply_edits(MotionTexture model) {
  if (model.edits_applied) throw InvalidInput("the edits of the model are applied already");
  model.edits_applied = true;
  if (model.edits.empty()) return model;
  Relabelling labels(model);
  for (const ModelEdit& edit : model.edits) labels.apply(edit);
  if (std::all_of(labels.owner.begin(), labels.owner.end(), [](int owner) { return owner < 0; }))
    throw InvalidInput("no texton would be left");
  TransitionMatrix learned = model.transitions;
  if (labels.has_dropped) {
    MotionTexture left = model;
    cut_out_dropped(left, labels.owner);
    learned = transitions_with_jumps(left);
  }
  if (labels.has_merged) join_merged(model, labels.owner);
  if (labels.has_dropped) {
    std::vector<int> stays(labels.owner.size(), -1);  // instances carry their owners by now
    for (const int owner : labels.owner)
      if (owner >= 0) stays[at(owner)] = owner;
    cut_out_dropped(model, stays);
  }
  if (!labels.has_dropped && !labels.has_merged && labels.weights.empty()) return model;
  const TransitionMatrix unweighted = contracted(learned, labels, false);
  model.transitions = contracted(learned, labels, true);
  check_ways_out(model, unweighted);
  check_dances(model);
  if (!labels.weights.empty()) {
    model.unweighted = unweighted;
    find_visit_ratios(model);
  }
  return model;
}

namespace {

void check_has_effect(const MotionTexture& applied, const ModelEdit& edit) {
  if (edit.kind != ModelEdit::Kind::kWeight) return;
  const int from = edit.textons[0], to = edit.textons[1];
  bool follows = false;
  for (const TransitionCount& c : applied.transitions.counts()) follows |= c.to == to && (from < 0 || c.from == from);
  if (follows || from < 0) return;
  std::vector<int> followers;
  for (const TransitionCount& c : applied.transitions.counts_from(from)) followers.push_back(c.to);
  throw InvalidInput("texton " + texton_label(applied, to) + " never follows " + texton_label(applied, from) +
                     " in this model, so there is nothing to weigh; " + listed(applied, followers) +
                     (followers.size() == 1 ? " does" : " do"));
}

std::vector<int> without(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

}  // namespace

EditReport add_edit(MotionTexture& learned, ModelEdit edit) {
  if (parse_edit(edit_text(edit)) != edit) throw InvalidInput("an edit and its name stand on one line");
  const MotionTexture before = apply_edits(learned);
  learned.edits.push_back(std::move(edit));
  try {
    const MotionTexture after = apply_edits(learned);
    check_has_effect(before, learned.edits.back());
    const auto danced_before = danced_textons(before), danced_after = danced_textons(after);
    EditReport report{without(danced_before, danced_after), without(danced_after, danced_before)};
    std::erase_if(report.lost, [&](int i) { return !after.textons[at(i)].is_playable(); });
    return report;
  } catch (...) {
    learned.edits.pop_back();
    throw;
  }
}

ModelEdit undo_edit(MotionTexture& learned, int k) {
  const auto count = static_cast<int>(learned.edits.size());
  if (count == 0) throw InvalidInput("the model has no edit to undo");
  if (k < -1 || k >= count)
    throw InvalidInput("there is no edit " + std::to_string(k) + "; the model has 0 … " + std::to_string(count - 1));
  if (k < 0) k = count - 1;
  const std::vector<ModelEdit> old = learned.edits;
  learned.edits.erase(learned.edits.begin() + k);
  try {
    apply_edits(learned);
  } catch (const Error& error) {
    learned.edits = old;
    throw InvalidInput("edit " + std::to_string(k) + " (" + edit_text(old[at(k)]) +
                       ") cannot be taken back alone, a later one needs it: " + error.what());
  }
  return old[at(k)];
}

void check_playable(const MotionTexture& model, int texton) {
  check_not_gone(model, texton);
  if (!model.textons[at(texton)].is_playable())
    throw InvalidInput("texton " + texton_label(model, texton) + " has no example");
}

std::optional<int> find_texton(const MotionTexture& model, std::string_view text) {
  for (std::size_t i = 0; i < model.textons.size(); ++i)
    if (!text.empty() && model.textons[i].name == text) return static_cast<int>(i);
  int number = 0;
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number < 0 || at(number) >= model.textons.size()) return std::nullopt;
  return number;
}

std::string texton_label(const MotionTexture& model, int texton) {
  const std::string& name = model.textons.at(at(texton)).name;
  return std::to_string(texton) + (name.empty() ? "" : " (" + name + ")");
}

}  // namespace motex
