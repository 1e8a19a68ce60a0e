// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motex/people/edit_list.h"
#include "motex/people/people_texture.h"

namespace motex {

/// An edit list as JSON (docs/formats.md); frames are those of the people texture, from 0:
///   {"motex_edits": 1, "frames_per_sec": 25, "frames": 130, "loop": false,
///    "shots": [{"first": 10, "last": 59, "motif": "A", "source": "kata.mp4", "source_first": 10, "mirrored": false}],
///    "cuts": [{"from": 59, "to": 200, "transition_frames": 5, "difference": 9.1, "smoothness": 0.4}],
///    "performances": [{"motif": "A", "start": 0, "frames": 60}]}
/// motif: its letter, null = none (of a performance: standing).
std::string edit_list_json(const PeopleTexture& texture, const EditList& edits);

/// Reads it back. Needed are first and last of every shot; cuts may be missing: hard ones then join the shots. What the
/// texture says already (source, difference …) is not looked at. Throws InvalidInput naming the entry: no JSON, frames
/// that are not there or in two takes, cuts that do not join their shots, an unknown motif.
EditList parse_edit_list(std::string_view text, const std::string& name, const PeopleTexture& texture);

/// The same film for editing programs, OpenTimelineIO: one video track with a clip a shot (of the files that the takes
/// were learned from) and a dissolve of the same length at each cut that has a transition; what dissolves cannot say
/// stands under metadata.motex. A loop's last cut is left out.
std::string edit_list_otio(const PeopleTexture& texture, const EditList& edits, const std::string& title);

/// As the extension says: .json or .otio. Throws InvalidInput for another one.
void write_edit_list(const std::filesystem::path& path, const PeopleTexture& texture, const EditList& edits);

}  // namespace motex
