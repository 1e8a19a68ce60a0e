// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <set>

#include "motex/core/error.h"
#include "motex/motion_io/c3d.h"
#include "motex/motion_io/c3d_sections.h"
#include "motex/motion_io/markers_io.h"
#include "motex/motion_io/text_scanner.h"

namespace motex {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestPlace = 1e9;
constexpr double kClampedFrames = 65535;

/// The rows of the matrix are the file's axes that become x, y and z.
using Axes = Eigen::Matrix3d;

Vector3 screen_axis(const std::string& text) {
  Vector3 axis = Vector3::Zero();
  if (text.empty()) return axis;
  const char letter = text.back();
  const int k = letter >= 'x' && letter <= 'z' ? letter - 'x' : letter - 'X';
  if (k < 0 || k > 2) return axis;
  axis[k] = text.front() == '-' ? -1 : 1;
  return axis;
}

Axes axes_of(const C3dParameters& parameters, UpAxis up) {
  if (up != UpAxis::kAuto) return Axes::Identity();  // z is turned later, as for every reader
  const Vector3 vertical = screen_axis(parameters.text("POINT:Y_SCREEN"));
  if (vertical.isZero() || vertical == Vector3::UnitY()) return Axes::Identity();
  Vector3 right = screen_axis(parameters.text("POINT:X_SCREEN"));
  if (std::abs(right.dot(vertical)) > 0.5 || right.isZero())
    right = std::abs(vertical.x()) > 0.5 ? Vector3::UnitZ() : Vector3::UnitX();
  Axes axes;
  axes << right.transpose(), vertical.transpose(), right.cross(vertical).transpose();
  return axes;
}

/// Where the numbers of a frame lie and what they mean.
struct Layout {
  bool is_float = false;
  double scale = 1;
  std::size_t data_at = 0, frame_size = 0;  ///< bytes
  Index num_frames = 0;
};

class C3dReader {
 public:
  C3dReader(std::string_view bytes, const std::string& name, const ReadClipOptions& options, const JobContext& job)
      : name_(name),
        options_(options),
        job_(job),
        bytes_(bytes, name),
        header_(read_c3d_header(bytes_, job)),
        parameters_(bytes_, header_, job) {}

  MarkerSet read() {
    MarkerSet markers;
    markers.name = clip_name(name_);
    markers.metres_per_unit = unit();
    markers.frame_time_secs = 1 / frame_rate();
    const Layout layout = find_layout();
    const std::vector<int> points = choose_points(markers);
    const Axes axes = axes_of(parameters_, options_.up);
    markers.positions.resize(layout.num_frames, 3 * markers.num_markers());
    for (Index t = 0; t < layout.num_frames; ++t) {
      if (t % 1024 == 0) job_.check_cancelled();
      const std::size_t frame_at = layout.data_at + static_cast<std::size_t>(t) * layout.frame_size;
      for (int m = 0; m < markers.num_markers(); ++m)
        markers.set_position(t, m, axes * place(layout, frame_at, points[static_cast<std::size_t>(m)]));
    }
    return markers;
  }

 private:
  double unit() const {
    const std::string text = parameters_.text("POINT:UNITS");
    const double metres = metres_of_unit_name(text);
    if (metres == 0) job_.warn(name_ + ": the unit of length is not known; name it with --unit");
    return metres;
  }

  double frame_rate() const {
    if (options_.fps > 0) return options_.fps;
    for (const double rate : {parameters_.number("POINT:RATE").value_or(0), header_.frame_rate})
      if (rate >= 1e-3 && rate <= 1e5) return rate;
    bytes_.fail(20, "the file states no frame rate; name it with --fps");
  }

  Layout find_layout() const {
    if (header_.num_points == 0) bytes_.fail(2, "the file holds no marker, analog data at most");
    Layout layout;
    double scale = parameters_.number("POINT:SCALE").value_or(0);
    if (scale == 0 || !std::isfinite(scale)) scale = header_.scale;
    if (scale == 0 || !std::isfinite(scale)) bytes_.fail(12, "the scale of the coordinates is missing");
    layout.is_float = scale < 0;
    layout.scale = std::abs(scale);
    layout.data_at = header_.data_at;
    const double stated = parameters_.unsigned_number("POINT:DATA_START").value_or(0);
    if (layout.data_at == 0 && stated > 1) layout.data_at = (static_cast<std::size_t>(stated) - 1) * 512;
    if (layout.data_at == 0) bytes_.fail(16, "the file does not say where its data start");
    layout.frame_size =
        static_cast<std::size_t>(4 * header_.num_points + header_.analog_per_frame) * (layout.is_float ? 4 : 2);
    const std::size_t room = bytes_.size() > layout.data_at ? bytes_.size() - layout.data_at : 0;
    layout.num_frames =
        choose_num_frames(std::floor(static_cast<double>(room) / static_cast<double>(layout.frame_size)));
    return layout;
  }

