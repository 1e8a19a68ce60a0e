// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/audio/wav.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/files.h"

namespace motex {
namespace {

static_assert(std::endian::native == std::endian::little);

enum Encoding : std::uint16_t { kPcm = 1, kFloat = 3, kExtensible = 0xfffe };

struct Format {
  std::uint16_t encoding = 0, channels = 0, bits = 0;
  std::uint32_t rate = 0;
  std::size_t bytes_per_sample() const { return bits / 8; }
};

/// Bytes of a file with a position.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  template <typename T>
  T take() {
    T value;
    if (left() < sizeof value) fail("the file ends in the middle of something");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string_view take(std::size_t count) {
    const std::string_view part = bytes_.substr(at_, count);
    at_ += part.size();
    return part;
  }
  void skip(std::size_t count) { at_ += std::min(count, left()); }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw ParseError(name_, ParseError::Unit::kByte, static_cast<std::int64_t>(at_), what);
  }

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

Format read_format(Reader& reader, std::uint32_t size, const std::string& name) {
  if (size < 16) reader.fail("the fmt chunk is shorter than 16 bytes");
  Format format;
  format.encoding = reader.take<std::uint16_t>();
  format.channels = reader.take<std::uint16_t>();
  format.rate = reader.take<std::uint32_t>();
  reader.skip(6);  // bytes a second, bytes a frame: they follow from the rest
  format.bits = reader.take<std::uint16_t>();
  std::size_t read = 16;
  if (format.encoding == kExtensible && size >= 26) {
    reader.skip(8);
    format.encoding = reader.take<std::uint16_t>();
    read = 26;
  }
  reader.skip(size - read);
  if (format.channels == 0 || format.channels > 256) reader.fail("a number of channels outside 1 … 256");
  if (format.rate < 100 || format.rate > 1'000'000) reader.fail("a rate outside 100 … 1000000 samples a second");
  const bool is_known =
      (format.encoding == kPcm && (format.bits == 8 || format.bits == 16 || format.bits == 24 || format.bits == 32)) ||
      (format.encoding == kFloat && (format.bits == 32 || format.bits == 64));
  if (!is_known)
    throw UnsupportedFile(name + ": WAVE encoding " + std::to_string(format.encoding) + " with " +
                          std::to_string(format.bits) +
                          " bits is not read; convert it to PCM of 16 bits (ffmpeg -i in.wav -c:a pcm_s16le out.wav)");
  return format;
}

template <typename T>
T value_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

double sample_at(const char* bytes, const Format& format) {
  if (format.encoding == kFloat)
    return format.bits == 32 ? static_cast<double>(value_at<float>(bytes)) : value_at<double>(bytes);
  if (format.bits == 8) return (static_cast<double>(static_cast<unsigned char>(*bytes)) - 128) / 128;
  if (format.bits == 16) return static_cast<double>(value_at<std::int16_t>(bytes)) / 32768;
  if (format.bits == 32) return static_cast<double>(value_at<std::int32_t>(bytes)) / 2147483648.0;
  const auto byte = [&](int i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])); };
  const auto shifted = static_cast<std::int32_t>((byte(0) << 8) | (byte(1) << 16) | (byte(2) << 24));
  return static_cast<double>(shifted) / 2147483648.0;
}

Sound decode(std::string_view data, const Format& format) {
  const std::size_t width = format.bytes_per_sample(), frame = width * format.channels;
  Sound sound;
  sound.rate = format.rate;
  sound.samples.reserve(data.size() / frame);
  for (std::size_t at = 0; at + frame <= data.size(); at += frame) {
    double sum = 0;
    for (std::size_t c = 0; c < format.channels; ++c) sum += sample_at(data.data() + at + c * width, format);
    const double mean = sum / format.channels;
    sound.samples.push_back(std::isfinite(mean) ? static_cast<float>(std::clamp(mean, -1e6, 1e6)) : 0.0F);
  }
  return sound;
}

}  // namespace

Sound read_wav_bytes(std::string_view bytes, const std::string& name) {
  Reader reader(bytes, name);
  if (bytes.size() < 12 || bytes.substr(0, 4) != "RIFF" || bytes.substr(8, 4) != "WAVE")
    throw UnsupportedFile(name + " is no WAVE file (RIFF); convert the sound to .wav");
  reader.skip(12);
  Format format;
  while (reader.left() >= 8) {
    const std::string_view id = reader.take(4);
    const auto size = reader.take<std::uint32_t>();
    if (id == "fmt ") {
      format = read_format(reader, size, name);
    } else if (id == "data") {
      if (format.channels == 0) reader.fail("the data come before the fmt chunk");
      Sound sound = decode(reader.take(size), format);
      if (sound.samples.empty()) reader.fail("there is no sample");
      return sound;
    } else {
      reader.skip(size);
    }
    if (size % 2 == 1) reader.skip(1);
  }
  reader.fail("there is no data chunk");
}

Sound read_wav(const std::filesystem::path& path) { return read_wav_bytes(read_file(path), path.string()); }

std::string write_wav_bytes(const Sound& sound) {
  std::string out;
  const auto put = [&out](auto value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto rate = static_cast<std::uint32_t>(std::lround(sound.rate));
  const auto size = static_cast<std::uint32_t>(2 * sound.samples.size());
  out += "RIFF";
  put(std::uint32_t{36} + size);
  out += "WAVEfmt ";
  put(std::uint32_t{16});
  put(std::uint16_t{kPcm});
  put(std::uint16_t{1});
  put(rate);
  put(2 * rate);
  put(std::uint16_t{2});
  put(std::uint16_t{16});
  out += "data";
  put(size);
  for (const float sample : sound.samples)
    put(static_cast<std::int16_t>(std::lround(32767 * std::clamp(sample, -1.0F, 1.0F))));
  return out;
}

}  // namespace motex
