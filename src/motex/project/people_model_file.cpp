// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/people_model_file.h"

#include <algorithm>
#include <cmath>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/project/textured_motion_rows.h"

namespace motex {
namespace {

constexpr char kKind[] = "people_texture";
constexpr std::uint32_t kNewestVersion = 1;
constexpr int kMaxFrames = 100000000, kMaxSide = 32768;
constexpr std::size_t kMostReaders = 4, kMostKept = 64;
constexpr char kEndOfText = '\0';
using Ints = std::vector<std::int64_t>;

/// Texts one after another in one entry.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word.substr(0, word.find(kEndOfText)) + kEndOfText;
  return text;
}

std::vector<std::string> split(const ArchiveReader& in, const std::string& name, std::size_t count) {
  const std::string text = in.text(name);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find(kEndOfText, at);
    if (end == std::string::npos) break;
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  if (words.size() != count) in.fail("'" + name + "' has another number of names than the model");
  return words;
}

void write_takes(ArchiveWriter& out, const PeopleModel& model) {
  TableWriter takes(6), chunks(5);
  Ints boxes;
  std::vector<std::string> sources;
  std::string footage;
  footage.reserve(static_cast<std::size_t>(model.footage_bytes()));
  for (std::size_t k = 0; k < model.texture.takes.size(); ++k) {
    const Take& take = model.texture.takes[k];
    const TakeFilm& film = model.films[k];
    sources.push_back(take.source);
    takes.row({take.source_start + 0.0, take.person + 0.0, take.mirrored ? 1.0 : 0.0, take.frames.start + 0.0,
               take.frames.length + 0.0, film.lossless ? 1.0 : 0.0});
    for (const BoundingBox& box : film.boxes) {
      const bool none = box.empty();
      boxes.insert(boxes.end(),
                   {none ? 0 : box.left, none ? 0 : box.top, none ? 0 : box.width(), none ? 0 : box.height()});
    }
    for (const FilmChunk& chunk : film.chunks) {
      chunks.row({chunk.canvas.left + 0.0, chunk.canvas.top + 0.0, chunk.canvas.right + 0.0, chunk.canvas.bottom + 0.0,
                  chunk.video == nullptr ? 0.0 : static_cast<double>(chunk.video->size())});
      if (chunk.video != nullptr) footage += *chunk.video;
    }
  }
  out.add("take_sources", joined(sources));
  out.add("takes", takes.matrix());
  out.add("boxes", boxes);
  out.add("chunks", chunks.matrix());
  out.add("footage", footage);
}

void write_silhouettes(ArchiveWriter& out, const PeopleTexture& texture) {
  TableWriter rows(14);
  for (const Silhouette& s : texture.silhouettes)
    rows.row({s.box.left + 0.0, s.box.top + 0.0, s.box.right + 0.0, s.box.bottom + 0.0, s.area, s.centroid_x,
              s.centroid_y, s.mu20, s.mu11, s.mu02, s.mu30, s.mu21, s.mu12, s.mu03});
  out.add("silhouettes", rows.matrix());
}

void write_alphabet(ArchiveWriter& out, const MotifSet& alphabet) {
  TableWriter motifs(5), occurrences(3);
  std::vector<std::string> names;
  for (const Motif& motif : alphabet.motifs) {
    names.push_back(motif.letter);
    names.push_back(motif.name);
    motifs.row({motif.window + 0.0, motif.distance, motif.radius, motif.exemplar + 0.0,
                static_cast<double>(motif.occurrences.size())});
    for (const Occurrence& one : motif.occurrences) occurrences.row({one.start + 0.0, one.length + 0.0, one.distance});
  }
  Ints idle;
  for (const FrameSpan& span : alphabet.idle) idle.insert(idle.end(), {span.start, span.length});
  out.add("motif_names", joined(names));
  out.add("motifs", motifs.matrix());
  out.add("occurrences", occurrences.matrix());
  out.add("idle", idle);
}

void write_cuts(ArchiveWriter& out, const CutSet& set) {
  TableWriter cuts(5);
  for (const Cut& cut : set.cuts)
    cuts.row({cut.from + 0.0, cut.to + 0.0, cut.transition_frames + 0.0, cut.difference, cut.smoothness});
  const double natural[] = {set.natural_difference};
  out.add("cuts", cuts.matrix());
  out.add("natural_difference", natural);
}

/// A signed whole number of a table.
int take_whole(const ArchiveReader& in, TableReader& table, double most) {
  const double value = table.take();
  if (!(std::abs(value) <= most) || value != std::floor(value)) in.fail("a number of frames or pixels is out of range");
  return static_cast<int>(value);
}

BoundingBox take_box(const ArchiveReader& in, TableReader& table) {
  BoundingBox box;
  for (int* side : {&box.left, &box.top, &box.right, &box.bottom}) *side = take_whole(in, table, 4 * kMaxSide);
  return box;
}

void read_clip(const ArchiveReader& in, PeopleModel& model) {
  const auto clip = in.doubles("clip", 3);
  for (std::size_t k = 0; k < 2; ++k)
    if (!(clip[k] >= 1 && clip[k] <= kMaxSide) || clip[k] != std::floor(clip[k])) in.fail("the size is out of range");
  model.texture.width = static_cast<int>(clip[0]);
  model.texture.height = static_cast<int>(clip[1]);
  model.texture.frames_per_sec = clip[2];
  if (!(clip[2] >= 0.01 && clip[2] <= 1000)) in.fail("the frame rate is out of range");
  if (!in.has("plate")) return;
  model.plate = decode_png(in.text("plate"), "the model's plate");
  if (model.plate.width != model.texture.width || model.plate.height != model.texture.height)
    in.fail("the plate is of another size than the film");
}

/// What takes hold of the arrays that all of them share, one after another.
class FilmTableReader {
 public:
  explicit FilmTableReader(const ArchiveReader& in)
      : in_(in), boxes_(in.ints("boxes")), chunks_(in, "chunks", 5), footage_(in.text("footage")) {}

