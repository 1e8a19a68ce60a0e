// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/compress_clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/clip_codec.h"
#include "motex/particles/plane_codec.h"
#include "motex/particles/pursuit.h"
#include "motex/particles/refine.h"

namespace motex {
namespace {

constexpr double kShareOfBases = 0.10;       // of the squared error that quantising bases may add
constexpr double kShareOfBackground = 0.02;  // and the background
constexpr double kNumbersPerBase = 3;        // that add an error of that size
constexpr double kHold = 0.75;               // a number stays until it is that many steps off

double squared_error(const Planes& a, const Planes& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].values.size(); ++i) {
      const double d = static_cast<double>(a[k].values[i]) - static_cast<double>(b[k].values[i]);
      sum += d * d;
    }
  return sum;
}

Planes nothing(Planes like) {
  for (Plane& plane : like) std::fill(plane.values.begin(), plane.values.end(), 0.0F);
  return like;
}

/// Joint least squares of the coefficients of each plane.
void refit(BaseMap& map, const Planes& target) {
  std::vector<BasePatch> patches;
  for (const Base& base : map.bases) patches.push_back(render_patch(base, map.width, map.height));
  std::vector<float> fit(map.bases.size(), 0);
  for (std::size_t k = 0; k < target.size(); ++k) {
    fit = fit_coefficients(target[k], patches, fit);
    for (std::size_t j = 0; j < fit.size(); ++j) map.bases[j].coefficients[k] = fit[j];
  }
}

std::int32_t rounded(double value) { return static_cast<std::int32_t>(std::lround(std::clamp(value, -1e6, 1e6))); }
/// Stays at `before` while that is near enough.
std::int32_t held(double value, std::int32_t before) {
  return std::abs(value - before) <= kHold ? before : rounded(value);
}

/// A base, and where its number stands.
struct Slot {
  std::size_t cable;
  int path;  ///< −1 = the core, else the coil
  std::size_t idx;
};

class Quantiser {
 public:
  /// clip: null = the cables' own coefficients are kept, and `noise` is the error of a pixel.
  Quantiser(const ClipFrames* clip, const Planes& background, const std::vector<Cable>& cables, double noise,
            QuantisedClip sizes, const CompressClipOptions& options, const JobContext& job)
      : clip_(clip),
        background_(background),
        cables_(cables),
        noise_(noise),
        options_(options),
        job_(job),
        out_(std::move(sizes)) {}

  QuantisedClip run() {
    choose_steps();
    out_.background = decoded_background();
    for (const Cable& cable : cables_) add(cable);
    if (clip_ != nullptr) fit_coefficients_again();
    drop_what_is_nothing();
    sort_for_coding(out_);
    return std::move(out_);
  }

 private:
  Planes decoded_background() const {
    RangeWriter writer;
    write_planes(writer, background_, static_cast<double>(out_.background_step));
    const std::string bytes = writer.finish();
    RangeReader reader(bytes, "background");
    return read_planes(reader, out_.width, out_.height, out_.num_planes, static_cast<double>(out_.background_step));
  }

  /// Squared error of one plane, from what the bases leave in a few frames.
  void choose_steps() {
    const int num_seen = static_cast<int>(std::min<std::int64_t>(8, out_.num_frames));
    const double pixels = static_cast<double>(out_.width) * out_.height * num_seen;
    double error = clip_ == nullptr ? noise_ * noise_ * pixels * out_.num_planes : 0, num_bases = 0;
    for (int k = 0; k < num_seen; ++k) {
      const int frame = static_cast<int>((k + 0.5) * static_cast<double>(out_.num_frames) / num_seen);
      const BaseMap map = bases_in_frame(cables_, frame, out_.width, out_.height, out_.num_planes);
      num_bases += static_cast<double>(map.bases.size());
      if (clip_ != nullptr) error += squared_error(reconstruct(map, background_), frame_planes(*clip_, frame));
    }
    error /= out_.num_planes;
    num_bases = std::max(1.0, num_bases);
    const double bases = std::sqrt(12 * kShareOfBases * error / (kNumbersPerBase * num_bases)),
                 still = std::sqrt(12 * kShareOfBackground * error / pixels);
    out_.coefficient_step =
        static_cast<float>(options_.coefficient_step > 0 ? options_.coefficient_step : std::clamp(bases, 0.5, 1e5));
    out_.background_step =
        static_cast<float>(options_.background_step > 0 ? options_.background_step : std::clamp(still, 0.5, 64.0));
  }

