// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/joint_map_file.h"

#include <nlohmann/json.hpp>

#include "motex/core/csv.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/trimmed.h"

namespace motex {
namespace {

using Json = nlohmann::ordered_json;

bool is_json(const std::filesystem::path& path) { return path.extension() == ".json" || path.extension() == ".JSON"; }

JointNamePairs read_csv(std::string_view bytes, const std::string& name) {
  JointNamePairs pairs;
  std::vector<std::string> cells;
  std::int64_t number = 0;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  while (!bytes.empty()) {
    const std::string line(trimmed(bytes.substr(0, bytes.find('\n'))));
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size() - 1) + 1);
    ++number;
    if (line.empty() || line[0] == '#') continue;
    csv_cells(line, ',', cells);
    if (cells.size() != 2) throw ParseError(name, ParseError::Unit::kLine, number, "expected 'target,source'");
    if (pairs.empty() && cells[0] == "target" && cells[1] == "source") continue;
    if (!cells[0].empty() && !cells[1].empty()) pairs.emplace_back(cells[0], cells[1]);
  }
  return pairs;
}

JointNamePairs read_json(std::string_view bytes, const std::string& name) {
  const Json root = Json::parse(bytes, nullptr, false);
  if (!root.is_object()) throw InvalidInput(name + ": a joint map is a JSON object {\"target\": \"source\", …}");
  JointNamePairs pairs;
  for (const auto& [target, source] : root.items()) {
    if (source.is_null()) continue;
    if (!source.is_string()) throw InvalidInput(name + ": the source of '" + target + "' is no name");
    if (!source.get_ref<const std::string&>().empty()) pairs.emplace_back(target, source.get<std::string>());
  }
  return pairs;
}

}  // namespace

JointNamePairs read_joint_map_bytes(std::string_view bytes, const std::string& name) {
  const JointNamePairs pairs = is_json(name) ? read_json(bytes, name) : read_csv(bytes, name);
  if (pairs.empty()) throw InvalidInput(name + ": the joint map joins nothing");
  return pairs;
}

JointNamePairs read_joint_map(const std::filesystem::path& path) {
  return read_joint_map_bytes(read_file(path), path.string());
}

std::string joint_map_text(const Skeleton& source, const Skeleton& target, const JointMap& map,
                           const std::filesystem::path& path) {
  Json root = Json::object();
  std::string csv = "target,source\n";
  for (std::size_t j = 0; j < target.joints.size(); ++j) {
    const int s = map.source_of[j];
    const std::string& name = target.joints[j].name;
    const std::string from = s < 0 ? "" : source.joints[static_cast<std::size_t>(s)].name;
    root[name] = s < 0 ? Json() : Json(from);
    csv += csv_cell(name) + "," + csv_cell(from) + "\n";
  }
  return is_json(path) ? root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : csv;
}

}  // namespace motex
