// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/window_match.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/gemm.h"
#include "motex/core/parallel.h"

namespace motex {
namespace {

using ArrayD = Eigen::ArrayXd;
using ArrayF = Eigen::ArrayXf;
constexpr double kInf = std::numeric_limits<double>::infinity();
/// Diagonals that one task works on.
constexpr Index kBlock = 1024;
/// Squared distances below this are computed again without cancellation.
constexpr float kNear = 0.02F;

struct Problem {
  FrameMatrixF reference, generated;  // about the reference's mean
  ArrayF reference_norms, generated_norms;
  // Of each reference frame: 0 when the run has so many frames before it that a step back (continues), a local window
  // or a whole window ends there; else infinite.
  ArrayD continues, ends_local, ends_window;
  WindowMatchOptions options;
};

/// What a task keeps of its diagonals d = k − t from one block of `window` rows to the next.
struct Diagonals {
  Index first = 0;
  ArrayD window_sum, local_sum, path;  // of the windows that end here; H
  FrameMatrixF before;                 // window × kBlock: c of the previous block of rows
  // Of the present block of rows:
  ArrayD best_window;            // by reference frame, from first_column
  ArrayD best_local, best_path;  // by row
  Index first_column = 0;
};

Problem make_problem(const FrameMatrixF& reference, std::span<const Index> run_lengths, const FrameMatrixF& generated,
                     const WindowMatchOptions& options) {
  Problem p;
  p.options = options;
  const Eigen::RowVectorXf mean = reference.colwise().mean();
  p.reference = reference.rowwise() - mean;
  p.generated = generated.rowwise() - mean;
  p.reference_norms = p.reference.rowwise().squaredNorm();
  p.generated_norms = p.generated.rowwise().squaredNorm();
  p.continues = p.ends_local = p.ends_window = ArrayD::Constant(reference.rows(), kInf);
  Index first = 0;
  for (const Index length : run_lengths) {
    const auto from = [&](ArrayD& array, Index skip) {
      if (length > skip) array.segment(first + skip, length - skip).setZero();
    };
    from(p.continues, 1);
    from(p.ends_local, options.local_window - 1);
    from(p.ends_window, options.window - 1);
    first += length;
  }
  return p;
}

/// Distances c of rows [row, row + num_rows) to the diagonals, 0 outside the reference; num_rows × kBlock.
FrameMatrixF block_distances(const Problem& p, const Diagonals& diagonals, Index row, Index num_rows) {
  FrameMatrixF distances = FrameMatrixF::Zero(p.options.window, kBlock);
  const Index columns = p.reference.rows(), features = p.reference.cols();
  const Index begin = std::max<Index>(0, diagonals.first + row);
  const Index end = std::min(columns, diagonals.first + kBlock + row + num_rows - 1);
  FrameMatrixF products(num_rows, end - begin);
  gemm(false, true, num_rows, end - begin, features, 1.0F, &p.generated(row, 0), features, &p.reference(begin, 0),
       features, 0.0F, products.data(), end - begin);
  for (Index r = 0; r < num_rows; ++r) {
    const Index shift = diagonals.first + row + r;  // column = diagonal index in the block + shift
    const Index i = std::max<Index>(0, -shift), num = std::min(kBlock, columns - shift) - i;
    if (num <= 0) continue;
    const Index k = i + shift;
    auto out = distances.row(r).segment(i, num).transpose().array();
    out = (p.generated_norms[row + r] + p.reference_norms.segment(k, num) -
           2 * products.row(r).segment(k - begin, num).transpose().array());
    if (out.minCoeff() < kNear)
      for (Index n = 0; n < num; ++n)
        if (out[n] < kNear) out[n] = (p.generated.row(row + r) - p.reference.row(k + n)).squaredNorm();
    out = out.max(0.0F).sqrt();
  }
  return distances;
}

/// Moves the diagonals on by num_rows ≤ window rows. cut_costs: G(row + r − window) by r.
void advance(const Problem& p, Diagonals& diagonals, Index row, Index num_rows, const ArrayD& cut_costs) {
  const Index window = p.options.window, local = p.options.local_window, columns = p.reference.rows();
  diagonals.best_local = diagonals.best_path = ArrayD::Constant(window, kInf);
  diagonals.first_column = diagonals.first + row;
  diagonals.best_window = ArrayD::Constant(kBlock + window, kInf);
  if (diagonals.first + kBlock + row + num_rows - 1 <= 0 || diagonals.first + row >= columns) return;
  FrameMatrixF now = block_distances(p, diagonals, row, num_rows);
  for (Index r = 0; r < num_rows; ++r) {
    const Index shift = diagonals.first + row + r, t = row + r;
    const Index i = std::max<Index>(0, -shift), num = std::min(kBlock, columns - shift) - i;
    if (num <= 0) continue;
    const Index k = i + shift;
    const auto cost = [&](const FrameMatrixF& m, Index at) {
      return m.row(at).segment(i, num).transpose().array().cast<double>();
    };
    auto window_sum = diagonals.window_sum.segment(i, num), local_sum = diagonals.local_sum.segment(i, num);
    auto path = diagonals.path.segment(i, num);
    window_sum += cost(now, r) - cost(diagonals.before, r);
    local_sum += cost(now, r) - (r >= local ? cost(now, r - local) : cost(diagonals.before, r + window - local));
    path = (path + cost(now, r) + p.continues.segment(k, num))
               .min(window_sum + p.ends_window.segment(k, num) + cut_costs[r]);
    diagonals.best_path[r] = path.minCoeff();
    if (t + 1 >= local) diagonals.best_local[r] = (local_sum + p.ends_local.segment(k, num)).minCoeff();
    if (t + 1 >= window) {
      auto best = diagonals.best_window.segment(i + r, num);
      best = best.min(window_sum + p.ends_window.segment(k, num));
    }
  }
  diagonals.before.swap(now);
}

std::vector<Diagonals> make_diagonals(const Problem& p) {
  std::vector<Diagonals> blocks;
  for (Index first = 1 - p.generated.rows(); first < p.reference.rows(); first += kBlock) {
    Diagonals block;
    block.first = first;
    block.window_sum = block.local_sum = ArrayD::Zero(kBlock);
    block.path = ArrayD::Constant(kBlock, kInf);
    block.before = FrameMatrixF::Zero(p.options.window, kBlock);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

void check_sizes(const FrameMatrixF& reference, std::span<const Index> run_lengths, const FrameMatrixF& generated,
                 const WindowMatchOptions& options) {
  if (options.window < 1 || options.local_window < 1 || options.local_window > options.window)
    throw InvalidInput("windows must have at least one frame, and the local window no more than the other");
  if (reference.cols() != generated.cols()) throw InvalidInput("reference and generated frames have different sizes");
  if (std::accumulate(run_lengths.begin(), run_lengths.end(), Index{0}) != reference.rows())
    throw InvalidInput("the runs do not add up to the reference");
  const Index longest = run_lengths.empty() ? 0 : *std::max_element(run_lengths.begin(), run_lengths.end());
  if (longest < options.window || generated.rows() < options.window)
    throw InvalidInput((longest < options.window ? "the reference" : "the generated clip") +
                       std::string(" is too short to compare: it needs at least ") + std::to_string(options.window) +
                       " frames in one piece");
}

}  // namespace

WindowMatchReport match_windows(const FrameMatrixF& reference, std::span<const Index> run_lengths,
                                const FrameMatrixF& generated, const WindowMatchOptions& options,
                                const JobContext& job) {
  check_sizes(reference, run_lengths, generated, options);
  const Problem p = make_problem(reference, run_lengths, generated, options);
  const Index rows = generated.rows(), window = options.window;
  std::vector<Diagonals> blocks = make_diagonals(p);
  ArrayD best_window = ArrayD::Constant(reference.rows(), kInf), cut_costs = ArrayD::Constant(window, kInf);
  double local_sum = 0, cut_cost = 0;
  for (Index row = 0; row < rows; row += window) {
    job.check_cancelled();
    job.progress("comparing windows", static_cast<double>(row) / static_cast<double>(rows));
    const Index num_rows = std::min(window, rows - row);
    // G(row + r − window): none before the first frame but G(−1) = 0.
    if (row == 0) cut_costs[window - 1] = 0;
    parallel_for(job.jobs, static_cast<int>(blocks.size()),
                 [&](int b) { advance(p, blocks[static_cast<std::size_t>(b)], row, num_rows, cut_costs); });
    ArrayD best_path = ArrayD::Constant(window, kInf), best_local = best_path;
    for (const Diagonals& block : blocks) {
      best_path = best_path.min(block.best_path);
      best_local = best_local.min(block.best_local);
      const Index begin = std::max<Index>(0, block.first_column);
      const Index num = std::min(reference.rows(), block.first_column + kBlock + window) - begin;
      if (num <= 0) continue;
      auto best = best_window.segment(begin, num);
      best = best.min(block.best_window.segment(begin - block.first_column, num));
    }
    for (Index r = 0; r < num_rows; ++r)
      if (row + r + 1 >= options.local_window) local_sum += best_local[r];
    cut_cost = best_path[num_rows - 1];
    cut_costs = best_path;
  }
  WindowMatchReport report;
  report.num_reference_windows = (p.ends_window == 0).count();
  const double limit = options.threshold * static_cast<double>(window);
  report.coverage = static_cast<double>((p.ends_window == 0 && best_window < limit).count()) /
                    static_cast<double>(report.num_reference_windows);
  report.global_diversity = cut_cost / static_cast<double>(rows);
  report.local_diversity = local_sum / static_cast<double>(options.local_window * (rows - options.local_window + 1));
  return report;
}

}  // namespace motex
