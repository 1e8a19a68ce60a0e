// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/video_io/libav_source.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/parallel.h"

namespace motex::libav {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;
constexpr int kMaxThreads = 8;

bool says_alpha(const AVStream& stream) {
  const AVDictionaryEntry* entry = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
  return entry != nullptr && std::string(entry->value) == "1";
}

/// The default decoders of VP8 and VP9 drop alpha without a word.
const AVCodec* decoder_for(const AVStream& stream) {
  const AVCodecID id = stream.codecpar->codec_id;
  const AVCodec* decoder = nullptr;
  if (says_alpha(stream) && id == AV_CODEC_ID_VP8) decoder = avcodec_find_decoder_by_name("libvpx");
  if (says_alpha(stream) && id == AV_CODEC_ID_VP9) decoder = avcodec_find_decoder_by_name("libvpx-vp9");
  return decoder != nullptr ? decoder : avcodec_find_decoder(id);
}

double ratio(AVRational value) { return value.num > 0 && value.den > 0 ? av_q2d(value) : 0; }

bool same_time(double a, double b, double frame_secs) { return std::abs(a - b) < 0.25 * frame_secs; }

}  // namespace

LibavSource::LibavSource(std::unique_ptr<InputBytes> input, const std::string& name, const JobContext& job)
    : input_(std::move(input)), job_(job), frame_(new_frame()), packet_(new_packet()) {
  info_.name = name;
  restart();
  if (!decode()) throw UnsupportedFile(name + ": no frame of it can be decoded; the file is damaged or cut off");
  has_pending_ = true;
  describe();
}

LibavSource::~LibavSource() = default;

void LibavSource::restart() {
  codec_.reset();
  demuxer_.reset();
  demuxer_.emplace(*input_, info_.name, job_);
  open_codec();
  draining_ = has_ended_ = has_pending_ = false;
  idx_ = -1;
  num_damaged_ = 0;
}

void LibavSource::open_codec() {
  const AVStream& stream = demuxer_->stream();
  const AVCodec* decoder = decoder_for(stream);
  if (decoder == nullptr)
    throw UnsupportedFile(info_.name + ": there is no decoder for " + avcodec_get_name(stream.codecpar->codec_id));
  codec_.reset(avcodec_alloc_context3(decoder));
  if (codec_ == nullptr) throw std::bad_alloc();
  int code = avcodec_parameters_to_context(codec_.get(), stream.codecpar);
  codec_->pkt_timebase = stream.time_base;
  codec_->max_pixels = kMaxPixels;
  codec_->thread_count = std::min(num_threads(job_.jobs), kMaxThreads);
  if (code >= 0) code = avcodec_open2(codec_.get(), decoder, nullptr);
  if (code < 0) throw UnsupportedFile(info_.name + ": " + decoder->name + " cannot decode it: " + error_text(code));
}

