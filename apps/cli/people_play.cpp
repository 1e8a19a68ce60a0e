// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <deque>
#include <iostream>
#include <sstream>

#include "commands.h"
#include "motex/core/options_check.h"
#include "motex/people/director.h"
#include "motex/people/script.h"
#include "options_value.h"
#include "output_file.h"
#include "people_film.h"

namespace motex::cli {
namespace {

constexpr double kMaxFrames = 1e7;

/// "@120 high kick", "bow", "stop".
struct Choice {
  std::int64_t frame = 0;
  int motif = -1;  ///< −1 = stop
};

std::vector<Choice> read_choices(std::istream& input, const MotifSet& alphabet) {
  std::vector<Choice> choices;
  for (std::string line; std::getline(input, line);) {
    Choice choice{choices.empty() ? 0 : choices.back().frame, -1};
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word[0] == '#') continue;
    if (word[0] == '@') {
      parse_value("standard input", word.substr(1), choice.frame);
      if (!choices.empty() && choice.frame < choices.back().frame)
        throw InvalidInput("standard input: '" + line + "' comes before the command above it");
      std::getline(words, word);
    } else {
      word = line;
    }
    const std::size_t first = word.find_first_not_of(" \t"), last = word.find_last_not_of(" \t\r");
    word = first == std::string::npos ? "" : word.substr(first, last - first + 1);
    if (word != "stop") choice.motif = motif_named(word, alphabet);
    choices.push_back(choice);
  }
  return choices;
}

struct Play {
  std::string model_path;
  FilmArguments film;
  std::int64_t frames = 0;
  double secs = 0;
  bool with_steering = false;
  PlayOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex people learn", model_path);
    film.declare(arguments);
    arguments.value("--frames", "N", "length in frames", frames);
    arguments.value("--secs", "S", "length in seconds", secs);
    arguments.toggle("--steer",
                     "read choices from standard input, a line each: high kick, A, '@120 bow' (not before that frame), "
                     "stop",
                     with_steering);
    arguments.section("Play");
    arguments.options(options);
    film.declare_looks(arguments);
  }

  void run(Session& session) {
    if ((frames > 0) == (secs > 0)) throw InvalidInput("the film needs a length: either --frames N or --secs S");
    if (frames < 0 || secs < 0 || !std::isfinite(secs)) throw InvalidInput("the length of a film is above 0");
    check_options(options);
    film.check(session);
    PeopleModel model = load_people_model(model_path);
    const double wanted = frames > 0 ? static_cast<double>(frames) : std::round(secs * model.texture.frames_per_sec);
    if (wanted < 1 || wanted > kMaxFrames) throw InvalidInput("a film has 1 to 10000000 frames");
    const auto num_frames = static_cast<int>(wanted);
    const std::vector<Choice> choices =
        with_steering ? read_choices(std::cin, model.texture.alphabet) : std::vector<Choice>{};
    complete_cuts(model, session.job(0, 0.2));
    const EditList edits =
        with_steering ? steered(model.texture, num_frames, choices) : play(model.texture, num_frames, options);
    if (session.flags.dry_run) return would_write(film.paths(), edits.num_frames(), session);
    Value object;
    object["options"] = options_value(options);
    film.write(model, edits, options.seed, object, session);
  }

 private:
  EditList steered(const PeopleTexture& texture, int num_frames, const std::vector<Choice>& choices) const {
    Director director(texture, options);
    std::deque<Choice> waiting(choices.begin(), choices.end());
    std::vector<DirectedFrame> shown;
    for (int t = 0; t < num_frames; ++t) {
      while (!waiting.empty() && waiting.front().frame <= t) {
        if (waiting.front().motif < 0) {
          if (!shown.empty()) return edit_list_of_frames(texture, shown, options.transition_frames);
          throw InvalidInput("standard input: stop comes before the first frame");
        }
        director.choose(waiting.front().motif);
        waiting.pop_front();
      }
      shown.push_back(director.next());
    }
    return edit_list_of_frames(texture, shown, options.transition_frames);
  }
};

}  // namespace

Command people_play() {
  return make_command<Play>(
      {"people play", "play an actor's footage for ever in new orders, at random or as chosen meanwhile",
       "The film stays where it can go on for ever, so it never runs into the end of a take, and goes to what was not "
       "shown lately. The same seed gives the same film. Models hold no sound, so films have none.",
       "motex people play kata.motex --secs 75 -o play.mov --seed 3\n"
       "motex people play kata.motex --secs 75 --shot-secs 15 -o play.mp4 --background plate\n"
       "printf '@100 high kick\\n@250 bow\\n@400 stop\\n' | motex people play kata.motex --steer --frames 500 -o "
       "chosen.webm"});
}

}  // namespace motex::cli
