// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/direct.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr double kStepSecs = 4;  // longer standing is planned in pieces
constexpr int kRounds = 3;       // in which occurrences that come again are made dearer
constexpr int kMemory = 3;       // performances of a motif after which the same occurrence may come again
constexpr int kMaxSteps = 20000;
constexpr std::size_t kMaxBeginnings = 12;  // of a loop that are tried

/// One motif performed once (motif ≥ 0), or idle frames.
struct Step {
  int motif = -1;
  int num_frames = 0;
  bool is_drawn = false;  // in free play: another motif does as well
};

std::string name_of(const PeopleTexture& texture, const Step& step) {
  if (step.motif < 0) return "stand";
  const Motif& motif = texture.alphabet.motifs[static_cast<std::size_t>(step.motif)];
  return motif.name.empty() ? motif.letter : motif.name;
}

double mean_length(const Motif& motif) {
  double sum = 0;
  for (const Occurrence& o : motif.occurrences) sum += o.length;
  return motif.occurrences.empty() ? std::max(motif.window, 1) : sum / static_cast<double>(motif.occurrences.size());
}

/// Takes a script apart into steps; free play is drawn here.
class StepList {
 public:
  StepList(const PeopleTexture& texture, const DirectOptions& options)
      : texture_(texture), options_(options), rng_(options.seed) {}

  std::vector<Step> of(std::span<const Direction> script) {
    for (const Direction& direction : script) {
      const double frames = direction.secs * texture_.frames_per_sec;
      if (direction.kind == Direction::Kind::kIdle)
        stand(direction);
      else if (direction.kind == Direction::Kind::kAny)
        play_freely(direction, frames);
      else
        perform(direction, frames);
      if (steps_.size() > kMaxSteps)
        throw InvalidInput("the script asks for more than " + std::to_string(kMaxSteps) + " actions");
    }
    return std::move(steps_);
  }

 private:
  const Motif& motif(int k) const { return texture_.alphabet.motifs[static_cast<std::size_t>(k)]; }

  void stand(const Direction& direction) {
    const double secs = (direction.secs > 0 ? direction.secs : options_.stand_secs) * direction.times;
    int left = std::max(1, static_cast<int>(std::lround(secs * texture_.frames_per_sec)));
    const int most = std::max(2, static_cast<int>(std::lround(kStepSecs * texture_.frames_per_sec)));
    while (left > 0) {
      const int now = left > most && left < 2 * most ? left / 2 : std::min(left, most);
      steps_.push_back({-1, now});
      left -= now;
    }
  }

  void perform(const Direction& direction, double frames) {
    if (direction.motif < 0 || direction.motif >= static_cast<int>(texture_.alphabet.motifs.size()))
      throw InvalidInput("the script asks for motif " + std::to_string(direction.motif) + ", which does not exist");
    int times = direction.times;
    if (frames > 0) times *= std::max(1, static_cast<int>(std::lround(frames / mean_length(motif(direction.motif)))));
    steps_.insert(steps_.end(), static_cast<std::size_t>(times), {direction.motif, 0});
  }

  /// Motifs by how often the actor performed them, none twice in a row where there are others.
  void play_freely(const Direction& direction, double frames) {
    std::vector<double> weights;
    for (const Motif& m : texture_.alphabet.motifs) weights.push_back(static_cast<double>(m.occurrences.size()));
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
      throw InvalidInput("'*': there is no motif to play freely with");
    double left = frames;
    for (int k = 0; frames > 0 ? left > 0 : k < direction.times; ++k) {
      std::vector<double> now = weights;
      const int last = steps_.empty() ? -1 : steps_.back().motif;
      if (last >= 0 && std::count(now.begin(), now.end(), 0.0) + 1 < static_cast<std::ptrdiff_t>(now.size()))
        now[static_cast<std::size_t>(last)] = 0;
      steps_.push_back({static_cast<int>(rng_.weighted(now)), 0, true});
      left -= mean_length(motif(steps_.back().motif));
    }
  }

  const PeopleTexture& texture_;
  const DirectOptions& options_;
  Rng rng_;
  std::vector<Step> steps_;
};

