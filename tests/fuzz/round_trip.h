// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>

#include "motex/core/error.h"

namespace motex {

/// Whatever the bytes are, parse(bytes, name) returns a model or throws; a model that it returns is written (bytes_of)
/// and read again as the same bytes. Returns that model.
template <typename Parse, typename BytesOf>
auto round_trip(const std::string& bytes, Parse&& parse, BytesOf&& bytes_of)
    -> std::optional<decltype(parse(bytes, "fuzz"))> {
  std::optional<decltype(parse(bytes, "fuzz"))> model;
  try {
    model = parse(bytes, "fuzz");
  } catch (const Error&) {
    return std::nullopt;
  }
  const std::string written = bytes_of(*model);
  if (bytes_of(parse(written, "again")) != written) {
    std::cerr << "write and read changed the model\n";
    std::abort();
  }
  return model;
}

}  // namespace motex
