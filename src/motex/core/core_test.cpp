// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/core/gemm.h"
#include "motex/core/job.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/core/rng.h"
#include "motex/core/trimmed.h"
#include "motex/core/xml_escape.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

TEST(Rng, IsTheSameEverywhere) {
  Rng rng(1);
  EXPECT_EQ(rng.next_u64(), 12966619160104079557ULL);  // xoshiro256** seeded by splitmix64(1)
  EXPECT_EQ(rng.next_u64(), 9600361134598540522ULL);
}

TEST(Rng, NormalHasUnitMoments) {
  Rng rng(7);
  const int n = 200000;
  double sum = 0, squares = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal();
    sum += x, squares += x * x, fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.01);
  EXPECT_NEAR(squares / n, 1, 0.02);
  EXPECT_NEAR(fourth / n, 3, 0.1);
}

TEST(Rng, WeightedFollowsWeightsAndRefusesNonsense) {
  Rng rng(3);
  const double weights[] = {1, 0, 3};
  int counts[3] = {};
  for (int i = 0; i < 40000; ++i) ++counts[rng.weighted(weights)];
  EXPECT_EQ(counts[1], 0);
  EXPECT_NEAR(counts[2] / 40000.0, 0.75, 0.01);
  const double none[] = {0, 0}, bad[] = {1, NAN};
  EXPECT_THROW(rng.weighted(none), InvalidInput);
  EXPECT_THROW(rng.weighted(bad), InvalidInput);
}

TEST(Parallel, DoesEveryTaskOnceAndPassesExceptionsOn) {
  std::vector<int> done(1000, 0);
  parallel_for(2, 1000, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 1000);
  EXPECT_THROW(parallel_for(2, 100,
                            [](int i) {
                              if (i == 50) throw NumericalFailure("x");
                            }),
               NumericalFailure);
}

TEST(Gemm, AgreesWithEigenForEveryTranspose) {
  const FrameMatrix a = FrameMatrix::Random(5, 7), b = FrameMatrix::Random(7, 3);
  const FrameMatrix at = a.transpose(), bt = b.transpose();
  FrameMatrix c = FrameMatrix::Ones(5, 3);
  gemm(false, false, 5, 3, 7, 2.0, a.data(), 7, b.data(), 3, 1.0, c.data(), 3);
  EXPECT_TRUE(c.isApprox(2 * a * b + FrameMatrix::Ones(5, 3), 1e-12));
  gemm(true, true, 5, 3, 7, 1.0, at.data(), 5, bt.data(), 7, 0.0, c.data(), 3);
  EXPECT_TRUE(c.isApprox(a * b, 1e-12));
}

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("motex_core_test_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  fs::path dir_;
};

TEST_F(Folder, AtomicFileKeepsTheOldFileUntilCommit) {
  const fs::path path = dir_ / "a.txt";
  write_file(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
  }
  EXPECT_EQ(read_file(path), "old");
  write_file(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_), fs::directory_iterator()), 1);
}

TEST_F(Folder, WritingSaysWhy) {
  EXPECT_THROW(AtomicFile(dir_ / "no_such_folder" / "a"), InvalidInput);
  EXPECT_THROW(AtomicFile{dir_}, InvalidInput);
  EXPECT_THROW(write_file("/dev/full", std::string(100000, 'x')), WriteError);
  EXPECT_THROW(read_file(dir_ / "missing"), InvalidInput);
}

struct ToyOptions {
  double length = 2;
  int size = 0;
  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"length", "cm", "a length"}, self.length, Range{0.5, 10});
    visit(Field{"size", "", "a size"}, self.size, Range{4, 8, true});
  }
};

TEST(Options, RangesAreChecked) {
  ToyOptions options;
  EXPECT_NO_THROW(check_options(options));
  options.size = 3;
  EXPECT_THROW(check_options(options), InvalidInput);
  options.size = 4;
  options.length = NAN;
  EXPECT_THROW(check_options(options), InvalidInput);
}

std::string toy_archive() {
  ArchiveWriter writer("toy", 3);
  writer.add("names", "a\nb");
  writer.add("values", FrameMatrix(FrameMatrix::Constant(2, 3, 1.5)));
  writer.add("floats", FrameMatrixF(FrameMatrixF::Constant(1, 2, 2.5F)));
  const std::int64_t ints[] = {1, -2};
  writer.add("ints", ints);
  return writer.bytes();
}

TEST(Archive, RoundTrip) {
  const ArchiveReader reader(toy_archive(), "toy.motex", "toy", 3);
  EXPECT_EQ(reader.version(), 3U);
  EXPECT_EQ(reader.text("names"), "a\nb");
  EXPECT_EQ(reader.matrix("values", 2, 3)(1, 2), 1.5);
  EXPECT_EQ(reader.matrix_f("floats")(0, 1), 2.5F);
  EXPECT_EQ(reader.ints("ints", 2)[1], -2);
  EXPECT_THROW(reader.matrix("values", 3, 3), InvalidInput);
  EXPECT_THROW(reader.matrix("ints"), InvalidInput);
  EXPECT_THROW(reader.text("missing"), InvalidInput);
}

TEST(Archive, EveryTruncationAndEveryFlippedByteIsRefused) {
  const std::string good = toy_archive();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THROW(ArchiveReader(good.substr(0, size), "x", "toy", 3), InvalidInput) << size;
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    EXPECT_THROW(ArchiveReader(bad, "x", "toy", 3), InvalidInput) << i;
  }
  EXPECT_THROW(ArchiveReader(good, "x", "other", 3), UnsupportedFile);
  EXPECT_THROW(ArchiveReader(good, "x", "toy", 2), UnsupportedFile);
}

TEST(Quantile, IsLinearBetweenRanks) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_THROW(quantile({}, 0.5), InvalidInput);
}

TEST(Quantile, MedianOfTwoIsTheUpperOne) {
  EXPECT_DOUBLE_EQ(median({5, 1, 3}), 3);
  EXPECT_DOUBLE_EQ(median({4, 1, 3, 2}), 3);
  EXPECT_DOUBLE_EQ(median({}), 0);
}

TEST(Text, IsTrimmedAndEscaped) {
  EXPECT_EQ(trimmed(" \ta b\r"), "a b");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed("\" a \"", " \""), "a");
  EXPECT_EQ(xml_escaped("a<b>&\"c\"\n"), "a&lt;b&gt;&amp;&quot;c&quot;\xef\xbf\xbd");
}

TEST(Job, PartTellsItsShareOfTheWhole) {
  std::vector<double> told;
  JobContext job;
  job.on_progress = [&](std::string_view, double fraction) { told.push_back(fraction); };
  const JobContext part = job.part(0.2, 0.6).part(0.5, 1);
  part.progress("x", 0);
  part.progress("x", 1);
  part.progress("x", 2);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_NEAR(told[0], 0.4, 1e-12);
  EXPECT_NEAR(told[1], 0.6, 1e-12);
  EXPECT_NEAR(told[2], 0.6, 1e-12);
  JobContext{}.part(0, 1).progress("x", 0.5);
}

}  // namespace
}  // namespace motex