/// What a film is planned with; planned several times, since an occurrence should not come again and again.
class FilmPlan {
 public:
  FilmPlan(const PeopleTexture& texture, const DirectOptions& options, std::vector<Step> steps,
           std::span<const double> beats, const JobContext& job)
      : texture_(texture),
        options_(options),
        job_(job),
        steps_(std::move(steps)),
        penalties_(steps_.size()),
        graph_(texture, min_shot_frames(options, texture.frames_per_sec), options.transition_frames),
        max_wait_(static_cast<int>(std::lround(options.max_latency_secs * texture.frames_per_sec))) {
    for (const double beat : beats) beats_.push_back(beat * texture.frames_per_sec);
  }

  std::vector<FilmPiece> pieces() {
    std::vector<FilmPiece> best;
    for (int round = 0; round < kRounds; ++round) {
      job_.progress("planning the film", static_cast<double>(round) / kRounds);
      best = options_.loop ? plan_loop() : plan();
      if (!penalise_repetition(best)) break;
    }
    return best;
  }
  const std::vector<Step>& steps() const { return steps_; }
  double cost() const { return cost_; }

 private:
  std::vector<FilmPiece> plan() {
    FilmPlanner planner(texture_, graph_, beats_);
    const std::vector<FilmState> states = go_on(planner, begin(planner), 1);
    cost_ = states.front().cost;
    return planner.pieces_of(states.front());
  }

  std::vector<FilmState> begin(FilmPlanner& planner) const {
    const Step& first = steps_.front();
    std::vector<FilmState> states = first.motif >= 0 ? planner.begin_with_motif(first.motif, 0, penalties_[0])
                                                     : planner.begin_with_idle(first.num_frames, 0);
    if (!states.empty()) return states;
    if (first.motif >= 0)
      throw InvalidInput("'" + name_of(texture_, first) + "' is never performed whole inside a take");
    throw InvalidInput("the actor cannot stand for " + std::to_string(first.num_frames) +
                       " frames: idle stretches are shorter and no cut joins them");
  }

  std::vector<FilmState> go_on(FilmPlanner& planner, std::vector<FilmState> states, std::size_t first_step) {
    for (std::size_t k = first_step; k < steps_.size(); ++k) {
      job_.check_cancelled();
      states = go_on_to(planner, states, static_cast<int>(k));
    }
    return states;
  }

  std::vector<FilmState> go_on_to(FilmPlanner& planner, const std::vector<FilmState>& from, int k) {
    Step& step = steps_[static_cast<std::size_t>(k)];
    const Step &before = steps_[static_cast<std::size_t>(k) - 1], wanted = step;
    std::vector<FilmState> states = ways_to(planner, from, k);
    // A loop is planned from several beginnings, which have to agree on the steps.
    for (const int motif : wanted.is_drawn && !options_.loop ? by_frequency(before.motif) : std::vector<int>{}) {
      if (!states.empty()) break;
      step.motif = motif;
      penalties_[static_cast<std::size_t>(k)].clear();
      states = ways_to(planner, from, k);
    }
    if (states.empty())
      throw InvalidInput("there is no way from '" + name_of(texture_, before) + "' to '" + name_of(texture_, wanted) +
                         "': no cut is good enough; allow more difference at cuts or add footage");
    return states;
  }

