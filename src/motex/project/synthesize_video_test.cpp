// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/synthesize_video.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/edit.h"
#include "motex/project/moveton_edits_file.h"
#include "motex/project/staged_files.h"
#include "motex/project/track_csv.h"
#include "motex/video_io/video_reader.h"

namespace motex {
namespace {

namespace fs = std::filesystem;

struct TemporaryFolder {
  fs::path path;
  TemporaryFolder() {
    for (int k = 0; path.empty() || !fs::create_directory(path); ++k)
      path = fs::temp_directory_path() / ("motex_synthesize_video_test" + std::to_string(k));
  }
  ~TemporaryFolder() { fs::remove_all(path); }
  std::size_t num_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator{}));
  }
};

TexturedMotion one_spot() {
  TexturedMotion model;
  model.width = 48;
  model.height = 32;
  model.num_frames = 4;
  Cable cable;
  for (int t = 0; t < 4; ++t) {
    Base core{BaseKind::kGaussian, 20.0 + t, 15, 2, 0, {}};
    core.coefficients[0] = static_cast<float>(coefficient_of_peak(core, 90));
    cable.core.push_back(core);
  }
  model.cables.push_back(cable);
  model.background = Planes(1, Plane(48, 32, 60));
  return model;
}

constexpr ParticleVideoShape kShape{48, 32, 1, 25};

TEST(ParticleOutputs, NamesBesideTheVideo) {
  EXPECT_EQ(particle_outputs("a/o.mp4").tracks, "a/o.tracks.csv");
  EXPECT_EQ(particle_outputs("a/o.mp4").layer, "a/o.layer.mov");
  EXPECT_EQ(particle_outputs("a/f_%04d.png").tracks, "a/f.tracks.csv");
  EXPECT_EQ(particle_outputs("a/%04d.png").tracks, "a/frames.tracks.csv");
  EXPECT_EQ(particle_outputs("a/pictures").layer, "a/pictures.layer.mov");
  EXPECT_EQ(particle_outputs("a/pictures/").layer, "a/pictures.layer.mov");
}

TEST(WriteParticleVideo, LayerOverBackgroundIsTheVideo) {
  const TemporaryFolder folder;
  const TexturedMotion model = one_spot();
  const ParticleOutputs outputs = particle_outputs(folder.path / "o.mkv");
  for (const double scale : {1.0, 2.0}) {
    LearnedMovetons source(model);
    PhotoPainter painter(magnified_background(model, scale), scale, 1);
    const ParticleVideoReport report = write_particle_video(kShape, source, painter, 10, outputs);
    EXPECT_EQ(report.num_frames, 4) << "as many as there are";
    EXPECT_EQ(report.num_tracks, 1);
    EXPECT_EQ(report.width, 48 * scale);
    EXPECT_EQ(folder.num_files(), 3U);
    VideoReader video(outputs.video), layer(outputs.layer);
    VideoFrame picture, alone;
    for (int t = 0; t < 4; ++t) {
      ASSERT_TRUE(video.next(picture));
      ASSERT_TRUE(layer.next(alone));
      Image composed(picture.image.width, picture.image.height, {60, 60, 60, 255});
      paste(composed, alone.image, 0, 0);
      EXPECT_GT(psnr(composed, picture.image), 50);
      EXPECT_NEAR(picture.image.at(static_cast<int>((20 + t) * scale), static_cast<int>(15 * scale)).r, 150, 8);
      EXPECT_EQ(alone.image.at(1, 1).a, 0);
    }
    const std::vector<Track> tracks = parse_tracks_csv(read_file(outputs.tracks), "t");
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_EQ(tracks[0].points[3].x, 23) << "pixels of the model";
    EXPECT_NEAR(tracks[0].points[3].amplitude, 90, 0.01);
  }
}

/// Fails in its second frame.
class FailingPainter : public FramePainter {
 public:
  void paint(const MovetonFrame& frame, Image& picture, Image& layer) override {
    if (frame.frame == 1) throw NumericalFailure("made to fail");
    picture = layer = Image(48, 32, {1, 2, 3, 255});
  }
};

TEST(WriteParticleVideo, AllOrNothing) {
  const TemporaryFolder folder;
  const TexturedMotion model = one_spot();
  for (const char* name : {"o.mp4", "o.webm", "f_%03d.png", "pictures"}) {
    LearnedMovetons source(model);
    FailingPainter painter;
    EXPECT_THROW(write_particle_video(kShape, source, painter, 4, particle_outputs(folder.path / name)),
                 NumericalFailure);
    EXPECT_EQ(folder.num_files(), 0U) << name;
  }
}

