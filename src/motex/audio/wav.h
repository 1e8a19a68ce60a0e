// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace motex {

/// Sound of one channel.
struct Sound {
  double rate = 0;             ///< samples a second
  std::vector<float> samples;  ///< −1 … 1
  double duration_secs() const { return static_cast<double>(samples.size()) / rate; }
};

/// RIFF WAVE: PCM of 8, 16, 24 or 32 bits, IEEE float of 32 or 64, plain or extensible; several channels are averaged.
/// A data chunk that claims more than there is (a recorder that was switched off) is read as far as it goes.
/// Throws ParseError with the byte, UnsupportedFile naming the encoding, InvalidInput when the file cannot be read.
Sound read_wav(const std::filesystem::path& path);
Sound read_wav_bytes(std::string_view bytes, const std::string& name);

/// 16-bit PCM of one channel.
std::string write_wav_bytes(const Sound& sound);

}  // namespace motex
