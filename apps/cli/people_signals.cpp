// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "closest.h"
#include "commands.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/project/load_people.h"
#include "motex/project/signal_plot.h"
#include "options_value.h"
#include "output_file.h"
#include "people_source.h"
#include "text_table.h"

namespace motex::cli {
namespace {

struct Signals {
  PeopleSourceArguments source;
  std::vector<std::string> outputs;
  std::string shown;
  SignalOptions options;

  void declare(Arguments& arguments) {
    source.declare(arguments);
    arguments
        .value("-o,--output", "FILE", ".csv (a row a frame) or .png or .svg (a plot); may be given several times",
               outputs)
        .required = true;
    arguments.value("--show", "LIST", "which signals the plot has, names with commas between (default: all)", shown);
    arguments.options(options);
    source.declare_keying(arguments);
  }

  void run(Session& session) {
    check_options(options);
    check_outputs(outputs, {".csv", ".png", ".svg"}, session);
    source.check();
    if (session.flags.dry_run) return would_write(outputs, -1, session);
    const LoadedPeople people = source.load(session.job(0, 0.95));
    const PeopleSignals signals = measure_signals(people.texture, options);
    const std::vector<std::string> names = split_at_commas(shown);
    for (const std::string& name : names) signal_named(signals, name);
    for (const std::string& path : outputs) {
      if (extension_of(path) == ".csv")
        write_file(path, signals_csv(people.texture, signals));
      else
        write_picture(path, draw_signals(people.texture, signals, names));
    }
    session.say("wrote " + enumerate(outputs) + ": " + std::to_string(signals.num_frames()) + " frames");
    session.result(value(people.texture, signals), "");
  }

 private:
  Value value(const PeopleTexture& texture, const PeopleSignals& signals) const {
    Value object;
    object["input"] = source.path;
    object["output"] = Value::List();
    for (const std::string& path : outputs) object["output"].append(path);
    object["frames"] = signals.num_frames();
    object["frames_per_sec"] = texture.frames_per_sec;
    object["takes"] = takes_value(texture);
    object["bridged"] = spans_value(signals.bridged);
    object["signals"] = Value::List();
    for (const Signal& signal : signals.signals) object["signals"].append(signal.name);
    object["options"] = options_value(options);
    return object;
  }
};

}  // namespace

Command people_signals() {
  return make_command<Signals>(
      {"people signals", "what an actor's silhouette measures over time: aspect, area, centroid, moments",
       "A video is keyed first, each shot against its own clean plate. Several people apart from one another are takes "
       "of their own, one after another. Moments are central, divided by area^(1 + (p + q)/2); mu11, mu30 and mu12 "
       "tell "
       "left from right.",
       "motex people signals dance.mp4 -o signals.csv -o signals.png\n"
       "motex people signals actor.motex -o plot.svg --show aspect,area,mu30"});
}

}  // namespace motex::cli
