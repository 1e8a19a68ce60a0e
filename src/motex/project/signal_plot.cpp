// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/signal_plot.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motex/core/csv.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

constexpr double kWidth = 1000;
constexpr double kPanelHeight = 150;

std::string number(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
  return {text.data(), end.ptr};
}

StripPlot motif_strip(const PeopleTexture& texture) {
  StripPlot strip;
  strip.x_axis.label = "";
  strip.x_axis.min = 0, strip.x_axis.max = texture.num_frames() / texture.frames_per_sec;
  strip.width = kWidth;
  StripRow row{"motifs", {}};
  for (std::size_t k = 0; k < texture.alphabet.motifs.size(); ++k)
    for (const Occurrence& one : texture.alphabet.motifs[k].occurrences)
      row.segments.push_back({one.start / texture.frames_per_sec, one.length / texture.frames_per_sec,
                              static_cast<int>(k), texture.alphabet.motifs[k].letter});
  strip.rows.push_back(std::move(row));
  return strip;
}

Drawing panel(const PeopleTexture& texture, const Signal& signal, int colour, bool is_last) {
  LinePlot plot;
  plot.size = {kWidth, kPanelHeight};
  plot.y_axis.label = signal.unit.empty() ? signal.name : signal.name + " (" + signal.unit + ")";
  if (is_last) plot.x_axis.label = "time (s)";
  plot.x_axis.min = 0, plot.x_axis.max = texture.num_frames() / texture.frames_per_sec;
  for (std::size_t k = 1; k < texture.takes.size(); ++k)
    plot.x_markers.push_back({texture.takes[k].frames.start / texture.frames_per_sec, ""});
  Series series{"", {}, {}, Mark::kLine, series_colour(colour)};
  const auto add = [&](double t, double value) {
    series.x.push_back(t / texture.frames_per_sec);
    series.y.push_back(value);
  };
  for (const Take& take : texture.takes) {
    for (int t = take.frames.start; t < take.frames.end(); ++t) add(t, signal.values[static_cast<std::size_t>(t)]);
    add(take.frames.end(), std::nan(""));  // lines do not run across cuts
  }
  plot.series.push_back(std::move(series));
  return draw(plot);
}

}  // namespace

std::string signals_csv(const PeopleTexture& texture, const PeopleSignals& signals) {
  std::string out = "frame,source,source_frame,person,mirrored,seen";
  for (const Signal& signal : signals.signals) out += "," + signal.name;
  out += "\n";
  for (const Take& take : texture.takes)
    for (int t = take.frames.start; t < take.frames.end(); ++t) {
      const auto i = static_cast<std::size_t>(t);
      out += std::to_string(t) + "," + csv_cell(take.source) + "," +
             std::to_string(take.source_start + t - take.frames.start) + "," + std::to_string(take.person) +
             (take.mirrored ? ",1" : ",0") + (texture.silhouettes[i].empty() ? ",0" : ",1");
      for (const Signal& signal : signals.signals) out += "," + number(signal.values[i]);
      out += "\n";
    }
  return out;
}

Drawing draw_signals(const PeopleTexture& texture, const PeopleSignals& signals,
                     const std::vector<std::string>& names) {
  std::vector<const Signal*> shown;
  if (names.empty())
    for (const Signal& signal : signals.signals) shown.push_back(&signal);
  for (const std::string& name : names) shown.push_back(&signal_named(signals, name));
  std::vector<Drawing> panels;
  if (!texture.alphabet.motifs.empty()) panels.push_back(draw(motif_strip(texture)));
  for (std::size_t k = 0; k < shown.size(); ++k)
    panels.push_back(panel(texture, *shown[k], static_cast<int>(k), k + 1 == shown.size()));
  return grid(panels, 1, "");
}

}  // namespace motex
