// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "colour_argument.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

namespace motex::cli {

std::optional<Rgba> colour_of(const std::string& text) {
  constexpr std::array<std::pair<const char*, Rgba>, 6> kNamed{{{"black", {0, 0, 0, 255}},
                                                                {"white", {255, 255, 255, 255}},
                                                                {"gray", {128, 128, 128, 255}},
                                                                {"grey", {128, 128, 128, 255}},
                                                                {"green", {0, 177, 64, 255}},
                                                                {"blue", {0, 71, 187, 255}}}};
  for (const auto& [name, colour] : kNamed)
    if (text == name) return colour;
  unsigned number = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [end, code] = std::from_chars(text.data() + 1, text.data() + 7, number, 16);
  if (code != std::errc() || end != text.data() + 7) return std::nullopt;
  return Rgba{static_cast<std::uint8_t>(number >> 16U), static_cast<std::uint8_t>(number >> 8U),
              static_cast<std::uint8_t>(number), 255};
}

}  // namespace motex::cli