  void read(int num_frames, TakeFilm& film) {
    for (int first = 0; first < num_frames; first += kChunkFrames) {
      read_chunk(film.chunks.emplace_back());
      for (int k = first; k < std::min(num_frames, first + kChunkFrames); ++k) read_box(film);
    }
  }
  void finish() {
    if (box_ != boxes_.size() || byte_ != footage_.size() || chunks_.next_row_if_any())
      in_.fail("there is more footage than takes have frames");
  }

 private:
  void read_chunk(FilmChunk& chunk) {
    chunks_.next_row();
    chunk.canvas = take_box(in_, chunks_);
    const double size = chunks_.take();
    if (!(size >= 0 && size <= static_cast<double>(footage_.size() - byte_)) || size != std::floor(size))
      in_.fail("the footage is cut off");
    const auto count = static_cast<std::size_t>(size);
    if (count == 0) {
      chunk.canvas = {};
      return;
    }
    const BoundingBox& canvas = chunk.canvas;
    if (canvas.empty() || canvas.bottom < canvas.top || canvas.width() > kMaxCanvasSide ||
        canvas.height() > kMaxCanvasSide)
      in_.fail("a canvas is out of range");
    chunk.video = std::make_shared<const std::string>(footage_.substr(byte_, count));
    byte_ += count;
  }

  void read_box(TakeFilm& film) {
    if (boxes_.size() - box_ < 4) in_.fail("there are fewer boxes than frames");
    const std::int64_t *box = &boxes_[box_], width = box[2], height = box[3];
    const BoundingBox& canvas = film.chunks.back().canvas;
    box_ += 4;
    if (width == 0 && height == 0) {
      film.boxes.emplace_back();
      return;
    }
    if (width < 1 || height < 1 || box[0] < canvas.left || box[1] < canvas.top || width > canvas.width() ||
        height > canvas.height() || box[0] + width - 1 > canvas.right || box[1] + height - 1 > canvas.bottom)
      in_.fail("the box of a frame lies outside its canvas");
    film.boxes.push_back({static_cast<int>(box[0]), static_cast<int>(box[1]), static_cast<int>(box[0] + width - 1),
                          static_cast<int>(box[1] + height - 1)});
  }

