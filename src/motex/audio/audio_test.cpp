// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "motex/audio/beat_tracking.h"
#include "motex/audio/fourier.h"
#include "motex/audio/wav.h"
#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

/// A WAVE file of these sample bytes.
std::string wave(std::uint16_t encoding, std::uint16_t channels, std::uint16_t bits, const std::string& data) {
  std::string out = "RIFF....WAVEJUNK";
  const auto put = [&out](auto value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{3});
  out += "abc";
  out += '\0';  // padding of an odd chunk
  out += "fmt ";
  put(std::uint32_t{16});
  put(encoding), put(channels), put(std::uint32_t{8000}), put(std::uint32_t{0}), put(std::uint16_t{0}), put(bits);
  out += "data";
  put(static_cast<std::uint32_t>(data.size()));
  return out + data;
}

template <typename T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) out.append(reinterpret_cast<const char*>(&value), sizeof value);
  return out;
}

TEST(Wav, WhatIsNoWaveIsSaid) {
  EXPECT_THROW(read_wav_bytes("", "x"), UnsupportedFile);
  EXPECT_THROW(read_wav_bytes("ID3 something else", "x.wav"), UnsupportedFile);
  EXPECT_THROW(read_wav_bytes(wave(2, 1, 4, "abcd"), "x.wav"), UnsupportedFile);  // ADPCM
  EXPECT_THROW(read_wav_bytes(wave(1, 0, 16, "abcd"), "x.wav"), ParseError);
  EXPECT_THROW(read_wav_bytes(wave(1, 1, 16, ""), "x.wav"), ParseError);
  const std::string good = wave(1, 1, 16, "abcdefgh");
  for (std::size_t length = 0; length < good.size() - 8; ++length)
    EXPECT_THROW(read_wav_bytes(std::string_view(good).substr(0, length), "x.wav"), InvalidInput) << length;
}

TEST(Wav, EveryEncoding) {
  const auto samples = [](const std::string& file) { return read_wav_bytes(file, "x.wav").samples; };
  EXPECT_EQ(samples(wave(1, 1, 16, bytes_of<std::int16_t>({-32768, 0, 16384}))), (std::vector<float>{-1, 0, 0.5F}));
  EXPECT_EQ(samples(wave(1, 1, 8, bytes_of<std::uint8_t>({0, 128, 192}))), (std::vector<float>{-1, 0, 0.5F}));
  EXPECT_EQ(samples(wave(1, 1, 32, bytes_of<std::int32_t>({-2147483647 - 1, 1 << 30}))),
            (std::vector<float>{-1, 0.5F}));
  EXPECT_EQ(samples(wave(1, 1, 24, std::string("\x00\x00\x80\x00\x00\x40", 6))), (std::vector<float>{-1, 0.5F}));
  EXPECT_EQ(samples(wave(3, 1, 32, bytes_of<float>({-1, 0.25F}))), (std::vector<float>{-1, 0.25F}));
  EXPECT_EQ(samples(wave(3, 1, 64, bytes_of<double>({-1, 0.25}))), (std::vector<float>{-1, 0.25F}));
  EXPECT_EQ(samples(wave(1, 2, 16, bytes_of<std::int16_t>({16384, 0, -16384, -16384}))),
            (std::vector<float>{0.25F, -0.5F}));  // channels averaged
  EXPECT_EQ(read_wav_bytes(wave(1, 1, 8, "ab"), "x").rate, 8000);
}

TEST(Wav, AnInterruptedRecordingIsReadAsFarAsItGoes) {
  std::string file = wave(1, 1, 16, bytes_of<std::int16_t>({100, 200, 300}));
  std::uint32_t claimed = 0xffffffff;
  std::memcpy(file.data() + file.size() - 10, &claimed, 4);
  EXPECT_EQ(read_wav_bytes(file, "x").samples.size(), 3U);
}

TEST(Wav, WrittenIsRead) {
  const Sound sound{22050, {0, 0.5F, -0.25F}};
  const Sound back = read_wav_bytes(write_wav_bytes(sound), "x");
  EXPECT_EQ(back.rate, 22050);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back.samples[i], sound.samples[i], 1e-4);
}

TEST(Fourier, AWaveIsOneLine) {
  std::vector<std::complex<double>> values(16);
  for (std::size_t t = 0; t < 16; ++t) values[t] = std::cos(2 * std::numbers::pi * 3 * static_cast<double>(t) / 16);
  FourierTransform(16)(values);
  for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(std::abs(values[k]), k == 3 || k == 13 ? 8 : 0, 1e-12) << k;
  EXPECT_THROW(FourierTransform(12), InvalidInput);
}

/// Drum hits at these moments over quiet noise and a steady tone.
Sound drum(const std::vector<double>& hits, double secs, double rate = 22050) {
  Sound sound;
  sound.rate = rate;
  sound.samples.resize(static_cast<std::size_t>(secs * rate));
  Rng rng(5);
  for (std::size_t i = 0; i < sound.samples.size(); ++i)
    sound.samples[i] = static_cast<float>(0.01 * rng.normal() +
                                          0.05 * std::sin(2 * std::numbers::pi * 440 * static_cast<double>(i) / rate));
  for (const double hit : hits)
    for (auto i = static_cast<std::size_t>(hit * rate); i < sound.samples.size(); ++i) {
      const double t = static_cast<double>(i) / rate - hit;
      if (t > 0.3) break;
      sound.samples[i] += static_cast<float>(0.5 * std::exp(-20 * t) * std::sin(2 * std::numbers::pi * 120 * t) +
                                             0.2 * std::exp(-60 * t) * rng.normal());
    }
  return sound;
}

TEST(BeatTracking, SilenceHasNoBeat) {
  EXPECT_THROW(track_beats(Sound{22050, std::vector<float>(22050 * 5, 0.0F)}), InvalidInput);
  EXPECT_THROW(track_beats(Sound{22050, std::vector<float>(100, 0.5F)}), InvalidInput);
}

TEST(BeatTracking, SteadyDrumsAtSeveralTempi) {
  for (const double tempo : {75.0, 100.0, 150.0}) {
    std::vector<double> hits;
    for (double t = 0.31; t < 11; t += 60 / tempo) hits.push_back(t);
    const BeatTrack track = track_beats(drum(hits, 12));
    EXPECT_NEAR(track.tempo_bpm, tempo, 0.02 * tempo);
    ASSERT_GE(track.beat_secs.size(), hits.size() - 2);
    for (const double beat : track.beat_secs) {
      double offset = 1;
      for (const double hit : hits) offset = std::min(offset, std::abs(beat - hit));
      EXPECT_LT(offset, 0.012) << tempo << " at " << beat;
    }
  }
}

TEST(BeatTracking, ATempoThatDriftsAndAMissingHit) {
  std::vector<double> hits, played;
  double t = 0.2;
  for (int i = 0; t < 28; ++i, t += 60 / (110 + 0.5 * i)) {
    hits.push_back(t);
    if (i % 9 != 4) played.push_back(t);
  }
  const BeatTrack track = track_beats(drum(played, 30, 44100));
  int num_met = 0;
  for (const double hit : hits)
    for (const double beat : track.beat_secs)
      if (std::abs(beat - hit) < 0.03) {
        ++num_met;
        break;
      }
  EXPECT_GE(num_met, static_cast<int>(0.9 * static_cast<double>(hits.size())));
}

}  // namespace
}  // namespace motex
