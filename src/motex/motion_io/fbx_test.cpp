// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/fbx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/motion_io/clip_io.h"

namespace motex {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kSingle = 1e-4;  // Assimp works in single precision; lengths here are up to 100

/// A text FBX of a hand that hangs from an arm that hangs from travelling hips.
struct FbxText {
  int up_axis = 1;
  double unit = 2.54;
  int key_step = 1;             ///< frames from key to key
  std::string arm_scale = "1";  ///< of all three axes
  std::string inherit_type = "1";
  int num_keys = 5;

  static std::string number(double x) { return std::to_string(x); }

  /// Hips travel by this in x, the arm turns about its x by that many degrees, at key k.
  static double travel(double frame) { return 3 * frame; }
  static double turn(double frame) { return 10 * frame; }

  std::string curve(int id, double (*value)(double)) const {
    std::string times, values;
    for (int k = 0; k < num_keys; ++k) {
      times += (k > 0 ? "," : "") + std::to_string(static_cast<std::int64_t>(1539538600) * k * key_step);
      values += (k > 0 ? "," : "") + number(value(k * key_step));
    }
    const std::string n = std::to_string(num_keys);
    return "\tAnimationCurve: " + std::to_string(id) + ", \"AnimCurve::\", \"\" {\n\t\tDefault: 0\n\t\tKeyVer: 4008\n" +
           "\t\tKeyTime: *" + n + " {\n\t\t\ta: " + times + "\n\t\t}\n\t\tKeyValueFloat: *" + n +
           " {\n\t\t\ta: " + values +
           "\n\t\t}\n\t\tKeyAttrFlags: *1 {\n\t\t\ta: 24836\n\t\t}\n\t\tKeyAttrDataFloat: *4 {\n\t\t\ta: "
           "0,0,0,0\n\t\t}\n" +
           "\t\tKeyAttrRefCount: *1 {\n\t\t\ta: " + n + "\n\t\t}\n\t}\n";
  }
  static std::string curve_node(int id, const std::string& kind) {
    return "\tAnimationCurveNode: " + std::to_string(id) + ", \"AnimCurveNode::" + kind +
           "\", \"\" {\n\t\tProperties70:  {\n\t\t\tP: \"d|X\", \"Number\", \"\", \"A\",0\n\t\t\tP: \"d|Y\", "
           "\"Number\", \"\", "
           "\"A\"," +
           (kind == "T" ? "90" : "0") + "\n\t\t\tP: \"d|Z\", \"Number\", \"\", \"A\",0\n\t\t}\n\t}\n";
  }
  std::string model(int id, const std::string& name, const std::string& translation, const std::string& more) const {
    return "\tModel: " + std::to_string(id) + ", \"Model::" + name + "\", \"LimbNode\" {\n\t\tVersion: 232\n" +
           "\t\tProperties70:  {\n\t\t\tP: \"InheritType\", \"enum\", \"\", \"\"," + inherit_type +
           "\n\t\t\tP: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\"," + translation + "\n" + more +
           "\t\t}\n\t\tShading: Y\n\t\tCulling: \"CullingOff\"\n\t}\n";
  }
  std::string text() const {
    const std::string scale = "\t\t\tP: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\"," + arm_scale + "," + arm_scale +
                              "," + arm_scale + "\n";
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
           "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\"," +
           std::to_string(up_axis) + "\n\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + number(unit) +
           "\n\t\tP: \"TimeMode\", \"enum\", \"\", \"\",6\n\t}\n}\nObjects:  {\n" +
           model(100, "Hips", "0,90,0", scale) +
           model(101, "Arm", "20,40,0",
                 "\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",1\n\t\t\tP: \"PreRotation\", \"Vector3D\", "
                 "\"Vector\", "
                 "\"\",0,0,90\n" +
                     scale) +
           model(102, "Hand", "30,0,5", scale) + "\tAnimationStack: 200, \"AnimStack::Take\", \"\" {\n\t}\n" +
           "\tAnimationLayer: 201, \"AnimLayer::Base\", \"\" {\n\t}\n" + curve_node(300, "T") + curve_node(301, "R") +
           curve(400, travel) + curve(401, turn) +
           "}\nConnections:  {\n\tC: \"OO\",100,0\n\tC: \"OO\",101,100\n\tC: \"OO\",102,101\n\tC: \"OO\",201,200\n"
           "\tC: \"OO\",300,201\n\tC: \"OO\",301,201\n\tC: \"OP\",300,100,\"Lcl Translation\"\n"
           "\tC: \"OP\",301,101,\"Lcl Rotation\"\n\tC: \"OP\",400,300,\"d|X\"\n\tC: \"OP\",401,301,\"d|X\"\n}\n";
  }
};

/// Where the hand is in the frames of the file.
Vector3 hand_place(double frame) {
  const Quat arm = Quat(Eigen::AngleAxisd(90 * kRadPerDeg, Vector3::UnitZ())) *
                   Quat(Eigen::AngleAxisd(FbxText::turn(frame) * kRadPerDeg, Vector3::UnitX()));
  return Vector3(FbxText::travel(frame), 90, 0) + Vector3(20, 40, 0) + arm * Vector3(30, 0, 5);
}

Clip read(const FbxText& file, std::vector<std::string>* warnings = nullptr, const ReadClipOptions& options = {}) {
  JobContext job;
  if (warnings != nullptr) job.on_warning = [warnings](const std::string& text) { warnings->push_back(text); };
  return read_clip_bytes(file.text(), "hand.fbx", options, job);
}

Vector3 place_in(const Clip& clip, const std::string& joint, Index frame) {
  Pose pose;
  forward_kinematics(clip, frame, pose);
  return pose.positions.col(clip.skeleton.find(joint));
}

TEST(Fbx, WithoutAssimpSaysWhatToDo) {
  if (reads_fbx()) GTEST_SKIP() << "this build has Assimp";
  try {
    read(FbxText());
    FAIL();
  } catch (const UnsupportedFile& error) {
    EXPECT_NE(std::string(error.what()).find("libassimp-dev"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("BVH"), std::string::npos);
  }
}

class FbxRead : public testing::Test {
 protected:
  void SetUp() override {
    if (!reads_fbx()) GTEST_SKIP() << "this build has no Assimp";
  }
};

TEST_F(FbxRead, HierarchyPivotsCurvesUnitAndRateAreAsWritten) {
  const Clip clip = read(FbxText());
  ASSERT_EQ(clip.skeleton.num_joints(), 3);
  EXPECT_EQ(clip.skeleton.find("Hand"), 2);
  EXPECT_EQ(clip.skeleton.joints[2].parent_idx, 1);
  ASSERT_EQ(clip.num_frames(), 5);
  EXPECT_NEAR(clip.frame_rate(), 30, 1e-9);
  EXPECT_NEAR(clip.skeleton.metres_per_unit, 0.0254, 1e-8);
  for (Index t = 0; t < 5; ++t)
    EXPECT_NEAR((place_in(clip, "Hand", t) - hand_place(static_cast<double>(t))).norm(), 0, kSingle) << t;
}

TEST_F(FbxRead, ZUpFilesAreTurned) {
  FbxText file;
  file.up_axis = 2;
  const Clip clip = read(file);
  const Vector3 p = hand_place(3);
  EXPECT_NEAR((place_in(clip, "Hand", 3) - Vector3(p.x(), p.z(), -p.y())).norm(), 0, kSingle);
  ReadClipOptions options;
  options.up = UpAxis::kY;
  EXPECT_NEAR((place_in(read(file, nullptr, options), "Hand", 3) - p).norm(), 0, kSingle);
}

TEST_F(FbxRead, SparseKeysAreReadStraightAndSaid) {
  FbxText file;
  file.key_step = 6;
  file.num_keys = 3;
  std::vector<std::string> warnings;
  const Clip clip = read(file, &warnings);
  ASSERT_EQ(clip.num_frames(), 13);
  EXPECT_NEAR((place_in(clip, "Hand", 5) - hand_place(5)).norm(), 0, kSingle);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("keys more than a frame apart"), std::string::npos);
}

// As Maya writes characters in metres: every node is scaled by 0.01 and hands no scale down.
TEST_F(FbxRead, ScaleThatIsNotInheritedIsNotMultipliedUp) {
  FbxText file;
  file.arm_scale = "0.5";
  file.inherit_type = "2";
  const Clip clip = read(file);
  const Vector3 hips(FbxText::travel(2), 90, 0), plain = hand_place(2);
  EXPECT_NEAR((place_in(clip, "Hand", 2) - (hips + 0.5 * (plain - hips))).norm(), 0, kSingle);
}

TEST_F(FbxRead, RefusesBrokenFilesAndThoseWithoutAnimation) {
  EXPECT_THROW(read_fbx_bytes("; FBX 7.4.0 project file\n", "x.fbx"), InvalidInput);
  EXPECT_THROW(read_fbx_bytes("", "x.fbx"), InvalidInput);
  std::string text = FbxText().text();
  for (std::size_t size = 10; size < text.size(); size += 97) {
    try {
      check_clip(read_fbx_bytes(text.substr(0, size), "x.fbx"));
    } catch (const InvalidInput&) {
    }
  }
  const std::size_t stack = text.find("\tAnimationStack"), nodes = text.find("\tAnimationCurveNode");
  EXPECT_THROW(read_fbx_bytes(text.erase(stack, nodes - stack), "x.fbx"), InvalidInput);
}

// A binary file: header, one record with an array property.
std::string binary_with_array(std::uint32_t count, std::uint32_t encoding, std::uint32_t stored) {
  const auto word = [](std::uint32_t x) {
    std::string out;
    for (int k = 0; k < 4; ++k) out += static_cast<char>(x >> (8 * k) & 0xFF);
    return out;
  };
  std::string out("Kaydara FBX Binary  \0\x1a\0", 23);
  out += word(7400);
  const std::uint32_t end = 27 + 13 + 1 + 13 + 16;
  out += word(end) + word(1) + word(13 + 16) + std::string("\1A", 2);
  out += "d" + word(count) + word(encoding) + word(stored) + std::string(16, '\0');
  return out + std::string(13, '\0');
}

TEST_F(FbxRead, NodesThatHangFromOneAnotherDoNotEndTheProgram) {
  std::string text = FbxText().text();
  const std::string last = "\tC: \"OO\",102,101\n";
  ASSERT_NE(text.find(last), text.npos);
  text.insert(text.find(last), "\tC: \"OO\",101,102\n");
  EXPECT_THROW(read_fbx_bytes(text, "ring.fbx"), InvalidInput);
}

TEST(CheckFbxRecords, RefusesArraysThatTheirBytesCannotHold) {
  EXPECT_NO_THROW(check_fbx_records(binary_with_array(2, 0, 16), "x.fbx"));
  EXPECT_THROW(check_fbx_records(binary_with_array(3, 0, 16), "x.fbx"), ParseError);
  EXPECT_NO_THROW(check_fbx_records(binary_with_array(2000, 1, 16), "x.fbx"));
  EXPECT_THROW(check_fbx_records(binary_with_array(4'000'000'000U, 1, 16), "x.fbx"), ParseError);
  EXPECT_THROW(check_fbx_records(binary_with_array(2, 0, 17), "x.fbx"), ParseError);
  EXPECT_THROW(check_fbx_records(binary_with_array(2, 2, 16), "x.fbx"), ParseError);
}

TEST(CheckFbxRecords, RefusesRecordsThatNestWithoutEnd) {
  std::string text = "; FBX 7.4.0 project file\n";
  for (int k = 0; k < 70; ++k) text += "A: {\n";
  EXPECT_THROW(check_fbx_records(text, "x.fbx"), ParseError);
  EXPECT_NO_THROW(check_fbx_records(FbxText().text(), "x.fbx"));
}

}  // namespace
}  // namespace motex
