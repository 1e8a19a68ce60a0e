// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace motex {

/// Collects the binary part of a GLB: each piece of data gets a buffer view and an accessor of its own.
class GlbBuilder {
 public:
  struct Kind {
    int component_type;
    const char* type;
    std::size_t count;
    int target;  ///< 34962: vertices, 34963: indices, 0: neither
  };
  /// Index of the new accessor.
  int add(const void* data, std::size_t num_bytes, const Kind& kind);
  /// Index of a new buffer view alone.
  int add_view(const void* data, std::size_t num_bytes, int target);
  /// Least and largest of each component.
  void set_bounds(int accessor, const std::vector<float>& values, std::size_t num_components);

  /// Begins with the views and accessors of another file that file() made; their indices stay. Throws InvalidInput when
  /// it is none.
  void import(std::string_view glb, const std::string& name);
  /// The data of an accessor, to be changed in place.
  char* data(int accessor);

  /// The file. json: an object without accessors, bufferViews and buffers, which are added. Throws InvalidInput beyond
  /// 4 GiB.
  std::string file(std::string_view json, const std::string& name) const;

 private:
  struct View {
    std::size_t offset, size;
    int target;
  };
  struct Accessor {
    int view;
    Kind kind;
    std::vector<float> low, high;
  };
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
  std::string binary_;
};

}  // namespace motex
