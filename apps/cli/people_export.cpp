// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/image/png.h"
#include "motex/project/film_video.h"
#include "motex/project/sprite_atlas.h"
#include "options_value.h"
#include "output_folder.h"

namespace motex::cli {
namespace {

std::string page_name(int page) { return "atlas_" + std::to_string(page) + ".png"; }

Value frame_value(const AtlasFrame& frame) {
  Value one;
  one["page"] = frame.page;
  one["x"] = frame.x;
  one["y"] = frame.y;
  one["width"] = frame.width;
  one["height"] = frame.height;
  one["left"] = frame.left;
  one["top"] = frame.top;
  one["pivot_x"] = frame.pivot_x;
  one["pivot_y"] = frame.pivot_y;
  one["source"] = frame.source;
  return one;
}

Value atlas_value(const SpriteAtlas& atlas, const PeopleTexture& texture, const SpriteAtlasOptions& options) {
  Value object;
  object["format"] = "motex sprite atlas";
  object["version"] = 1;
  object["width"] = texture.width;
  object["height"] = texture.height;
  object["frames_per_sec"] = texture.frames_per_sec / options.every;
  object["pages"] = Value::List();
  for (int page = 0; page < atlas.num_pages; ++page) {
    Value one;
    one["file"] = page_name(page);
    one["width"] = options.page_size;
    one["height"] = options.page_size;
    object["pages"].append(std::move(one));
  }
  object["frames"] = Value::List();
  for (const AtlasFrame& frame : atlas.frames) object["frames"].append(frame_value(frame));
  object["actions"] = Value::List();
  for (const AtlasAction& action : atlas.actions) {
    Value one;
    const bool stands = action.motif < 0;
    const Motif motif = stands ? Motif{} : texture.alphabet.motifs[static_cast<std::size_t>(action.motif)];
    one["letter"] = stands ? "" : motif.letter;
    one["name"] = stands ? "stand" : motif.name;
    one["frames"] = action.frames;
    object["actions"].append(std::move(one));
  }
  object["cuts"] = Value::List();
  for (const AtlasCut& cut : atlas.cuts) {
    Value one;
    one["from"] = cut.from;
    one["to"] = cut.to;
    one["difference"] = cut.difference;
    object["cuts"].append(std::move(one));
  }
  return object;
}

struct Export {
  std::string path, output;
  SpriteAtlasOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex people learn", path);
    arguments.value("-o,--output", "DIR", "folder for the pages and atlas.json", output).required = true;
    arguments.options(options);
  }

  void run(Session& session) {
    check_options(options);
    check_output_folder(output, session);
    PeopleModel model = load_people_model(path);
    complete_cuts(model, session.job(0, 0.3));
    StoredFootage sprites(model);
    const SpriteAtlas atlas = plan_atlas(model.texture, sprites, options, session.job(0.3, 0.6));
    Value object;
    object["output"] = output;
    object["pages"] = atlas.num_pages;
    object["frames"] = static_cast<std::int64_t>(atlas.frames.size());
    object["actions"] = static_cast<std::int64_t>(atlas.actions.size());
    object["cuts"] = static_cast<std::int64_t>(atlas.cuts.size());
    object["options"] = options_value(options);
    if (session.flags.dry_run) {
      object["dry_run"] = true;
      session.result(object, "");
      return;
    }
    OutputFolder folder(output);
    const auto write = [&](int page, const Image& picture) {
      write_file(folder.file(page_name(page)), encode_png(picture));
    };
    draw_atlas(atlas, sprites, options.page_size, write, session.job(0.6, 1));
    write_file(folder.file("atlas.json"), to_json(atlas_value(atlas, model.texture, options)) + "\n");
    folder.commit();
    session.say("wrote " + output + ": " + std::to_string(atlas.frames.size()) + " frames on " +
                std::to_string(atlas.num_pages) + (atlas.num_pages == 1 ? " page, " : " pages, ") +
                std::to_string(atlas.cuts.size()) + " cuts among them");
    session.result(object, "");
  }
};

}  // namespace

Command people_export() {
  return make_command<Export>(
      {"people export", "an actor as sprites for a game: pages of pictures and what is where on them",
       "Writes atlas_0.png, … (straight alpha) and atlas.json: frames (page, x, y, width, height; left, top in the "
       "film; pivot: under the body, on the floor; source), actions with their frames in order of play, and the cuts "
       "by which one frame may follow another.",
       "motex people export kata.motex -o kata_sprites\n"
       "motex people export kata.motex -o small --every 2 --page-size 1024 --idle-secs 1\n"
       "motex people export kata.motex -o whole --all"});
}

}  // namespace motex::cli
