// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <filesystem>

#include "commands.h"
#include "motex/project/people_model_file.h"
#include "people_alphabet.h"
#include "people_source.h"
#include "text_table.h"

namespace motex::cli {
namespace {

double original_secs(const PeopleTexture& texture) {
  int frames = 0;
  for (const Take& take : texture.takes) frames += take.mirrored ? 0 : take.frames.length;
  return frames / texture.frames_per_sec;
}

struct Info {
  std::string path;

  void declare(Arguments& arguments) { arguments.positional("MODEL", "made by motex people learn", path); }

  void run(Session& session) {
    const PeopleModel model = load_people_model(path);
    session.result(value(model), text(model));
  }

 private:
  Value value(const PeopleModel& model) const {
    const PeopleTexture& texture = model.texture;
    Value object;
    object["model"] = path;
    object["bytes"] = static_cast<std::int64_t>(std::filesystem::file_size(path));
    object["width"] = texture.width;
    object["height"] = texture.height;
    object["frames"] = texture.num_frames();
    object["frames_per_sec"] = texture.frames_per_sec;
    object["footage_secs"] = original_secs(texture);
    object["footage_bytes"] = model.footage_bytes();
    object["lossless"] = !model.films.empty() && model.films[0].lossless;
    object["takes"] = takes_value(texture);
    object["motifs"] = motifs_value(texture.alphabet);
    object["idle"] = spans_value(texture.alphabet.idle);
    object["cuts"] = static_cast<std::int64_t>(texture.cuts.cuts.size());
    return object;
  }

  std::string text(const PeopleModel& model) const {
    const PeopleTexture& texture = model.texture;
    const double secs = original_secs(texture);
    int idle = 0;
    for (const FrameSpan& span : texture.alphabet.idle) idle += span.length;
    std::string out =
        text_pairs({{"model", path},
                    {"film", std::to_string(texture.width) + " × " + std::to_string(texture.height) + " at " +
                                 fixed(texture.frames_per_sec, 2) + " frames a second"},
                    {"footage", fixed(secs, 1) + " s, " +
                                    fixed(static_cast<double>(model.footage_bytes()) / 1e6 / std::max(0.001, secs), 2) +
                                    " MB a second" + (model.films[0].lossless ? ", lossless" : "")},
                    {"standing", fixed(idle / texture.frames_per_sec, 1) + " s"},
                    {"cuts", std::to_string(texture.cuts.cuts.size())}});
    std::vector<std::vector<std::string>> rows{{"take", "clip", "from frame", "person", "frames", ""}};
    for (std::size_t k = 0; k < texture.takes.size(); ++k) {
      const Take& take = texture.takes[k];
      rows.push_back({std::to_string(k), take.source, std::to_string(take.source_start), std::to_string(take.person),
                      std::to_string(take.frames.length), take.mirrored ? "mirrored" : ""});
    }
    out += "\n" + text_table(rows);
    return texture.alphabet.motifs.empty() ? out : out + "\n" + alphabet_table(texture);
  }
};

}  // namespace

Command people_info() {
  return make_command<Info>({"people info", "what a model of an actor holds: takes, actions, cuts", "",
                             "motex people info kata.motex\n"
                             "motex people info kata.motex --json"});
}

}  // namespace motex::cli
