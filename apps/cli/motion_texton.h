// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "arguments.h"
#include "motex/motion_texture/model_edits.h"
#include "session.h"

namespace motex::cli {

/// What the commands that edit a model share: MODEL, and -o when the edited one should be another file.
struct ModelEditing {
  std::string model_path, output;
  MotionTexture learned;  ///< as in the file
  MotionTexture applied;  ///< with the edits so far: what names and numbers refer to

  void declare_model(Arguments& arguments);
  void declare_output(Arguments& arguments);
  /// Checks where the result goes and loads the model.
  void open(Session& session);
  /// Adds the edit, writes the model and reports. done: "dropped textons 3 and 5".
  void commit(const ModelEdit& edit, const std::string& done, Session& session);
  /// Writes `learned`, whose edits have changed, and reports.
  void write(Value object, const std::string& said, Session& session);
};

/// Edits as --json lists them: what files hold.
Value edits_value(const MotionTexture& model);

}  // namespace motex::cli
