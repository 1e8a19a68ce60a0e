// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "texton_argument.h"

#include "closest.h"
#include "motex/core/error.h"
#include "motex/motion_texture/model_edits.h"

namespace motex::cli {

int texton_number(const MotionTexture& model, const std::string& argument, const std::string& word) {
  const auto found = find_texton(model, word);
  if (!found) {
    std::vector<std::string> names;
    for (const Texton& texton : model.textons)
      if (!texton.name.empty()) names.push_back(texton.name);
    throw InvalidInput(argument + ": there is no texton " + (word.empty() ? "''" : word) + "; the model has 0 … " +
                       std::to_string(model.textons.size() - 1) + did_you_mean(word, names));
  }
  try {
    check_playable(model, *found);
  } catch (const InvalidInput& error) {
    throw InvalidInput(argument + ": " + error.what());
  }
  return *found;
}

std::vector<int> texton_numbers(const MotionTexture& model, const std::string& argument,
                                const std::vector<std::string>& words) {
  std::vector<int> out;
  for (const std::string& word : words) out.push_back(texton_number(model, argument, word));
  return out;
}

}  // namespace motex::cli
