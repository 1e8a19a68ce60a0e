// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/simulate_actor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

using std::numbers::pi;
using J = PuppetJoint;

constexpr double kCameraMetres = 6, kCameraHeight = 1.1;
constexpr double kBodyShare = 0.62;  // of the picture's height that a standing body takes
constexpr double kBodyMetres = 1.72, kReachMetres = 2.1;
constexpr double kShortestIdleSecs = 0.35, kUsualIdleSecs = 0.9;
constexpr int kBlurSamples = 5;

std::vector<int> chosen_actions(const std::string& text) {
  std::vector<int> out;
  const auto& names = actor_actions();
  if (text.empty())
    for (std::size_t k = 0; k < names.size(); ++k) out.push_back(static_cast<int>(k));
  for (std::size_t at = 0; !text.empty() && at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string word = text.substr(at, end - at);
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      std::string all;
      for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
      throw InvalidInput("--actions: there is no action '" + word + "'; there are " + all);
    }
    out.push_back(static_cast<int>(found - names.begin()));
    at = end + 1;
  }
  return out;
}

/// Mean of premultiplied pictures taken while the shutter was open.
Sprite mean_of(const std::vector<Sprite>& sprites) {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  for (const Sprite& one : sprites) {
    if (one.empty()) continue;
    left = std::min(left, one.left), top = std::min(top, one.top);
    right = std::max(right, one.left + one.width), bottom = std::max(bottom, one.top + one.height);
  }
  Sprite out;
  if (right < 0) return out;
  out.left = left, out.top = top, out.width = right - left, out.height = bottom - top;
  const auto size = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  std::vector<std::array<int, 4>> sums(size);
  for (const Sprite& one : sprites)
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x) {
        auto& sum = sums[static_cast<std::size_t>(one.top + y - top) * static_cast<std::size_t>(out.width) +
                         static_cast<std::size_t>(one.left + x - left)];
        for (std::size_t k = 0; k < 4; ++k) sum[k] += one.at(x, y)[k];
      }
  const int count = static_cast<int>(sprites.size());
  for (const auto& sum : sums) {
    PremultipliedRgba& pixel = out.pixels.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) pixel[k] = static_cast<std::uint8_t>((sum[k] + count / 2) / count);
  }
  return out;
}

}  // namespace

ActorSimulation::ActorSimulation(const SimulateActorOptions& options)
    : options_((check_options(options), options)),
      stage_(options.width, options.height,
             {options.screen, options.unevenness, options.shadow, options.noise, options.seed}) {
  const auto one = [this](const char* joint) { columns_.push_back({body_.column(joint), body_.column(joint), 0}); };
  const auto between = [this](const char* joint, const char* tip, double weight) {
    columns_.push_back({body_.column(joint), body_.tip_column(tip), weight});
  };
  // In the order of PuppetJoint.
  between("head", "head", 0.45);
  between("head", "head", 0.45);
  one("neck");
  one("hip");
  for (const std::string side : {"l", "r"}) {
    for (const char* joint : {"Shldr", "ForeArm", "Hand"}) one((side + joint).c_str());
    between((side + "Hand").c_str(), (side + "Hand").c_str(), 1);
    for (const char* joint : {"Thigh", "Shin", "Foot"}) one((side + joint).c_str());
    between((side + "Foot").c_str(), (side + "Foot").c_str(), 1);
  }
  const std::vector<int> actions = chosen_actions(options_.actions);
  const double slot = options_.width / static_cast<double>(options_.persons);
  for (int k = 0; k < options_.persons; ++k) {
    Rng rng = Rng(options_.seed).fork(10 + static_cast<std::uint64_t>(k));
    Person& person = persons_.emplace_back();
    person.x = slot * (k + 0.5);
    person.yaw = rng.uniform(0.25, 0.5) * (k % 2 == 0 ? 1 : -1);
    person.pixels_per_metre = std::min(kBodyShare * options_.height / kBodyMetres, slot / kReachMetres);
    person.phase = rng.uniform(0, 2 * pi);
    person.look = puppet_look(k + static_cast<int>(options_.seed % 4) - 1);
    schedule(actions, k);
  }
  std::sort(performances_.begin(), performances_.end(), [](const ActorPerformance& a, const ActorPerformance& b) {
    return a.start != b.start ? a.start < b.start : a.person < b.person;
  });
}

