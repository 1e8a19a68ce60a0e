// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "commands.h"
#include "model_clips.h"
#include "motex/motion_texture/learn.h"
#include "motex/project/motion_texture_file.h"
#include "text_table.h"

namespace motex::cli {
namespace {

Value score_value(const ScoreReport& score) {
  Value object;
  object["log_likelihood_per_frame"] = score.log_likelihood_per_frame;
  object["global_lds_log_likelihood_per_frame"] = score.global_lds_log_likelihood_per_frame;
  object["frames"] = std::int64_t{score.num_frames};
  return object;
}

std::vector<std::string> score_row(const std::string& name, const ScoreReport& score) {
  return {name, std::to_string(score.num_frames), fixed(score.log_likelihood_per_frame, 3),
          fixed(score.global_lds_log_likelihood_per_frame, 3),
          fixed(score.log_likelihood_per_frame - score.global_lds_log_likelihood_per_frame, 3)};
}

/// Mean over frames.
ScoreReport total(const std::vector<ScoreReport>& scores) {
  ScoreReport sum;
  for (const ScoreReport& score : scores) {
    const auto n = static_cast<double>(score.num_frames);
    sum.log_likelihood_per_frame += n * score.log_likelihood_per_frame;
    sum.global_lds_log_likelihood_per_frame += n * score.global_lds_log_likelihood_per_frame;
    sum.num_frames += score.num_frames;
  }
  sum.log_likelihood_per_frame /= static_cast<double>(sum.num_frames);
  sum.global_lds_log_likelihood_per_frame /= static_cast<double>(sum.num_frames);
  return sum;
}

struct Score {
  std::string model_path;
  std::vector<std::string> clip_paths;
  ReadClipOptions read;

  void declare(Arguments& arguments) {
    arguments.positional("MODEL", "made by motex motion learn", model_path);
    arguments.positional("CLIP...", "clips of the model's skeleton, or folders of them", clip_paths);
    arguments.section("Reading clips");
    arguments.options(read);
  }

  void run(Session& session) {
    const MotionTexture model = load_motion_texture(model_path);
    const std::vector<Clip> clips = load_clips_for(model, clip_paths, read, session);
    std::vector<std::vector<std::string>> rows{{"clip", "frames", "textons", "global", "gain"}};
    std::vector<ScoreReport> scores;
    Value list = Value::List();
    for (const Clip& clip : clips) {
      const double done = 0.2 + 0.8 * static_cast<double>(scores.size()) / static_cast<double>(clips.size());
      scores.push_back(
          score_clips(model, {&clip, 1}, session.job(done, done + 0.8 / static_cast<double>(clips.size()))));
      rows.push_back(score_row(clip.name, scores.back()));
      Value entry = score_value(scores.back());
      entry["clip"] = clip.name;
      list.append(std::move(entry));
    }
    const ScoreReport all = total(scores);
    if (scores.size() > 1) rows.push_back(score_row("all", all));
    Value object = score_value(all);
    object["clips"] = std::move(list);
    session.result(object, text_table(rows) + "log-likelihood, nats per frame\n");
  }
};

}  // namespace

Command motion_score() {
  return make_command<Score>(
      {"motion score", "log-likelihood of clips under a model and under one global linear dynamic system",
       "Nats per frame; larger is better. The global system has the model's state size and was learned from the same "
       "clips.",
       "motex motion score dance.motex new.bvh\n"
       "motex motion score dance.motex held_out/ --json"});
}

}  // namespace motex::cli
