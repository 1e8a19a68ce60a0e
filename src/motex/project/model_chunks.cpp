// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/model_chunks.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "motex/motion_texture/model_edits.h"

namespace motex {
namespace {

struct Chunk {
  const char* name;
  bool (*is_needed)(const MotionTexture& model);  ///< it differs from what its absence means
  void (*write)(ArchiveWriter& out, const char* name, const MotionTexture& model);
  void (*read)(const ArchiveReader& in, const char* name, MotionTexture& model);
};

void write_reference_height(ArchiveWriter& out, const char* name, const MotionTexture& model) {
  const double height[] = {model.features.reference_height};
  out.add(name, height);
}

void read_reference_height(const ArchiveReader& in, const char* name, MotionTexture& model) {
  model.features.reference_height = in.doubles(name, 1)[0];
}

void write_edits(ArchiveWriter& out, const char* name, const MotionTexture& model) {
  std::string lines;
  for (const ModelEdit& edit : model.edits) lines += edit_text(edit) + '\n';
  out.add(name, lines);
}

void read_edits(const ArchiveReader& in, const char* name, MotionTexture& model) {
  std::istringstream lines(in.text(name));
  for (std::string line; std::getline(lines, line);) model.edits.push_back(parse_edit(line));
  if (model.edits.empty()) in.fail("the list of edits is empty");
}

constexpr Chunk kChunks[] = {
    {"reference_height", [](const MotionTexture& model) { return model.features.reference_height != 0; },
     write_reference_height, read_reference_height},
    {"edits", [](const MotionTexture& model) { return !model.edits.empty(); }, write_edits, read_edits},
};

}  // namespace

std::uint32_t model_version(const MotionTexture& model) {
  return std::any_of(std::begin(kChunks), std::end(kChunks), [&](const Chunk& chunk) { return chunk.is_needed(model); })
             ? 2
             : 1;
}

void write_chunks(ArchiveWriter& out, const MotionTexture& model) {
  for (const Chunk& chunk : kChunks)
    if (chunk.is_needed(model)) chunk.write(out, chunk.name, model);
}

void read_chunks(const ArchiveReader& in, MotionTexture& model) {
  for (const Chunk& chunk : kChunks)
    if (in.has(chunk.name)) chunk.read(in, chunk.name, model);
}

}  // namespace motex