void LibavSource::describe() {
  const AVStream& stream = demuxer_->stream();
  const Orientation orientation = orientation_of(av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  converter_.set_size(frame_->width, frame_->height, orientation);
  const bool upright = orientation.quarter_turns % 2 == 0;
  info_.container = demuxer_->format().iformat->name;
  info_.codec = avcodec_get_name(stream.codecpar->codec_id);
  const char* pixel_format = av_get_pix_fmt_name(static_cast<AVPixelFormat>(frame_->format));
  info_.pixel_format = pixel_format == nullptr ? "unknown" : pixel_format;
  info_.width = upright ? frame_->width : frame_->height;
  info_.height = upright ? frame_->height : frame_->width;
  if (info_.width > 32768 || info_.height > 32768)
    throw UnsupportedFile(info_.name + ": frames with more than 32768 pixels a side cannot be read");
  info_.num_channels = num_channels_of(frame_->format);
  info_.bit_depth = bit_depth_of(frame_->format);
  info_.coarse_colour = has_coarse_colour(frame_->format);
  info_.rotation_deg = 90 * orientation.quarter_turns;
  info_.mirrored = orientation.mirrored;
  const double aspect =
      ratio(av_guess_sample_aspect_ratio(&demuxer_->format(), const_cast<AVStream*>(&stream), nullptr));
  info_.pixel_aspect = aspect <= 0 ? 1 : upright ? aspect : 1 / aspect;
  info_.frames_per_sec = ratio(stream.avg_frame_rate) > 0 ? ratio(stream.avg_frame_rate) : ratio(stream.r_frame_rate);
  info_.num_frames_said = std::max<std::int64_t>(0, stream.nb_frames);
  if (stream.duration > 0)
    info_.duration_secs = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  else if (demuxer_->format().duration > 0)
    info_.duration_secs = static_cast<double>(demuxer_->format().duration) / AV_TIME_BASE;
  info_.has_sound = av_find_best_stream(&demuxer_->format(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0) >= 0;
  if (frame_->best_effort_timestamp != AV_NOPTS_VALUE)
    first_secs_ = static_cast<double>(frame_->best_effort_timestamp) * av_q2d(stream.time_base);
  info_.start_secs = first_secs_;
}

bool LibavSource::feed() {
  const int code = draining_ ? AVERROR_EOF : demuxer_->read(*packet_);
  if (draining_) return false;
  if (code < 0) {
    draining_ = true;
    cut_off_ = code != AVERROR_EOF;
    avcodec_send_packet(codec_.get(), nullptr);
    return true;
  }
  if (avcodec_send_packet(codec_.get(), packet_.get()) < 0) ++num_damaged_;
  return true;
}

bool LibavSource::decode() {
  for (;;) {
    job_.check_cancelled();
    const int code = avcodec_receive_frame(codec_.get(), frame_.get());
    if (code == 0) {
      if (frame_->width <= 0 || frame_->height <= 0 || frame_->data[0] == nullptr) continue;
      if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0) ++num_damaged_;
      return true;
    }
    if (code == AVERROR_EOF) return false;
    if (code != AVERROR(EAGAIN)) ++num_damaged_;
    if (!feed()) return false;
  }
}

void LibavSource::take_time() {
  const AVStream& stream = demuxer_->stream();
  const double usual_step = info_.frames_per_sec > 0 ? 1 / info_.frames_per_sec : 0.04;
  const double before = time_secs_;
  const bool known = frame_->best_effort_timestamp != AV_NOPTS_VALUE;
  if (known) time_secs_ = static_cast<double>(frame_->best_effort_timestamp) * av_q2d(stream.time_base) - first_secs_;
  // Time stamps that are missing or run backwards are replaced by the usual step.
  if (idx_ > 0 && (!known || time_secs_ <= before)) time_secs_ = before + usual_step;
  if (idx_ == 0) time_secs_ = std::max(0.0, time_secs_);
  if (idx_ > 0) longest_step_secs_ = std::max(longest_step_secs_, time_secs_ - before);
  const bool resized = info_.rotation_deg % 180 == 0 ? frame_->width != info_.width || frame_->height != info_.height
                                                     : frame_->width != info_.height || frame_->height != info_.width;
  if (resized && !warned_size_) {
    warned_size_ = true;
    job_.warn(info_.name + ": the size changes at frame " + std::to_string(idx_) +
              "; later frames are scaled to that of the first");
  }
}

bool LibavSource::advance() {
  if (has_ended_) return false;
  if (!has_pending_ && !decode()) {
    finish();
    return false;
  }
  has_pending_ = false;
  ++idx_;
  take_time();
  return true;
}

void LibavSource::finish() {
  has_ended_ = true;
  if (warned_ || has_sought_) return;
  const std::int64_t num_read = idx_ + 1, said = info_.num_frames_said;
  // Matroska counts no frames; there the length tells.
  const double secs_missing = info_.duration_secs - time_secs_ - 2 * longest_step_secs_;
  const bool too_short = said > 0 ? num_read < said : !info_.has_sound && longest_step_secs_ > 0 && secs_missing > 0.1;
  if (!cut_off_ && num_damaged_ == 0 && !too_short) return;
  warned_ = true;
  const std::string trouble = num_damaged_ > 0 ? "is damaged in " + std::to_string(num_damaged_) + " places or cut off"
                                               : "is cut off or its header is wrong";
  job_.warn(info_.name + ": " + trouble + ": " + std::to_string(num_read) +
            (said > num_read ? " of " + std::to_string(said) : std::string()) + " frames could be read and are used");
}

void LibavSource::to_image(Image& image) const { converter_.to_image(*frame_, image); }
void LibavSource::to_planes(Planes& planes) const { converter_.to_planes(*frame_, planes); }

void LibavSource::to_preview(Image& image, int width, int height) const {
  const Orientation orientation = converter_.orientation();
  const bool upright = orientation.quarter_turns % 2 == 0;
  reducer_.set_size(upright ? width : height, upright ? height : width, orientation);
  reducer_.to_image(*frame_, image);
}

std::vector<double> LibavSource::frame_times() {
  if (times_.empty()) scan_times();
  return times_;
}

void LibavSource::scan_times() {
  std::unique_ptr<InputBytes> again = input_->again();
  if (again == nullptr) throw InvalidInput(info_.name + ": a pipe cannot be read twice; save it as a file first");
  JobContext quiet = job_;
  quiet.on_warning = nullptr;
  {
    Demuxer scan(*again, info_.name, quiet);
    PacketTimes found = packet_times(scan);
    times_ = std::move(found.shown), key_times_ = std::move(found.keys);
  }
  for (auto* times : {&times_, &key_times_}) {
    for (double& time : *times) time -= first_secs_;
    times->erase(times->begin(), std::find_if(times->begin(), times->end(), [](double time) { return time > -1e-6; }));
  }
  const bool strictly_rising = std::adjacent_find(times_.begin(), times_.end(), std::greater_equal<>()) == times_.end();
  if (!times_.empty() && strictly_rising) return;
  times_.clear(), key_times_.clear();
  LibavSource whole(input_->again(), info_.name, quiet);
  while (whole.advance()) times_.push_back(whole.time_secs());
}

bool LibavSource::is_ahead(std::int64_t idx) const {
  if (has_ended_ || idx <= idx_) return false;
  const double next = times_[static_cast<std::size_t>(idx_ + 1)], target = times_[static_cast<std::size_t>(idx)];
  const auto key = std::upper_bound(key_times_.begin(), key_times_.end(), target + 1e-6);
  return key == key_times_.begin() || *(key - 1) <= next + 1e-6;
}

bool LibavSource::decode_to(std::int64_t idx) {
  const double target = times_[static_cast<std::size_t>(idx)];
  const double step = 1 / (info_.frames_per_sec > 0 ? info_.frames_per_sec : 25);
  while (has_pending_ || decode()) {
    has_pending_ = false;
    if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) return false;
    const double time =
        static_cast<double>(frame_->best_effort_timestamp) * av_q2d(demuxer_->stream().time_base) - first_secs_;
    if (!same_time(time, target, step)) {
      if (time < target) continue;
      return false;
    }
    has_pending_ = true;
    idx_ = idx - 1;
    time_secs_ = idx > 0 ? times_[static_cast<std::size_t>(idx - 1)] : 0;
    return true;
  }
  return false;
}

void LibavSource::seek(std::int64_t idx) {
  if (times_.empty()) scan_times();
  has_sought_ = idx > 0;
  if (idx < 0 || idx >= static_cast<std::int64_t>(times_.size())) {
    has_ended_ = true;
    return;
  }
  if (is_ahead(idx) && decode_to(idx)) return;
  const AVStream& stream = demuxer_->stream();
  const double target = times_[static_cast<std::size_t>(idx)] + first_secs_;
  const auto ticks = static_cast<std::int64_t>(std::floor(target / av_q2d(stream.time_base)));
  if (idx > 8 && av_seek_frame(&demuxer_->format(), stream.index, ticks, AVSEEK_FLAG_BACKWARD) >= 0) {
    avcodec_flush_buffers(codec_.get());
    draining_ = has_ended_ = has_pending_ = false;
    if (decode_to(idx)) return;
  }
  restart();  // the container cannot be sought in exactly: from the beginning
  while (idx_ + 1 < idx && decode()) ++idx_;
  time_secs_ = idx > 0 ? times_[static_cast<std::size_t>(idx - 1)] : 0;
}

}  // namespace motex::libav
