// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "motex/core/error.h"
#include "motex/plot/charts.h"
#include "motex/plot/frame.h"

namespace motex {

Drawing grid(const std::vector<Drawing>& panels, int columns, const std::string& title) {
  if (panels.empty() || columns < 1) throw InvalidInput("a figure needs at least one panel and one column");
  constexpr double kGap = 14;
  double cell_width = 0, cell_height = 0;
  for (const Drawing& panel : panels) {
    cell_width = std::max(cell_width, panel.width);
    cell_height = std::max(cell_height, panel.height);
  }
  const int count = static_cast<int>(panels.size()), across = std::min(columns, count);
  const int down = (count + across - 1) / across;
  const double head = title.empty() ? kGap : 44;
  Drawing figure{across * (cell_width + kGap) + kGap, head + down * (cell_height + kGap), panels[0].background, {}};
  if (!title.empty()) figure.add(Text{{figure.width / 2, 30}, title, 17, kInk, Align::kCentre, true, false});
  for (int i = 0; i < count; ++i) {
    const int row = i / across, column = i % across;
    const double x = kGap + column * (cell_width + kGap), y = head + row * (cell_height + kGap);
    append(figure, panels[static_cast<std::size_t>(i)], {x, y});
  }
  return figure;
}

}  // namespace motex