TEST(MagnifiedBackground, SizesAndReplacements) {
  const TexturedMotion model = one_spot();
  EXPECT_EQ(magnified_background(model, 2.5)[0].width, 120);
  EXPECT_THROW(magnified_background(model, 1000), InvalidInput);
  const Image wide(200, 20, {10, 20, 30, 255});
  const Planes planes = magnified_background(model, 2, &wide);
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_EQ(planes[0].width, 96);
  EXPECT_EQ(planes[0].height, 64);
  EXPECT_NEAR(planes[2].at(50, 30), 30, 0.01);
  // bases with one coefficient on three planes
  Image picture, layer;
  MovetonFrame frame;
  LearnedMovetons(model).next_frame(frame);
  PhotoPainter(planes, 2, 1).paint(frame, picture, layer);
  const Rgba at = picture.at(41, 31);
  EXPECT_NEAR(at.r, 100, 6);
  EXPECT_NEAR(at.b, 120, 6);
}

std::string complaint(const std::string& text) {
  try {
    parse_moveton_edits(text, "e.json");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(MovetonEditsFile, ReadsAndComplains) {
  const MovetonEdits edits = parse_moveton_edits(
      R"({"insert": [{"frame": 10, "x": 4.5, "y": 5}, {"frame": 1, "x": 0, "y": 0, "vx": 1, "vy": -2, "species": 3, "track": 7}],
          "move": [{"track": 2, "dx": -3}], "remove": [4, 5]})",
      "e.json");
  ASSERT_EQ(edits.insertions.size(), 2U);
  EXPECT_EQ(edits.insertions[0].element.track, kFirstInsertedTrack);
  EXPECT_EQ(edits.insertions[0].element.species, -1);
  EXPECT_EQ(edits.insertions[1].element.track, 7);
  EXPECT_EQ(edits.insertions[1].element.vy, -2);
  EXPECT_EQ(edits.displacements[0].dx, -3);
  EXPECT_EQ(edits.removals, (std::vector<std::int64_t>{4, 5}));
  EXPECT_TRUE(parse_moveton_edits("{}", "e.json").empty());
  EXPECT_NE(complaint("oops").find("e.json: edits are a JSON object"), std::string::npos);
  EXPECT_NE(complaint(R"({"delete": []})").find("unknown word \"delete\""), std::string::npos);
  EXPECT_NE(complaint(R"({"insert": [{"frame": 1, "x": 2}]})").find("insert[0]: has no \"y\""), std::string::npos);
  EXPECT_NE(complaint(R"({"insert": [{"frame": 1.5, "x": 2, "y": 1}]})").find("no whole number"), std::string::npos);
  EXPECT_NE(complaint(R"({"move": [{"track": 1, "dz": 2}]})").find("unknown word \"dz\""), std::string::npos);
  EXPECT_NE(complaint(R"({"remove": [1.5]})").find("remove[0]"), std::string::npos);
  EXPECT_NE(complaint(R"({"remove": 3})").find("no list"), std::string::npos);
}

TEST(StagedFiles, AppearTogether) {
  const TemporaryFolder folder;
  write_file(folder.path / "a", "old");
  {
    StagedFiles staged;
    write_file(staged.stage(folder.path / "a"), "new");
    write_file(staged.stage(folder.path / "b"), "new");
  }
  EXPECT_EQ(read_file(folder.path / "a"), "old");
  EXPECT_EQ(folder.num_files(), 1U);
  {
    StagedFiles staged;
    write_file(staged.stage(folder.path / "a"), "new");
    write_file(staged.stage(folder.path / "b"), "new");
    staged.commit();
  }
  EXPECT_EQ(read_file(folder.path / "a"), "new");
  EXPECT_EQ(folder.num_files(), 2U);
  StagedFiles staged;
  EXPECT_THROW(staged.stage(folder.path / "missing" / "c"), InvalidInput);
}

TEST(StagedFiles, WarningsNameTheTarget) {
  const TemporaryFolder folder;
  StagedFiles staged;
  const std::filesystem::path place = staged.stage(folder.path / "odd.mp4");
  std::string said;
  JobContext job;
  job.on_warning = [&](const std::string& message) { said = message; };
  staged.naming_targets(job).warn(place.string() + ": the size is odd");
  EXPECT_EQ(said, (folder.path / "odd.mp4").string() + ": the size is odd");
  EXPECT_NO_THROW(staged.naming_targets({}).warn("nobody listens"));
}

}  // namespace
}  // namespace motex
