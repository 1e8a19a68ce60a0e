// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/script.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

MotifSet alphabet() {
  MotifSet set;
  for (const auto& [letter, name] : {std::pair{"A", "high kick"}, {"B", "bow"}, {"C", ""}, {"D", "kick 2"}}) {
    Motif& motif = set.motifs.emplace_back();
    motif.letter = letter, motif.name = name;
  }
  set.idle.push_back({0, 10});
  return set;
}

std::string message_of(const std::string& script, const MotifSet& set) {
  try {
    parse_script(script, set);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Script, NamesLettersTimesAndSeconds) {
  const std::vector<Direction> script =
      parse_script("stand, High Kick ×2, B x3,C*4 , stand 3s, * 10s, any, kick 2", alphabet());
  ASSERT_EQ(script.size(), 8U);
  using Kind = Direction::Kind;
  EXPECT_EQ(script[0].kind, Kind::kIdle);
  EXPECT_EQ(script[0].secs, 0);
  EXPECT_EQ(script[1].motif, 0);
  EXPECT_EQ(script[1].times, 2);
  EXPECT_EQ(script[2].motif, 1);
  EXPECT_EQ(script[2].times, 3);
  EXPECT_EQ(script[3].motif, 2);
  EXPECT_EQ(script[3].times, 4);
  EXPECT_EQ(script[4].secs, 3);
  EXPECT_EQ(script[5].kind, Kind::kAny);
  EXPECT_EQ(script[5].secs, 10);
  EXPECT_EQ(script[6].kind, Kind::kAny);
  EXPECT_EQ(script[6].times, 1);
  EXPECT_EQ(script[7].motif, 3) << "a name that ends in a number";
}

TEST(Script, LettersWithoutCommas) {
  const std::vector<Direction> script = parse_script("A bow C", alphabet());
  ASSERT_EQ(script.size(), 3U);
  EXPECT_EQ(script[1].motif, 1);
}

TEST(Script, UnknownNameListsTheAlphabetAndTheNearest) {
  const std::string message = message_of("stand, hihg kick", alphabet());
  EXPECT_NE(message.find("'hihg kick' is no motif"), std::string::npos) << message;
  EXPECT_NE(message.find("A (high kick), B (bow), C, D (kick 2), stand"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'high kick'?"), std::string::npos) << message;
  EXPECT_EQ(message_of("zzzzzzzzzzzz", alphabet()).find("did you mean"), std::string::npos);
  EXPECT_EQ(motif_named("b", alphabet()), 1);
  EXPECT_THROW(motif_named("E", alphabet()), InvalidInput);
}

TEST(Script, RefusesNonsense) {
  for (const char* script : {"", " , ,", "A x0", "bow ×99999999999", "stand 0s", "stand 1.2.3s", "×2", "bow 3 s s"})
    EXPECT_NE(message_of(script, alphabet()), "") << script;
  MotifSet restless = alphabet();
  restless.idle.clear();
  EXPECT_NE(message_of("stand", restless).find("stands still"), std::string::npos);
}

}  // namespace
}  // namespace motex
