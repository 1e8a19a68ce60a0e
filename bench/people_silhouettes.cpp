// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT

// All pairs of 9,000 silhouettes as masks of 2,048 bits, CPU seconds: the nearest of each and all pairs within a limit,
// with one alignment and with four; the best of five runs.
#include <cstdio>
#include <ctime>
#include <functional>

#include "motex/core/rng.h"
#include "motex/people/silhouette_bits.h"

namespace {

using namespace motex;

constexpr int kFrames = 9000;

/// Masks that wander: each frame changes 20 cells of the one before it.
std::vector<MaskBits> wandering_masks(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<MaskBits> masks(kFrames);
  MaskBits mask{};
  for (std::uint64_t& word : mask) word = rng.next_u64();
  for (MaskBits& out : masks) {
    for (int k = 0; k < 20; ++k) {
      const std::uint64_t bit = rng.below(kMaskBits);
      mask[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    }
    out = mask;
  }
  return masks;
}

double cpu_secs(const std::function<void()>& work) {
  double best = 1e9;
  for (int run = 0; run < 5; ++run) {
    const std::clock_t start = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

}  // namespace

int main() {
  std::vector<std::vector<MaskBits>> four;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) four.push_back(wandering_masks(seed));
  const MaskSet box(four[0]), pinned(four);
  std::printf("%d frames, %s\n", kFrames, mask_instructions());
  std::printf("nearest of each, one alignment    %.3f s CPU\n", cpu_secs([&] { (void)box.nearest(15); }));
  std::printf("nearest of each, four alignments  %.3f s CPU\n", cpu_secs([&] { (void)pinned.nearest(15); }));
  std::printf("pairs within 200 cells, one       %.3f s CPU, %zu pairs\n",
              cpu_secs([&] { (void)box.pairs_within(200, 15); }), box.pairs_within(200, 15).size());
  std::printf("pairs within 200 cells, four      %.3f s CPU\n", cpu_secs([&] { (void)pinned.pairs_within(200, 15); }));
  return 0;
}
