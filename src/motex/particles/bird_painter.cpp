// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bird_painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "motex/image/image.h"

namespace motex {
namespace {

constexpr int kSamples = 4;         // a side, of a pixel
constexpr double kNearest = 0.7;    // wingspans from the camera; nearer birds are not drawn
constexpr double kHazeDepth = 200;  // wingspans at which 1 − 1/e of the contrast is gone
constexpr double kMostHaze = 0.5;
constexpr float kAmbient = 0.45F;
constexpr float kDarkShare = 0.28F;  // light of a dark bird in that of what is behind it

struct Corner {
  float x, y, inverse_depth;  // samples from the box's corner
};

/// Depth and shade of each sample of a box.
class SampleBox {
 public:
  SampleBox(int width, int height)
      : width_(width),
        height_(height),
        nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        shade_(nearest_.size()) {}

  void add(const Corner& a, const Corner& b, const Corner& c, float shade) {
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(area) < 1e-6F) return;
    const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int right = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
        const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        const float inverse_depth =
            a.inverse_depth + wb * (b.inverse_depth - a.inverse_depth) + wc * (c.inverse_depth - a.inverse_depth);
        const std::size_t idx =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (inverse_depth <= nearest_[idx]) continue;
        nearest_[idx] = inverse_depth;
        shade_[idx] = shade;
      }
  }

  /// Sum of shades and number of covered samples of pixel (x, y).
  std::pair<float, int> pixel(int x, int y) const {
    float sum = 0;
    int count = 0;
    for (int v = 0; v < kSamples; ++v)
      for (int u = 0; u < kSamples; ++u) {
        const std::size_t idx = static_cast<std::size_t>(y * kSamples + v) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(x * kSamples + u);
        if (nearest_[idx] <= 0) continue;
        sum += shade_[idx];
        ++count;
      }
    return {sum, count};
  }

 private:
  int width_, height_;
  std::vector<float> nearest_, shade_;  // 1 / depth, 0 = nothing; light
};

std::vector<Vector3> in_world(const BirdMesh& mesh, const BirdPose& bird) {
  const Vector3 right = bird.forward.cross(bird.up);
  std::vector<Vector3> out;
  for (const Vector3& v : mesh.vertices)
    out.emplace_back(bird.position + v.x() * bird.forward + v.y() * bird.up + v.z() * right);
  return out;
}

/// Light on a face seen from the origin; both of its sides look alike.
float light_on(const Vector3& a, const Vector3& b, const Vector3& c) {
  static const Vector3 sun = Vector3(-0.35, 0.85, 0.4).normalized();
  Vector3 normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (length <= 0) return kAmbient;
  normal /= normal.dot(a) > 0 ? -length : length;  // towards the camera
  return kAmbient + (1 - kAmbient) * static_cast<float>(std::max(0.0, 0.5 + 0.5 * normal.dot(sun)));
}

void put_sprite(const BirdSprite& sprite, Image& image) {
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x) {
      const std::size_t idx =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(sprite.width) + static_cast<std::size_t>(x);
      const float alpha = sprite.alpha[idx];
      if (alpha <= 0) continue;
      const auto level = [&](std::size_t k) {
        return static_cast<std::uint8_t>(std::clamp(sprite.colour[3 * idx + k] / alpha, 0.0F, 255.0F) + 0.5F);
      };
      blend(image.at(sprite.left + x, sprite.top + y), {level(0), level(1), level(2), 255}, static_cast<double>(alpha));
    }
}

}  // namespace

