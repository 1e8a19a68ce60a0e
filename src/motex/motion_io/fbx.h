// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "motex/motion_io/read_options.h"

namespace motex {

/// Whether this build reads FBX (it was made where libassimp is installed).
bool reads_fbx();

/// First animation of an FBX file, text or binary, through libassimp. Joints are the animated nodes, bones of meshes,
/// the nodes between them and the empty ones below. Pivots and pre-rotations are folded in by Assimp; scales that a
/// node does not hand down (inherit type Rrs) are honoured. The unit is UnitScaleFactor centimetres; with options.up =
/// auto a file whose z points up is turned; the rate is the file's own (options.fps overrides it). Curves are sampled
/// straight between keys: where keys are sparse, the motion between them differs from the editor's, which is said.
/// Throws UnsupportedFile where the build has no Assimp (with what to do) and for files without animation, ParseError
/// with the byte for broken binary records, InvalidInput with Assimp's reason for all else.
Clip read_fbx_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options = {},
                    const JobContext& job = {});

/// Looks at the records of an FBX file before anybody allocates by them: throws ParseError with the byte for records
/// that leave the file, nest deeper than 64, or hold arrays that no deflate stream of their length can fill.
void check_fbx_records(std::string_view bytes, const std::string& name);

}  // namespace motex
