// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/direct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "motex/core/error.h"
#include "motex/people/cut_smoothness.h"
#include "motex/people/director.h"
#include "motex/people/find_cuts.h"
#include "motex/people/test_actor.h"

namespace motex {
namespace {

/// Footage with its cuts found.
PeopleTexture texture_of(const std::vector<std::string>& takes) {
  test_actor::Footage footage = test_actor::make_footage(takes);
  MemorySprites source(footage.sprites);
  footage.texture.cuts = find_cuts(footage.texture, comparable_frames(footage.texture, source)).cuts;
  return footage.texture;
}

const PeopleTexture& kata() {
  static const PeopleTexture kTexture = texture_of({"ABCAB", "CABBA", "CCA"});
  return kTexture;
}

std::vector<int> frames_of(const EditList& edits) {
  std::vector<int> frames;
  for (const Shot& shot : edits.shots)
    for (int t = shot.first; t <= shot.last; ++t) frames.push_back(t);
  return frames;
}

/// What any film has to keep.
void check_film(const PeopleTexture& texture, const EditList& edits, int min_shot) {
  const std::vector<int> take_of = take_of_frames(texture);
  std::set<std::pair<int, int>> found;
  for (const Cut& cut : texture.cuts.cuts) found.insert({cut.from, cut.to});
  ASSERT_EQ(edits.cuts.size(), edits.shots.size() - (edits.loop ? 0U : 1U));
  for (std::size_t k = 0; k < edits.shots.size(); ++k) {
    const Shot& shot = edits.shots[k];
    ASSERT_LE(shot.first, shot.last);
    EXPECT_EQ(take_of[static_cast<std::size_t>(shot.first)], take_of[static_cast<std::size_t>(shot.last)]);
    const bool inner = (k > 0 || edits.loop) && (k + 1 < edits.shots.size() || edits.loop);
    if (inner) {
      EXPECT_GE(shot.last - shot.first + 1, min_shot) << "shot " << k;
    }
  }
  for (std::size_t k = 0; k < edits.cuts.size(); ++k) {
    EXPECT_EQ(edits.cuts[k].from, edits.shots[k].last);
    EXPECT_EQ(edits.cuts[k].to, edits.shots[(k + 1) % edits.shots.size()].first);
    EXPECT_TRUE(found.contains({edits.cuts[k].from, edits.cuts[k].to}));
  }
}

/// Letters of the performances, '-' for standing; each must be one of the motif, whole up to a tenth at each end.
std::string performed(const PeopleTexture& texture, const EditList& edits) {
  const std::vector<int> frames = frames_of(edits);
  std::string letters;
  for (const Performance& performance : edits.performances) {
    letters +=
        performance.motif < 0 ? "-" : texture.alphabet.motifs[static_cast<std::size_t>(performance.motif)].letter;
    for (int t = performance.start; t < performance.start + performance.length; ++t) {
      const int frame = frames.at(static_cast<std::size_t>(t));
      bool inside = false;
      if (performance.motif < 0)
        for (const FrameSpan& idle : texture.alphabet.idle) inside |= frame >= idle.start && frame < idle.end();
      else
        for (const Occurrence& o : texture.alphabet.motifs[static_cast<std::size_t>(performance.motif)].occurrences)
          inside |= frame >= o.start && frame < o.start + o.length;
      EXPECT_TRUE(inside) << letters << " at film frame " << t;
    }
    if (performance.motif >= 0) {
      EXPECT_GE(performance.length, 0.6 * test_actor::kActionFrames);
    }
  }
  return letters;
}

DirectReport directed(const PeopleTexture& texture, const std::string& script, const DirectOptions& options = {},
                      const std::vector<double>& beats = {}) {
  return direct(texture, parse_script(script, texture.alphabet), options, beats);
}

TEST(Direct, PerformsTheScriptInOrder) {
  const DirectReport report = directed(kata(), "stand, high kick ×2, squat, raise, stand 3s, squat, high kick");
  check_film(kata(), report.edits, min_shot_frames({}, 25));
  EXPECT_EQ(performed(kata(), report.edits), "-BBCA-CB");
  EXPECT_EQ(report.edits.performances[0].length, 25);
  EXPECT_EQ(report.edits.performances[5].length, 75);
  EXPECT_LE(report.longest_latency_secs(), 3);
}

TEST(Direct, FootageInItsOwnOrderNeedsNoCut) {
  const DirectReport report = directed(kata(), "A B C A B");
  EXPECT_EQ(report.edits.cuts.size(), 0U);
  EXPECT_EQ(report.edits.shots.size(), 1U);
  EXPECT_EQ(report.edits.shots[0].first, kata().alphabet.motifs[0].occurrences[0].start + 3);
}

TEST(Direct, TheSameActionTwiceIsNotTheSameFootageTwice) {
  const DirectReport report = directed(kata(), "squat x3");
  EXPECT_EQ(performed(kata(), report.edits), "CCC");
  const std::vector<int> frames = frames_of(report.edits);
  std::set<int> firsts;
  for (const Performance& p : report.edits.performances) firsts.insert(frames[static_cast<std::size_t>(p.start)]);
  EXPECT_EQ(firsts.size(), 3U);
}

TEST(Direct, LatencyLimitIsKeptWhereItCanBe) {
  DirectOptions quick;
  quick.max_latency_secs = 1;
  const DirectReport report = directed(kata(), "A, C, B, C, A, B, C, A, C", quick);
  check_film(kata(), report.edits, min_shot_frames(quick, 25));
  EXPECT_EQ(performed(kata(), report.edits), "ACBCABCAC");
  EXPECT_LE(report.longest_latency_secs(), 1);
  DirectOptions impossible;
  impossible.max_latency_secs = 0;
  std::string warning;
  JobContext job;
  job.on_warning = [&](const std::string& text) { warning = text; };
  const DirectReport late = direct(kata(), parse_script("C A", kata().alphabet), impossible, {}, job);
  EXPECT_EQ(performed(kata(), late.edits), "CA");
  EXPECT_EQ(warning.empty(), late.longest_latency_secs() == 0);
}

TEST(Direct, LoopsGoOnFromTheLastFrameToTheFirst) {
  for (const char* script : {"B, A", "stand 2s", "A B C A B", "squat"}) {
    DirectOptions loop;
    loop.loop = true;
    const DirectReport report = directed(kata(), script, loop);
    EXPECT_TRUE(report.edits.loop);
    check_film(kata(), report.edits, min_shot_frames(loop, 25));
    EXPECT_FALSE(report.edits.performances.empty());
  }
}

TEST(Direct, ActionsAndCutsFallOnBeats) {
  std::vector<double> beats;
  for (double t = 0.37; t < 60; t += 0.9) beats.push_back(t);
  const auto offset = [&](const EditList& edits) {
    double sum = 0;
    int film = 0;
    for (std::size_t k = 0; k + 1 < edits.shots.size(); ++k) {
      film += edits.shots[k].last - edits.shots[k].first + 1;
      double nearest = 1e9;
      for (const double beat : beats) nearest = std::min(nearest, std::abs(beat * 25 - film));
      sum += nearest;
    }
    return sum / static_cast<double>(edits.cuts.size());
  };
  const std::string script = "B, C, A, stand, C, B, A, stand 2s, B, C, B, A";
  const DirectReport free = directed(kata(), script), bound = directed(kata(), script, {}, beats);
  check_film(kata(), bound.edits, min_shot_frames({}, 25));
  EXPECT_EQ(performed(kata(), bound.edits), "BCA-CBA-BCBA");
  ASSERT_GT(bound.edits.cuts.size(), 2U);
  EXPECT_LT(offset(bound.edits), 2.5);
  EXPECT_LT(offset(bound.edits), offset(free.edits));
}

TEST(Direct, FreePlayIsDrawnByTheSeed) {
  DirectOptions one, two;
  two.seed = 2;
  const DirectReport a = directed(kata(), "* x6", one), b = directed(kata(), "* x6", two),
                     c = directed(kata(), "* x6", one);
  EXPECT_EQ(performed(kata(), a.edits), performed(kata(), c.edits));
  EXPECT_NE(performed(kata(), a.edits), performed(kata(), b.edits));
  const std::string letters = performed(kata(), a.edits);
  EXPECT_EQ(letters.size(), 6U);
  for (std::size_t k = 1; k < letters.size(); ++k) EXPECT_NE(letters[k], letters[k - 1]);
}

TEST(Direct, SaysWhatCannotBeDone) {
  PeopleTexture uncut = kata();
  uncut.cuts = {};
  EXPECT_THROW(directed(uncut, "A"), InvalidInput);
  // B only in a take that no cut leads to.
  PeopleTexture apart = texture_of({"AA", "BB"});
  const int second = apart.takes[1].frames.start;
  std::erase_if(apart.cuts.cuts, [&](const Cut& cut) { return (cut.from < second) != (cut.to < second); });
  try {
    directed(apart, "A, high kick");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("no way from 'raise' to 'high kick'"), std::string::npos) << error.what();
  }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    DirectOptions options;
    options.seed = seed;
    EXPECT_EQ(performed(apart, directed(apart, "A, * x3", options).edits), "AAAA") << "free play takes what there is";
  }
}