  bool is_seen(const Cable& cable, std::size_t idx) const {
    const auto seen = [&](const Base& base) {
      const BaseReach reach = reach_of(base);
      return base.x + reach.x > 0 && base.y + reach.y > 0 && base.x - reach.x < out_.width - 1 &&
             base.y - reach.y < out_.height - 1;
    };
    if (seen(cable.core[idx])) return true;
    return std::any_of(cable.coils.begin(), cable.coils.end(),
                       [&](const std::vector<Base>& coil) { return seen(coil[idx]); });
  }

  void add(const Cable& cable) {
    std::size_t first = 0, last = cable.core.size();
    while (first < last && (cable.first_frame + static_cast<std::int64_t>(first) < 0 || !is_seen(cable, first)))
      ++first;
    while (last > first &&
           (cable.first_frame + static_cast<std::int64_t>(last) > out_.num_frames || !is_seen(cable, last - 1)))
      --last;
    if (first == last) return;
    QuantisedCable& quantised = out_.cables.emplace_back();
    quantised.first_frame = cable.first_frame + static_cast<std::int64_t>(first);
    quantised.core = path_of(cable.core, first, last);
    for (const std::vector<Base>& coil : cable.coils) quantised.coils.push_back(path_of(coil, first, last));
  }

  /// Places, scales and angles; coefficients for now as they are.
  QuantisedPath path_of(const std::vector<Base>& bases, std::size_t first, std::size_t last) const {
    QuantisedPath path;
    path.kind = bases[first].kind;
    double strength = 0, scale = 0;
    for (std::size_t k = first; k < last; ++k) {
      strength += std::abs(luma_coefficient(bases[k], out_.num_planes)) / static_cast<double>(last - first);
      scale += std::log2(bases[k].scale) / static_cast<double>(last - first);
    }
    const double step =
        std::min(1.0, std::numbers::sqrt2 * static_cast<double>(out_.coefficient_step) / std::max(1e-9, strength)) *
        std::exp2(scale);
    path.precision = std::clamp(static_cast<int>(std::floor(std::log2(step))), kFinestPlace, kCoarsestPlace);
    const bool turns = is_oriented(path.kind);
    const double half_turns = std::floor(bases[first].angle / std::numbers::pi);
    const double unit = std::ldexp(1.0, -path.precision);
    for (std::size_t k = first; k < last; ++k) {
      const Base& base = bases[k];
      QuantisedState& state = path.states.emplace_back();
      const QuantisedState* before = k > first ? &path.states[path.states.size() - 2] : nullptr;
      state.x = rounded(base.x * unit);
      state.y = rounded(base.y * unit);
      const double octave = std::clamp(kScaleLevels * std::log2(base.scale), -2.0 * kScaleLevels, 6.0 * kScaleLevels);
      state.scale = before == nullptr ? rounded(octave) : held(octave, before->scale);
      if (turns) {
        const double angle = (base.angle / std::numbers::pi - half_turns) * kAngleLevels;
        state.angle = before == nullptr ? rounded(angle) : held(angle, before->angle);
      }
      const float sign = path.kind == BaseKind::kGaborSin && std::fmod(half_turns, 2) != 0 ? -1.0F : 1.0F;
      if (clip_ == nullptr)
        set_coefficients(path, path.states.size() - 1,
                         {sign * base.coefficients[0], sign * base.coefficients[1], sign * base.coefficients[2]});
    }
    return path;
  }

  QuantisedPath& path_at(const Slot& slot) {
    QuantisedCable& cable = out_.cables[slot.cable];
    return slot.path < 0 ? cable.core : cable.coils[static_cast<std::size_t>(slot.path)];
  }

