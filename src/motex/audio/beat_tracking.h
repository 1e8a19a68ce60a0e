// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/audio/wav.h"
#include "motex/core/matrix.h"

namespace motex {

/// How strongly something begins, 100 times a second: the spectral flux Σ_bands max(0, log-energy now − one step
/// before) of 40 bands from 40 Hz to 8 kHz, spaced by pitch, in Hann windows of 46 ms; minus its mean over a second
/// around, divided by its deviation. Value t is for the moment t / 100 s.
struct OnsetStrength {
  double rate = 100;
  Vector values;
};
OnsetStrength onset_strength(const Sound& sound);

struct BeatTrack {
  double tempo_bpm = 0;
  std::vector<double> beat_secs;
};

/// Beats by dynamic programming [Ellis 2007]: the tempo is the lag of the largest autocorrelation of the onset
/// strength, weighted by a log-normal of 0.9 octaves about 120 beats a minute; beats t_i maximise
///
///   Σ_i o(t_i) − 100 Σ_i log²((t_i − t_{i−1}) / period)
///
/// and weak beats before the first and after the last strong one are left out. Throws InvalidInput for sound shorter
/// than 2 s or in which nothing begins.
BeatTrack track_beats(const OnsetStrength& onsets);
BeatTrack track_beats(const Sound& sound);

}  // namespace motex
