// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "motex/motion_io/read_options.h"

namespace motex {

/// First animation of a glTF 2.0 file, text (.gltf) or binary (.glb). Joints are the animated nodes, the joints of
/// skins and the nodes between them; fixed nodes above are folded into the root. Scale is kept constant and folded into
/// lengths (a warning when it moves or differs by axis). Times are seconds, so fps is the rate at which the curves are
/// sampled; 0 = that of the densest track. The unit is the metre. Throws ParseError or InvalidInput for broken files,
/// UnsupportedFile for sparse or compressed accessors and files without animation.
Clip read_gltf(const std::filesystem::path& path, const ReadClipOptions& options = {}, const JobContext& job = {});
/// Buffers in other files are not looked for (UnsupportedFile).
Clip read_gltf_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                     const JobContext& job = {});

/// Binary glTF 2.0: a node a joint, a skinned mesh of sticks (so that programs see an armature), one animation "motion"
/// with linear keys at every frame; tracks that stand still have one key or, at rest, none. Lengths are metres by
/// metres_per_unit_or_guess, as asset.extras says. End sites are kept in the extras of their joints.
/// A skeleton that has a skin whose joints it has (skin_fits) gets that instead of sticks; the skin grows with the
/// bones.
std::string write_glb_bytes(const Clip& clip);
/// Several animations of one skeleton, each by the name of its clip. Throws InvalidInput when skeletons differ.
std::string write_glb_bytes(std::span<const Clip> clips);
void write_glb(const std::filesystem::path& path, const Clip& clip);

}  // namespace motex
