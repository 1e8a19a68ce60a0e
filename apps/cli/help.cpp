// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "help.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "motex/core/error.h"

namespace motex::cli {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kHelpColumn = 30;

/// Columns that UTF-8 text takes.
std::size_t num_columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Words broken into lines that end before kWidth; lines after the first begin at column `indent`.
std::string wrapped(const std::string& text, std::size_t column, std::size_t indent) {
  std::istringstream words(text);
  std::string out, word;
  bool first = true;
  while (words >> word) {
    if (!first && column + 1 + num_columns(word) > kWidth) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
      first = true;
    }
    if (!first) out += ' ', ++column;
    out += word;
    column += num_columns(word);
    first = false;
  }
  return out + "\n";
}

std::string in_two_columns(const std::string& left, const std::string& right) {
  const std::size_t used = num_columns(left);
  if (used + 2 <= kHelpColumn)
    return left + std::string(kHelpColumn - used, ' ') + wrapped(right, kHelpColumn, kHelpColumn);
  return left + "\n" + std::string(kHelpColumn, ' ') + wrapped(right, kHelpColumn, kHelpColumn);
}

std::string left_column(const Argument& argument) {
  if (argument.flag.empty()) return "  " + argument.placeholder;
  std::string text = argument.short_flag.empty() ? "  " : "  " + argument.short_flag + ", ";
  text += argument.flag;
  if (!argument.negation.empty()) text += ", " + argument.negation;
  if (!argument.placeholder.empty()) text += " " + argument.placeholder;
  return text;
}

std::string usage(const Command& command, const Arguments& arguments) {
  std::string text = "usage: motex " + command.name;
  for (const Argument& argument : arguments.all()) {
    if (!argument.required) continue;
    const std::string& flag = argument.short_flag.empty() ? argument.flag : argument.short_flag;
    text += flag.empty() ? " " + argument.placeholder : " " + flag + " " + argument.placeholder;
  }
  return text + " [options]\n";
}

std::string as_sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text + ".";
}

std::string noun_of(const std::string& name) { return name.substr(0, name.find(' ')); }

/// Every beginning of commands' names, and the words that can come next.
std::map<std::string, std::string> groups_of(const CommandTable& table) {
  std::map<std::string, std::string> groups;
  for (const Command& command : table)
    for (std::size_t at = command.name.find(' '); at != std::string::npos; at = command.name.find(' ', at + 1)) {
      const std::string verb = command.name.substr(at + 1, command.name.find(' ', at + 1) - at - 1);
      std::string& verbs = groups[command.name.substr(0, at)];
      if ((" " + verbs + " ").find(" " + verb + " ") == std::string::npos) verbs += (verbs.empty() ? "" : " ") + verb;
    }
  return groups;
}

/// Name as a shell variable's part of a case pattern.
std::string completion_case(const Command& command) {
  CommonFlags flags;
  const Arguments arguments = arguments_of(command, flags);
  std::string words = "--help", choices;
  for (const Argument& argument : arguments.all()) {
    if (!argument.flag.empty()) words += " " + argument.flag;
    if (!argument.negation.empty()) words += " " + argument.negation;
    if (argument.choices.empty()) continue;
    choices += "        " + argument.flag + ") values='";
    for (const std::string& choice : argument.choices) choices += choice + " ";
    choices.back() = '\'';
    choices += " ;;\n";
  }
  std::string text = "    '" + command.name + "'*)\n      flags='" + words + "'\n";
  if (!choices.empty()) text += "      case $prev in\n" + choices + "      esac\n";
  return text + "      ;;\n";
}

}  // namespace