  const ArchiveReader& in_;
  Ints boxes_;
  TableReader chunks_;
  std::string footage_;
  std::size_t box_ = 0, byte_ = 0;
};

void read_takes(const ArchiveReader& in, PeopleModel& model) {
  TableReader table(in, "takes", 6);
  FilmTableReader films(in);
  int next = 0;
  while (table.next_row_if_any()) {
    Take& take = model.texture.takes.emplace_back();
    TakeFilm& film = model.films.emplace_back();
    take.source_start = table.take_count(kMaxFrames);
    take.person = table.take_count(1e6);
    take.mirrored = table.take_count(1) == 1;
    take.frames.start = table.take_count(kMaxFrames);
    take.frames.length = table.take_count(kMaxFrames);
    if (take.frames.start != next || take.frames.length < 1) in.fail("takes do not follow one another");
    next = take.frames.end();
    if (next > kMaxFrames) in.fail("there are too many frames");
    film.lossless = table.take_count(1) == 1;
    if (!take.mirrored) films.read(take.frames.length, film);
  }
  films.finish();
  if (model.texture.takes.empty()) in.fail("it has no takes");
  const auto sources = split(in, "take_sources", model.texture.takes.size());
  for (std::size_t k = 0; k < sources.size(); ++k) model.texture.takes[k].source = sources[k];
  model.originals = original_takes(model.texture);
}

void read_silhouettes(const ArchiveReader& in, PeopleTexture& texture) {
  TableReader table(in, "silhouettes", 14);
  while (table.next_row_if_any()) {
    Silhouette& s = texture.silhouettes.emplace_back();
    s.box = take_box(in, table);
    for (double* value :
         {&s.area, &s.centroid_x, &s.centroid_y, &s.mu20, &s.mu11, &s.mu02, &s.mu30, &s.mu21, &s.mu12, &s.mu03})
      *value = table.take();
    if (!(s.area >= 0)) in.fail("a silhouette has no area");
  }
  if (texture.num_frames() != texture.takes.back().frames.end())
    in.fail("there must be as many silhouettes as frames of takes");
}

void read_alphabet(const ArchiveReader& in, PeopleTexture& texture) {
  const int num_frames = texture.num_frames();
  TableReader motifs(in, "motifs", 5), occurrences(in, "occurrences", 3);
  while (motifs.next_row_if_any()) {
    Motif& motif = texture.alphabet.motifs.emplace_back();
    motif.window = motifs.take_count(num_frames);
    motif.distance = motifs.take();
    motif.radius = motifs.take();
    motif.exemplar = motifs.take_count(num_frames - 1);
    for (int left = motifs.take_count(num_frames); left > 0; --left) {
      occurrences.next_row();
      Occurrence& one = motif.occurrences.emplace_back();
      one.start = occurrences.take_count(num_frames - 1);
      one.length = occurrences.take_count(num_frames - one.start);
      one.distance = occurrences.take();
      if (one.length < 1) in.fail("an occurrence of a motif has no frames");
    }
  }
  const auto names = split(in, "motif_names", 2 * texture.alphabet.motifs.size());
  for (std::size_t k = 0; k < texture.alphabet.motifs.size(); ++k) {
    texture.alphabet.motifs[k].letter = names[2 * k];
    texture.alphabet.motifs[k].name = names[2 * k + 1];
  }
  const Ints idle = in.ints("idle");
  if (idle.size() % 2 != 0) in.fail("the table of idle stretches is cut off");
  for (std::size_t k = 0; k < idle.size(); k += 2) {
    if (idle[k] < 0 || idle[k + 1] < 1 || idle[k] > num_frames || idle[k + 1] > num_frames - idle[k])
      in.fail("an idle stretch is out of range");
    texture.alphabet.idle.push_back({static_cast<int>(idle[k]), static_cast<int>(idle[k + 1])});
  }
}

void read_cuts(const ArchiveReader& in, PeopleTexture& texture) {
  const double last = texture.num_frames() - 1.0;
  TableReader table(in, "cuts", 5);
  while (table.next_row_if_any()) {
    Cut& cut = texture.cuts.cuts.emplace_back();
    cut.from = table.take_count(last);
    cut.to = table.take_count(last);
    cut.transition_frames = table.take_count(last);
    cut.difference = table.take();
    cut.smoothness = table.take();
  }
  texture.cuts.natural_difference = in.doubles("natural_difference", 1)[0];
}

}  // namespace

