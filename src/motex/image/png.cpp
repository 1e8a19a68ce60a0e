// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/png.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr int kRowFilterSub = 1, kRowFilterUp = 2, kRowFilterAverage = 3, kRowFilterPaeth = 4;

const Bytef* as_bytes(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

void append_u32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255);
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

std::uint32_t crc_of(std::string_view type_and_data) {
  return static_cast<std::uint32_t>(crc32(0, as_bytes(type_and_data), static_cast<uInt>(type_and_data.size())));
}

void append_chunk(std::string& out, const char* type, const std::string& data) {
  const std::string body = type + data;
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  out += body;
  append_u32(out, crc_of(body));
}

int paeth(int left, int up, int up_left) {
  const int p = left + up - up_left;
  const int to_left = std::abs(p - left), to_up = std::abs(p - up), to_up_left = std::abs(p - up_left);
  if (to_left <= to_up && to_left <= to_up_left) return left;
  return to_up <= to_up_left ? up : up_left;
}

/// What a filter expects of a sample, from those beside it.
int predicted(int filter, int left, int up, int up_left) {
  switch (filter) {
    case kRowFilterSub:
      return left;
    case kRowFilterUp:
      return up;
    case kRowFilterAverage:
      return (left + up) / 2;
    case kRowFilterPaeth:
      return paeth(left, up, up_left);
    default:
      return 0;
  }
}

/// Samples row by row without filter bytes: 1, 3 or 4 a pixel.
std::string samples_of(const Image& image, std::size_t channels) {
  std::string samples;
  samples.reserve(image.pixels.size() * channels);
  for (const Rgba& p : image.pixels) {
    samples += static_cast<char>(p.r);
    if (channels == 1) continue;
    samples += static_cast<char>(p.g);
    samples += static_cast<char>(p.b);
    if (channels == 4) samples += static_cast<char>(p.a);
  }
  return samples;
}

void filter_row(int filter, std::size_t channels, std::string_view above, std::string_view row, std::string& out) {
  out.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int left = i < channels ? 0 : static_cast<unsigned char>(row[i - channels]);
    const int up = static_cast<unsigned char>(above[i]);
    const int up_left = i < channels ? 0 : static_cast<unsigned char>(above[i - channels]);
    out[i] = static_cast<char>(row[i] - predicted(filter, left, up, up_left));
  }
}

/// Sum of the distances from zero: the usual guess of how well a row will compress.
std::int64_t roughness(std::string_view row) {
  std::int64_t sum = 0;
  for (const char c : row) sum += std::abs(static_cast<signed char>(c));
  return sum;
}

/// Rows, each with its filter byte. Up where it is as good as any: it turns flat areas and vertical edges into zeros.
std::string filtered_rows(const Image& image, std::size_t channels) {
  const std::string samples = samples_of(image, channels);
  const std::size_t stride = static_cast<std::size_t>(image.width) * channels;
  std::string above(stride, '\0'), best, candidate, rows;
  rows.reserve(samples.size() + static_cast<std::size_t>(image.height));
  for (std::size_t at = 0; at < samples.size(); at += stride) {
    const std::string_view row(samples.data() + at, stride);
    filter_row(kRowFilterUp, channels, above, row, best);
    int chosen = kRowFilterUp;
    std::int64_t least = roughness(best);
    for (const int filter : {kRowFilterSub, kRowFilterAverage, kRowFilterPaeth}) {
      if (least == 0) break;
      filter_row(filter, channels, above, row, candidate);
      if (const std::int64_t rough = roughness(candidate); rough < least) {
        least = rough;
        chosen = filter;
        best.swap(candidate);
      }
    }
    rows += static_cast<char>(chosen);
    rows += best;
    above.assign(row);
  }
  return rows;
}

struct Header {
  int width = 0, height = 0, channels = 0;
};

Header read_header(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 8) != kSignature || bytes.size() < 33 || bytes.substr(12, 4) != "IHDR")
    throw ParseError(name, ParseError::Unit::kByte, 0, "this is not a PNG file");
  const std::uint32_t width = read_u32(bytes, 16), height = read_u32(bytes, 20);
  const int depth = bytes[24], colour_type = bytes[25], interlace = bytes[28];
  const int channels = colour_type == 0 ? 1 : colour_type == 2 ? 3 : colour_type == 6 ? 4 : 0;
  if (depth != 8 || channels == 0 || interlace != 0)
    throw UnsupportedFile(name + ": only 8-bit grey, RGB and RGBA PNG files without interlacing can be read");
  if (width == 0 || height == 0 || width > 32768 || height > 32768)
    throw ParseError(name, ParseError::Unit::kByte, 16, "the size must be 1 … 32768 pixels");
  return {static_cast<int>(width), static_cast<int>(height), channels};
}

