// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "clip_info.h"

#include <algorithm>

#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "output_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

std::string length_text(Index num_frames, double frame_time_secs) {
  return std::to_string(num_frames) + " frames at " + fixed(1 / frame_time_secs, 2) + " Hz (" +
         fixed(static_cast<double>(num_frames) * frame_time_secs, 2) + " s)";
}

std::string unit_text(double metres_per_unit) {
  if (!(metres_per_unit > 0)) return "unknown";
  char text[48];
  std::snprintf(text, sizeof text, "%.6g m", metres_per_unit);
  return text;
}

Value common_value(const std::string& path, Index num_frames, double frame_time_secs, double metres_per_unit) {
  Value object;
  object["file"] = path;
  object["frames"] = std::int64_t{num_frames};
  object["frame_rate"] = 1 / frame_time_secs;
  object["secs"] = static_cast<double>(num_frames) * frame_time_secs;
  object["metres_per_unit"] = metres_per_unit > 0 ? Value(metres_per_unit) : Value();
  return object;
}

void report_markers(const std::string& path, bool list, Session& session) {
  const MarkerSet markers = read_markers(path, {}, session.job());
  Value object = common_value(path, markers.num_frames(), markers.frame_time_secs, markers.metres_per_unit);
  object["markers"] = markers.num_markers();
  object["missing_share"] = missing_share(markers);
  Value entries = Value::List();
  std::vector<std::vector<std::string>> rows{{"marker", "missing %"}};
  for (int m = 0; m < markers.num_markers(); ++m) {
    const std::string& name = markers.names[static_cast<std::size_t>(m)];
    Value entry;
    entry["name"] = name;
    entry["missing_share"] = missing_share(markers, m);
    entries.append(std::move(entry));
    rows.push_back({name, fixed(100 * missing_share(markers, m), 2)});
  }
  object["marker_list"] = std::move(entries);
  std::string text = text_pairs({{"markers", path},
                                 {"length", length_text(markers.num_frames(), markers.frame_time_secs)},
                                 {"points", std::to_string(markers.num_markers()) + ", " +
                                                fixed(100 * missing_share(markers), 2) + " % of their places missing"},
                                 {"unit", unit_text(markers.metres_per_unit)}});
  if (list) text += "\n" + text_table(rows);
  session.result(std::move(object), text);
}

void report_clip(const std::string& path, bool list, Session& session) {
  const Clip clip = read_clip(path, {}, session.job());
  Value object = common_value(path, clip.num_frames(), clip.frame_time_secs, clip.skeleton.metres_per_unit);
  object["joints"] = clip.skeleton.num_joints();
  Value entries = Value::List();
  std::vector<std::vector<std::string>> rows{{"joint", "hangs from", "channels"}};
  for (const Joint& joint : clip.skeleton.joints) {
    const std::string parent =
        joint.parent_idx < 0 ? "" : clip.skeleton.joints[static_cast<std::size_t>(joint.parent_idx)].name;
    Value entry;
    entry["name"] = joint.name;
    entry["parent"] = joint.parent_idx < 0 ? Value() : Value(parent);
    entries.append(std::move(entry));
    rows.push_back({joint.name, parent, std::to_string(joint.channels.size())});
  }
  object["joint_list"] = std::move(entries);
  std::string text = text_pairs({{"clip", path},
                                 {"length", length_text(clip.num_frames(), clip.frame_time_secs)},
                                 {"body", std::to_string(clip.skeleton.num_joints()) + " joints, " +
                                              std::to_string(clip.skeleton.end_sites.size()) + " end sites"},
                                 {"unit", unit_text(clip.skeleton.metres_per_unit)}});
  if (list) text += "\n" + text_table(rows);
  session.result(std::move(object), text);
}

}  // namespace

bool is_motion_file(const std::string& path) {
  const auto& clips = readable_clip_extensions();
  const std::string extension = extension_of(path);
  return std::find(clips.begin(), clips.end(), extension) != clips.end() ||
         (extension != ".motex" && holds_markers(std::filesystem::path(path)));
}

void report_motion_file(const std::string& path, bool list, Session& session) {
  if (holds_markers(std::filesystem::path(path)))
    report_markers(path, list, session);
  else
    report_clip(path, list, session);
}

}  // namespace motex::cli