  /// Motifs that are performed, the commonest first and the last one at the end.
  std::vector<int> by_frequency(int last) const {
    const std::vector<Motif>& motifs = texture_.alphabet.motifs;
    std::vector<int> order;
    for (std::size_t m = 0; m < motifs.size(); ++m)
      if (!motifs[m].occurrences.empty()) order.push_back(static_cast<int>(m));
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      if ((a == last) != (b == last)) return b == last;
      return motifs[static_cast<std::size_t>(a)].occurrences.size() >
             motifs[static_cast<std::size_t>(b)].occurrences.size();
    });
    return order;
  }

  /// Within the latency limit, or as soon as possible; empty where no cut leads there.
  std::vector<FilmState> ways_to(FilmPlanner& planner, const std::vector<FilmState>& from, int k) const {
    const Step& step = steps_[static_cast<std::size_t>(k)];
    for (int wait = max_wait_;; wait = std::min(2 * std::max(wait, 8), graph_.num_frames())) {
      std::vector<FilmState> states =
          step.motif >= 0 ? planner.go_on_to_motif(from, step.motif, k, wait, penalties_[static_cast<std::size_t>(k)])
                          : planner.go_on_to_idle(from, step.num_frames, k, wait);
      if (!states.empty() || wait >= graph_.num_frames()) return states;
    }
  }

  /// Every beginning by itself: the end has to lead back to it.
  std::vector<FilmPiece> plan_loop() {
    std::optional<std::vector<FilmPiece>> best;
    FilmPlanner planner(texture_, graph_, beats_);
    std::vector<FilmState> beginnings = begin(planner);
    if (beginnings.size() > kMaxBeginnings) {  // spread over all
      std::vector<FilmState> some;
      for (std::size_t k = 0; k < kMaxBeginnings; ++k)
        some.push_back(beginnings[k * beginnings.size() / kMaxBeginnings]);
      beginnings = std::move(some);
    }
    for (const FilmState& beginning : beginnings) {
      const int first = planner.pieces_of(beginning).front().first;
      std::vector<FilmState> ends;
      try {
        ends = go_on(planner, {beginning}, 1);
      } catch (const Cancelled&) {
        throw;
      } catch (const InvalidInput&) {
        continue;
      }
      for (int wait = max_wait_;; wait = std::min(2 * std::max(wait, 8), graph_.num_frames())) {
        const std::vector<FilmState> closed = planner.go_on_to_frame(ends, first, wait);
        if (!closed.empty() && (!best || closed.front().cost < cost_)) {
          cost_ = closed.front().cost;
          best = planner.pieces_of(closed.front());
        }
        if (!closed.empty() || wait >= graph_.num_frames()) break;
      }
    }
    if (!best) throw InvalidInput("no cut leads from the end of the film back to its beginning; leave out --loop");
    return *best;
  }

  /// Makes occurrences dearer that were shown among the last performances of the same motif. False when there are none.
  bool penalise_repetition(const std::vector<FilmPiece>& pieces) {
    std::vector<std::vector<int>> shown(texture_.alphabet.motifs.size());
    bool repeats = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const int step = pieces[i].step;
      if (step < 0 || (i > 0 && pieces[i - 1].step == step)) continue;
      const int motif = steps_[static_cast<std::size_t>(step)].motif;
      if (motif < 0) continue;
      const std::vector<Occurrence>& all = texture_.alphabet.motifs[static_cast<std::size_t>(motif)].occurrences;
      const auto is_shown = [&](const Occurrence& o) {
        return pieces[i].first >= o.start && pieces[i].first < o.start + o.length;
      };
      const int occurrence = static_cast<int>(std::find_if(all.begin(), all.end(), is_shown) - all.begin());
      std::vector<int>& before = shown[static_cast<std::size_t>(motif)];
      const std::size_t memory = std::min<std::size_t>(kMemory, all.size() - 1);
      const auto recent = before.end() - static_cast<std::ptrdiff_t>(std::min(memory, before.size()));
      if (std::find(recent, before.end(), occurrence) != before.end()) {
        repeats = true;
        penalties_[static_cast<std::size_t>(step)][occurrence] += PlanCosts{}.same_again;
      }
      before.push_back(occurrence);
    }
    return repeats;
  }

  const PeopleTexture& texture_;
  const DirectOptions& options_;
  const JobContext& job_;
  std::vector<Step> steps_;
  std::vector<FilmPlanner::Penalties> penalties_;
  FilmGraph graph_;
  int max_wait_;
  std::vector<double> beats_;
  double cost_ = 0;
};

