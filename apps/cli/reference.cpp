// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "reference.h"

#include <algorithm>
#include <sstream>

#include "help.h"

namespace motex::cli {
namespace {

/// In a cell of a table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    if (c == '<') {
      out += "&lt;";
      continue;
    }
    out += c;
  }
  return out;
}

std::string names_of(const Argument& argument) {
  const std::string value = argument.placeholder.empty() ? "" : " " + argument.placeholder;
  if (argument.flag.empty()) return "`" + cell(argument.placeholder) + "`";
  std::string text = argument.short_flag.empty() ? "" : "`" + argument.short_flag + "`, ";
  text += "`" + argument.flag + cell(value) + "`";
  if (!argument.negation.empty()) text += ", `" + argument.negation + "`";
  return text;
}

std::string table_of(const std::vector<Argument>& arguments) {
  std::string text, section = "\n";
  for (const Argument& argument : arguments) {
    if (argument.section != section) {
      section = argument.section;
      text += "\n" + (section.empty() ? std::string() : "*" + section + "*\n\n") +
              "| argument | meaning |\n| --- | --- |\n";
    }
    text += "| " + names_of(argument) + " | " + (argument.required ? "(required) " : "") + cell(argument.help) + " |\n";
  }
  return text;
}

std::string as_sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text + ".";
}

std::string chapter(const Command& command, const std::vector<Argument>& own) {
  std::string text = "\n## motex " + command.name + "\n\n" + as_sentence(command.summary) +
                     (command.details.empty() ? "" : " " + command.details) + "\n" + table_of(own) + "\n```\n";
  std::istringstream examples(command.examples);
  for (std::string line; std::getline(examples, line);) text += line + "\n";
  return text + "```\n";
}

}  // namespace

std::string reference_markdown(const CommandTable& table) {
  std::string text =
      "# Commands and their options\n\n"
      "Made by `motex help --reference` from what the commands declare; do not edit. The same fields, with `_` for "
      "`-`, are\n"
      "the members of the options structs in C++ and the keys of `--json`.\n";
  std::string chapters;
  std::vector<Argument> common;
  for (const Command& command : table) {
    CommonFlags flags;
    const Arguments arguments = arguments_of(command, flags);
    std::vector<Argument> own;
    common.clear();
    for (const Argument& argument : arguments.all()) (argument.section == "Common" ? common : own).push_back(argument);
    chapters += chapter(command, own);
  }
  // A seed of its own stands in a command's table; the common one draws nothing.
  common.erase(std::remove_if(common.begin(), common.end(), [](const Argument& a) { return a.flag == "--seed"; }),
               common.end());
  for (Argument& argument : common) argument.section.clear();
  return text + "\n## Every command\n\nEvery command takes these, and `--seed N` even where nothing is random.\n" +
         table_of(common) + chapters;
}

}  // namespace motex::cli
