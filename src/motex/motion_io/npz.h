// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motex/motion/clip.h"

namespace motex {

/// Named arrays for numpy.load: a zip of .npy (version 1.0) files, deflated where that makes them smaller.
/// The same arrays give the same bytes. Throws InvalidInput for a name given twice and beyond the 4 GiB of a zip.
class NpzWriter {
 public:
  void add(const std::string& name, const FrameMatrix& values);
  void add(const std::string& name, const FrameMatrixF& values);
  void add(const std::string& name, std::span<const double> values);
  void add(const std::string& name, std::span<const std::int64_t> values);
  /// UTF-8; in numpy an array of fixed-length unicode.
  void add(const std::string& name, std::span<const std::string> values);
  /// An array without dimensions.
  void add(const std::string& name, double value);
  /// More than two dimensions, rows first; their product is the number of values.
  void add(const std::string& name, std::span<const double> values, std::span<const Index> shape);
  /// The complete file; the writer may go on to be used.
  std::string bytes() const;

 private:
  void add_npy(const std::string& name, std::string_view type, std::span<const Index> shape, std::string_view elements);
  struct Entry {
    std::string name;
    std::size_t offset;
    std::uint32_t crc, stored_size, size;
    bool deflated;
  };
  std::string body_;
  std::vector<Entry> entries_;
};

/// rotations frames × joints × 4 (w, x, y, z), translations frames × joints × 3 (in the parent's frame), positions
/// frames × joints × 3 (in the world), offsets joints × 3, parents, names, end_site_parents, end_site_offsets,
/// frame_time, metres_per_unit (0 = unknown).
std::string write_npz_bytes(const Clip& clip);
void write_npz(const std::filesystem::path& path, const Clip& clip);

}  // namespace motex
