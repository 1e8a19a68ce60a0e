// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/edit_list_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/people/film_frames.h"
#include "motex/people/script.h"

namespace motex {
namespace {

using Json = nlohmann::ordered_json;

const Take& take_at(const PeopleTexture& texture, int frame) {
  for (const Take& take : texture.takes)
    if (frame >= take.frames.start && frame < take.frames.end()) return take;
  throw InvalidInput("frame " + std::to_string(frame) + " is in no take");
}

int source_frame(const Take& take, int frame) { return take.source_start + frame - take.frames.start; }

Json letter_of(const PeopleTexture& texture, int motif) {
  return motif < 0 ? Json() : Json(texture.alphabet.motifs.at(static_cast<std::size_t>(motif)).letter);
}

/// One entry of a list, "edits.json: shots[2]" for messages.
class Entry {
 public:
  Entry(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json_.is_object()) fail("is no object {…}");
  }
  int whole(const char* word) const {
    if (!json_.contains(word)) fail(std::string("has no \"") + word + "\"");
    return whole_or(word, 0);
  }
  int whole_or(const char* word, int other) const {
    if (!json_.contains(word)) return other;
    const double value = number_or(word, 0);
    if (value != std::floor(value) || std::abs(value) > 1e9) fail(std::string("\"") + word + "\" is no whole number");
    return static_cast<int>(value);
  }
  double number_or(const char* word, double other) const {
    if (!json_.contains(word)) return other;
    if (!json_[word].is_number() || !std::isfinite(json_[word].get<double>()))
      fail(std::string("\"") + word + "\" is no number");
    return json_[word].get<double>();
  }
  int motif(const MotifSet& alphabet) const {
    if (!json_.contains("motif") || json_["motif"].is_null()) return -1;
    if (!json_["motif"].is_string()) fail("\"motif\" is no letter or name");
    return motif_named(json_["motif"].get<std::string>(), alphabet);
  }
  [[noreturn]] void fail(const std::string& message) const { throw InvalidInput(where_ + ": " + message); }

 private:
  const Json& json_;
  std::string where_;
};

template <typename Visit>
void visit_list(const Json& root, const char* word, const std::string& name, Visit visit) {
  if (!root.contains(word)) return;
  if (!root[word].is_array()) throw InvalidInput(name + ": \"" + word + "\" is no list […]");
  for (std::size_t k = 0; k < root[word].size(); ++k)
    visit(Entry(root[word][k], name + ": " + word + "[" + std::to_string(k) + "]"));
}

void join_by_hard_cuts(EditList& edits) {
  const std::size_t count = edits.shots.size() - (edits.loop ? 0 : 1);
  for (std::size_t k = 0; k < count; ++k)
    edits.cuts.push_back({edits.shots[k].last, edits.shots[(k + 1) % edits.shots.size()].first});
}

Json rational_time(double value, double rate) {
  return {{"OTIO_SCHEMA", "RationalTime.1"}, {"rate", rate}, {"value", value}};
}

Json time_range(double start, double duration, double rate) {
  return {{"OTIO_SCHEMA", "TimeRange.1"},
          {"duration", rational_time(duration, rate)},
          {"start_time", rational_time(start, rate)}};
}

/// "a b.mp4" → "a%20b.mp4": target_url is a URL.
std::string url_of(const std::string& path) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    if (plain)
      url += c;
    else
      url += {'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return url;
}

class OtioTrack {
 public:
  explicit OtioTrack(const PeopleTexture& texture) : texture_(texture), rate_(texture.frames_per_sec) {
    for (const Take& take : texture.takes) {
      int& end = source_end_[take.source];
      end = std::max(end, take.source_start + take.frames.length);
    }
  }

  Json clip(const Shot& shot) const {
    const Take& take = take_at(texture_, shot.first);
    const int length = shot.last - shot.first + 1;
    Json motex{{"first", shot.first}, {"last", shot.last}, {"person", take.person}, {"mirrored", take.mirrored}};
    motex["motif"] = letter_of(texture_, shot.motif);
    Json effects = Json::array();
    if (take.mirrored)
      effects.push_back({{"OTIO_SCHEMA", "Effect.1"},
                         {"metadata", Json::object()},
                         {"name", "mirrored"},
                         {"effect_name", "Flop"},
                         {"enabled", true}});
    return {{"OTIO_SCHEMA", "Clip.2"},
            {"metadata", {{"motex", motex}}},
            {"name", name_of(shot, take)},
            {"source_range", time_range(source_frame(take, shot.first), length, rate_)},
            {"effects", effects},
            {"markers", Json::array()},
            {"enabled", true},
            {"media_references", {{"DEFAULT_MEDIA", media(take)}}},
            {"active_media_reference_key", "DEFAULT_MEDIA"}};
  }

  /// Of the frames before the cut and after it that the two takes share.
  Json transition(const Cut& cut, int length) const {
    const int before = (length + 1) / 2;
    return {{"OTIO_SCHEMA", "Transition.1"},
            {"metadata", {{"motex", {{"renderer", "morph"}, {"difference", cut.difference}}}}},
            {"name", "morph"},
            {"in_offset", rational_time(before, rate_)},
            {"out_offset", rational_time(length - before, rate_)},
            {"transition_type", "SMPTE_Dissolve"}};
  }

