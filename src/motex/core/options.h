// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace motex {

/// One line of an options struct as its visit_fields() lists it. Command line flags, JSON, Python keywords, the
/// studio's form and docs/reference_options.md are all made from these lines.
///
///   struct FitOptions {
///     double prior_frames = 30;
///     template <typename Self, typename Visitor>
///     static void visit_fields(Self& self, Visitor&& visit) {
///       visit(Field{"prior_frames", "frames", "weight of the prior"}, self.prior_frames, Range{0, 1e6});
///     }
///   };
///
/// A field is bool, int, double, std::uint64_t or std::string with a Range (ignored for bool and string), or an enum
/// with Choices whose order is that of the enumerators. The default is the value in a default-constructed struct.
struct Field {
  const char* name;  ///< snake_case; the flag is --name with '-' for '_'
  const char* unit;  ///< "" when it has none
  const char* help;
};

struct Range {
  double min = 0;
  double max = 0;
  bool zero_is_auto = false;  ///< 0 lies outside the range and means "choose from the data"; doors write it as "auto"
};

struct Choices {
  std::vector<std::string> names;
};

/// Throws InvalidInput naming the first field outside its range. Defined in options_check.h.
template <typename Options>
void check_options(const Options& options);

}  // namespace motex