Arguments arguments_of(const Command& command, CommonFlags& flags) {
  Arguments arguments;
  command.declare(arguments);
  arguments.section("Common");
  static std::uint64_t unused_seed = 0;
  if (!arguments.has("--seed"))
    arguments.value("--seed", "N", "taken by every command; this one draws nothing at random", unused_seed);
  arguments.toggle("--json", "print the result as one JSON object on stdout", flags.json);
  arguments.toggle("-f,--force", "replace files that exist", flags.force);
  arguments.toggle("--dry-run", "check everything, say what would be done, write nothing", flags.dry_run);
  arguments.value("-j,--jobs", "N", "threads (default: all cores); results do not depend on it", flags.jobs).set =
      [&flags](const std::string& text) {
        parse_value("--jobs", text, flags.jobs);
        if (flags.jobs < 1 || flags.jobs > 1024) throw InvalidInput("--jobs: " + text + " is outside 1 … 1024");
      };
  arguments.toggle("-q,--quiet", "say nothing but errors", flags.quiet);
  return arguments;
}

std::string help_page(const Command& command, const Arguments& arguments) {
  std::string text =
      usage(command, arguments) + "\n" + wrapped(as_sentence(command.summary) + " " + command.details, 0, 0);
  std::string section = "\n";
  for (const Argument& argument : arguments.all()) {
    if (argument.section != section) {
      section = argument.section;
      text += "\n" + (section.empty() ? std::string() : section + "\n");
    }
    text += in_two_columns(left_column(argument), argument.help);
  }
  text += "\nExamples\n";
  std::istringstream examples(command.examples);
  for (std::string line; std::getline(examples, line);) text += "  " + line + "\n";
  return text;
}

std::string help_overview(const CommandTable& table, const std::string& noun) {
  std::string text = "usage: motex " + (noun.empty() ? "COMMAND" : noun + " COMMAND") + " [arguments]\n\n";
  if (noun.empty()) text += "motex learns how something moves from examples and makes endless more of it.\n\n";
  for (const Command& command : table)
    if (noun.empty() || command.name.starts_with(noun + " "))
      text += in_two_columns("  " + command.name, command.summary);
  if (noun.empty()) text += in_two_columns("  completion bash", "a script for bash that completes commands and flags");
  const std::string prefix = noun.empty() ? "" : noun + " ";
  text += "\nmotex " + prefix + "COMMAND --help shows arguments and examples; motex --version the version.\n";
  if (noun.empty())
    text +=
        "\nExample\n  motex motion learn dance/*.bvh -o dance.motex\n"
        "  motex motion synthesize dance.motex -o new.bvh --secs 60\n";
  return text;
}

std::string bash_completion(const CommandTable& table) {
  std::string nouns, cases;
  std::vector<std::string> seen;
  for (const Command& command : table) {
    const std::string noun = noun_of(command.name);
    if (std::find(seen.begin(), seen.end(), noun) != seen.end()) continue;
    seen.push_back(noun);
    nouns += noun + " ";
  }
  for (const auto& [group, verbs] : groups_of(table)) cases += "    '" + group + "') verbs='" + verbs + "' ;;\n";
  std::string text =
      "# bash completion of motex: source <(motex completion bash)\n_motex() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verbs= flags= values=\n"
      "  local before=\"${COMP_WORDS[*]:1:COMP_CWORD-1}\"\n"
      "  case $before in\n" +
      cases +
      "  esac\n"
      "  if [[ $COMP_CWORD == 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W '" +
      nouns +
      "completion --help --version' -- \"$current\"))\n"
      "    return\n  elif [[ -n $verbs ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$verbs --help\" -- \"$current\"))\n    return\n  fi\n"
      "  case \"$before \" in\n";
  for (const Command& command : table) text += completion_case(command);
  return text +
         "    'completion '*) values=bash ;;\n  esac\n"
         "  if [[ -n $values ]]; then\n    COMPREPLY=($(compgen -W \"$values\" -- \"$current\"))\n"
         "  elif [[ $current == -* ]]; then\n    COMPREPLY=($(compgen -W \"$flags\" -- \"$current\"))\n"
         "  else\n    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n  fi\n}\n"
         "complete -o filenames -F _motex motex\n";
}

}  // namespace motex::cli