std::string joined_image_data(std::string_view bytes, const std::string& name) {
  std::string data;
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    const std::size_t size = read_u32(bytes, at);
    if (size > bytes.size() - at - 12) break;
    const std::string_view body = bytes.substr(at + 4, size + 4);
    if (crc_of(body) != read_u32(bytes, at + 8 + size))
      throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at), "the checksum is wrong");
    if (body.substr(0, 4) == "IEND") return data;
    if (body.substr(0, 4) == "IDAT") data += body.substr(4);
    at += size + 12;
  }
  throw ParseError(name, ParseError::Unit::kByte, static_cast<std::int64_t>(at), "the file is cut off");
}

/// Undoes the filter of one row in place. `above` is the finished row before it, or zeros.
void unfilter(int filter, std::size_t channels, std::string_view above, char* row) {
  for (std::size_t i = 0; i < above.size(); ++i) {
    const int left = i < channels ? 0 : static_cast<unsigned char>(row[i - channels]);
    const int up = static_cast<unsigned char>(above[i]);
    const int up_left = i < channels ? 0 : static_cast<unsigned char>(above[i - channels]);
    row[i] = static_cast<char>(row[i] + predicted(filter, left, up, up_left));
  }
}

}  // namespace

std::string encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) throw InvalidInput("an image without pixels cannot be written");
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(), [](const Rgba& p) { return p.a == 255; });
  const bool grey = opaque && std::all_of(image.pixels.begin(), image.pixels.end(),
                                          [](const Rgba& p) { return p.r == p.g && p.g == p.b; });
  const std::string rows = filtered_rows(image, grey ? 1 : opaque ? 3 : 4);
  uLongf size = compressBound(rows.size());
  std::string data(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(data.data()), &size, as_bytes(rows), rows.size(), 6) != Z_OK)
    throw NumericalFailure("the picture could not be compressed");
  data.resize(size);
  std::string header;
  append_u32(header, static_cast<std::uint32_t>(image.width));
  append_u32(header, static_cast<std::uint32_t>(image.height));
  header += {8, static_cast<char>(grey ? 0 : opaque ? 2 : 6), 0, 0, 0};
  std::string out(kSignature);
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", data);
  append_chunk(out, "IEND", "");
  return out;
}

Image decode_png(std::string_view bytes, const std::string& name) {
  const Header header = read_header(bytes, name);
  const std::string data = joined_image_data(bytes, name);
  const auto channels = static_cast<std::size_t>(header.channels);
  const std::size_t stride = static_cast<std::size_t>(header.width) * channels + 1;
  const std::size_t expected = stride * static_cast<std::size_t>(header.height);
  // Deflate cannot shrink by more than about 1032: a tiny file must not make us allocate gigabytes.
  if (expected / 1040 > data.size() + 64) throw ParseError(name, ParseError::Unit::kByte, 33, "the pixels are cut off");
  std::string rows(expected, '\0');
  uLongf size = expected;
  if (uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, as_bytes(data), data.size()) != Z_OK || size != expected)
    throw ParseError(name, ParseError::Unit::kByte, 33, "the pixels are damaged or cut off");
  Image image(header.width, header.height);
  std::string above(stride - 1, '\0');
  for (int y = 0; y < header.height; ++y) {
    char* row = &rows[static_cast<std::size_t>(y) * stride];
    unfilter(*row, channels, above, row + 1);
    above.assign(row + 1, stride - 1);
    for (int x = 0; x < header.width; ++x) {
      const auto* p = reinterpret_cast<const unsigned char*>(above.data()) + static_cast<std::size_t>(x) * channels;
      image.at(x, y) = channels == 1 ? Rgba{p[0], p[0], p[0], 255}
                                     : Rgba{p[0], p[1], p[2], channels == 4 ? p[3] : std::uint8_t{255}};
    }
  }
  return image;
}

}  // namespace motex
