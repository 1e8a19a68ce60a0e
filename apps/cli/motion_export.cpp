// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <filesystem>

#include "commands.h"
#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"
#include "motex/project/engine_export.h"
#include "motex/project/motion_texture_file.h"
#include "options_value.h"
#include "output_folder.h"

namespace motex::cli {
namespace {

struct Export {
  std::string model_path, output;
  bool bvh = false;
  EngineExportOptions options;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.value("-o,--output", "DIR", "folder to write: textons.glb and graph.json", output).required = true;
    arguments.toggle("--bvh", "each clip as a BVH file too", bvh);
    arguments.section("How");
    arguments.options(options);
  }

  void run(Session& session) {
    check_output_folder(output, session);
    const MotionTexture model = load_motion_texture(model_path);
    const EnginePack pack =
        make_engine_pack(model, std::filesystem::path(model_path).stem().string(), options, session.job(0, 0.5));
    if (!session.flags.dry_run) write(pack);
    session.say((session.flags.dry_run ? "would write " : "wrote ") + output + ": " +
                std::to_string(pack.clips.size()) + " clips, " + std::to_string(pack.transitions.size()) +
                " transitions");
    Value object, names = Value(Value::List{});
    for (const EngineClip& clip : pack.clips) names.append(clip.name);
    object["clips"] = names;
    object["transitions"] = static_cast<std::int64_t>(pack.transitions.size());
    object["output"] = output;
    object["options"] = options_value(options);
    session.result(object, "");
  }

 private:
  void write(const EnginePack& pack) const {
    OutputFolder folder(output);
    write_file(folder.file("textons.glb"), engine_glb(pack));
    write_file(folder.file("graph.json"), pack.graph);
    if (bvh)
      for (const EngineClip& clip : pack.clips) write_bvh(folder.file(clip.name + ".bvh"), clip.clip);
    folder.commit();
  }
};

}  // namespace

Command motion_export() {
  return make_command<Export>(
      {"motion export", "textons as named clips with a graph of their transitions, for engines",
       "textons.glb holds an animation a texton; graph.json says which may follow which, how likely, and how long to "
       "blend (docs/formats.md).",
       "motex motion export dance.motex -o pack\n"
       "motex motion export dance.motex -o pack --all-examples --bvh"});
}

}  // namespace motex::cli
