// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/video_io/frame_sink.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

class PictureSink : public FrameSink {
 public:
  PictureSink(const fs::path& path, bool alpha) : alpha_(alpha) {
    std::string name = path.filename().string();
    folder_ = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (name.find('%') == std::string::npos) {
      folder_ = path;
      name = "%05d.png";
      std::error_code ec;
      made_folder_ = fs::create_directory(folder_, ec);
      if (ec) throw InvalidInput(folder_.string() + ": cannot be made: " + ec.message());
    }
    const std::size_t mark = name.find('%'), end = name.find('d', mark);
    const std::string digits = end == std::string::npos ? "x" : name.substr(mark + 1, end - mark - 1);
    if (digits.size() > 3 || !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
      throw InvalidInput(path.string() + ": write the place of the number as %d or %04d");
    num_digits_ = digits.empty() ? 0 : static_cast<std::size_t>(std::stoi(digits));
    head_ = name.substr(0, mark);
    tail_ = name.substr(end + 1);
  }
  ~PictureSink() override {
    if (finished_) return;
    std::error_code ec;
    for (const fs::path& picture : written_) fs::remove(picture, ec);
    if (made_folder_) fs::remove(folder_, ec);
  }
  PictureSink(const PictureSink&) = delete;
  PictureSink& operator=(const PictureSink&) = delete;

  void write(const Image& image, double) override {
    std::string number = std::to_string(written_.size());
    number.insert(0, number.size() < num_digits_ ? num_digits_ - number.size() : 0, '0');
    const fs::path path = folder_ / (head_ + number + tail_);
    Image opaque;
    if (!alpha_) {
      opaque = image;
      for (Rgba& pixel : opaque.pixels) pixel.a = 255;
    }
    write_file(path, encode_png(alpha_ ? image : opaque));
    written_.push_back(path);
  }
  void finish() override { finished_ = true; }

 private:
  fs::path folder_;
  std::string head_, tail_;
  std::size_t num_digits_ = 0;
  std::vector<fs::path> written_;
  bool alpha_, made_folder_ = false, finished_ = false;
};

}  // namespace

std::unique_ptr<FrameSink> make_picture_sink(const fs::path& path, const SinkShape& shape) {
  return std::make_unique<PictureSink>(path, shape.alpha);
}

}  // namespace motex
