// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "motex/image/image.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"
#include "motex/project/take_film.h"

namespace motex {

/// A people texture with its pictures.
struct PeopleModel {
  PeopleTexture texture;
  /// One a take. That of a mirrored take is empty: its frames are those of the take that `originals` names, mirrored.
  std::vector<TakeFilm> films;
  std::vector<int> originals;  ///< one a take: itself, or the take that it mirrors
  Image plate;                 ///< the empty scene; no pixels when it was not kept

  std::int64_t footage_bytes() const;
};

/// Which take each one mirrors: the earlier one of the same source, first frame, person and length; itself when it is
/// not mirrored. Throws InvalidInput when there is none.
std::vector<int> original_takes(const PeopleTexture& texture);

/// A people texture as one file (docs/formats.md, archive kind "people_texture").
std::string people_model_bytes(const PeopleModel& model);
void save_people_model(const std::filesystem::path& path, const PeopleModel& model);

/// Safe to use on files from strangers. Throws InvalidInput, ParseError, UnsupportedFile.
PeopleModel parse_people_model(std::string bytes, const std::string& name);
PeopleModel load_people_model(const std::filesystem::path& path);

/// The pictures of a model, decoded as they are asked for; the last 64 are kept. Copies of a model share the footage,
/// so each thread may have a StoredFootage of its own at little cost.
class StoredFootage : public SpriteSource {
 public:
  explicit StoredFootage(const PeopleModel& model);
  int num_frames() const override { return num_frames_; }
  std::shared_ptr<const Sprite> sprite(int frame) override;

 private:
  struct Stretch {
    int first = 0, length = 0, original = 0;  // take whose film is read
    bool mirrored = false;
  };
  FilmChunkReader& reader_of(int take, int chunk);

  std::vector<Stretch> takes_;
  std::vector<TakeFilm> films_;
  int width_ = 0, num_frames_ = 0;
  struct OpenChunk {
    int take = 0, chunk = 0;
    std::unique_ptr<FilmChunkReader> reader;
  };
  std::list<OpenChunk> readers_;                                   // the last used first
  std::list<std::pair<int, std::shared_ptr<const Sprite>>> kept_;  // the same
};

}  // namespace motex
