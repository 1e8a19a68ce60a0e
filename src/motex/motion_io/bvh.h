// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motex/motion_io/read_options.h"

namespace motex {

/// Biovision hierarchy. The rotation of a joint is the product of its rotation channels in the order listed,
/// q = R_first · R_second · R_third; position channels give the place in the parent's frame and replace OFFSET, axis by
/// axis; a root's OFFSET is dropped when it has all three. Several ROOTs are read as several trees.
/// The rows that are there count, not the number of frames the header states. A frame may wrap over lines but starts a
/// line. Of the options only fps is used here. Throws ParseError with the line.
Clip read_bvh(const std::filesystem::path& path, const ReadClipOptions& options = {}, const JobContext& job = {});
/// name: file name for messages and for Clip::name.
Clip read_bvh_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                    const JobContext& job = {});

/// The clip with its joints' own channels, to which those are added that its motion needs (a translation that leaves
/// OFFSET, a rotation that one or two angles cannot give). Angles continue from frame to frame without jumps of 360°.
/// Offsets and frame time are written to the last bit; channels with as many decimals as keep every joint of the reread
/// clip within 1e-6 of the unit. Joints must stand in depth-first order, else they are put so. Throws InvalidInput as
/// check_clip.
std::string write_bvh_bytes(const Clip& clip);
void write_bvh(const std::filesystem::path& path, const Clip& clip);

}  // namespace motex
