// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_paths.h"

#include <algorithm>
#include <string>

#include "motex/core/error.h"
#include "motex/markov/paths.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/model_edits.h"

namespace motex {
namespace {

constexpr int kMostTextons = 100'000;

TextonPath measured(const MotionTexture& model, Path path) {
  TextonPath out{std::move(path.states), path.log_prob, 2, 2};
  for (const int texton : out.textons) {
    Index shortest = 0, longest = 0;
    for (const int i : model.textons[static_cast<std::size_t>(texton)].instances) {
      const Instance& instance = model.instances[static_cast<std::size_t>(i)];
      const Index length = hand_over_row(model, instance) - instance.row;
      shortest = shortest == 0 ? length : std::min(shortest, length);
      longest = std::max(longest, length);
    }
    out.shortest += shortest;
    out.longest += longest;
  }
  return out;
}

/// The chain speaks of states; here these are textons.
std::string of_textons(std::string text) {
  const std::string from = "state", to = "texton";
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TextonPaths find_texton_paths(const MotionTexture& model, int from, int to, int num_textons) {
  for (const int texton : {from, to}) check_playable(model, texton);
  if (num_textons < 0 || num_textons > kMostTextons)
    throw InvalidInput("a path has 1 to " + std::to_string(kMostTextons) + " textons");
  std::vector<Path> paths;
  try {
    paths = num_textons > 0 ? best_paths_of_length(model.transitions, from, to, num_textons, 2)
                            : best_paths(model.transitions, from, to, 2);
  } catch (const InvalidInput& error) {
    throw InvalidInput(of_textons(error.what()));
  }
  TextonPaths out{measured(model, std::move(paths[0])), std::nullopt};
  if (paths.size() > 1) out.runner_up = measured(model, std::move(paths[1]));
  return out;
}

}  // namespace motex