  double trial_field(const std::string& name) const {
    const auto low = parameters_.unsigned_number(name, 0), high = parameters_.unsigned_number(name, 1);
    return low ? *low + 65536 * high.value_or(0) : 0;
  }

  Index choose_num_frames(double room) const {
    const double last = trial_field("TRIAL:ACTUAL_END_FIELD"), first = trial_field("TRIAL:ACTUAL_START_FIELD");
    const double in_header = header_.last_frame - header_.first_frame + 1;
    double largest = 0;
    bool skipped = false;
    for (double stated :
         {last > 0 ? last - std::max(first, 1.0) + 1 : 0, parameters_.number("POINT:LONG_FRAMES").value_or(0),
          parameters_.unsigned_number("POINT:FRAMES").value_or(0), in_header}) {
      if (!(stated >= 1) || !std::isfinite(stated)) continue;
      stated = std::floor(stated);
      if (stated == kClampedFrames && room > stated) {
        job_.warn(name_ + ": states 65535 frames and holds more; all " + std::to_string(static_cast<Index>(room)) +
                  " are used");
        return static_cast<Index>(room);
      }
      largest = std::max(largest, stated);
      if (stated <= room) {
        if (skipped)
          job_.warn(name_ + ": its statements of the number of frames differ; " +
                    std::to_string(static_cast<Index>(stated)) + " are used");
        return static_cast<Index>(stated);
      }
      skipped = true;
    }
    if (largest == 0) bytes_.fail(6, "the file holds no frame");
    bytes_.fail(bytes_.size(), "the file ends after " + std::to_string(static_cast<Index>(room)) + " of its " +
                                   std::to_string(static_cast<Index>(largest)) + " frames; it was cut off");
  }

  /// The points that are places; fills the names.
  std::vector<int> choose_points(MarkerSet& markers) const {
    std::set<std::string> no_places;
    for (const char* kind : {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS"})
      for (const std::string& label : parameters_.all_texts(std::string("POINT:") + kind))
        if (!label.empty()) no_places.insert(label);
    const std::vector<std::string> labels = parameters_.all_texts("POINT:LABELS");
    std::vector<int> points;
    for (int p = 0; p < header_.num_points; ++p) {
      const auto idx = static_cast<std::size_t>(p);
      const std::string label = idx < labels.size() ? labels[idx] : "";
      if (no_places.count(label) > 0) continue;
      points.push_back(p);
      markers.names.push_back(label);
    }
    if (points.empty()) bytes_.fail(2, "the file holds angles and forces but no marker");
    const int left_out = header_.num_points - static_cast<int>(points.size());
    if (left_out > 0)
      job_.warn(name_ + ": " + std::to_string(left_out) + " points that are angles, forces or the like are left out");
    markers.names = distinct_marker_names(std::move(markers.names));
    return points;
  }

  Vector3 place(const Layout& layout, std::size_t frame_at, int point) const {
    const std::size_t size = layout.is_float ? 4 : 2, at = frame_at + 4 * size * static_cast<std::size_t>(point);
    const auto value = [&](std::size_t k) {
      return layout.is_float ? static_cast<double>(bytes_.real(at + size * k))
                             : static_cast<double>(bytes_.signed_word(at + size * k));
    };
    Vector3 p(value(0), value(1), value(2));
    if (!layout.is_float) p *= layout.scale;
    const bool missing = value(3) < 0 || !(p.cwiseAbs().maxCoeff() < kLargestPlace) || !p.allFinite() || p.isZero(0);
    return missing ? Vector3::Constant(kNaN) : p;
  }

  std::string name_;
  const ReadClipOptions& options_;
  const JobContext& job_;
  C3dBytes bytes_;
  C3dHeader header_;
  C3dParameters parameters_;
};

}  // namespace

MarkerSet read_c3d_bytes(std::string_view bytes, const std::string& name, const ReadClipOptions& options,
                         const JobContext& job) {
  return C3dReader(bytes, name, options, job).read();
}

}  // namespace motex
