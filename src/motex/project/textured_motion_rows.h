// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "motex/core/archive.h"
#include "motex/particles/textured_motion.h"

/// Parts of textured_motion_file.cpp: tables of numbers, and the maps.
namespace motex {

/// A matrix that is filled row by row.
class TableWriter {
 public:
  explicit TableWriter(Index num_columns) : num_columns_(num_columns) {}
  /// Begins a row; all rows must come to num_columns numbers.
  void row(std::initializer_list<double> numbers) {
    ++num_rows_;
    append(numbers);
  }
  void append(std::initializer_list<double> numbers) { values_.insert(values_.end(), numbers); }
  FrameMatrix matrix() const;

 private:
  Index num_columns_, num_rows_ = 0;
  std::vector<double> values_;
};

/// The other way; every failure names the array.
class TableReader {
 public:
  TableReader(const ArchiveReader& in, std::string name, Index num_columns);
  bool next_row_if_any();
  void next_row();
  double take();
  /// A whole number from 0 to `most`.
  int take_count(double most);
  Spread take_spread();

 private:
  const ArchiveReader& in_;
  std::string name_;
  FrameMatrix values_;
  Index row_ = -1, column_ = 0;
};

void write_maps(ArchiveWriter& out, const BirthDeathMaps& maps);
/// The rest of the model must have been read. A model without maps has empty ones.
void read_maps(const ArchiveReader& in, TexturedMotion& model);

}  // namespace motex