void ActorSimulation::schedule(const std::vector<int>& actions, int person) {
  Rng rng = Rng(options_.seed).fork(100 + static_cast<std::uint64_t>(person));
  const auto frames_of = [this](double secs) { return static_cast<int>(std::lround(secs * options_.frames_per_sec)); };
  const int shortest = frames_of(options_.repetitions == 0 ? kUsualIdleSecs : kShortestIdleSecs);
  std::vector<ActorPerformance> list;
  int used = shortest;
  const auto num_wanted = static_cast<std::int64_t>(actions.size()) * options_.repetitions;
  for (std::size_t k = 0; options_.repetitions == 0 || static_cast<std::int64_t>(k) < num_wanted; ++k) {
    const int action = actions[k % actions.size()];
    const int length = frames_of(body_.duration_secs(action) * rng.uniform(0.95, 1.05));
    if (used + length + shortest > options_.frames) {
      if (options_.repetitions == 0) break;
      throw InvalidInput("--repetitions: " + std::to_string(num_wanted) + " performances do not fit into " +
                         std::to_string(options_.frames) + " frames; ask for more --frames or fewer repetitions");
    }
    used += length + shortest;
    list.push_back({0, length, action, person, rng.uniform(0.9, 1.1)});
  }
  for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[rng.below(k)]);
  std::vector<double> shares{0};
  for (std::size_t k = 0; k <= list.size(); ++k) shares.push_back(shares.back() + rng.uniform(0.5, 1.5));
  int at = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const int spare = options_.frames - used;
    list[k].start = at + shortest + static_cast<int>(spare * shares[k + 1] / shares.back());
    at += list[k].length + shortest;
  }
  persons_[static_cast<std::size_t>(person)].performances = list;
  performances_.insert(performances_.end(), list.begin(), list.end());
}

PuppetPoint ActorSimulation::seen(const Person& person, const Vector3& place) const {
  const double c = std::cos(person.yaw), s = std::sin(person.yaw);
  const double x = c * place.x() + s * place.z(), z = -s * place.x() + c * place.z();
  const double distance = std::max(1.0, kCameraMetres - z);
  const double scale = person.pixels_per_metre * kCameraMetres / distance;
  // The middle of a standing body is somewhat below that of the picture.
  const double floor = 0.5 * options_.height + 0.53 * kBodyMetres * person.pixels_per_metre;
  const double horizon = floor - kCameraHeight * person.pixels_per_metre;
  return {person.x + x * scale, horizon - (place.y() - kCameraHeight) * scale, distance, scale};
}

PuppetPose ActorSimulation::pose(double number, int person_idx) const {
  const Person& person = persons_[static_cast<std::size_t>(person_idx)];
  ActorBody::Moment moment{number / options_.frames_per_sec, person.phase};
  for (const ActorPerformance& one : person.performances)
    if (number > one.start && number < one.start + one.length)
      moment.action = one.action, moment.share = (number - one.start) / one.length, moment.amplitude = one.amplitude;
  const auto places = body_.positions(moment);
  PuppetPose out;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const JointColumns& at = columns_[k];
    out.joints[k] = seen(person, (1 - at.weight) * places.col(at.first) + at.weight * places.col(at.second));
  }
  // The face lies before the middle of the head, across the shoulders.
  const Vector3 up = (places.col(columns_[0].second) - places.col(body_.column("neck"))).normalized();
  const Vector3 left = places.col(body_.column("lShldr")) - places.col(body_.column("rShldr"));
  const Vector3 middle = 0.55 * places.col(columns_[0].first) + 0.45 * places.col(columns_[0].second);
  out.at(J::kFace) = seen(person, middle + 0.045 * left.cross(up).normalized() - 0.02 * up);
  return out;
}

Sprite ActorSimulation::sprite(int number, int person) const {
  const auto draw = [&](double time) {
    return draw_puppet(pose(time, person), persons_[static_cast<std::size_t>(person)].look, options_.width,
                       options_.height, {PuppetStage::screen_colour(options_.screen), options_.spill});
  };
  if (options_.motion_blur <= 0) return draw(number);
  std::vector<Sprite> open;
  for (int k = 0; k < kBlurSamples; ++k)
    open.push_back(draw(number + options_.motion_blur * ((k + 0.5) / kBlurSamples - 0.5)));
  return mean_of(open);
}

ActorSimulation::Frame ActorSimulation::frame(int number) const {
  Frame out{stage_.screen(), Image(options_.width, options_.height, {0, 0, 0, 255})};
  for (int k = 0; k < options_.persons; ++k) {
    const PuppetPose body = pose(number, k);
    const PuppetPoint &left = body.at(J::kLeftAnkle), &right = body.at(J::kRightAnkle);
    stage_.shade_floor(out.image, 0.5 * (left.x + right.x), std::max(left.y, right.y) + 4,
                       persons_[static_cast<std::size_t>(k)].pixels_per_metre);
  }
  for (int k = 0; k < options_.persons; ++k) {
    Sprite body = sprite(number, k);
    paint(out.image, body);
    for (PremultipliedRgba& pixel : body.pixels) pixel = {pixel[3], pixel[3], pixel[3], pixel[3]};
    paint(out.matte, body);
  }
  stage_.add_noise(out.image, number);
  return out;
}

}  // namespace motex
