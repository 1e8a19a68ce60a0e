// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/people/motifs.h"
#include "people_source.h"
#include "session.h"

namespace motex::cli {

/// What is asked of `people motifs`.
struct MotifRequest {
  FindMotifsOptions options;
  std::vector<std::string> pictures;
  bool paper = false;
};

/// The part of `people motifs` that goes with VIDEO|MODEL.
struct FootageMotifs {
  PeopleSourceArguments source;

  /// request.options are in range. A model shows the alphabet that it was learned with, unless options ask for another
  /// search.
  void run(const std::string& path, const MotifRequest& request, Session& session);
};

/// Whether the input of `people motifs` is a table of numbers.
bool is_series_file(const std::string& path);

}  // namespace motex::cli
