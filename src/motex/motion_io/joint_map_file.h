// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motex/motion/joint_map.h"

namespace motex {

/// Target joint, source joint.
using JointNamePairs = std::vector<std::pair<std::string, std::string>>;

/// By extension: .json is an object {"target joint": "source joint", …}, null or "" for none; anything else is CSV, a
/// line "target,source" each (that heading and lines that begin with # are skipped; names with a comma or quote stand
/// in quotes). Throws InvalidInput naming the line or member.
JointNamePairs read_joint_map(const std::filesystem::path& path);
JointNamePairs read_joint_map_bytes(std::string_view bytes, const std::string& name);

/// Every joint of the target with its source, or nothing, as that extension says.
std::string joint_map_text(const Skeleton& source, const Skeleton& target, const JointMap& map,
                           const std::filesystem::path& path);

}  // namespace motex
