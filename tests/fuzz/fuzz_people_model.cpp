// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "motex/core/error.h"
#include "motex/project/people_model_file.h"
#include "sealed_archive.h"

namespace motex {
namespace {

/// Whatever the bytes are, the reader returns a model or throws; a model that it returns is written and read again as
/// the same bytes.
void try_model(const std::string& bytes) {
  PeopleModel model;
  try {
    model = parse_people_model(bytes, "fuzz");
  } catch (const Error&) {
    return;
  }
  const std::string written = people_model_bytes(model);
  if (people_model_bytes(parse_people_model(written, "again")) != written) {
    std::cerr << "write and read changed the model\n";
    std::abort();
  }
}

}  // namespace
}  // namespace motex

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  motex::try_model(motex::sealed_archive(data, size));
  return 0;
}