  void fit_coefficients_again() {
    std::vector<std::vector<Slot>> slots(static_cast<std::size_t>(out_.num_frames));
    for (std::size_t k = 0; k < out_.cables.size(); ++k) {
      const QuantisedCable& cable = out_.cables[k];
      for (std::size_t idx = 0; idx < cable.core.states.size(); ++idx)
        for (int path = -1; path < static_cast<int>(cable.coils.size()); ++path)
          slots[static_cast<std::size_t>(cable.first_frame) + idx].push_back({k, path, idx});
    }
    std::vector<std::vector<std::array<float, 3>>> fits(slots.size());
    parallel_for(job_.jobs, static_cast<int>(slots.size()), [&](int frame) {
      job_.check_cancelled();
      fits[static_cast<std::size_t>(frame)] = fit_frame(frame, slots[static_cast<std::size_t>(frame)]);
    });
    for (std::size_t frame = 0; frame < slots.size(); ++frame)  // in time, for what is held
      for (std::size_t j = 0; j < slots[frame].size(); ++j)
        set_coefficients(path_at(slots[frame][j]), slots[frame][j].idx, fits[frame][j]);
  }

  std::vector<std::array<float, 3>> fit_frame(int frame, const std::vector<Slot>& slots) {
    BaseMap map{out_.width, out_.height, out_.num_planes, {}};
    for (const Slot& slot : slots) {
      const QuantisedPath& path = path_at(slot);
      map.bases.push_back(dequantised(out_, path, path.states[slot.idx]));
    }
    refit(map, minus(frame_planes(*clip_, frame), out_.background));
    std::vector<std::array<float, 3>> fits;
    for (const Base& base : map.bases) fits.push_back(base.coefficients);
    return fits;
  }

  void set_coefficients(QuantisedPath& path, std::size_t idx, const std::array<float, 3>& fit) const {
    QuantisedState& state = path.states[idx];
    const QuantisedState* before = idx > 0 ? &path.states[idx - 1] : nullptr;
    double luma = static_cast<double>(fit[0]), blue = static_cast<double>(fit[1]), red = static_cast<double>(fit[2]);
    const auto step = static_cast<double>(out_.coefficient_step);
    if (out_.num_planes == 3) {
      to_luma_and_differences(luma, blue, red);
      state.blue = quantised(blue / (1.5 * step), before == nullptr ? nullptr : &before->blue);
      state.red = quantised(red / (1.5 * step), before == nullptr ? nullptr : &before->red);
    }
    state.luma = quantised(luma / step, before == nullptr ? nullptr : &before->luma);
  }

  static std::int32_t quantised(double value, const std::int32_t* before) {
    if (before != nullptr) return held(value, *before);
    return static_cast<std::int32_t>(std::copysign(std::floor(std::min(std::abs(value), 1e6) + 0.4), value));
  }

  static bool is_nothing(const QuantisedState& state) { return state.luma == 0 && state.blue == 0 && state.red == 0; }

  void drop_what_is_nothing() {
    const auto dark = [](const QuantisedPath& path) {
      return std::all_of(path.states.begin(), path.states.end(), is_nothing);
    };
    for (QuantisedCable& cable : out_.cables) std::erase_if(cable.coils, dark);
    std::erase_if(out_.cables, [&](const QuantisedCable& cable) { return cable.coils.empty() && dark(cable.core); });
  }

  const ClipFrames* clip_;
  const Planes& background_;
  const std::vector<Cable>& cables_;
  double noise_;
  const CompressClipOptions& options_;
  const JobContext& job_;
  QuantisedClip out_;
};

}  // namespace

QuantisedClip quantise_clip(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                            const CompressClipOptions& options, const JobContext& job) {
  check_options(options);
  if (clip.num_frames() == 0) throw InvalidInput("a clip without frames cannot be compressed");
  if (static_cast<int>(background.size()) != clip.num_planes())
    throw InvalidInput("the background must have as many planes as the clip");
  for (const Plane& plane : background)
    if (plane.width != clip.width || plane.height != clip.height)
      throw InvalidInput("the background must be as large as the clip");
  QuantisedClip sizes;
  sizes.width = clip.width;
  sizes.height = clip.height;
  sizes.num_planes = clip.num_planes();
  sizes.num_frames = clip.num_frames();
  sizes.frames_per_sec = static_cast<float>(clip.frames_per_sec);
  return Quantiser(&clip, background, cables, 0, std::move(sizes), options, job).run();
}

