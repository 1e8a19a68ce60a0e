// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/trackmate_xml.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "motex/core/csv.h"
#include "motex/core/xml_escape.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

constexpr const char* kHeading = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::string number(double value) { return rounded_text(value, 6); }
std::string number(std::int64_t value) { return std::to_string(value); }
std::string number(std::size_t value) { return std::to_string(value); }
std::string number(int value) { return std::to_string(value); }

template <typename T>
void attribute(std::string& xml, const char* name, const T& value) {
  xml += ' ';
  xml += name;
  xml += "=\"";
  if constexpr (std::is_arithmetic_v<T>)
    xml += number(value);
  else
    xml += xml_escaped(value);
  xml += '"';
}

struct FeatureName {
  const char *key, *name, *short_name, *dimension;
  bool is_int;
};
constexpr FeatureName kSpotFeatures[] = {{"QUALITY", "Quality", "Quality", "QUALITY", false},
                                         {"POSITION_X", "X", "X", "POSITION", false},
                                         {"POSITION_Y", "Y", "Y", "POSITION", false},
                                         {"POSITION_Z", "Z", "Z", "POSITION", false},
                                         {"POSITION_T", "T", "T", "TIME", false},
                                         {"FRAME", "Frame", "Frame", "NONE", true},
                                         {"RADIUS", "Radius", "R", "LENGTH", false},
                                         {"VISIBILITY", "Visibility", "Visibility", "NONE", true},
                                         {"AMPLITUDE", "Amplitude", "Amp.", "INTENSITY", false},
                                         {"ANGLE", "Angle", "Angle", "ANGLE", false}};
constexpr FeatureName kEdgeFeatures[] = {{"SPOT_SOURCE_ID", "Source spot ID", "Source ID", "NONE", true},
                                         {"SPOT_TARGET_ID", "Target spot ID", "Target ID", "NONE", true},
                                         {"LINK_COST", "Edge cost", "Cost", "COST", false},
                                         {"SPEED", "Speed", "Speed", "VELOCITY", false},
                                         {"DISPLACEMENT", "Displacement", "Disp.", "LENGTH", false},
                                         {"EDGE_TIME", "Edge time", "Edge T", "TIME", false}};
constexpr FeatureName kTrackFeatures[] = {{"TRACK_INDEX", "Track index", "Index", "NONE", true},
                                          {"TRACK_ID", "Track ID", "ID", "NONE", true},
                                          {"NUMBER_SPOTS", "Number of spots in track", "N spots", "NONE", true},
                                          {"NUMBER_GAPS", "Number of gaps", "N gaps", "NONE", true},
                                          {"TRACK_DURATION", "Track duration", "Duration", "TIME", false},
                                          {"TRACK_START", "Track start", "Track start", "TIME", false},
                                          {"TRACK_STOP", "Track stop", "Track stop", "TIME", false},
                                          {"TRACK_DISPLACEMENT", "Track displacement", "Track disp.", "LENGTH", false}};

template <std::size_t kNum>
void declare_features(std::string& xml, const char* element, const FeatureName (&features)[kNum]) {
  xml += std::string("      <") + element + ">\n";
  for (const FeatureName& feature : features) {
    xml += "        <Feature";
    attribute(xml, "feature", std::string_view(feature.key));
    attribute(xml, "name", std::string_view(feature.name));
    attribute(xml, "shortname", std::string_view(feature.short_name));
    attribute(xml, "dimension", std::string_view(feature.dimension));
    attribute(xml, "isint", std::string_view(feature.is_int ? "true" : "false"));
    xml += " />\n";
  }
  xml += std::string("      </") + element + ">\n";
}

struct Spot {
  std::int64_t id;
  const TrackPoint* point;
};

class SessionWriter {
 public:
  SessionWriter(const std::vector<Track>& tracks, const TrackedClip& clip) : tracks_(tracks), clip_(clip) {}

