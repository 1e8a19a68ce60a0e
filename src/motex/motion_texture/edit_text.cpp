// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <sstream>

#include "motex/core/error.h"
#include "motex/motion_texture/model_edits.h"

namespace motex {
namespace {

using Kind = ModelEdit::Kind;
constexpr const char* kVerbs[] = {"name", "drop", "keep", "merge", "weight"};
constexpr std::size_t kLongestName = 60;
constexpr double kMostFactor = 1e6;

/// What can stand in lists, on lines and for a number is no name.
void check_name(const std::string& name) {
  if (name.empty()) return;
  const auto bad = [](unsigned char c) { return c < ' ' || c == ',' || c == 127; };
  const bool begins_well = !std::isspace(static_cast<unsigned char>(name[0])) && name[0] != '-' &&
                           !(name[0] >= '0' && name[0] <= '9') && name.back() != ' ';
  if (!begins_well || name == "any" || name.size() > kLongestName || std::any_of(name.begin(), name.end(), bad))
    throw InvalidInput("'" + name + "' cannot be a texton's name: it begins with a letter, has no comma, and at most " +
                       std::to_string(kLongestName) + " characters");
}

void check_edit(const ModelEdit& edit) {
  const auto verb = std::string(kVerbs[static_cast<std::size_t>(edit.kind)]);
  const std::size_t count = edit.textons.size();
  const bool is_weight = edit.kind == Kind::kWeight;
  const std::size_t least = edit.kind == Kind::kMerge || is_weight ? 2 : 1;
  if (count < least || (is_weight && count > 2) || (edit.kind == Kind::kName && count > 1))
    throw InvalidInput("the edit '" + verb + "' does not go with " + std::to_string(count) + " textons");
  for (std::size_t i = 0; i < count; ++i)
    if (edit.textons[i] < (is_weight && i == 0 ? -1 : 0)) throw InvalidInput("a texton's number is not below 0");
  if (!(edit.factor >= 0 && edit.factor <= kMostFactor))
    throw InvalidInput("the factor of a transition is outside 0 … 1e6");
  check_name(edit.name);
}

}  // namespace

std::string edit_text(const ModelEdit& edit) {
  std::ostringstream out;
  out.precision(17);
  out << kVerbs[static_cast<std::size_t>(edit.kind)];
  for (const int texton : edit.textons)
    if (texton < 0)
      out << " any";
    else
      out << ' ' << texton;
  if (edit.kind == Kind::kWeight) out << ' ' << edit.factor;
  if (edit.kind == Kind::kName && !edit.name.empty()) out << ' ' << edit.name;
  return out.str();
}

ModelEdit parse_edit(const std::string& line) {
  std::istringstream in(line);
  std::string verb, word;
  in >> verb;
  const auto found = std::find(std::begin(kVerbs), std::end(kVerbs), verb);
  if (found == std::end(kVerbs)) throw InvalidInput("there is no edit '" + verb + "'");
  ModelEdit edit;
  edit.kind = static_cast<Kind>(found - std::begin(kVerbs));
  const std::size_t most = edit.kind == Kind::kName ? 1 : edit.kind == Kind::kWeight ? 2 : line.size();
  while (edit.textons.size() < most && in >> word) {
    std::istringstream number(word);
    int texton = -1;
    if (word != "any" && (!(number >> texton) || !number.eof() || texton < 0))
      throw InvalidInput("'" + word + "' is no texton's number");
    edit.textons.push_back(texton);
  }
  if (edit.kind == Kind::kWeight && !(in >> edit.factor)) throw InvalidInput("an edit 'weight' lacks its factor");
  if (edit.kind == Kind::kName && in.get() == ' ') std::getline(in, edit.name);
  check_edit(edit);
  return edit;
}

}  // namespace motex
