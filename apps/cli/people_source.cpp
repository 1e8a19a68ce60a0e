// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "people_source.h"

#include <filesystem>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex::cli {

void PeopleSourceArguments::declare(Arguments& arguments) {
  arguments.positional("VIDEO|MODEL", "footage of a fixed camera, or a model made by motex people learn (.motex)",
                       path);
}

void PeopleSourceArguments::declare_keying(Arguments& arguments) {
  arguments.section("Keying of a video");
  arguments.options(options.key.plate);
  arguments.value("--plate", "PNG", "picture of the empty scene (default: estimated from each shot)", plate_picture);
  arguments.value("--garbage-mask", "PNG", "what is bright (or opaque, where it has alpha) never is the actor",
                  garbage_mask);
  arguments.options(options.key.key);
  arguments.toggle("--one-shot", "do not look for hard cuts", one_shot);
}

void PeopleSourceArguments::check() const {
  check_options(options.key.plate);
  check_options(options.key.key);
  if (path.find('%') == std::string::npos && path.find('*') == std::string::npos && !std::filesystem::exists(path))
    throw InvalidInput(path + ": no such file");
}

LoadedPeople PeopleSourceArguments::load(const JobContext& job) const {
  PeopleFootageOptions used = options;
  used.key.plate_picture = plate_picture;
  used.key.garbage_mask = garbage_mask;
  used.cuts = !one_shot;
  return load_people(path, used, job);
}

Value takes_value(const PeopleTexture& texture) {
  Value list = Value::List();
  for (const Take& take : texture.takes) {
    Value one;
    one["source"] = take.source;
    one["source_start"] = take.source_start;
    one["person"] = take.person;
    one["mirrored"] = take.mirrored;
    one["start"] = take.frames.start;
    one["length"] = take.frames.length;
    list.append(std::move(one));
  }
  return list;
}

Value spans_value(const std::vector<FrameSpan>& spans) {
  Value list = Value::List();
  for (const FrameSpan& span : spans) {
    Value one;
    one["start"] = span.start;
    one["length"] = span.length;
    list.append(std::move(one));
  }
  return list;
}

}  // namespace motex::cli
