// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/moveton_edits_file.h"

#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"

namespace motex {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargestWhole = 9e15;

/// One entry of a list: "edits.json: insert[2]" for messages.
class Entry {
 public:
  Entry(const Json& json, std::string where, std::initializer_list<const char*> words)
      : json_(json), where_(std::move(where)) {
    if (!json_.is_object()) fail("is no object {…}");
    for (const auto& [word, value] : json_.items())
      if (std::find(words.begin(), words.end(), word) == words.end()) fail("has an unknown word \"" + word + "\"");
  }
  bool has(const char* word) const { return json_.contains(word); }
  double number(const char* word) const {
    if (!has(word)) fail(std::string("has no \"") + word + "\"");
    if (!json_[word].is_number()) fail(std::string("\"") + word + "\" is no number");
    const auto value = json_[word].get<double>();
    if (!std::isfinite(value)) fail(std::string("\"") + word + "\" is not finite");
    return value;
  }
  double number_or(const char* word, double other) const { return has(word) ? number(word) : other; }
  std::int64_t whole(const char* word) const {
    const double value = number(word);
    if (value != std::floor(value) || std::abs(value) > kLargestWhole)
      fail(std::string("\"") + word + "\" is no whole number");
    return static_cast<std::int64_t>(value);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InvalidInput(where_ + ": " + message); }

  const Json& json_;
  std::string where_;
};

const Json& list_of(const Json& root, const char* word, const std::string& name) {
  static const Json kNone = Json::array();
  if (!root.contains(word)) return kNone;
  if (!root[word].is_array()) throw InvalidInput(name + ": \"" + word + "\" is no list […]");
  return root[word];
}

std::string place(const std::string& name, const char* word, std::size_t k) {
  return name + ": " + word + "[" + std::to_string(k) + "]";
}

}  // namespace

MovetonEdits parse_moveton_edits(std::string_view text, const std::string& name) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object())
    throw InvalidInput(name + R"(: edits are a JSON object {"insert": […], "move": […], "remove": […]})");
  for (const auto& [word, value] : root.items())
    if (word != "insert" && word != "move" && word != "remove")
      throw InvalidInput(name + ": unknown word \"" + word + "\"; there are insert, move, remove");
  MovetonEdits edits;
  const Json &inserted = list_of(root, "insert", name), &moved = list_of(root, "move", name),
             &removed = list_of(root, "remove", name);
  for (std::size_t k = 0; k < inserted.size(); ++k) {
    const Entry entry(inserted[k], place(name, "insert", k), {"frame", "x", "y", "vx", "vy", "species", "track"});
    InsertedElement element{kFirstInsertedTrack + static_cast<std::int64_t>(k),
                            entry.number("x"),
                            entry.number("y"),
                            entry.number_or("vx", 0),
                            entry.number_or("vy", 0),
                            -1};
    if (entry.has("species"))
      element.species = static_cast<int>(std::clamp<std::int64_t>(entry.whole("species"), -1, 1 << 30));
    if (entry.has("track")) element.track = entry.whole("track");
    edits.insertions.push_back({entry.whole("frame"), element});
  }
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const Entry entry(moved[k], place(name, "move", k), {"track", "dx", "dy"});
    edits.displacements.push_back({entry.whole("track"), entry.number_or("dx", 0), entry.number_or("dy", 0)});
  }
  for (std::size_t k = 0; k < removed.size(); ++k) {
    const double track = removed[k].is_number() ? removed[k].get<double>() : 0.5;
    if (track != std::floor(track) || std::abs(track) > kLargestWhole)
      throw InvalidInput(place(name, "remove", k) + ": is no track number");
    edits.removals.push_back(static_cast<std::int64_t>(track));
  }
  return edits;
}

}  // namespace motex
