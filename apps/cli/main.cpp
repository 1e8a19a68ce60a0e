// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <new>

#include "closest.h"
#include "commands.h"
#include "help.h"
#include "interrupt.h"
#include "motex/core/error.h"
#include "parse.h"
#include "reference.h"

namespace motex::cli {
namespace {

CommandTable make_table() {
  // clang-format off: one a line
  return {
      motion_learn(),
      motion_info(),
      motion_synthesize(),
      motion_segment(),
      motion_score(),
      motion_path(),
      motion_choreograph(),
      motion_inbetween(),
      motion_stretch(),
      motion_vary(),
      motion_edit(),
      motion_compare(),
      motion_features(),
      motion_view(),
      motion_convert(),
      motion_retarget(),
      motion_play(),
      motion_export(),
      motion_mix(),
      motion_texton_list(),
      motion_texton_name(),
      motion_texton_drop(),
      motion_texton_keep(),
      motion_texton_merge(),
      motion_texton_weight(),
      motion_texton_undo(),
      particles_learn(),
      particles_info(),
      particles_tracks(),
      particles_explain(),
      particles_compress(),
      particles_decompress(),
      particles_synthesize(),
      particles_decompose(),
      particles_score(),
      particles_maps(),
      particles_simulate_snow(),
      particles_simulate_birds(),
      particles_simulate_fireworks(),
      people_key(),
      people_signals(),
      people_learn(),
      people_info(),
      people_name(),
      people_export(),
      people_crowd(),
      people_simulate(),
      people_motifs(),
      people_direct(),
      people_play(),
      doctor(),
  };
  // clang-format on
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

bool asks_for_help(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), std::find(words.begin(), words.end(), "--"),
                     [](const std::string& word) { return word == "--help" || word == "-h"; });
}

/// What can stand after `group` ("motion texton"; "" = at the beginning) in a command's name.
std::vector<std::string> words_after(const CommandTable& table, const std::string& group) {
  std::vector<std::string> out;
  for (const Command& command : table) {
    if (!group.empty() && !command.name.starts_with(group + " ")) continue;
    const std::string rest = command.name.substr(group.empty() ? 0 : group.size() + 1);
    const std::string word = rest.substr(0, rest.find(' '));
    if (std::find(out.begin(), out.end(), word) == out.end()) out.push_back(word);
  }
  return out;
}

/// The command that the first words name; they are taken off.
const Command& find_command(const CommandTable& table, std::vector<std::string>& words) {
  for (std::size_t num_words : {3U, 2U, 1U}) {
    if (words.size() < num_words) continue;
    const std::string name = joined({words.begin(), words.begin() + static_cast<std::ptrdiff_t>(num_words)});
    for (const Command& command : table) {
      if (command.name != name) continue;
      words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(num_words));
      return command;
    }
  }
  std::size_t num_known = 0;  // the longest beginning that is one of a command's name
  std::string group;
  std::vector<std::string> known = words_after(table, "");
  known.emplace_back("completion");
  while (num_known < words.size() && std::find(known.begin(), known.end(), words[num_known]) != known.end()) {
    group += (group.empty() ? "" : " ") + words[num_known++];
    known = words_after(table, group);
  }
  if (num_known == words.size()) throw InvalidInput("motex " + group + " what? " + enumerate(known, "or"));
  const std::string prefix = group.empty() ? "" : group + " ";
  throw InvalidInput("there is no command '" + prefix + words[num_known] + "'" + did_you_mean(words[num_known], known) +
                     " (motex " + prefix + "--help lists all)");
}

/// True when the words ask for text that needs no command.
bool print_text(const CommandTable& table, const std::vector<std::string>& words, Session& session) {
  const auto is_help = [](const std::string& word) { return word == "--help" || word == "-h" || word == "help"; };
  if (is_help(words[0]) && words.size() == 2 && words[1] == "--reference") {
    session.result({}, reference_markdown(table));
  } else if (is_help(words[0])) {
    session.result({}, help_overview(table, ""));
  } else if (words[0] == "--version") {
    session.result({}, "motex " MOTEX_VERSION "\n");
  } else if (words[0] == "completion" && words.size() == 2 && words[1] == "bash") {
    session.result({}, bash_completion(table));
  } else if (words[0] == "completion") {
    if (!asks_for_help(words)) throw InvalidInput("usage: motex completion bash");
    session.result({}, "usage: motex completion bash\n\nExample\n  source <(motex completion bash)\n");
  } else if (words.size() <= 3 && is_help(words.back()) &&
             !words_after(table, joined({words.begin(), words.end() - 1})).empty()) {
    session.result({}, help_overview(table, joined({words.begin(), words.end() - 1})));
  } else {
    return false;
  }
  return true;
}

void run(std::vector<std::string> words, Session& session) {
  const CommandTable table = make_table();
  if (words.empty()) throw InvalidInput("motex what? motex --help lists the commands");
  if (!print_text(table, words, session)) {
    const Command& command = find_command(table, words);
    const Arguments arguments = arguments_of(command, session.flags);
    if (asks_for_help(words)) {
      session.result({}, help_page(command, arguments));
    } else {
      parse(words, arguments);
      watch_interrupts();
      command.run(session);
    }
  }
  session.finish();
}

/// The one catch of this door: kind of failure → exit code.
int run_and_report(const std::vector<std::string>& words) {
  Session session;
  try {
    run(words, session);
    return 0;
  } catch (const Cancelled&) {
    session.fail("interrupted; nothing was written");
    return 130;
  } catch (const InvalidInput& error) {
    session.fail(error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    session.fail("out of memory");
  } catch (const std::exception& error) {
    session.fail(error.what());
  }
  return 1;
}

}  // namespace
}  // namespace motex::cli

int main(int argc, char** argv) { return motex::cli::run_and_report({argv + std::min(argc, 1), argv + argc}); }
