// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/clip_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "motex/core/archive.h"
#include "motex/core/error.h"
#include "motex/particles/plane_codec.h"
#include "motex/particles/range_coder.h"

namespace motex {
namespace {

constexpr std::string_view kMagic = "\x89MTXC\r\n";
constexpr std::uint32_t kNewestVersion = 2;  // with streaks; clips without them are version 1
constexpr std::int64_t kMostPixels = std::int64_t{1} << 24;
constexpr std::int64_t kMostFrames = 10'000'000;
constexpr std::size_t kChecksumSize = 4;
constexpr std::int64_t kMostPlace = 1 << 20;  ///< in units of the precision
constexpr int kVelocityShift = 4;             ///< mean velocities in 1/16 pixel
constexpr int kMostScale = 10 * kScaleLevels;

/// Models of one number by its context.
template <std::size_t kContexts>
struct Numbers {
  std::array<NumberModel, kContexts> models;
  NumberModel& operator[](std::size_t context) { return models[context]; }
};

struct ClipModels {
  NumberModel num_births, block_gap, num_coils;
  BitModel streak;  // version 2
  std::array<BitModel, 3> kind;
  Numbers<kNumBaseKinds> scale, luma, blue, red;  // by kind
  Numbers<4> precision;
  Numbers<3> angle;  // by oriented kind
  NumberModel place_outside;
  BitModel inside;
  std::array<std::array<BitModel, 8>, 2> place_digit;  // the upper half of a block or the lower, and on
  std::array<BitModel, 8> goes_on;                     // by age
  Numbers<12> step_x, step_y;                          // by precision and by how far the last one was off
  Numbers<4> scale_step, luma_step, blue_step, red_step, angle_step;
  Numbers<kNumBaseKinds> coil_x, coil_y;
  Numbers<1> coil_scale, coil_luma;
};

std::size_t kind_idx(BaseKind kind) { return static_cast<std::size_t>(kind); }

std::size_t size_class(std::int32_t value) {
  const std::int32_t size = std::abs(value);
  return size == 0 ? 0 : size == 1 ? 1 : size < 4 ? 2 : 3;
}

/// a / 2^shift, rounded to the nearest.
std::int32_t shifted(std::int32_t value, int shift) {
  return shift <= 0 ? value << -shift : (value + (1 << (shift - 1))) >> shift;
}

/// One who lives: where it is in the clip and what it did last.
struct Living {
  std::size_t cable = 0;
  std::int32_t age = 1;
  std::int32_t velocity_x = 0, velocity_y = 0;  ///< units of its precision
  std::int32_t miss = 0;                        ///< of the last prediction
};

/// The part after the background, for writing and reading alike.
template <typename Coder>
class ClipCoder {
 public:
  /// most_states: a reader gives up beyond it.
  ClipCoder(Coder& coder, QuantisedClip& clip, std::uint32_t version, bool reads, std::int64_t most_states)
      : coder_(coder), clip_(clip), version_(version), reads_(reads), states_left_(most_states) {}

  void code() {
    persistence_ = static_cast<std::int32_t>(coder_.raw(static_cast<std::uint32_t>(persistence_), 5));
    std::size_t next = 0;
    for (std::int64_t frame = 0; frame < clip_.num_frames; ++frame) {
      code_living(frame);
      next = code_births(frame, next);
    }
  }
  void set_persistence(std::int32_t sixteenths) { persistence_ = sixteenths; }

 private:
  void count_state() {
    if (--states_left_ < 0) coder_.fail("more elements than a file of this size can hold; it is damaged");
  }
  std::int32_t in_range(std::int32_t value, std::int64_t most) {
    if (value > most || value < -most) coder_.fail("a number is out of range");
    return value;
  }

