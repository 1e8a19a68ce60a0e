// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"
#include "motex/motion/floor.h"
#include "motex/motion/limb_target.h"
#include "motex/motion_texture/model.h"
#include "motex/motion_texture/play_options.h"

namespace motex {

/// A frame of a clip that the model was learned from, counted from 0 in the clip as read.
struct ClipFrame {
  std::string clip;  ///< as in MotionTexture::clip_names, with or without its extension
  Index frame = 0;
};

/// Corpus row of a frame. Throws InvalidInput when the model has no such clip, or several; when the clip has no such
/// frame; when the frame was left out of learning, naming the nearest that was not.
Index corpus_row(const MotionTexture& model, const ClipFrame& pose);

/// Two consecutive frames that need not be in the model.
struct PosePair {
  std::string name;      ///< for messages
  FrameMatrix features;  ///< 2 × D, weighted
  RootPlace place;       ///< of the first
};
/// Frames `frame` and `frame` + 1 of a clip. Throws InvalidInput when it has no such frames, or is of another skeleton.
PosePair pose_pair(const FeatureSpace& space, const Clip& clip, Index frame);

struct ChoreographyRequest {
  struct Via {
    ClipFrame pose;
    Index frame = 0;  ///< output frames `frame` and `frame` + 1 are that frame and the next of its clip
  };
  ClipFrame start;                              ///< i: output frames 0 and 1 are i and i + 1
  ClipFrame end;                                ///< j: the last two output frames are j − 1 and j
  std::optional<PosePair> first_two, last_two;  ///< instead of `start`, of `end`
  Index num_frames = 0;                         ///< N
  std::vector<Via> via;                         ///< by rising output frame
  std::vector<RootTarget> at;                   ///< where the root is, and which way it looks, at some frames
  std::vector<FloorBox> avoid;                  ///< what the root goes around
  std::vector<LimbTarget> reach;                ///< where hands or feet are at some frames
  std::optional<RootPlace> place;               ///< of output frame 0; where the start frame stands when not given
};

struct ChoreographyOptions : PlayOptions {
  double stretch = 0.15;
  bool lively = true;
  BendPathOptions path;
  ReachOptions reach;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    PlayOptions::visit_fields(self, visit);
    visit(Field{"stretch", "", "how much longer or shorter than itself an example may be played"}, self.stretch,
          Range{0, 1});
    visit(Field{"lively", "", "as lively as the examples are; else the likeliest dance, which is slower"}, self.lively,
          Range{});
    BendPathOptions::visit_fields(self.path, visit);
    ReachOptions::visit_fields(self.reach, visit);
  }
};

/// A texton as it was played: output frames start … start + length − 1, of which it shares two with each neighbour.
struct ChoreographedTexton {
  int texton = 0;
  int instance = 0;
  Index start = 0, length = 0;
  Index source_row = 0, source_length = 0;  ///< of the corpus
  double first_distance = 0;                ///< cm (root mean square of two frames) by which its first poses were bent
  double last_distance = 0;                 ///< and its last ones
};

struct ChoreographyReport {
  std::vector<ChoreographedTexton> played;
  double log_prob = 0;        ///< Σ log M over the transitions
  double cost = 0;            ///< what was minimised (ChoreographyPlanner)
  double start_distance = 0;  ///< cm from the start poses to those of the example that begins there
  double end_distance = 0;    ///< cm from the end poses to those of the example that ends there
  double start_from_model = 0, end_from_model = 0;  ///< cm from poses that are not in the model to the nearest that are
  BendPathReport path;                              ///< how the way of the root was bent to places and around boxes
  FloorReport floor;
  std::vector<ReachedTarget> reached;  ///< as ChoreographyRequest::reach
};

/// A dance from pose to pose in exactly N frames [MT02 5.2, Figure 1]. Body pose, tilt and height of the first two and
/// last two frames, and of the frames of `via`, are those of the examples, also after planted feet were held and the
/// body kept above the floor. Where the root has places to be at or boxes to go around, 16 ways are planned, and the
/// one is played in which the examples and the bending of their way (bend_root_path) together cost least. Warns where a
/// pose is far from every example and where a limb misses its place. Throws InvalidInput for a frame that does not
/// exist, `via` out of order, or no way in that many frames, naming the nearest N, or around the boxes.
Clip choreograph(const MotionTexture& model, const ChoreographyRequest& request, const ChoreographyOptions& options,
                 ChoreographyReport& report, const JobContext& job = {});

}  // namespace motex
