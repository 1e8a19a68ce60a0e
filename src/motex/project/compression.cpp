// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/compression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/particles/clip_codec.h"
#include "motex/particles/compress_clip.h"
#include "motex/particles/plane_codec.h"
#include "motex/project/textured_motion_file.h"

namespace motex {
namespace {

constexpr std::string_view kMagic = "\x89MTXG\r\n";
constexpr double kMapPeak = 255, kMapStep = 4;
constexpr std::uint32_t kMostBytes = 256U << 20U;

/// Bytes by their eight bits, in the context of the byte before.
template <typename Coder>
void code_bytes(Coder& coder, std::string& bytes) {
  const auto models = std::make_unique<std::array<std::array<BitModel, 256>, 256>>();
  std::uint8_t before = 0;
  for (char& c : bytes) {
    const auto value = static_cast<std::uint8_t>(c);
    std::uint32_t coded = 1;
    for (int k = 7; k >= 0; --k)
      coded = coded << 1U | static_cast<std::uint32_t>(coder.bit((*models)[before][coded], (value >> k & 1U) != 0));
    before = static_cast<std::uint8_t>(coded);
    c = static_cast<char>(before);
  }
}

std::array<Plane*, 4> planes_of(BirthDeathMaps& maps) {
  return {&maps.source, &maps.sink, &maps.occupancy, &maps.hazard};
}

float peak_of(const Plane& plane) {
  float peak = 0;
  for (const float value : plane.values) peak = std::max(peak, value);
  return peak;
}

void scale(Plane& plane, double factor) {
  for (float& value : plane.values) value = std::max(0.0F, static_cast<float>(static_cast<double>(value) * factor));
}

void clear(Planes& planes) {
  for (Plane& plane : planes) std::fill(plane.values.begin(), plane.values.end(), 0.0F);
}

TexturedMotion without_hidden_variables(TexturedMotion model) {
  model.cables.clear();
  model.maps.births.clear();
  model.maps.deaths.clear();
  model.maps.bursts.clear();
  return model;
}

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

float background_step(const TexturedMotion& model) {
  return static_cast<float>(std::clamp(0.5 * model.noise, 1.0, 64.0));
}

}  // namespace

std::string generative_model_bytes(const TexturedMotion& model) {
  TexturedMotion rest = without_hidden_variables(model);
  RangeWriter writer;
  write_planes(writer, rest.background, static_cast<double>(background_step(model)));
  std::string header(kMagic);
  put(header, background_step(model));
  for (Plane* map : planes_of(rest.maps)) {
    const float peak = peak_of(*map);
    put(header, peak);
    if (peak <= 0) continue;
    scale(*map, kMapPeak / static_cast<double>(peak));
    write_planes(writer, {*map}, kMapStep);
    scale(*map, 0);
  }
  clear(rest.background);
  std::string bytes = textured_motion_bytes(rest);
  put(header, static_cast<std::uint32_t>(bytes.size()));
  RangeWriter names;
  code_bytes(names, bytes);
  const std::string coded = names.finish();
  put(header, static_cast<std::uint32_t>(coded.size()));
  bytes = header + coded + writer.finish();
  put(bytes, archive_checksum(bytes));
  return bytes;
}

TexturedMotion parse_generative_model(const std::string& bytes, const std::string& name) {
  std::size_t at = kMagic.size();
  const auto fail = [&](const char* message) -> void {
    throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at), message);
  };
  constexpr std::size_t kHeader = 7 + 5 * 4 + 2 * 4;
  if (bytes.compare(0, kMagic.size(), kMagic) != 0 || bytes.size() < kHeader + 4) fail("is no model made by motex");
  std::uint32_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + bytes.size() - 4, 4);
  if (checksum != archive_checksum(std::string_view(bytes).substr(0, bytes.size() - 4)))
    fail("is cut off or damaged: its checksum is wrong");
  std::array<float, 5> numbers{};
  std::array<std::uint32_t, 2> sizes{};
  std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
  std::memcpy(sizes.data(), bytes.data() + at + sizeof numbers, sizeof sizes);
  at = kHeader;
  const std::size_t left = bytes.size() - 4 - at;
  if (sizes[1] > left || sizes[0] > kMostBytes || !(numbers[0] >= 1e-3F && numbers[0] < 1e6F))
    fail("a size in the header is out of range");
  std::string rest(sizes[0], '\0');
  RangeReader names(std::string_view(bytes).substr(at, sizes[1]), name, static_cast<std::int64_t>(at));
  code_bytes(names, rest);
  TexturedMotion model = parse_textured_motion(std::move(rest), name);
  at += sizes[1];
  RangeReader pictures(std::string_view(bytes).substr(at, bytes.size() - 4 - at), name, static_cast<std::int64_t>(at));
  if (!model.background.empty())
    model.background = read_planes(pictures, model.width, model.height, static_cast<int>(model.background.size()),
                                   static_cast<double>(numbers[0]));
  std::size_t next = 1;
  for (Plane* map : planes_of(model.maps)) {
    const float peak = numbers[next++];
    if (!(peak > 0) || map->values.empty()) continue;
    *map = read_planes(pictures, map->width, map->height, 1, kMapStep)[0];
    scale(*map, static_cast<double>(peak) / kMapPeak);
  }
  return model;
}

CompressionSummary measure_compression(const TexturedMotion& model) {
  CompressionSummary summary;
  summary.raw_bytes = std::int64_t{1} * model.width * model.height * model.num_planes * model.num_frames;
  summary.clip_bytes = static_cast<std::int64_t>(write_clip_bytes(quantise_cables(model), model.background).size());
  summary.model_bytes = static_cast<std::int64_t>(generative_model_bytes(model).size());
  return summary;
}

}  // namespace motex