  void code_living(std::int64_t frame) {
    std::size_t kept = 0;
    for (Living one : living_) {  // those that go on move forward in the same list
      QuantisedCable& cable = clip_.cables[one.cable];
      const auto idx = static_cast<std::size_t>(frame - cable.first_frame);
      const std::size_t age = static_cast<std::size_t>(std::min(one.age - 1, 7));
      const bool goes_on = coder_.bit(models_.goes_on[age], !reads_ && idx < cable.core.states.size());
      if (!goes_on) continue;
      code_step(cable, idx, one);
      living_[kept++] = one;
    }
    living_.resize(kept);
  }

  QuantisedState& state_at(QuantisedPath& path, std::size_t idx) {
    if (reads_) {
      count_state();
      path.states.push_back(path.states.back());
    }
    return path.states[idx];
  }

  void code_step(QuantisedCable& cable, std::size_t idx, Living& one) {
    QuantisedPath& path = cable.core;
    QuantisedState& now = state_at(path, idx);
    const QuantisedState before = path.states[idx - 1];
    const int finer = path.precision + kVelocityShift;  // 1/16 pixels to units
    const std::int32_t mean_x = shifted(mean_x_, finer), mean_y = shifted(mean_y_, finer);
    const auto expected = [&](std::int32_t own, std::int32_t mean) {
      return one.age < 2 ? mean : shifted(persistence_ * own + (16 - persistence_) * mean, 4);
    };
    const std::int32_t to_x = before.x + expected(one.velocity_x, mean_x),
                       to_y = before.y + expected(one.velocity_y, mean_y);
    const std::size_t sight = one.age < 2 ? 3 : size_class(one.miss) > 2 ? 2 : size_class(one.miss);
    const std::size_t context = sight * 3 + static_cast<std::size_t>(std::clamp(path.precision + 2, 0, 2));
    const std::int32_t miss_x = code_number(coder_, models_.step_x[context], now.x - to_x),
                       miss_y = code_number(coder_, models_.step_y[context], now.y - to_y);
    now.x = in_range(to_x + in_range(miss_x, kMostPlace), kMostPlace);
    now.y = in_range(to_y + in_range(miss_y, kMostPlace), kMostPlace);
    one.velocity_x = now.x - before.x;
    one.velocity_y = now.y - before.y;
    one.miss = std::max(std::abs(miss_x), std::abs(miss_y));
    one.age = std::min(one.age + 1, 1000);
    mean_x_ += shifted(shifted(one.velocity_x, -finer) - mean_x_, 5);
    mean_y_ += shifted(shifted(one.velocity_y, -finer) - mean_y_, 5);
    code_looks(path.kind, before, now);
    for (QuantisedPath& coil : cable.coils) {
      QuantisedState& coil_now = state_at(coil, idx);
      const QuantisedState coil_before = coil.states[idx - 1];
      const int shift = coil.precision - path.precision;
      const std::size_t kind = kind_idx(coil.kind);
      const std::int32_t coil_x = coil_before.x + shifted(one.velocity_x, shift),
                         coil_y = coil_before.y + shifted(one.velocity_y, shift);
      coil_now.x = in_range(coil_x + code_number(coder_, models_.coil_x[kind], coil_now.x - coil_x), kMostPlace);
      coil_now.y = in_range(coil_y + code_number(coder_, models_.coil_y[kind], coil_now.y - coil_y), kMostPlace);
      code_looks(coil.kind, coil_before, coil_now);
    }
  }

  void code_looks(BaseKind base_kind, const QuantisedState& before, QuantisedState& now) {
    const std::size_t kind = kind_idx(base_kind);
    const auto change = [&](NumberModel& model, std::int32_t old, std::int32_t& value, std::int64_t most) {
      value = in_range(old + code_number(coder_, model, value - old), most);
    };
    change(models_.scale_step[kind], before.scale, now.scale, kMostScale);
    change(models_.luma_step[size_class(before.luma)], before.luma, now.luma, 1 << 26);
    if (clip_.num_planes == 3) {
      change(models_.blue_step[size_class(before.blue)], before.blue, now.blue, 1 << 26);
      change(models_.red_step[size_class(before.red)], before.red, now.red, 1 << 26);
    }
    if (is_oriented(base_kind)) change(models_.angle_step[kind], before.angle, now.angle, 1 << 20);
  }