/// A loop begins at one of its cuts, at best at one that no performance goes on over.
void turn_to_a_cut(std::vector<FilmPiece>& pieces) {
  for (const bool between_performances : {true, false})
    for (std::size_t i = pieces.size(); i-- > 0;) {
      const bool inside = i > 0 && pieces[i].step >= 0 && pieces[i - 1].step == pieces[i].step;
      if (pieces[i].cut < 0 || (between_performances && inside)) continue;
      std::rotate(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(i), pieces.end());
      return;
    }
}

void measure_latency(DirectReport& report, double frames_per_sec, int max_wait, const JobContext& job) {
  const std::vector<Performance>& performances = report.edits.performances;
  int late = 0;
  for (std::size_t k = 0; k < performances.size(); ++k) {
    const int end = k == 0 ? performances[0].start : performances[k - 1].start + performances[k - 1].length;
    const int wait = performances[k].start - end;
    report.latency_secs.push_back(wait / frames_per_sec);
    late += wait > max_wait ? 1 : 0;
  }
  if (late > 0)
    job.warn(std::to_string(late) + (late == 1 ? " action comes" : " actions come") +
             " later than the latency limit, " + std::to_string(report.longest_latency_secs()).substr(0, 4) +
             " s at most: nothing nearer leads to it");
}

}  // namespace

double DirectReport::longest_latency_secs() const {
  return latency_secs.empty() ? 0 : *std::max_element(latency_secs.begin(), latency_secs.end());
}

EditList edit_list_of(const PeopleTexture& texture, std::span<const FilmPiece> pieces,
                      std::span<const int> motif_of_step, int transition_frames) {
  EditList edits;
  int time = 0, last_step = -1;
  for (const FilmPiece& piece : pieces) {
    if (piece.cut >= 0 && time > 0) {
      edits.cuts.push_back(texture.cuts.cuts[static_cast<std::size_t>(piece.cut)]);
      edits.cuts.back().transition_frames = transition_frames;
    }
    if (edits.shots.empty() || piece.cut >= 0) edits.shots.push_back({piece.first, piece.first - 1, -1});
    Shot& shot = edits.shots.back();
    const int length = piece.last - piece.first + 1;
    shot.last = piece.last;
    const int motif = piece.step < 0 ? -1 : motif_of_step[static_cast<std::size_t>(piece.step)];
    if (motif >= 0 && shot.motif < 0) shot.motif = motif;
    if (piece.step >= 0 && length > 0) {
      const bool goes_on =
          piece.step == last_step || (motif < 0 && !edits.performances.empty() && edits.performances.back().motif < 0 &&
                                      edits.performances.back().start + edits.performances.back().length == time);
      if (goes_on && !edits.performances.empty())
        edits.performances.back().length = time + length - edits.performances.back().start;
      else
        edits.performances.push_back({motif, time, length});
    }
    if (length > 0) last_step = piece.step;
    time += length;
  }
  return edits;
}

DirectReport direct(const PeopleTexture& texture, std::span<const Direction> script, const DirectOptions& options,
                    std::span<const double> beats, const JobContext& job) {
  check_options(options);
  if (script.empty()) throw InvalidInput("the script is empty");
  if (texture.cuts.cuts.empty())
    throw InvalidInput("no cut of this footage is good enough for a film; learn from more footage of repeated actions");
  FilmPlan plan(texture, options, StepList(texture, options).of(script), beats, job);
  std::vector<FilmPiece> pieces = plan.pieces();
  std::vector<int> motif_of_step;
  for (const Step& step : plan.steps()) motif_of_step.push_back(step.motif);
  if (options.loop) turn_to_a_cut(pieces);
  DirectReport report;
  report.cost = plan.cost();
  report.edits = edit_list_of(texture, pieces, motif_of_step, options.transition_frames);
  report.edits.loop = options.loop;
  if (options.loop) {
    report.edits.cuts.push_back(texture.cuts.cuts[static_cast<std::size_t>(pieces.front().cut)]);
    report.edits.cuts.back().transition_frames = options.transition_frames;
  }
  measure_latency(report, texture.frames_per_sec,
                  static_cast<int>(std::lround(options.max_latency_secs * texture.frames_per_sec)), job);
  return report;
}

}  // namespace motex
