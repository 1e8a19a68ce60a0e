// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/npz.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "motex/core/error.h"
#include "motex/core/files.h"

namespace motex {
namespace {

constexpr std::uint64_t kLargestZip = 0xFFFFFFFEU;
constexpr std::uint16_t kVersion = 20, kDeflate = 8, kDate1980 = 0x21, kUtf8Names = 0x800;

void put(std::string& out, std::uint64_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

std::string deflated(std::string_view bytes) {
  z_stream stream{};
  // Negative window bits: without a header, as a zip holds it.
  if (deflateInit2(&stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) return std::string(bytes);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return done ? out : std::string(bytes);
}

// Code points; broken bytes stand for themselves.
std::u32string decode_utf8(const std::string& text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead >= 0xF0 && lead < 0xF5   ? 3
                             : lead >= 0xE0 && lead < 0xF0 ? 2
                             : lead >= 0xC2 && lead < 0xE0 ? 1
                                                           : 0;
    char32_t point = more == 0 ? lead : lead & (0x3F >> more);
    bool whole = i + more < text.size();
    for (std::size_t k = 1; k <= more && whole; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      whole = next >> 6 == 2;
      point = point << 6 | (next & 0x3F);
    }
    whole = whole && point <= 0x10FFFF && (point < 0xD800 || point > 0xDFFF);
    out += whole ? point : lead;
    i += whole ? more + 1 : 1;
  }
  return out;
}

template <typename T>
std::string_view as_bytes(const T* data, Index count) {
  return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(count) * sizeof(T)};
}

}  // namespace

void NpzWriter::add_npy(const std::string& name, std::string_view type, std::span<const Index> shape,
                        std::string_view elements) {
  std::string header = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (";
  for (const Index n : shape) header += std::to_string(n) + ",";
  header += "), }";
  header.resize((header.size() + 10 + 1 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::string npy("\x93NUMPY\x01\0", 8);
  put(npy, header.size(), 2);
  npy.append(header).append(elements);
  if (npy.size() + body_.size() > kLargestZip) throw InvalidInput("the arrays do not fit the 4 GiB of an NPZ file");
  for (const Entry& entry : entries_)
    if (entry.name == name + ".npy") throw InvalidInput("the array '" + name + "' is given twice");
  const std::string packed = deflated(npy);
  const bool smaller = packed.size() < npy.size();
  const std::string& stored = smaller ? packed : npy;
  Entry entry{
      name + ".npy", body_.size(), 0, static_cast<std::uint32_t>(stored.size()), static_cast<std::uint32_t>(npy.size()),
      smaller};
  entry.crc =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(npy.data()), static_cast<uInt>(npy.size())));
  put(body_, 0x04034b50, 4), put(body_, kVersion, 2), put(body_, kUtf8Names, 2);
  put(body_, smaller ? kDeflate : 0, 2), put(body_, 0, 2), put(body_, kDate1980, 2), put(body_, entry.crc, 4);
  put(body_, entry.stored_size, 4), put(body_, entry.size, 4), put(body_, entry.name.size(), 2), put(body_, 0, 2);
  body_ += entry.name;
  body_ += stored;
  entries_.push_back(std::move(entry));
}

void NpzWriter::add(const std::string& name, const FrameMatrix& values) {
  const Index shape[] = {values.rows(), values.cols()};
  add_npy(name, "<f8", shape, as_bytes(values.data(), values.size()));
}

void NpzWriter::add(const std::string& name, const FrameMatrixF& values) {
  const Index shape[] = {values.rows(), values.cols()};
  add_npy(name, "<f4", shape, as_bytes(values.data(), values.size()));
}

void NpzWriter::add(const std::string& name, std::span<const double> values) {
  const Index shape[] = {static_cast<Index>(values.size())};
  add(name, values, shape);
}

void NpzWriter::add(const std::string& name, std::span<const double> values, std::span<const Index> shape) {
  Index count = 1;
  for (const Index n : shape) count *= n;
  if (count != static_cast<Index>(values.size())) throw InvalidInput("the array '" + name + "' does not fit its shape");
  add_npy(name, "<f8", shape, as_bytes(values.data(), count));
}

void NpzWriter::add(const std::string& name, std::span<const std::int64_t> values) {
  const Index shape[] = {static_cast<Index>(values.size())};
  add_npy(name, "<i8", shape, as_bytes(values.data(), shape[0]));
}

void NpzWriter::add(const std::string& name, double value) { add(name, {&value, 1}, std::span<const Index>()); }

void NpzWriter::add(const std::string& name, std::span<const std::string> values) {
  std::vector<std::u32string> points;
  std::size_t longest = 1;
  for (const std::string& value : values) longest = std::max(longest, points.emplace_back(decode_utf8(value)).size());
  std::u32string elements;
  for (std::u32string& value : points) {
    value.resize(longest, U'\0');
    elements += value;
  }
  const Index shape[] = {static_cast<Index>(values.size())};
  add_npy(name, "<U" + std::to_string(longest), shape, as_bytes(elements.data(), static_cast<Index>(elements.size())));
}

std::string NpzWriter::bytes() const {
  std::string out = body_, directory;
  for (const Entry& entry : entries_) {
    put(directory, 0x02014b50, 4), put(directory, kVersion, 2), put(directory, kVersion, 2);
    put(directory, kUtf8Names, 2), put(directory, entry.deflated ? kDeflate : 0, 2), put(directory, 0, 2);
    put(directory, kDate1980, 2), put(directory, entry.crc, 4), put(directory, entry.stored_size, 4);
    put(directory, entry.size, 4), put(directory, entry.name.size(), 2), put(directory, 0, 2);
    put(directory, 0, 2), put(directory, 0, 2), put(directory, 0, 2), put(directory, 0, 4);
    put(directory, entry.offset, 4);
    directory += entry.name;
  }
  if (out.size() + directory.size() > kLargestZip || entries_.size() > 0xFFFE)
    throw InvalidInput("the arrays do not fit the 4 GiB of an NPZ file");
  const std::size_t start = out.size();
  out += directory;
  put(out, 0x06054b50, 4), put(out, 0, 4), put(out, entries_.size(), 2), put(out, entries_.size(), 2);
  put(out, directory.size(), 4), put(out, start, 4), put(out, 0, 2);
  return out;
}

std::string write_npz_bytes(const Clip& clip) {
  check_clip(clip);
  const Index frames = clip.num_frames(), joints = clip.skeleton.num_joints();
  const auto span = [](const FrameMatrix& m) { return std::span(m.data(), static_cast<std::size_t>(m.size())); };
  const FrameMatrix positions = world_positions(clip).leftCols(3 * joints);
  std::vector<std::int64_t> parents, site_parents;
  std::vector<std::string> names;
  FrameMatrix offsets(joints, 3), site_offsets(static_cast<Index>(clip.skeleton.end_sites.size()), 3);
  for (const Joint& joint : clip.skeleton.joints) {
    offsets.row(static_cast<Index>(names.size())) = joint.offset.transpose();
    parents.push_back(joint.parent_idx);
    names.push_back(joint.name);
  }
  for (const EndSite& site : clip.skeleton.end_sites) {
    site_offsets.row(static_cast<Index>(site_parents.size())) = site.offset.transpose();
    site_parents.push_back(site.parent_idx);
  }
  NpzWriter npz;
  const Index quat_shape[] = {frames, joints, 4}, vector_shape[] = {frames, joints, 3};
  npz.add("rotations", span(clip.rotations), quat_shape);
  npz.add("translations", span(clip.translations), vector_shape);
  npz.add("positions", span(positions), vector_shape);
  npz.add("offsets", offsets);
  npz.add("parents", std::span<const std::int64_t>(parents));
  npz.add("names", std::span<const std::string>(names));
  npz.add("end_site_parents", std::span<const std::int64_t>(site_parents));
  npz.add("end_site_offsets", site_offsets);
  npz.add("frame_time", clip.frame_time_secs);
  npz.add("metres_per_unit", clip.skeleton.metres_per_unit);
  return npz.bytes();
}

void write_npz(const std::filesystem::path& path, const Clip& clip) { write_file(path, write_npz_bytes(clip)); }

}  // namespace motex