  std::string write() {
    xml_ = std::string(kHeading) + "<TrackMate version=\"7.11.1\">\n  <Log>Tracks made by motex.</Log>\n  <Model";
    attribute(xml_, "spatialunits", clip_.length_unit);
    attribute(xml_, "timeunits", clip_.time_unit);
    xml_ += ">\n    <FeatureDeclarations>\n";
    declare_features(xml_, "SpotFeatures", kSpotFeatures);
    declare_features(xml_, "EdgeFeatures", kEdgeFeatures);
    declare_features(xml_, "TrackFeatures", kTrackFeatures);
    xml_ += "    </FeatureDeclarations>\n";
    write_spots();
    write_tracks();
    xml_ += "  </Model>\n";
    write_settings();
    xml_ += "  <GUIState state=\"ConfigureViews\" />\n  <DisplaySettings />\n</TrackMate>\n";
    return std::move(xml_);
  }

 private:
  double time_of(const TrackPoint& point) const { return static_cast<double>(point.frame) * clip_.frame_interval; }
  double distance(const TrackPoint& a, const TrackPoint& b) const {
    return std::hypot(b.x - a.x, b.y - a.y) * clip_.pixel_size;
  }

  void write_spots() {
    std::map<std::int64_t, std::vector<Spot>> frames;
    std::int64_t id = 0;
    for (const Track& track : tracks_)
      for (const TrackPoint& point : track.points) frames[point.frame].push_back({id++, &point});
    xml_ += "    <AllSpots";
    attribute(xml_, "nspots", id);
    xml_ += ">\n";
    for (const auto& [frame, spots] : frames) {
      xml_ += "      <SpotsInFrame";
      attribute(xml_, "frame", frame);
      xml_ += ">\n";
      for (const Spot& spot : spots) write_spot(spot);
      xml_ += "      </SpotsInFrame>\n";
    }
    xml_ += "    </AllSpots>\n";
  }

  void write_spot(const Spot& spot) {
    const TrackPoint& point = *spot.point;
    const double scale = point.scale > 0 ? point.scale : 1;
    xml_ += "        <Spot";
    attribute(xml_, "ID", spot.id);
    attribute(xml_, "name", "ID" + std::to_string(spot.id));
    attribute(xml_, "QUALITY", std::abs(point.amplitude));
    attribute(xml_, "POSITION_T", time_of(point));
    attribute(xml_, "VISIBILITY", 1);
    attribute(xml_, "FRAME", point.frame);
    attribute(xml_, "RADIUS", std::numbers::sqrt2 * scale * clip_.pixel_size);
    attribute(xml_, "POSITION_X", point.x * clip_.pixel_size);
    attribute(xml_, "POSITION_Y", point.y * clip_.pixel_size);
    attribute(xml_, "POSITION_Z", 0);
    attribute(xml_, "AMPLITUDE", point.amplitude);
    attribute(xml_, "ANGLE", point.angle);
    xml_ += " />\n";
  }

  void write_tracks() {
    std::string filtered;
    std::int64_t first_id = 0, index = 0;
    xml_ += "    <AllTracks>\n";
    for (const Track& track : tracks_) {
      if (track.points.size() > 1) {
        write_track(track, first_id, index++);
        filtered += "      <TrackID";
        attribute(filtered, "TRACK_ID", track.id);
        filtered += " />\n";
      }
      first_id += static_cast<std::int64_t>(track.points.size());
    }
    xml_ += "    </AllTracks>\n    <FilteredTracks>\n" + filtered + "    </FilteredTracks>\n";
  }

  void write_track(const Track& track, std::int64_t first_id, std::int64_t index) {
    const TrackPoint &first = track.points.front(), &last = track.points.back();
    std::int64_t num_gaps = 0;
    for (std::size_t k = 1; k < track.points.size(); ++k)
      num_gaps += track.points[k].frame > track.points[k - 1].frame + 1 ? 1 : 0;
    xml_ += "      <Track";
    attribute(xml_, "name", "Track_" + std::to_string(track.id));
    attribute(xml_, "TRACK_INDEX", index);
    attribute(xml_, "TRACK_ID", track.id);
    attribute(xml_, "NUMBER_SPOTS", track.points.size());
    attribute(xml_, "NUMBER_GAPS", num_gaps);
    attribute(xml_, "TRACK_DURATION", time_of(last) - time_of(first));
    attribute(xml_, "TRACK_START", time_of(first));
    attribute(xml_, "TRACK_STOP", time_of(last));
    attribute(xml_, "TRACK_DISPLACEMENT", distance(first, last));
    xml_ += ">\n";
    for (std::size_t k = 1; k < track.points.size(); ++k) {
      const TrackPoint &from = track.points[k - 1], &to = track.points[k];
      const double way = distance(from, to), time = time_of(to) - time_of(from);
      const std::int64_t source = first_id + static_cast<std::int64_t>(k) - 1;
      xml_ += "        <Edge";
      attribute(xml_, "SPOT_SOURCE_ID", source);
      attribute(xml_, "SPOT_TARGET_ID", source + 1);
      attribute(xml_, "LINK_COST", way * way);
      attribute(xml_, "SPEED", time > 0 ? way / time : 0.0);
      attribute(xml_, "DISPLACEMENT", way);
      attribute(xml_, "EDGE_TIME", (time_of(from) + time_of(to)) / 2);
      xml_ += " />\n";
    }
    xml_ += "      </Track>\n";
  }