  std::size_t code_births(std::int64_t frame, std::size_t next) {
    std::int32_t num_births = 0;
    if (!reads_)
      while (next + static_cast<std::size_t>(num_births) < clip_.cables.size() &&
             clip_.cables[next + static_cast<std::size_t>(num_births)].first_frame == frame)
        ++num_births;
    num_births = code_count(coder_, models_.num_births, num_births);
    std::int32_t block = 0;
    const std::int32_t columns = (clip_.width + kPlaceBlock - 1) / kPlaceBlock,
                       num_blocks = columns * ((clip_.height + kPlaceBlock - 1) / kPlaceBlock);
    for (std::int32_t k = 0; k < num_births; ++k, ++next) {
      if (reads_) {
        count_state();
        clip_.cables.emplace_back().first_frame = frame;
        clip_.cables.back().core.states.resize(1);
      }
      QuantisedCable& cable = clip_.cables[next];
      block += code_count(coder_, models_.block_gap, reads_ ? 0 : birth_block(clip_, cable.core) - block);
      if (block >= num_blocks) coder_.fail("a place is out of range");
      code_birth_of_core(cable.core, block % columns, block / columns);
      code_birth_of_coils(cable);
      living_.push_back({next, 1, 0, 0, 0});
    }
    return next;
  }

  void code_kind(BaseKind& kind) {
    const std::size_t value = kind_idx(kind);
    if (version_ >= 2 && coder_.bit(models_.streak, kind == BaseKind::kStreak)) {
      kind = BaseKind::kStreak;
      return;
    }
    const bool high = coder_.bit(models_.kind[0], value >= 2);
    const bool low = coder_.bit(models_.kind[high ? 2 : 1], value % 2 == 1);
    kind = static_cast<BaseKind>((high ? 2 : 0) + (low ? 1 : 0));
  }

  void code_birth_of_core(QuantisedPath& path, std::int32_t column, std::int32_t row) {
    code_kind(path.kind);
    QuantisedState& state = path.states.front();
    const std::size_t kind = kind_idx(path.kind);
    state.scale = in_range(code_number(coder_, models_.scale[kind], state.scale), kMostScale);
    state.luma = in_range(code_number(coder_, models_.luma[kind], state.luma), 1 << 26);
    code_precision(path);
    code_colour_and_angle(path, state);
    state.x = code_place(0, state.x, path.precision, column * kPlaceBlock);
    state.y = code_place(1, state.y, path.precision, row * kPlaceBlock);
  }

  void code_precision(QuantisedPath& path) {
    NumberModel& model = models_.precision[size_class(path.states.front().luma / 3)];
    path.precision = code_number(coder_, model, path.precision);
    if (path.precision < kFinestPlace || path.precision > kCoarsestPlace) coder_.fail("a precision is out of range");
  }

  void code_colour_and_angle(const QuantisedPath& path, QuantisedState& state) {
    const std::size_t kind = kind_idx(path.kind);
    if (clip_.num_planes == 3) {
      state.blue = in_range(code_number(coder_, models_.blue[kind], state.blue), 1 << 26);
      state.red = in_range(code_number(coder_, models_.red[kind], state.red), 1 << 26);
    }
    if (is_oriented(path.kind))
      state.angle = in_range(code_number(coder_, models_.angle[path.kind == BaseKind::kStreak ? 2 : kind - 1],
                                         state.angle - kAngleLevels / 2),
                             1 << 20) +
                    kAngleLevels / 2;
  }

