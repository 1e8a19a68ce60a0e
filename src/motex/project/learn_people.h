// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/find_cuts.h"
#include "motex/people/motifs.h"
#include "motex/project/people_footage.h"
#include "motex/project/people_model_file.h"

namespace motex {

struct LearnPeopleOptions {
  bool mirror = false;
  bool lossless = false;
  bool cuts = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(
        Field{"mirror", "", "learn every take as seen in a mirror too: what was done to one side can be done to both"},
        self.mirror, Range{});
    visit(
        Field{"lossless", "", "keep the pictures exactly (FFV1, about five times as large) rather than as fine H.264"},
        self.lossless, Range{});
    visit(Field{"cuts", "", "look for the places at which films can be cut; without, direct and play do each time"},
          self.cuts, Range{});
  }
};

struct LearnPeopleReport {
  struct Clip {
    std::filesystem::path video;
    int num_frames = 0, num_shots = 0, num_takes = 0;
  };
  std::vector<Clip> clips;
  std::vector<MotifCandidate> candidates;  ///< what was looked at and is no motif
  double footage_secs = 0;                 ///< of all takes that are not mirrored
  /// Wall time of the stages.
  double keying_secs = 0, motif_secs = 0, cut_secs = 0;
};

struct LearnedPeople {
  PeopleModel model;
  LearnPeopleReport report;
};

/// The whole way from footage of an actor to a model: shots and takes, each keyed and stored as it goes by
/// (read_people_footage, TakeFilmWriter), what repeats (find_footage_motifs), where films can be
/// cut (find_cuts). Several videos are clips of one actor; their frame rates must agree, pictures of another
/// size are scaled to fit into those of the first. Memory does not grow with the pictures of the footage, save for 9 kB
/// a frame while cuts are looked for. Throws InvalidInput naming the clip and what to do, and what its parts throw.
LearnedPeople learn_people(const std::vector<std::filesystem::path>& videos, const PeopleFootageOptions& footage = {},
                           const FindMotifsOptions& motifs = {}, const FindCutsOptions& cuts = {},
                           const LearnPeopleOptions& options = {}, const JobContext& job = {});

/// Adds each take as seen in a mirror. The alphabet must not have been looked for.
void add_mirrored_takes(PeopleModel& model);

}  // namespace motex
