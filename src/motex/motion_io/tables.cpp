// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/tables.h"

#include <numbers>
#include <vector>

#include "motex/core/csv.h"
#include "motex/core/files.h"
#include "motex/motion_io/euler_channels.h"

namespace motex {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;
constexpr int kPlaces = 9;

}  // namespace

std::string write_csv_bytes(const Clip& clip) {
  check_clip(clip);
  std::string text = "frame,time";
  std::vector<std::vector<Channel>> channels;
  std::vector<EulerTrack> tracks;
  for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
    channels.push_back(channels_for_motion(clip, j));
    tracks.emplace_back(channels.back());
    for (const Channel c : channels.back())
      text += "," + csv_cell(clip.skeleton.joints[static_cast<std::size_t>(j)].name + "." + channel_name(c));
  }
  text += '\n';
  for (Index t = 0; t < clip.num_frames(); ++t) {
    append_rounded(text += std::to_string(t) + ",", static_cast<double>(t) * clip.frame_time_secs, kPlaces);
    for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
      const auto& own = channels[static_cast<std::size_t>(j)];
      if (own.empty()) continue;
      const Vector3& angles = tracks[static_cast<std::size_t>(j)].next(clip.rotation(t, j));
      int num_angles = 0;
      for (const Channel c : own)
        append_rounded(text += ',',
                       is_position(c) ? clip.translations(t, 3 * j + axis_of(c)) : angles[num_angles++] * kDegPerRad,
                       kPlaces);
    }
    text += '\n';
  }
  return text;
}

void write_csv(const std::filesystem::path& path, const Clip& clip) { write_file(path, write_csv_bytes(clip)); }

}  // namespace motex