BirdSprite view_bird(const BirdPose& bird, double focal, int width, int height, const BirdColours& colours) {
  BirdSprite sprite;
  const double depth = -bird.position.z();
  if (!(depth > kNearest)) return sprite;
  const BirdMesh mesh = bird_mesh(bird.wings);
  const std::vector<Vector3> world = in_world(mesh, bird);
  std::vector<Corner> corners;
  float left = HUGE_VALF, top = HUGE_VALF, right = -HUGE_VALF, bottom = -HUGE_VALF;
  for (const Vector3& p : world) {
    const double away = std::max(0.1, -p.z());
    corners.push_back({static_cast<float>(0.5 * width + focal * p.x() / away),
                       static_cast<float>(0.5 * height - focal * p.y() / away), static_cast<float>(1 / away)});
    left = std::min(left, corners.back().x), right = std::max(right, corners.back().x);
    top = std::min(top, corners.back().y), bottom = std::max(bottom, corners.back().y);
  }
  if (!(right > 0 && bottom > 0 && left < static_cast<float>(width) && top < static_cast<float>(height))) return sprite;
  sprite.left = std::max(0, static_cast<int>(left));
  sprite.top = std::max(0, static_cast<int>(top));
  sprite.width = std::min(width, static_cast<int>(std::ceil(right))) - sprite.left;
  sprite.height = std::min(height, static_cast<int>(std::ceil(bottom))) - sprite.top;
  SampleBox samples(sprite.width * kSamples, sprite.height * kSamples);
  for (Corner& corner : corners) {
    corner.x = (corner.x - static_cast<float>(sprite.left)) * kSamples;
    corner.y = (corner.y - static_cast<float>(sprite.top)) * kSamples;
  }
  for (const std::array<int, 3>& face : mesh.triangles) {
    const auto a = static_cast<std::size_t>(face[0]), b = static_cast<std::size_t>(face[1]),
               c = static_cast<std::size_t>(face[2]);
    samples.add(corners[a], corners[b], corners[c], light_on(world[a], world[b], world[c]));
  }
  const auto haze = static_cast<float>(std::min(kMostHaze, 1 - std::exp(-depth / kHazeDepth)));
  constexpr float kPixel = 1.0F / (kSamples * kSamples);
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x) {
      const auto [shade, count] = samples.pixel(x, y);
      const float alpha = static_cast<float>(count) * kPixel;
      sprite.alpha.push_back(alpha);
      for (std::size_t k = 0; k < 3; ++k)
        sprite.colour.push_back((1 - haze) * colours.body[k] * shade * kPixel + haze * colours.haze[k] * alpha);
    }
  return sprite;
}

Image bird_portrait(const WingPosture& wings, int side, const BirdColours& colours) {
  constexpr double kElevation = 0.5, kDistance = 4;  // radians, wingspans
  const Vector3 near(0, -std::sin(kElevation), std::cos(kElevation));
  BirdPose bird;
  bird.position = {0, 0, -kDistance};
  bird.forward = (0.75 * Vector3(1, 0, 0) + 0.66 * near).normalized();
  bird.up = {0, std::cos(kElevation), std::sin(kElevation)};
  bird.wings = wings;
  Image image(side, side, {0, 0, 0, 0});
  put_sprite(view_bird(bird, kDistance * side, side, side, colours), image);
  return image;
}

BirdPainter::BirdPainter(const TexturedMotion& model, Planes background, double magnification,
                         const BirdFlightOptions& options)
    : flock_(model, options), magnification_(magnification), background_(to_image(background)) {
  BirdColours none;
  for (std::size_t k = 0; k < 3; ++k) {
    const Plane& plane = background[background.size() == 3 ? k : 0];
    double sum = 0;
    for (const float value : plane.values) sum += static_cast<double>(value);
    none.haze[k] = static_cast<float>(sum / static_cast<double>(plane.values.size()));
  }
  const float grey = (none.haze[0] + none.haze[1] + none.haze[2]) / 3;
  for (const MovetonTemplate& birds : model.templates) {
    BirdColours colours = none;
    for (std::size_t k = 0; k < 3; ++k) {
      const float pale = 0.5F * (none.haze[k] + grey);
      colours.body[k] = birds.amplitude.mean < 0 ? kDarkShare * pale : 255 - kDarkShare * (255 - pale);
    }
    colours_.push_back(colours);
  }
  colours_.push_back(none);
}

const BirdColours& BirdPainter::colours_of(int species) const {
  const bool is_known = species >= 0 && species + 1 < static_cast<int>(colours_.size());
  return is_known ? colours_[static_cast<std::size_t>(species)] : colours_.back();
}

void BirdPainter::paint(const MovetonFrame& frame, Image& picture, Image& layer) {
  picture = background_;
  if (layer.width != picture.width || layer.height != picture.height) layer = Image(picture.width, picture.height);
  std::fill(layer.pixels.begin(), layer.pixels.end(), Rgba{0, 0, 0, 0});
  const double focal = flock_.focal() * magnification_;
  for (const BirdPose& bird : flock_.advance(frame)) {
    const BirdSprite sprite = view_bird(bird, focal, picture.width, picture.height, colours_of(bird.species));
    put_sprite(sprite, layer);
    put_sprite(sprite, picture);
  }
}

}  // namespace motex