  /// The reader stops at a file without these, whatever they say.
  void write_settings() {
    xml_ += "  <Settings>\n    <ImageData";
    attribute(xml_, "filename", clip_.file_name);
    attribute(xml_, "folder", clip_.folder);
    attribute(xml_, "width", clip_.width);
    attribute(xml_, "height", clip_.height);
    attribute(xml_, "nslices", 1);
    attribute(xml_, "nframes", clip_.num_frames);
    attribute(xml_, "pixelwidth", clip_.pixel_size);
    attribute(xml_, "pixelheight", clip_.pixel_size);
    attribute(xml_, "voxeldepth", 1);
    attribute(xml_, "timeinterval", clip_.frame_interval);
    xml_ += " />\n    <BasicSettings";
    for (const char* start : {"xstart", "ystart", "zstart", "tstart"}) attribute(xml_, start, 0);
    attribute(xml_, "xend", std::max(0, clip_.width - 1));
    attribute(xml_, "yend", std::max(0, clip_.height - 1));
    attribute(xml_, "zend", 0);
    attribute(xml_, "tend", std::max<std::int64_t>(0, clip_.num_frames - 1));
    xml_ += " />\n    <DetectorSettings DETECTOR_NAME=\"MANUAL_DETECTOR\"";
    attribute(xml_, "RADIUS", 2 * clip_.pixel_size);
    xml_ +=
        " />\n    <InitialSpotFilter feature=\"QUALITY\" value=\"0.0\" isabove=\"true\" />\n"
        "    <SpotFilterCollection />\n    <TrackerSettings TRACKER_NAME=\"MANUAL_TRACKER\" />\n"
        "    <TrackFilterCollection />\n    <AnalyzerCollection>\n      <SpotAnalyzers />\n      <EdgeAnalyzers />\n"
        "      <TrackAnalyzers />\n    </AnalyzerCollection>\n  </Settings>\n";
  }

  const std::vector<Track>& tracks_;
  const TrackedClip& clip_;
  std::string xml_;
};

}  // namespace

std::string trackmate_xml(const std::vector<Track>& tracks, const TrackedClip& clip) {
  const std::vector<Track> visible = clip.width > 0 ? visible_part(tracks, clip.width, clip.height) : tracks;
  return SessionWriter(visible, clip).write();
}

std::string trackmate_simple_xml(const std::vector<Track>& tracks, const TrackedClip& clip) {
  const std::vector<Track> visible = clip.width > 0 ? visible_part(tracks, clip.width, clip.height) : tracks;
  std::string xml = std::string(kHeading) + "<Tracks";
  attribute(xml, "nTracks", visible.size());
  attribute(xml, "spaceUnits", clip.length_unit);
  attribute(xml, "frameInterval", clip.frame_interval);
  attribute(xml, "timeUnits", clip.time_unit);
  attribute(xml, "from", std::string_view("motex"));
  xml += ">\n";
  for (const Track& track : visible) {
    xml += "  <particle";
    attribute(xml, "nSpots", track.points.size());
    xml += ">\n";
    for (const TrackPoint& point : track.points) {
      xml += "    <detection";
      attribute(xml, "t", point.frame);
      attribute(xml, "x", point.x * clip.pixel_size);
      attribute(xml, "y", point.y * clip.pixel_size);
      attribute(xml, "z", 0);
      xml += " />\n";
    }
    xml += "  </particle>\n";
  }
  return xml + "</Tracks>\n";
}

}  // namespace motex
