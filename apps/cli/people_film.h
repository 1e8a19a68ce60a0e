// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "motex/people/direct.h"
#include "motex/project/film_video.h"
#include "session.h"

namespace motex::cli {

/// What commands that make a film of a model write, and how.
struct FilmArguments {
  std::vector<std::string> outputs, edit_outputs;
  std::string background;
  RenderFilmOptions render;

  void declare(Arguments& arguments);
  void declare_looks(Arguments& arguments);
  /// Before long work. Throws InvalidInput.
  void check(const Session& session) const;
  /// Everything that is written, for --dry-run.
  std::vector<std::string> paths() const;
  /// Draws and writes the film and its edit lists, tells and reports; `object`: the command's own part of
  /// the report; seed: of what was drawn by chance.
  void write(const PeopleModel& model, const EditList& edits, std::optional<std::uint64_t> seed, Value object,
             Session& session) const;
};

/// "A", or "high kick" where it has a name.
std::string motif_text(const PeopleTexture& texture, int motif);

}  // namespace motex::cli