 private:
  std::string name_of(const Shot& shot, const Take& take) const {
    if (shot.motif < 0) return take.source;
    const Motif& motif = texture_.alphabet.motifs.at(static_cast<std::size_t>(shot.motif));
    return motif.name.empty() ? motif.letter : motif.name;
  }
  Json media(const Take& take) const {
    return {{"OTIO_SCHEMA", "ExternalReference.1"},
            {"metadata", Json::object()},
            {"name", take.source},
            {"available_range", time_range(0, source_end_.at(take.source), rate_)},
            {"available_image_bounds", nullptr},
            {"target_url", url_of(take.source)}};
  }

  const PeopleTexture& texture_;
  double rate_;
  std::map<std::string, int> source_end_;
};

}  // namespace

std::string edit_list_json(const PeopleTexture& texture, const EditList& edits) {
  Json shots = Json::array(), cuts = Json::array(), performances = Json::array();
  for (const Shot& shot : edits.shots) {
    const Take& take = take_at(texture, shot.first);
    shots.push_back({{"first", shot.first},
                     {"last", shot.last},
                     {"motif", letter_of(texture, shot.motif)},
                     {"source", take.source},
                     {"source_first", source_frame(take, shot.first)},
                     {"mirrored", take.mirrored}});
  }
  for (const Cut& cut : edits.cuts)
    cuts.push_back({{"from", cut.from},
                    {"to", cut.to},
                    {"transition_frames", cut.transition_frames},
                    {"difference", cut.difference},
                    {"smoothness", cut.smoothness}});
  for (const Performance& performance : edits.performances)
    performances.push_back({{"motif", letter_of(texture, performance.motif)},
                            {"start", performance.start},
                            {"frames", performance.length}});
  const Json root{{"motex_edits", 1},
                  {"frames_per_sec", texture.frames_per_sec},
                  {"frames", edits.num_frames()},
                  {"loop", edits.loop},
                  {"shots", shots},
                  {"cuts", cuts},
                  {"performances", performances}};
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

EditList parse_edit_list(std::string_view text, const std::string& name, const PeopleTexture& texture) {
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object() || !root.contains("shots"))
    throw InvalidInput(name + R"(: an edit list is a JSON object {"shots": […], "cuts": […]})");
  EditList edits;
  if (root.contains("loop")) {
    if (!root["loop"].is_boolean()) throw InvalidInput(name + ": \"loop\" is neither true nor false");
    edits.loop = root["loop"].get<bool>();
  }
  visit_list(root, "shots", name, [&](const Entry& entry) {
    const Shot shot{entry.whole("first"), entry.whole("last"), entry.motif(texture.alphabet)};
    if (shot.first < 0 || shot.last < shot.first || shot.last >= texture.num_frames())
      entry.fail("frames " + std::to_string(shot.first) + " to " + std::to_string(shot.last) +
                 " are not all among the " + std::to_string(texture.num_frames()) + " of the model");
    edits.shots.push_back(shot);
  });
  if (edits.shots.empty()) throw InvalidInput(name + ": there is no shot");
  visit_list(root, "cuts", name, [&](const Entry& entry) {
    edits.cuts.push_back({entry.whole("from"), entry.whole("to"), entry.whole_or("transition_frames", 0),
                          entry.number_or("difference", 0), entry.number_or("smoothness", 0)});
  });
  visit_list(root, "performances", name, [&](const Entry& entry) {
    edits.performances.push_back({entry.motif(texture.alphabet), entry.whole("start"), entry.whole("frames")});
  });
  if (edits.cuts.empty()) join_by_hard_cuts(edits);
  try {
    (void)film_frames(texture, edits);
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what());
  }
  return edits;
}

std::string edit_list_otio(const PeopleTexture& texture, const EditList& edits, const std::string& title) {
  const OtioTrack track(texture);
  const std::vector<int> lengths = transition_lengths(texture, edits);
  Json children = Json::array();
  for (std::size_t k = 0; k < edits.shots.size(); ++k) {
    children.push_back(track.clip(edits.shots[k]));
    if (k + 1 < edits.shots.size() && lengths[k] > 0) children.push_back(track.transition(edits.cuts[k], lengths[k]));
  }
  const auto composition = [](const char* schema, const std::string& name, const Json& parts) {
    return Json{{"OTIO_SCHEMA", schema},    {"metadata", Json::object()}, {"name", name},    {"source_range", nullptr},
                {"effects", Json::array()}, {"markers", Json::array()},   {"enabled", true}, {"children", parts}};
  };
  Json video = composition("Track.1", "actor", children);
  video["kind"] = "Video";
  const Json root{{"OTIO_SCHEMA", "Timeline.1"},
                  {"metadata", {{"motex", {{"loop", edits.loop}}}}},
                  {"name", title},
                  {"global_start_time", nullptr},
                  {"tracks", composition("Stack.1", "tracks", Json::array({video}))}};
  return root.dump(4, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_edit_list(const std::filesystem::path& path, const PeopleTexture& texture, const EditList& edits) {
  if (path.extension() == ".json")
    write_file(path, edit_list_json(texture, edits));
  else if (path.extension() == ".otio")
    write_file(path, edit_list_otio(texture, edits, path.stem().string()));
  else
    throw InvalidInput(path.string() + ": an edit list is written as .json or .otio");
}

}  // namespace motex
