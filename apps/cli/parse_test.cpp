// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "parse.h"

#include <gtest/gtest.h>

#include "closest.h"
#include "motex/core/error.h"
#include "warnings.h"

namespace motex::cli {
namespace {

enum class Colour { kRed, kGreen };

struct PaintOptions {
  double thickness = 0;
  int num_coats = 2;
  bool dry_between = true;
  bool glossy = false;
  Colour colour = Colour::kRed;
  std::uint64_t seed = 1;
  std::string brush;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"thickness", "mm", "of the layer"}, self.thickness, Range{0.1, 9, true});
    visit(Field{"num_coats", "", "how many"}, self.num_coats, Range{1, 5});
    visit(Field{"dry_between", "", "wait"}, self.dry_between, Range{});
    visit(Field{"glossy", "", "shine"}, self.glossy, Range{});
    visit(Field{"colour", "", "of the paint"}, self.colour, Choices{{"red", "green"}});
    visit(Field{"seed", "", "random seed"}, self.seed, Range{0, 1.8e19});
    visit(Field{"brush", "", "name"}, self.brush, Range{});
  }
};

struct Call {
  PaintOptions options;
  std::string model;
  std::vector<std::string> walls, outputs;
  Arguments arguments;
  Call() {
    arguments.positional("MODEL", "", model);
    arguments.positional("WALL...", "", walls);
    arguments.value("-o,--output", "FILE", "", outputs).required = true;
    arguments.options(options);
  }
};

/// What parsing these words complains about; "" when it does not.
std::string complaint(const std::vector<std::string>& words) {
  Call call;
  try {
    parse(words, call.arguments);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Parse, ComplainsAboutUnknownFlagsFirst) {
  EXPECT_EQ(complaint({"--glosy"}), "unknown flag --glosy; did you mean '--glossy'?");
  EXPECT_EQ(complaint({"a", "--no-such-thing", "b"}), "unknown flag --no-such-thing");
}

TEST(Parse, NamesWhatIsMissing) {
  EXPECT_EQ(complaint({}), "MODEL, WALL... and -o FILE missing; see --help");
  EXPECT_EQ(complaint({"m", "w"}), "-o FILE missing; see --help");
}

TEST(Parse, NamesValuesThatDoNotFit) {
  const auto with = [](const std::string& flag, const std::string& value) {
    return complaint({"m", "w", "-o", "f", flag, value});
  };
  EXPECT_EQ(with("--thickness", "3x"), "--thickness: '3x' is not a number");
  EXPECT_EQ(with("--thickness", "nan"), "--thickness: 'nan' is not a number");
  EXPECT_EQ(with("--thickness", "0"), "--thickness: 0 is outside 0.1 … 9 mm (or auto)");
  EXPECT_EQ(with("--thickness", "-1"), "--thickness: -1 is outside 0.1 … 9 mm (or auto)");
  EXPECT_EQ(with("--num-coats", "1.5"), "--num-coats: '1.5' is not a whole number");
  EXPECT_EQ(with("--num-coats", "9"), "--num-coats: 9 is outside 1 … 5");
  EXPECT_EQ(with("--num-coats", "auto"), "--num-coats: 'auto' is not a whole number");
  EXPECT_EQ(with("--colour", "gren"), "--colour: 'gren' is none of red and green; did you mean 'green'?");
  EXPECT_EQ(with("--seed", "-1"), "--seed: '-1' is not a whole number");
}

TEST(Parse, FillsFieldsAndLists) {
  Call call;
  parse({"m", "w1", "w2", "-o", "f1", "--thickness", "2.5", "--output=f2", "--no-dry-between", "--glossy", "--colour",
         "green", "--seed", "18000000000000000000", "--num-coats", "3", "--num-coats", "4", "w3"},
        call.arguments);
  EXPECT_EQ(call.model, "m");
  EXPECT_EQ(call.walls, (std::vector<std::string>{"w1", "w2", "w3"}));
  EXPECT_EQ(call.outputs, (std::vector<std::string>{"f1", "f2"}));
  EXPECT_EQ(call.options.thickness, 2.5);
  EXPECT_EQ(call.options.num_coats, 4);
  EXPECT_FALSE(call.options.dry_between);
  EXPECT_TRUE(call.options.glossy);
  EXPECT_EQ(call.options.colour, Colour::kGreen);
  EXPECT_EQ(call.options.seed, 18000000000000000000U);
}

TEST(Parse, AutoIsZero) {
  Call call;
  call.options.thickness = 3;
  parse({"m", "w", "-o", "f", "--thickness", "auto", "--no-glossy", "--dry-between"}, call.arguments);
  EXPECT_EQ(call.options.thickness, 0);
  EXPECT_TRUE(call.options.dry_between);
  EXPECT_FALSE(call.options.glossy);
}

TEST(SplitAtCommas, KeepsEmptyWords) {
  EXPECT_TRUE(split_at_commas("").empty());
  EXPECT_EQ(split_at_commas("3,17"), (std::vector<std::string>{"3", "17"}));
  EXPECT_EQ(split_at_commas("3,,"), (std::vector<std::string>{"3", "", ""}));
}

TEST(DidYouMean, FindsTypingErrorsAndBeginnings) {
  const std::vector<std::string> verbs{"learn", "info", "segment", "score"};
  EXPECT_EQ(did_you_mean("laern", verbs), "; did you mean 'learn'?");
  EXPECT_EQ(did_you_mean("seg", verbs), "; did you mean 'segment'?");
  EXPECT_EQ(did_you_mean("paint", verbs), "");
}

TEST(FoldWarnings, AlikeOnesBecomeOne) {
  EXPECT_EQ(fold_warnings({"a.bvh: 3 frames jump", "b.bvh: 12 frames jump", "no unit"}, 8),
            (std::vector<std::string>{"a.bvh: 3 frames jump (and 1 more like it)", "no unit"}));
  EXPECT_EQ(fold_warnings({"one", "two", "three"}, 1), (std::vector<std::string>{"one (and 2 other warnings)"}));
  EXPECT_TRUE(fold_warnings({}, 1).empty());
}

}  // namespace
}  // namespace motex::cli
