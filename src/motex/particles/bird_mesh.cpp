// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bird_mesh.h"

#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr int kRingCorners = 8;

/// Places along the body: forward, height of its axis, radius.
constexpr std::array<std::array<double, 3>, 8> kBody{{{0.300, -0.004, 0.001},
                                                      {0.262, 0.000, 0.012},
                                                      {0.225, 0.006, 0.030},
                                                      {0.175, 0.004, 0.032},
                                                      {0.080, -0.006, 0.052},
                                                      {-0.040, -0.006, 0.050},
                                                      {-0.150, 0.000, 0.028},
                                                      {-0.210, 0.004, 0.012}}};

/// Across a half of a wing: distance from its hinge, leading and trailing edge.
struct Rib {
  double out, front, back;
};
constexpr double kShoulder = 0.035, kWrist = 0.205;  // from the middle of the body
constexpr std::array<Rib, 4> kInner{
    {{0.0, 0.105, -0.085}, {0.06, 0.125, -0.080}, {0.12, 0.150, -0.070}, {0.17, 0.165, -0.062}}};
constexpr std::array<Rib, 6> kOuter{{{0.0, 0.165, -0.062},
                                     {0.07, 0.160, -0.068},
                                     {0.14, 0.135, -0.060},
                                     {0.21, 0.090, -0.045},
                                     {0.26, 0.045, -0.030},
                                     {0.295, 0.000, -0.012}}};
constexpr double kCamber = 0.012;  // how much the trailing edge hangs below the leading one
constexpr double kSweep = 0.75;    // radians, of a wing that is folded in the upstroke

void add_quad(BirdMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

int add(BirdMesh& mesh, double x, double y, double z) {
  mesh.vertices.emplace_back(x, y, z);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

void add_body(BirdMesh& mesh) {
  for (std::size_t i = 0; i < kBody.size(); ++i) {
    const auto [x, y, radius] = kBody[i];
    for (int k = 0; k < kRingCorners; ++k) {
      const double turn = 2 * std::numbers::pi * k / kRingCorners;
      const int corner = add(mesh, x, y + radius * std::cos(turn), radius * std::sin(turn));
      if (i > 0)
        add_quad(mesh, corner, corner - k + (k + 1) % kRingCorners, corner - k + (k + 1) % kRingCorners - kRingCorners,
                 corner - kRingCorners);
    }
  }
}

void add_tail(BirdMesh& mesh) {
  constexpr int kFeathers = 6;
  const int root_left = add(mesh, -0.16, 0.004, -0.022), root_right = add(mesh, -0.16, 0.004, 0.022);
  int before = -1;
  for (int k = 0; k <= kFeathers; ++k) {
    const double turn = (2.0 * k / kFeathers - 1) * 0.42;
    const int tip = add(mesh, -0.16 - 0.185 * std::cos(turn), -0.004, 0.2 * std::sin(turn));
    const int root = k <= kFeathers / 2 ? root_left : root_right;
    if (k > 0) mesh.triangles.push_back({root, before, tip});
    if (k == kFeathers / 2) mesh.triangles.push_back({root_left, tip, root_right});
    before = tip;
  }
}

void add_wing(BirdMesh& mesh, const WingPosture& wings, double side) {
  const double bent = wings.inner + wings.outer;
  int front_before = -1, back_before = -1;
  const auto rib = [&](double x_front, double x_back, double y, double z, double tilt) {
    const int front = add(mesh, x_front, y, side * z);
    const int back = add(mesh, x_back, y - kCamber * std::cos(tilt), side * (z + kCamber * std::sin(tilt)));
    if (front_before >= 0) add_quad(mesh, front_before, front, back, back_before);
    front_before = front;
    back_before = back;
  };
  for (const Rib& r : kInner)
    rib(r.front, r.back, r.out * std::sin(wings.inner), kShoulder + r.out * std::cos(wings.inner), wings.inner);
  const double y = (kWrist - kShoulder) * std::sin(wings.inner),
               z = kShoulder + (kWrist - kShoulder) * std::cos(wings.inner);
  const double sweep = kSweep * wings.fold, c = std::cos(sweep), s = std::sin(sweep);
  constexpr double kPivot = 0.12;  // the wrist's own place between front and back
  for (const Rib& r : kOuter) {
    // Swept back in the plane of the wing about the wrist, then raised.
    const double front_x = kPivot + (r.front - kPivot) * c - r.out * s,
                 front_out = std::max(0.0, r.out * c + (r.front - kPivot) * s);
    const double back_x = kPivot + (r.back - kPivot) * c - r.out * s, back_out = r.out * c + (r.back - kPivot) * s;
    const double shared_out = r.out == 0 ? 0 : 0.5 * (front_out + std::max(0.0, back_out));
    rib(r.out == 0 ? r.front : front_x, r.out == 0 ? r.back : back_x, y + shared_out * std::sin(bent),
        z + shared_out * std::cos(bent), bent);
  }
}

}  // namespace

BirdMesh bird_mesh(const WingPosture& wings) {
  BirdMesh mesh;
  add_body(mesh);
  add_tail(mesh);
  add_wing(mesh, wings, 1);
  add_wing(mesh, wings, -1);
  return mesh;
}

}  // namespace motex
