// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "motex/people/motifs.h"
#include "people_source.h"
#include "session.h"

namespace motex::cli {

/// The part of `people motifs` that goes with VIDEO|MODEL.
struct FootageMotifs {
  PeopleSourceArguments source;
  std::vector<std::string> pictures;

  void declare(Arguments& arguments);
  /// Whether one of its own arguments was given, which have no meaning for a series.
  bool is_asked_for() const { return !pictures.empty(); }
  /// A model shows the alphabet that it was learned with, unless options ask for another search.
  void run(const std::string& path, const FindMotifsOptions& options, Session& session);
};

/// Whether the input of `people motifs` is a table of numbers.
bool is_series_file(const std::string& path);

}  // namespace motex::cli
