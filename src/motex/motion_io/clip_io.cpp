// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/clip_io.h"

#include <algorithm>

#include "motex/core/error.h"
#include "motex/core/extension.h"
#include "motex/core/files.h"
#include "motex/core/options_check.h"
#include "motex/motion_io/asf_amc.h"
#include "motex/motion_io/bvh.h"
#include "motex/motion_io/fbx.h"
#include "motex/motion_io/gltf.h"
#include "motex/motion_io/gltf_skin.h"
#include "motex/motion_io/npz.h"
#include "motex/motion_io/tables.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

enum class Kind { kBvh, kAmc, kGltf, kAsf, kFbx, kC3d, kTrc, kNpz, kMotex, kUnknown };
constexpr const char* kKindNames[] = {"BVH", "AMC", "glTF",       "ASF",         "FBX",
                                      "C3D", "TRC", "zip or NPZ", "motex model", ""};

Kind kind_of_extension(const std::string& extension) {
  static constexpr std::pair<const char*, Kind> kKinds[] = {
      {".bvh", Kind::kBvh}, {".amc", Kind::kAmc},    {".glb", Kind::kGltf}, {".gltf", Kind::kGltf},
      {".asf", Kind::kAsf}, {".fbx", Kind::kFbx},    {".c3d", Kind::kC3d},  {".trc", Kind::kTrc},
      {".npz", Kind::kNpz}, {".motex", Kind::kMotex}};
  for (const auto& [name, kind] : kKinds)
    if (extension == name) return kind;
  return Kind::kUnknown;
}

// Only what is certain.
Kind kind_of_content(std::string_view bytes) {
  const auto begins = [&](std::string_view start) { return bytes.substr(0, start.size()) == start; };
  if (begins("glTF")) return Kind::kGltf;
  if (begins("Kaydara FBX Binary") || begins("; FBX")) return Kind::kFbx;
  if (begins("PK\x03\x04")) return Kind::kNpz;
  if (begins("\x89MOTEX")) return Kind::kMotex;
  if (begins("PathFileType")) return Kind::kTrc;
  const std::size_t text = begins("\xEF\xBB\xBF") ? 3 : 0;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n", text);
  if (first == bytes.npos) return Kind::kUnknown;
  if (same_word(bytes.substr(first, 9), "HIERARCHY")) return Kind::kBvh;
  if (bytes[first] == '{' && bytes.find("\"asset\"") != bytes.npos) return Kind::kGltf;
  if (bytes.size() > 512 && bytes[1] == 0x50 && bytes[0] > 0 && bytes[0] < 64) return Kind::kC3d;
  return Kind::kUnknown;
}

std::string joined(const std::vector<std::string>& extensions) {
  std::string out;
  for (const std::string& extension : extensions) out += (out.empty() ? "" : ", ") + extension;
  return out;
}

[[noreturn]] void refuse(Kind kind, const std::string& name) {
  const std::string read = "; motex reads " + joined(readable_clip_extensions());
  if (kind == Kind::kMotex) throw UnsupportedFile(name + ": is a motex model, not a clip");
  if (kind == Kind::kAsf) throw UnsupportedFile(name + ": is a skeleton without motion; name the .amc clip beside it");
  if (kind == Kind::kC3d || kind == Kind::kTrc)
    throw UnsupportedFile(name + ": is a " + kKindNames[static_cast<int>(kind)] +
                          " file, which holds markers, not a skeleton; motex views and converts them; to learn "
                          "from them, solve them for a skeleton in a motion capture program and save that as BVH");
  if (kind == Kind::kUnknown) throw UnsupportedFile(name + ": is of no known kind" + read);
  throw UnsupportedFile(name + ": is a " + kKindNames[static_cast<int>(kind)] + " file" + read);
}

Kind choose_kind(std::string_view bytes, const std::string& name, const JobContext& job) {
  const Kind stated = kind_of_extension(extension_of(name)), found = kind_of_content(bytes);
  if (found == Kind::kUnknown || found == stated) return stated;
  const bool readable = found == Kind::kBvh || found == Kind::kGltf || found == Kind::kFbx;
  if (readable && stated != Kind::kUnknown)
    job.warn(name + ": holds " + kKindNames[static_cast<int>(found)] + ", whatever its name says; it is read so");
  return found;
}

Clip read_as(Kind kind, std::string_view bytes, const std::string& name, const ReadClipOptions& options,
             const JobContext& job) {
  if (kind == Kind::kBvh) return read_bvh_bytes(bytes, name, options, job);
  if (kind == Kind::kGltf) return read_gltf_bytes(bytes, name, options, job);
  if (kind == Kind::kFbx) return read_fbx_bytes(bytes, name, options, job);
  if (kind != Kind::kAmc) refuse(kind, name);
  if (options.asf.empty()) throw InvalidInput(name + ": an AMC clip needs its skeleton; name the .asf with --asf");
  const std::string skeleton = read_file(options.asf);
  return read_amc_bytes({skeleton, options.asf}, {bytes, name}, options, job);
}

Clip finished(Clip clip, const ReadClipOptions& options, const JobContext& job) {
  if (options.up == UpAxis::kAuto && looks_z_up(clip))
    job.warn(clip.name + ": the body stretches along z; if it should stand, read it with --up z");
  apply_read_options(options, clip);
  check_clip(clip);
  return clip;
}

}  // namespace

const std::vector<std::string>& readable_clip_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> all{".bvh", ".amc", ".glb", ".gltf"};
    if (reads_fbx()) all.emplace_back(".fbx");
    return all;
  }();
  return extensions;
}

const std::vector<std::string>& writable_clip_extensions() {
  static const std::vector<std::string> extensions{".bvh", ".glb", ".csv", ".npz"};
  return extensions;
}

Clip read_clip_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                     const JobContext& job) {
  check_options(options);
  return finished(read_as(choose_kind(bytes, name, job), bytes, name, options, job), options, job);
}

Clip read_clip(const fs::path& path, const ReadClipOptions& options, const JobContext& job) {
  check_options(options);
  const std::string bytes = read_file(path);
  const Kind kind = choose_kind(bytes, path.string(), job);
  // These two may need the files beside them.
  if (kind == Kind::kAmc) return finished(read_amc(path, options, job), options, job);
  if (kind == Kind::kGltf) return finished(read_gltf(path, options, job), options, job);
  return finished(read_as(kind, bytes, path.string(), options, job), options, job);
}

void check_clip_extension(const fs::path& path) {
  const auto& known = writable_clip_extensions();
  if (std::find(known.begin(), known.end(), extension_of(path)) == known.end())
    throw UnsupportedFile(path.string() + ": motex writes " + joined(known) + "; choose one by the extension");
}

void write_clip(const fs::path& path, const Clip& clip, const JobContext& job) {
  check_clip_extension(path);
  job.check_cancelled();
  const std::string extension = extension_of(path);
  if (extension == ".bvh") write_bvh(path, clip);
  if (extension == ".glb") {
    if (clip.skeleton.skin && !skin_fits(clip.skeleton))
      job.warn(path.string() + ": the skin is left out: the skeleton lacks some of its joints");
    write_glb(path, clip);
  }
  if (extension == ".csv") write_csv(path, clip);
  if (extension == ".npz") write_npz(path, clip);
}

}  // namespace motex
