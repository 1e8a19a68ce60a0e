// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motex/motion_io/read_options.h"

namespace motex {

/// Acclaim skeleton (.asf) and motion (.amc). A bone becomes a joint at its start; its end (direction · length) is the
/// offset of the joints below it, or an End Site. With C the bone's axis frame and M the product of its angles, the
/// joint's rotation is C M C⁻¹; for "axis … XYZ" both are R_z R_y R_x (x is applied first). The root's `position` is
/// not added: the AMC gives absolute places. Units: `length L` means inches · L (CMU writes 0.45), metres_per_unit =
/// 0.0254 / L; unknown when L is 1 or missing. A rate is used where the AMC states one (:SAMPLES-PER-SECOND), else fps,
/// else 120 Hz, CMU's, with a warning. Throws ParseError with the line.
///
/// The .asf is options.asf, or 11.asf beside 11_01.amc, or 11_01.asf, or the only .asf in the folder.
Clip read_amc(const std::filesystem::path& amc, const ReadClipOptions& options = {}, const JobContext& job = {});

struct NamedText {
  std::string_view bytes;
  std::string name;  ///< file name for messages
};
Clip read_amc_bytes(const NamedText& asf, const NamedText& amc, const ReadClipOptions& options = {},
                    const JobContext& job = {});

}  // namespace motex