  /// Within the block digit by digit; outside of it (beyond the picture's edges) as a number.
  std::int32_t code_place(std::size_t axis, std::int32_t place, int precision, std::int32_t start_px) {
    const int num_digits = 3 - precision;  // a block is 2³ pixels
    const std::int32_t start = precision >= 0 ? start_px >> precision : start_px << -precision;
    const std::int32_t offset = place - start;
    if (!coder_.bit(models_.inside, offset < 0 || offset >> num_digits != 0)) {
      std::uint32_t value = 0;
      for (int k = num_digits - 1; k >= 0; --k) {
        const bool digit = (static_cast<std::uint32_t>(offset) >> k & 1U) != 0;
        value = value << 1U | static_cast<std::uint32_t>(coder_.bit(
                                  models_.place_digit[axis][static_cast<std::size_t>(num_digits - 1 - k)], digit));
      }
      return start + static_cast<std::int32_t>(value);
    }
    return in_range(start + in_range(code_number(coder_, models_.place_outside, offset), kMostPlace), kMostPlace);
  }

  void code_birth_of_coils(QuantisedCable& cable) {
    const std::int32_t num_coils = code_count(coder_, models_.num_coils, static_cast<std::int32_t>(cable.coils.size()));
    const QuantisedState core = cable.core.states.front();
    for (std::int32_t k = 0; k < num_coils; ++k) {
      if (reads_) {
        count_state();
        cable.coils.emplace_back().states.resize(1);
      }
      QuantisedPath& coil = cable.coils[static_cast<std::size_t>(k)];
      QuantisedState& state = coil.states.front();
      code_kind(coil.kind);
      state.scale =
          in_range(core.scale + code_number(coder_, models_.coil_scale[0], state.scale - core.scale), kMostScale);
      state.luma = in_range(code_number(coder_, models_.coil_luma[0], state.luma), 1 << 26);
      code_precision(coil);
      code_colour_and_angle(coil, state);
      const int shift = coil.precision - cable.core.precision;
      const std::int32_t x = shifted(core.x, shift), y = shifted(core.y, shift);
      const std::size_t kind = kind_idx(coil.kind);
      state.x = in_range(x + code_number(coder_, models_.coil_x[kind], state.x - x), kMostPlace);
      state.y = in_range(y + code_number(coder_, models_.coil_y[kind], state.y - y), kMostPlace);
    }
  }

