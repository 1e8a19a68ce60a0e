// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <numeric>

#include "motex/core/error.h"
#include "motex/core/lowered.h"

namespace motex {
namespace {

constexpr std::array<const char*, 4> kIdleWords{"idle", "stand", "rest", "pause"};
constexpr int kMaxTimes = 10000;
constexpr double kMaxSecs = 1e5;

std::string trimmed_text(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

std::vector<std::string> split(std::string_view text, const char* separators) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find_first_of(separators);
    parts.push_back(trimmed_text(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

int find_motif(std::string_view word, const MotifSet& alphabet) {
  const std::string wanted = lowered(trimmed_text(word));
  const auto& motifs = alphabet.motifs;
  for (const bool by_name : {true, false})
    for (std::size_t k = 0; k < motifs.size(); ++k) {
      const std::string& own = by_name ? motifs[k].name : motifs[k].letter;
      if (!own.empty() && lowered(own) == wanted) return static_cast<int>(k);
    }
  return -1;
}

bool is_idle_word(const std::string& word) {
  return std::any_of(kIdleWords.begin(), kIdleWords.end(), [&](const char* idle) { return lowered(word) == idle; });
}

/// Letters to insert, delete or replace.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

[[noreturn]] void fail_unknown(const std::string& word, const MotifSet& alphabet) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(word.size() / 2, 1) + 1;
  const auto consider = [&](const std::string& name) {
    if (name.empty()) return;
    const std::size_t errors = edit_distance(lowered(word), lowered(name));
    if (errors < fewest) fewest = errors, nearest = name;
  };
  for (const Motif& motif : alphabet.motifs) consider(motif.name), consider(motif.letter);
  if (!alphabet.idle.empty()) consider("stand");
  throw InvalidInput("'" + word + "' is no motif; there are " + alphabet_text(alphabet) +
                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

/// Takes "×2", "x2", "*2" or "3s" off the end of a word.
class Suffix {
 public:
  static void take(std::string& word, Direction& direction) {
    while (take_times(word, direction) || take_secs(word, direction)) word = trimmed_text(word);
  }

 private:
  static std::size_t digits_at_end(const std::string& word, bool decimal) {
    std::size_t begin = word.size();
    const auto is_digit = [&](char c) { return (c >= '0' && c <= '9') || (decimal && c == '.'); };
    while (begin > 0 && is_digit(word[begin - 1])) --begin;
    return begin;
  }

  static bool take_times(std::string& word, Direction& direction) {
    const std::size_t begin = digits_at_end(word, false);
    if (begin == word.size() || begin == 0) return false;
    std::string before = trimmed_text(word.substr(0, begin));
    const bool letter_x = before.ends_with('x') || before.ends_with('X');
    if (before.ends_with("×"))
      before.resize(before.size() - std::string_view("×").size());
    else if (before.ends_with('*') || (letter_x && (before.size() == 1 || before[before.size() - 2] == ' ')))
      before.pop_back();
    else
      return false;
    if (trimmed_text(before).empty()) return false;  // nothing is left that could be repeated
    const auto [end, code] = std::from_chars(word.data() + begin, word.data() + word.size(), direction.times);
    if (code != std::errc() || direction.times < 1 || direction.times > kMaxTimes)
      throw InvalidInput("'" + word + "': an action can be asked for 1 to " + std::to_string(kMaxTimes) + " times");
    word = before;
    return true;
  }

  static bool take_secs(std::string& word, Direction& direction) {
    if (!word.ends_with('s')) return false;
    const std::string number = trimmed_text(word.substr(0, word.size() - 1));
    const std::size_t begin = digits_at_end(number, true);
    if (begin == number.size() || begin == 0 || number[begin - 1] != ' ') return false;
    double secs = 0;
    const auto [end, code] = std::from_chars(number.data() + begin, number.data() + number.size(), secs);
    if (code != std::errc() || end != number.data() + number.size() || !(secs > 0 && secs <= kMaxSecs))
      throw InvalidInput("'" + word + "': a duration is a number of seconds above 0");
    direction.secs = secs;
    word = number.substr(0, begin);
    return true;
  }
};

/// "A B A": several letters or names of one word without commas.
bool is_list_of_motifs(const std::string& word, const MotifSet& alphabet) {
  const std::vector<std::string> parts = split(word, " \t");
  return parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
           return part.empty() || find_motif(part, alphabet) >= 0;
         });
}

Direction parse_direction(std::string word, const MotifSet& alphabet) {
  Direction direction;
  direction.motif = find_motif(word, alphabet);
  if (direction.motif >= 0) return direction;
  Suffix::take(word, direction);
  direction.motif = find_motif(word, alphabet);
  if (direction.motif >= 0) return direction;
  if (word == "*" || lowered(word) == "any")
    direction.kind = Direction::Kind::kAny;
  else if (is_idle_word(word) && !alphabet.idle.empty())
    direction.kind = Direction::Kind::kIdle;
  else if (is_idle_word(word))
    throw InvalidInput("'" + word + "': the footage has no stretch where the actor stands still; there are " +
                       alphabet_text(alphabet));
  else
    fail_unknown(word, alphabet);
  return direction;
}

}  // namespace

std::vector<Direction> parse_script(std::string_view script, const MotifSet& alphabet) {
  std::vector<Direction> directions;
  for (const std::string& word : split(script, ",;\n")) {
    if (word.empty()) continue;
    if (find_motif(word, alphabet) < 0 && is_list_of_motifs(word, alphabet)) {
      for (const std::string& part : split(word, " \t"))
        if (!part.empty()) directions.push_back(parse_direction(part, alphabet));
    } else {
      directions.push_back(parse_direction(word, alphabet));
    }
  }
  if (directions.empty()) throw InvalidInput("the script is empty; there are " + alphabet_text(alphabet));
  return directions;
}

int motif_named(std::string_view name, const MotifSet& alphabet) {
  const int motif = find_motif(name, alphabet);
  if (motif < 0) fail_unknown(std::string(name), alphabet);
  return motif;
}

std::string alphabet_text(const MotifSet& alphabet) {
  std::string text;
  for (const Motif& motif : alphabet.motifs) {
    text += (text.empty() ? "" : ", ") + motif.letter;
    if (!motif.name.empty()) text += " (" + motif.name + ")";
  }
  if (!alphabet.idle.empty()) text += std::string(text.empty() ? "" : ", ") + "stand";
  return text.empty() ? "no motifs at all" : text;
}

}  // namespace motex