QuantisedClip quantise_cables(const TexturedMotion& model, const CompressClipOptions& options) {
  check_options(options);
  if (static_cast<int>(model.background.size()) != model.num_planes || model.num_frames < 1)
    throw InvalidInput("a model without background or frames has no clip to compress");
  QuantisedClip sizes;
  sizes.width = model.width;
  sizes.height = model.height;
  sizes.num_planes = model.num_planes;
  sizes.num_frames = model.num_frames;
  sizes.frames_per_sec = static_cast<float>(model.frames_per_sec);
  return Quantiser(nullptr, model.background, model.cables, std::max(1.0, model.noise), std::move(sizes), options, {})
      .run();
}

std::string compress_clip(const ClipFrames& clip, const Planes& background, const std::vector<Cable>& cables,
                          const CompressClipOptions& options, const JobContext& job, CompressClipReport* report) {
  const QuantisedClip quantised = quantise_clip(clip, background, cables, options, job);
  std::string bytes = write_clip_bytes(quantised, background);
  if (report == nullptr) return bytes;
  const std::vector<Cable> decoded = dequantised_cables(quantised);
  std::vector<double> quality(static_cast<std::size_t>(clip.num_frames()));
  parallel_for(job.jobs, clip.num_frames(), [&](int frame) {
    quality[static_cast<std::size_t>(frame)] =
        std::min(100.0, psnr(decoded_frame(quantised, decoded, frame), frame_planes(clip, frame)));
  });
  *report = {};
  for (const double value : quality) report->psnr += value / static_cast<double>(quality.size());
  report->raw_bytes =
      std::int64_t{1} * clip.width * clip.height * quantised.num_planes * static_cast<std::int64_t>(clip.num_frames());
  report->bytes = static_cast<std::int64_t>(bytes.size());
  RangeWriter still;
  write_planes(still, background, static_cast<double>(quantised.background_step));
  report->background_bytes = static_cast<std::int64_t>(still.finish().size());
  double num_bases = 0;
  for (const Cable& cable : decoded)
    num_bases += static_cast<double>(cable.core.size()) * static_cast<double>(1 + cable.coils.size());
  report->bases_per_frame = num_bases / clip.num_frames();
  report->bits_per_base =
      num_bases > 0 ? 8 * static_cast<double>(report->bytes - report->background_bytes) / num_bases : 0;
  return bytes;
}

Planes decoded_frame(const QuantisedClip& clip, const std::vector<Cable>& cables, std::int64_t frame) {
  return reconstruct(bases_in_frame(cables, frame, clip.width, clip.height, clip.num_planes), clip.background);
}

std::vector<Cable> with_free_bases(const ClipFrames& clip, const Planes& background, std::vector<Cable> cables,
                                   int num_bases, const JobContext& job) {
  std::vector<std::vector<Cable>> frames(static_cast<std::size_t>(clip.num_frames()));
  parallel_for(job.jobs, clip.num_frames(), [&](int frame) {
    job.check_cancelled();
    const Planes target = minus(frame_planes(clip, frame), background);
    BaseMap map = bases_in_frame(cables, frame, clip.width, clip.height, clip.num_planes());
    PursueOptions options;
    options.num_bases = num_bases - static_cast<int>(map.bases.size());
    if (options.num_bases < 1) return;
    const JobContext silent{nullptr, nullptr, job.cancel, 1};
    refit(map, target);
    for (Base& base : pursue(minus(target, reconstruct(map, nothing(background))), options, silent).bases) {
      Cable& cable = frames[static_cast<std::size_t>(frame)].emplace_back();
      cable.first_frame = frame;
      cable.core.push_back(base);
    }
  });
  for (std::vector<Cable>& frame : frames)
    cables.insert(cables.end(), std::make_move_iterator(frame.begin()), std::make_move_iterator(frame.end()));
  return cables;
}

}  // namespace motex
