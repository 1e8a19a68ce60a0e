// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "clip_output.h"
#include "closest.h"
#include "commands.h"
#include "motex/core/archive.h"
#include "motex/core/gemm.h"
#include "motex/core/parallel.h"
#include "motex/motion_io/clip_io.h"
#include "motex/motion_io/markers_io.h"
#include "motex/video_io/video_reader.h"
#include "motex/video_io/video_writer.h"
#include "text_table.h"

namespace motex::cli {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

/// Path of the first of these programs on PATH, or "".
std::string find_program(const std::vector<std::string>& names) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    for (const std::string& name : names) {
      const auto candidate = std::filesystem::path(folder) / name;
      std::error_code ec;
      if (std::filesystem::is_regular_file(candidate, ec)) return candidate.string();
    }
  return "";
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

struct Doctor {
  void declare(Arguments&) {}
  void run(Session& session) {
    const std::string browser =
        find_program({"chromium", "chromium-browser", "google-chrome", "firefox", "microsoft-edge"});
    Value object;
    object["motex"] = MOTEX_VERSION;
    object["compiler"] = kCompiler;
    object["eigen"] = eigen_version();
    object["blas"] = gemm_backend();
    object["cores"] = num_threads(0);
    object["zlib"] = zlib_release();
    object["reads"] = readable_clip_extensions();
    object["reads_markers"] = readable_marker_extensions();
    object["writes"] = clip_output_extensions();
    object["reads_video"] = readable_video_extensions();
    object["writes_video"] = writable_video_extensions();
    object["missing_video_encoders"] = missing_video_encoders();
    object["libav"] = libav_release();
    object["browser"] = browser.empty() ? Value() : Value(browser);
    session.result(object,
                   text_pairs({{"motex", MOTEX_VERSION},
                               {"compiler", kCompiler},
                               {"Eigen", eigen_version()},
                               {"BLAS", gemm_backend()},
                               {"zlib", zlib_release()},
                               {"cores", std::to_string(num_threads(0))},
                               {"reads", enumerate(readable_clip_extensions())},
                               {"markers", enumerate(readable_marker_extensions())},
                               {"writes", enumerate(clip_output_extensions())},
                               {"reads video", enumerate(readable_video_extensions())},
                               {"writes video", enumerate(writable_video_extensions())},
                               {"libav", libav_release()},
                               {"not here", missing_video_encoders().empty() ? "all video encoders are here"
                                                                             : enumerate(missing_video_encoders())},
                               {"browser", browser.empty() ? "none found: pages open in any other" : browser}}));
  }
};

}  // namespace

Command doctor() {
  return make_command<Doctor>(
      {"doctor", "versions, cores, formats, and what is missing", "", "motex doctor\nmotex doctor --json"});
}

}  // namespace motex::cli
