// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Learning, iteration by iteration, beside the matrix products that it cannot do without: those of the emissions of
// the textons that the iteration evaluates (all of them at first, then the changed ones), same sizes, same threads.
#include <chrono>
#include <cmath>
#include <ctime>

#include "motex/core/gemm.h"
#include "motex/core/parallel.h"
#include "motex/motion_texture/expectation_maximisation.h"
#include "motex/motion_texture/features.h"
#include "motex/motion_texture/initial_segments.h"
#include "motion_data.h"

namespace {

using motex::FrameMatrixF;
using motex::Index;

constexpr Index kBlockFrames = 192, kTileRows = 480;  // as in EmissionBank

/// Wall clock, and processor time of all threads: on a machine that others use only the second can be compared.
struct Stopwatch {
  struct Time {
    double wall_secs = 0, cpu_secs = 0;
  };
  static Time now() {
    timespec cpu = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double>(wall).count(),
            static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
  }
  Time start = now();
  Time elapsed() const {
    const Time end = now();
    return {end.wall_secs - start.wall_secs, end.cpu_secs - start.cpu_secs};
  }
};

/// One product of the emissions: all frames of a block times `rows` rows of textons, `width` numbers a frame.
struct Product {
  Index rows, width;
};

/// Those of a block for textons of these state sizes: residuals, and (own basis) what lies outside.
std::vector<Product> products(const std::vector<Index>& sizes, Index inputs, bool is_shared) {
  std::vector<Product> out;
  for (std::size_t first = 0; first < sizes.size();) {
    Index rows = 0, outside = 0;
    std::size_t end = first;
    for (; end < sizes.size() && (end == first || rows + sizes[end] <= kTileRows); ++end) {
      rows += sizes[end];
      outside += sizes[end] + 1;
    }
    out.push_back({rows, 3 * inputs + 1});
    if (!is_shared) out.push_back({outside, inputs + 1});
    first = end;
  }
  return out;
}

/// Multiplies stand-ins of the same sizes, nothing else.
Stopwatch::Time time_products(const motex::Corpus& corpus, const std::vector<Index>& sizes, Index inputs,
                              bool is_shared) {
  const std::vector<Product> all = products(sizes, inputs, is_shared);
  std::vector<Index> blocks;
  for (const motex::Run& run : corpus.runs)
    for (Index t = 2; t < run.length; t += kBlockFrames) blocks.push_back(std::min(kBlockFrames, run.length - t));
  const Index width = 3 * inputs + 1;
  const FrameMatrixF textons = FrameMatrixF::Constant(kTileRows + 64, width, 0.01F);
  const FrameMatrixF frames = FrameMatrixF::Constant(kBlockFrames, width, 0.5F);
  const Stopwatch watch;
  motex::parallel_for(0, static_cast<int>(blocks.size()), [&](int b) {
    const Index count = blocks[static_cast<std::size_t>(b)];
    FrameMatrixF product;
    for (const Product& p : all) {
      product.resize(count, p.rows);
      motex::gemm(false, true, count, p.rows, p.width, 1.0F, frames.data(), width, textons.data(), p.width, 0.0F,
                  product.data(), p.rows);
    }
  });
  return watch.elapsed();
}

using BySegment = std::vector<std::vector<std::pair<Index, Index>>>;

BySegment by_texton(const motex::Segmentation& segments, std::size_t num_textons) {
  BySegment out(num_textons);
  for (const motex::LabelledSegment& s : segments)
    out[static_cast<std::size_t>(s.texton)].emplace_back(s.row, s.length);
  return out;
}

/// State sizes of the textons that the next iteration fits and evaluates.
std::vector<Index> changed_sizes(const motex::ExpectationMaximisation& em, const BySegment& before,
                                 const BySegment& now) {
  std::vector<Index> sizes;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (before[i] != now[i]) sizes.push_back(em.textons()[i].dynamics.state_size());
  return sizes;
}

void print_learning(const char* name, const std::vector<motex::Clip>& clips, const motex::LearnOptions& options) {
  const motex::FeatureSpace space = motex::make_feature_space(clips);
  const auto frames = [&](double secs) { return static_cast<Index>(std::lround(secs / space.frame_time_secs)); };
  const Index min_frames = frames(options.min_duration), max_frames = frames(options.max_duration);
  const motex::Corpus corpus = motex::make_corpus(space, clips, min_frames, false, {});
  Stopwatch watch;
  const motex::TextonFitter fitter(corpus, options);
  const bool is_shared = fitter.is_shared();
  motex::Segmentation start =
      is_shared ? motex::merged_segments(corpus, fitter, 0, min_frames, {})
                : motex::greedy_segments(corpus, fitter, 0.45 * motex::random_pose_distance(corpus, options.seed),
                                         min_frames, max_frames, {});
  std::printf("%s: %ld frames; subspace and first segments %.2f s wall, %.2f s cpu\n", name,
              static_cast<long>(corpus.features.rows()), watch.elapsed().wall_secs, watch.elapsed().cpu_secs);
  std::printf("  iteration   textons evaluated   wall s   of its products   ratio   cpu s   of its products   ratio\n");
  const Index inputs = is_shared ? fitter.shared().basis.cols() : corpus.features.cols();
  motex::ExpectationMaximisation em(corpus, fitter, options, min_frames, max_frames, start);
  const std::size_t num_textons = em.textons().size();
  BySegment fitted_to(num_textons);
  Stopwatch::Time sum, sum_products;
  for (int i = 1; i <= options.max_iterations && !em.converged(); ++i) {
    const BySegment own = by_texton(em.segments(), num_textons);
    watch = {};
    em.iterate({});
    const Stopwatch::Time took = watch.elapsed();
    const std::vector<Index> sizes = changed_sizes(em, fitted_to, own);
    fitted_to = own;
    const Stopwatch::Time alone = time_products(corpus, sizes, inputs, is_shared);
    std::printf("  %9d   %17zu   %6.3f   %15.3f   %5.2f   %5.3f   %15.3f   %5.2f\n", i, sizes.size(), took.wall_secs,
                alone.wall_secs, took.wall_secs / alone.wall_secs, took.cpu_secs, alone.cpu_secs,
                took.cpu_secs / alone.cpu_secs);
    sum = {sum.wall_secs + took.wall_secs, sum.cpu_secs + took.cpu_secs};
    sum_products = {sum_products.wall_secs + alone.wall_secs, sum_products.cpu_secs + alone.cpu_secs};
  }
  std::printf("        all                       %6.3f   %15.3f   %5.2f   %5.3f   %15.3f   %5.2f\n", sum.wall_secs,
              sum_products.wall_secs, sum.wall_secs / sum_products.wall_secs, sum.cpu_secs, sum_products.cpu_secs,
              sum.cpu_secs / sum_products.cpu_secs);
}

void measure(const std::filesystem::path& folder) {
  const motex::bench::Dance dance = motex::bench::all_dances(folder).back();
  std::printf("%s, %s; wanted: an iteration <= 2 x its matrix products\n", dance.name.c_str(), motex::gemm_backend());
  motex::LearnOptions own;
  own.basis = motex::Basis::kOwn;
  print_learning("own basis", dance.clips, own);
  print_learning("shared basis", dance.clips, {});
}

}  // namespace

int main(int argc, char** argv) { return motex::bench::run(argc, argv, measure); }