std::int64_t PeopleModel::footage_bytes() const {
  std::int64_t sum = 0;
  for (const TakeFilm& film : films)
    for (const FilmChunk& chunk : film.chunks)
      if (chunk.video != nullptr) sum += static_cast<std::int64_t>(chunk.video->size());
  return sum;
}

std::vector<int> original_takes(const PeopleTexture& texture) {
  std::vector<int> out;
  for (const Take& take : texture.takes) {
    const auto is_original = [&](const Take& other) {
      return !other.mirrored && other.source == take.source && other.source_start == take.source_start &&
             other.person == take.person && other.frames.length == take.frames.length;
    };
    const auto found = take.mirrored ? std::find_if(texture.takes.begin(), texture.takes.end(), is_original)
                                     : texture.takes.begin() + static_cast<std::ptrdiff_t>(out.size());
    if (found == texture.takes.end()) throw InvalidInput("a mirrored take has no original");
    out.push_back(static_cast<int>(found - texture.takes.begin()));
  }
  return out;
}

std::string people_model_bytes(const PeopleModel& model) {
  ArchiveWriter out(kKind, kNewestVersion);
  const double clip[] = {static_cast<double>(model.texture.width), static_cast<double>(model.texture.height),
                         model.texture.frames_per_sec};
  out.add("clip", clip);
  write_takes(out, model);
  write_silhouettes(out, model.texture);
  write_alphabet(out, model.texture.alphabet);
  write_cuts(out, model.texture.cuts);
  if (model.plate.width > 0) out.add("plate", encode_png(model.plate));
  return out.bytes();
}

void save_people_model(const std::filesystem::path& path, const PeopleModel& model) {
  write_file(path, people_model_bytes(model));
}

PeopleModel parse_people_model(std::string bytes, const std::string& name) {
  const ArchiveReader in(std::move(bytes), name, kKind, kNewestVersion);
  PeopleModel model;
  read_clip(in, model);
  read_takes(in, model);
  read_silhouettes(in, model.texture);
  read_alphabet(in, model.texture);
  read_cuts(in, model.texture);
  return model;
}

PeopleModel load_people_model(const std::filesystem::path& path) {
  return parse_people_model(read_file(path), path.string());
}

StoredFootage::StoredFootage(const PeopleModel& model)
    : films_(model.films), width_(model.texture.width), num_frames_(model.texture.num_frames()) {
  for (std::size_t k = 0; k < model.texture.takes.size(); ++k) {
    const Take& take = model.texture.takes[k];
    takes_.push_back({take.frames.start, take.frames.length, model.originals[k], take.mirrored});
  }
}

FilmChunkReader& StoredFootage::reader_of(int take, int chunk) {
  const auto found = std::find_if(readers_.begin(), readers_.end(),
                                  [&](const OpenChunk& one) { return one.take == take && one.chunk == chunk; });
  if (found != readers_.end()) {
    readers_.splice(readers_.begin(), readers_, found);
  } else {
    if (readers_.size() == kMostReaders) readers_.pop_back();
    const TakeFilm& film = films_[static_cast<std::size_t>(take)];
    readers_.push_front(
        {take, chunk, std::make_unique<FilmChunkReader>(film.chunks[static_cast<std::size_t>(chunk)], film.lossless)});
  }
  return *readers_.front().reader;
}

std::shared_ptr<const Sprite> StoredFootage::sprite(int frame) {
  if (frame < 0 || frame >= num_frames_)
    throw InvalidInput("there is no frame " + std::to_string(frame) + "; the model has " + std::to_string(num_frames_));
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one.first == frame; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  const auto take =
      std::find_if(takes_.begin(), takes_.end(), [&](const Stretch& one) { return frame < one.first + one.length; });
  const int within = frame - take->first;
  const BoundingBox& box = films_[static_cast<std::size_t>(take->original)].boxes[static_cast<std::size_t>(within)];
  Sprite sprite;
  if (!box.empty()) sprite = reader_of(take->original, within / kChunkFrames).read(within % kChunkFrames, box);
  if (take->mirrored) sprite = mirrored(sprite, width_);
  if (kept_.size() == kMostKept) kept_.pop_back();
  kept_.emplace_front(frame, std::make_shared<const Sprite>(std::move(sprite)));
  return kept_.front().second;
}

}  // namespace motex
