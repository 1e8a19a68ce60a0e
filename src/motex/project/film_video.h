// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "motex/core/job.h"
#include "motex/people/find_cuts.h"
#include "motex/people/render_film.h"
#include "motex/project/backdrop.h"
#include "motex/project/people_model_file.h"

namespace motex {

struct FilmVideoReport {
  int num_frames = 0;
  std::vector<CutReport> cuts;  ///< how each cut was made
};

/// Draws a film of a model and writes it to every output: with alpha (.mov, .webm, .mkv, PNG files), or over the
/// backdrop (may be null). All outputs appear at the end, or none. Models hold no sound, so films have none.
/// Throws what FilmRenderer and VideoWriter throw.
FilmVideoReport write_film_video(const PeopleModel& model, const EditList& edits, const RenderFilmOptions& options,
                                 Backdrop* backdrop, const std::vector<std::filesystem::path>& outputs,
                                 const JobContext& job = {});

/// Finds the cuts of a model that has none yet.
void complete_cuts(PeopleModel& model, const JobContext& job = {});

}  // namespace motex