  Coder& coder_;
  QuantisedClip& clip_;
  std::uint32_t version_;
  bool reads_;
  std::int64_t states_left_;
  ClipModels models_;
  std::vector<Living> living_;
  std::int32_t persistence_ = 16;         ///< φ in sixteenths
  std::int32_t mean_x_ = 0, mean_y_ = 0;  ///< velocity of all, 1/16 pixels a frame
};

/// Header fields, little-endian.
class HeaderReader {
 public:
  HeaderReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}
  template <typename T>
  T take() {
    if (at_ + sizeof(T) > bytes_.size()) fail("ends within its header");
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  void skip(std::size_t num_bytes) { at_ += num_bytes; }
  std::size_t at() const { return at_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(name_, ParseError::Unit::kByte, static_cast<std::int64_t>(at_), message);
  }

 private:
  const std::string& bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

template <typename T>
void put(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

bool is_step(float step) { return step >= 1e-3F && step <= 1e6F; }

std::uint32_t version_of(const QuantisedClip& clip) {
  const auto is_streak = [](const QuantisedPath& path) { return path.kind == BaseKind::kStreak; };
  const bool any = std::any_of(clip.cables.begin(), clip.cables.end(), [&](const QuantisedCable& cable) {
    return is_streak(cable.core) || std::any_of(cable.coils.begin(), cable.coils.end(), is_streak);
  });
  return any ? 2 : 1;
}

/// φ by least squares over all steps, in sixteenths.
std::int32_t persistence_of(const QuantisedClip& clip) {
  double xx = 0, xy = 0, x = 0, y = 0, n = 0;
  for (const QuantisedCable& cable : clip.cables) {
    const std::vector<QuantisedState>& s = cable.core.states;
    for (std::size_t k = 2; k < s.size(); ++k)
      for (const auto& [z0, z1, z2] : {std::tuple{s[k - 2].x, s[k - 1].x, s[k].x}, {s[k - 2].y, s[k - 1].y, s[k].y}}) {
        const double unit = std::ldexp(1.0, cable.core.precision), before = unit * (z1 - z0), after = unit * (z2 - z1);
        xx += before * before;
        xy += before * after;
        x += before;
        y += after;
        n += 1;
      }
  }
  if (n < 10) return 16;
  const double variance = xx - x * x / n;
  return variance > 0 ? static_cast<std::int32_t>(std::clamp(std::lround(16 * (xy - x * y / n) / variance), 0L, 16L))
                      : 16;
}

}  // namespace

std::string write_clip_bytes(const QuantisedClip& clip, const Planes& background) {
  std::string bytes(kMagic);
  const std::uint32_t version = version_of(clip);
  put(bytes, version);
  put(bytes, static_cast<std::uint32_t>(clip.width));
  put(bytes, static_cast<std::uint32_t>(clip.height));
  put(bytes, static_cast<std::uint8_t>(clip.num_planes));
  put(bytes, static_cast<std::uint32_t>(clip.num_frames));
  put(bytes, clip.frames_per_sec);
  put(bytes, clip.coefficient_step);
  put(bytes, clip.background_step);
  RangeWriter writer;
  write_planes(writer, background, static_cast<double>(clip.background_step));
  QuantisedClip sorted = clip;
  sort_for_coding(sorted);
  ClipCoder<RangeWriter> coder(writer, sorted, version, false, 0);
  coder.set_persistence(persistence_of(sorted));
  coder.code();
  bytes += writer.finish();
  put(bytes, archive_checksum(bytes));
  return bytes;
}

QuantisedClip read_clip_bytes(const std::string& bytes, const std::string& name) {
  HeaderReader header(bytes, name);
  if (bytes.compare(0, kMagic.size(), kMagic) != 0) header.fail("is no clip compressed by motex");
  header.skip(kMagic.size());
  const auto version = header.take<std::uint32_t>();
  if (version > kNewestVersion) throw UnsupportedFile(name + ": made by a newer motex; update this one");
  QuantisedClip clip;
  const std::int64_t width = header.take<std::uint32_t>(), height = header.take<std::uint32_t>();
  clip.num_planes = header.take<std::uint8_t>();
  clip.num_frames = header.take<std::uint32_t>();
  clip.frames_per_sec = header.take<float>();
  clip.coefficient_step = header.take<float>();
  clip.background_step = header.take<float>();
  if (width < 1 || height < 1 || width > 32768 || height > 32768 || width * height > kMostPixels ||
      (clip.num_planes != 1 && clip.num_planes != 3) || clip.num_frames < 1 || clip.num_frames > kMostFrames ||
      !is_step(clip.frames_per_sec) || !is_step(clip.coefficient_step) || !is_step(clip.background_step))
    header.fail("a size or step in the header is out of range");
  std::uint32_t checksum = 0;
  const std::size_t end = bytes.size() - kChecksumSize;
  if (bytes.size() < header.at() + kChecksumSize) header.fail("ends within its header");
  std::memcpy(&checksum, bytes.data() + end, sizeof checksum);
  if (checksum != archive_checksum(std::string_view(bytes).substr(0, end)))
    header.fail("is cut off or damaged: its checksum is wrong");
  clip.width = static_cast<int>(width);
  clip.height = static_cast<int>(height);
  RangeReader reader(std::string_view(bytes).substr(header.at(), end - header.at()), name,
                     static_cast<std::int64_t>(header.at()));
  clip.background =
      read_planes(reader, clip.width, clip.height, clip.num_planes, static_cast<double>(clip.background_step));
  ClipCoder<RangeReader>(reader, clip, version, true, 65536 + 16 * static_cast<std::int64_t>(bytes.size())).code();
  return clip;
}

}  // namespace motex