TEST(Director, PlaysForEverAndNeverRunsIntoTheEndOfATake) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PlayOptions options;
    options.seed = seed;
    options.shot_secs = 3;
    const EditList edits = play(kata(), 5000, options);
    EXPECT_EQ(edits.num_frames(), 5000);
    check_film(kata(), edits, 10);
    EXPECT_GT(edits.shots.size(), 20U);
    // No two shots in a row show the same frames.
    int repeats = 0;
    for (std::size_t k = 2; k < edits.shots.size(); ++k)
      repeats +=
          edits.shots[k].first == edits.shots[k - 1].first || edits.shots[k].first == edits.shots[k - 2].first ? 1 : 0;
    EXPECT_LT(repeats, 3);
    std::set<int> shown;
    for (const int frame : frames_of(edits)) shown.insert(frame);
    EXPECT_GT(static_cast<int>(shown.size()), kata().num_frames() / 2);
  }
  EXPECT_NE(frames_of(play(kata(), 500, {5, 0.4, 5, 3, 1})), frames_of(play(kata(), 500, {5, 0.4, 5, 3, 2})));
}

TEST(Director, DoesWhatIsChosenAndPlaysOn) {
  Director director(kata());
  std::vector<DirectedFrame> frames;
  const auto run = [&](int count) {
    for (int t = 0; t < count; ++t) frames.push_back(director.next());
  };
  run(100);
  director.choose(2);
  director.choose(1);
  EXPECT_EQ(director.num_waiting(), 2);
  run(400);
  EXPECT_EQ(director.num_waiting(), 0);
  const EditList edits = edit_list_of_frames(kata(), frames, 5);
  check_film(kata(), edits, 10);
  EXPECT_EQ(performed(kata(), edits), "CB");
  EXPECT_THROW(director.choose(9), InvalidInput);
}

TEST(Director, RefusesFootageWithoutAWayBack) {
  PeopleTexture forward = kata();
  std::erase_if(forward.cuts.cuts, [](const Cut& cut) { return cut.to < cut.from; });
  EXPECT_THROW(Director{forward}, InvalidInput);
}

TEST(FilmGraph, AJoltCostsMoreThanADetour) {
  EXPECT_LT(cost_of_cut({0, 9, 5, 30, 1.1}, 30) + cost_of_cut({9, 30, 5, 30, 1.1}, 30),
            cost_of_cut({0, 30, 5, 10, 1.8}, 30));
}

TEST(FilmGraph, NothingThatEndsIsEndless) {
  const FilmGraph graph(kata(), 10);
  EXPECT_GT(graph.endless_share(), 0.7);
  for (const Take& take : kata().takes) {
    EXPECT_FALSE(graph.is_endless(take.frames.end() - 1));
    EXPECT_TRUE(std::isinf(graph.future_cost(take.frames.end() - 1)));
  }
  for (int t = 0; t < kata().num_frames(); ++t)
    if (graph.is_endless(t)) {
      EXPECT_TRUE(std::isfinite(graph.future_cost(t)));
    }
}

}  // namespace
}  // namespace motex
