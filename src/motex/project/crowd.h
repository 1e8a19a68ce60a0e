// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/image/image.h"
#include "motex/people/director.h"
#include "motex/people/render_film.h"
#include "motex/project/people_model_file.h"

namespace motex {

struct CrowdOptions {
  int people = 6;
  double depth = 0.6;
  double horizon = 0.35;
  bool mirror = true;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"people", "", "how many there are"}, self.people, Range{1, 200});
    visit(Field{"depth", "", "how much smaller the farthest is than the nearest, who is as filmed"}, self.depth,
          Range{0, 0.95});
    visit(Field{"horizon", "",
                "height of the eyes in the picture, share from the top: feet rise towards it with "
                "distance"},
          self.horizon, Range{-1, 0.9});
    visit(Field{"mirror", "", "every second one is seen in a mirror"}, self.mirror, Range{});
    visit(Field{"seed", "", "of places and of what each one does"}, self.seed, Range{0, 9007199254740991.0});
  }
};

/// When one of a crowd comes into the picture, and what he or she does then.
struct Cue {
  double start_secs = 0;
  std::string script;  ///< as parse_script() has it; played once, then free play; empty = free play throughout
};

/// Cues out of a text: one line a person, the farthest first: the time in seconds, then a script if there is one; #
/// begins a comment. "1.5 stand 2s, high kick x2". Throws ParseError with the line.
std::vector<Cue> parse_cues(std::string_view text, const std::string& name);

/// One of a crowd. His or her feet are where the floor is at that distance: y = horizon + scale (floor − horizon).
struct Extra {
  int model = 0;  ///< which of the models
  bool mirrored = false;
  double scale = 1;        ///< 1 = nearest
  double x = 0, feet = 0;  ///< pixels of the film: the middle of the standing body, the floor under it
  int start = 0;           ///< frame of the film in which he or she comes
  EditList edits;
};

/// Several people, each playing on its own in its own time, one behind the other in one picture.
class Crowd {
 public:
  /// models: of actors, shown in turn; they must outlive the crowd, agree in frame rate, and have cuts. The first gives
  /// the size of the picture. cues: of the first people; the others play freely from the beginning. Throws
  /// InvalidInput, and what play() and direct() throw.
  Crowd(const std::vector<PeopleModel>& models, int num_frames, const CrowdOptions& options = {},
        const PlayOptions& playing = {}, const RenderFilmOptions& render = {}, const JobContext& job = {},
        const std::vector<Cue>& cues = {});
  ~Crowd();
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  /// The farthest first.
  const std::vector<Extra>& extras() const { return extras_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Paints everyone's next frame; false after the last, when nothing is painted.
  bool next(Image& picture);

 private:
  struct Player;
  int width_ = 0, height_ = 0, num_frames_ = 0, time_ = 0;
  JobContext job_;
  std::vector<Extra> extras_;
  std::vector<std::unique_ptr<Player>> players_;
};

}  // namespace motex
