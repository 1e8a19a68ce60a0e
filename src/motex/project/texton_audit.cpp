// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/texton_audit.h"

#include <algorithm>
#include <string>

#include "motex/core/error.h"
#include "motex/motion_texture/recognition.h"
#include "motex/project/pose_pictures.h"

namespace motex {
namespace {

constexpr double kLabelWidth = 90, kGap = 14, kCaption = 11;

/// Playable textons, those with most segments first.
std::vector<int> order_of_audit(const MotionTexture& model) {
  std::vector<int> textons;
  for (int i = 0; i < static_cast<int>(model.textons.size()); ++i)
    if (model.textons[static_cast<std::size_t>(i)].is_playable()) textons.push_back(i);
  std::stable_sort(textons.begin(), textons.end(), [&](int a, int b) {
    return model.textons[static_cast<std::size_t>(a)].instances.size() >
           model.textons[static_cast<std::size_t>(b)].instances.size();
  });
  return textons;
}

Drawing strip_of(const MotionTexture& model, const Instance& instance) {
  const Index frames = std::min(instance.length, shortest_segment(model));
  const Clip clip = decode(model.features, model.corpus.middleRows(instance.row, frames).cast<double>());
  PoseStripOptions options;
  options.figures = 4;
  options.ghosts = 0;
  options.secs = static_cast<double>(frames) * model.frame_time_secs();
  options.figure_height = 64;
  options.frame_numbers = false;
  return pose_strip(clip, {}, options);
}

std::string place_of(const MotionTexture& model, const Instance& instance) {
  const Run& run = model.runs[static_cast<std::size_t>(instance.run_idx)];
  return model.clip_names[static_cast<std::size_t>(run.clip_idx)] + "@" +
         std::to_string(run.clip_start + instance.row - run.row);
}

struct Row {
  int texton = 0;
  std::vector<Drawing> strips;
  std::vector<std::string> places;
  double height = 0;
};

Row row_of(const MotionTexture& model, int texton) {
  Row row{texton, {}, {}, 0};
  const std::vector<int>& instances = model.textons[static_cast<std::size_t>(texton)].instances;
  for (std::size_t k = 0; k < std::min(instances.size(), kAuditSegments); ++k) {
    const Instance& instance = model.instances[static_cast<std::size_t>(instances[k])];
    row.strips.push_back(strip_of(model, instance));
    row.places.push_back(place_of(model, instance));
    row.height = std::max(row.height, row.strips.back().height);
  }
  return row;
}

}  // namespace

int num_audit_pages(const MotionTexture& model) {
  return static_cast<int>((order_of_audit(model).size() + kAuditRows - 1) / kAuditRows);
}

Drawing texton_audit(const MotionTexture& model, int page) {
  const std::vector<int> textons = order_of_audit(model);
  const int pages = num_audit_pages(model);
  if (page < 0 || page >= pages)
    throw InvalidInput("there is no page " + std::to_string(page) + "; the model's textons fill pages 0 … " +
                       std::to_string(pages - 1));
  std::vector<Row> rows;
  double column = 0;
  const std::size_t first = static_cast<std::size_t>(page) * kAuditRows;
  for (std::size_t i = first; i < std::min(textons.size(), first + kAuditRows); ++i) {
    rows.push_back(row_of(model, textons[i]));
    for (const Drawing& strip : rows.back().strips) column = std::max(column, strip.width);
  }
  Drawing out;
  out.width = kLabelWidth + kAuditColumns * (column + kGap);
  double y = kGap;
  for (const Row& row : rows) {
    const auto& texton = model.textons[static_cast<std::size_t>(row.texton)];
    const std::string name = texton.name.empty() ? "texton " + std::to_string(row.texton) : texton.name;
    out.add(Text{{8, y + 0.5 * row.height}, name, 13, {0, 0, 0, 255}, Align::kLeft, true});
    out.add(Text{{8, y + 0.5 * row.height + 16},
                 std::to_string(texton.instances.size()) + (texton.instances.size() == 1 ? " segment" : " segments") +
                     (texton.instances.size() > kAuditSegments ? ", the first " + std::to_string(kAuditSegments) : ""),
                 11,
                 {90, 90, 90, 255}});
    for (std::size_t k = 0; k < row.strips.size(); ++k) {
      if (k > 0 && k % kAuditColumns == 0) y += row.height + kCaption + kGap;
      const double x = kLabelWidth + static_cast<double>(k % kAuditColumns) * (column + kGap);
      append(out, row.strips[k], {x, y});
      out.add(Text{{x + 0.5 * row.strips[k].width, y + row.height + kCaption},
                   row.places[k],
                   9,
                   {120, 120, 120, 255},
                   Align::kCentre});
    }
    y += row.height + kCaption + kGap;
  }
  out.height = y;
  return out;
}

}  // namespace motex
