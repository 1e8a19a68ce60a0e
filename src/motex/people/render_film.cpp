// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/render_film.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/align_sprites.h"
#include "motex/people/carried_placement.h"
#include "motex/people/cut_smoothness.h"
#include "motex/people/film_frames.h"
#include "motex/people/transition.h"

namespace motex {

const char* name_of(TransitionRenderer renderer) {
  switch (renderer) {
    case TransitionRenderer::kAuto:
      return "auto";
    case TransitionRenderer::kFieldMorph:
      return "morph";
    case TransitionRenderer::kFlow:
      return "flow";
    case TransitionRenderer::kCrossDissolve:
      return "dissolve";
    case TransitionRenderer::kHardCut:
      return "cut";
  }
  return "";
}

class FilmRenderer::Playback {
 public:
  Playback(const PeopleTexture& texture, SpriteSource& sprites, const EditList& edits, const RenderFilmOptions& options,
           const JobContext& job)
      : texture_(texture),
        sprites_(sprites),
        edits_(edits),
        options_(options),
        job_(job),
        film_(film_frames(texture, edits)),
        scales_(second_difference_scales(texture)),
        carried_(texture.width, texture.height) {
    check_options(options);
    if (sprites.num_frames() != texture.num_frames())
      throw InvalidInput("the people texture has " + std::to_string(texture.num_frames()) + " frames, its sprites " +
                         std::to_string(sprites.num_frames()));
  }

  int num_frames() const { return static_cast<int>(film_.size()); }
  const std::vector<CutReport>& cuts() const { return cuts_; }

  bool next(Sprite& sprite) {
    job_.check_cancelled();
    if (position_ == film_.size()) return false;
    if (position_ == 0 && edits_.loop) close_loop();
    const FilmFrame& now = film_[position_];
    if (now.cut >= 0)
      sprite = show_transition(now);
    else
      sprite = show_footage(now);
    ++position_;
    return true;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  bool enters_shot() const { return position_ > 0 && film_[position_ - 1].shot != film_[position_].shot; }

  Sprite show_footage(const FilmFrame& now) {
    std::shared_ptr<const Sprite> shown = sprites_.sprite(now.frame);
    if (enters_shot() && film_[position_ - 1].cut < 0) hard_cut(now, *shown);
    if (now.shot + 1 == static_cast<int>(edits_.shots.size()) && aim_) aim_at_start(now);
    const bool goes_on = before_ != nullptr && before_frame_ + 1 == now.frame;
    const Placement placement = carried_.next(goes_on ? before_.get() : nullptr, *shown);
    Sprite sprite = placed(*shown, placement);
    before_ = std::move(shown), before_frame_ = now.frame;
    return sprite;
  }

  /// A cut without transition: what plays at the same instant lies on one another.
  void hard_cut(const FilmFrame& now, const Sprite& shown) {
    CutReport report;
    report.cut = now.shot - 1;
    if (before_ != nullptr) {
      const Placement before = carried_.placement_of(*before_);
      report.placement = entering_placement(placed(*before_, before), shown, edits_.shots[at(now.shot)]);
    }
    carried_.set(shown, report.placement);
    cuts_.push_back(report);
  }

  /// Where the take that is entered lies best on what is shown. Footage that the frame's edge cuts off is never moved
  /// away from that edge.
  Placement entering_placement(const Sprite& shown, const Sprite& entered, const Shot& shot) const {
    if (!options_.align) return {};
    bool left = false, right = false, top = false, bottom = false;
    for (int f = shot.first; f <= shot.last; ++f) {
      const BoundingBox& box = texture_.silhouettes[at(f)].box;
      if (box.empty()) continue;
      left |= box.left <= 0, right |= box.right >= texture_.width - 1;
      top |= box.top <= 0, bottom |= box.bottom >= texture_.height - 1;
    }
    AlignSpritesOptions align;
    if (left || right || top || bottom) align = {1, 1};
    Placement placement = align_sprites(shown, entered, align).placement;
    if (left) placement.x = std::min(placement.x, 0.0);
    if (right) placement.x = std::max(placement.x, 0.0);
    if (top) placement.y = std::min(placement.y, 0.0);
    if (bottom) placement.y = std::max(placement.y, 0.0);
    return placement;
  }

  /// Frames of the cut's transition as film_frames() has them, in order of k.
  std::vector<FilmFrame> frames_of(int cut) const {
    std::vector<FilmFrame> frames;
    for (const FilmFrame& frame : film_)
      if (frame.cut == cut) frames.push_back(frame);
    std::sort(frames.begin(), frames.end(), [](const FilmFrame& a, const FilmFrame& b) { return a.weight < b.weight; });
    return frames;
  }

  /// The frames of both takes, each in rising order.
  std::vector<Transition::Frame> load(int cut) {
    std::vector<Transition::Frame> frames;
    for (const FilmFrame& frame : frames_of(cut))
      frames.push_back(
          {{frame.frame, {}}, {frame.next_frame, {}}, sprites_.sprite(frame.frame), nullptr, frame.weight});
    for (Transition::Frame& frame : frames) frame.sprite_b = sprites_.sprite(frame.b.frame);
    return frames;
  }

  void start_transition(int cut) {
    std::vector<Transition::Frame> frames = load(cut);
    const Transition::Frame& middle = frames[frames.size() / 2];
    const Shot& shot = edits_.shots[(at(cut) + 1) % edits_.shots.size()];
    const Sprite shown = placed(*middle.sprite_a, carried_.placement_of(*middle.sprite_a));
    const Placement entering = entering_placement(shown, *middle.sprite_b, shot);
    entering_ = CarriedPlacement(texture_.width, texture_.height);
    entering_.set(*middle.sprite_b, entering);
    for (Transition::Frame& frame : frames) {
      frame.a.placement = carried_.placement_of(*frame.sprite_a);
      frame.b.placement = entering_.placement_of(*frame.sprite_b);
    }
    transition_.emplace(texture_, scales_, std::move(frames), options_, job_.jobs);
    transition_->report().cut = cut;
    transition_->report().placement = entering;
    cuts_.push_back(transition_->report());
  }

  /// The loop's last cut: the film begins where the footage has the actor, so that the take that is left must come to
  /// lie on that.
  void close_loop() {
    const int cut = static_cast<int>(edits_.cuts.size()) - 1;
    std::vector<Transition::Frame> frames = load(cut);
    if (!options_.align) {
      aim_ = CarriedPlacement(texture_.width, texture_.height);
    } else {
      std::shared_ptr<const Sprite> a, b;
      if (frames.empty()) {
        a = sprites_.sprite(edits_.cuts.back().from), b = sprites_.sprite(edits_.cuts.back().to);
      } else {
        a = frames[frames.size() / 2].sprite_a, b = frames[frames.size() / 2].sprite_b;
      }
      aim_ = CarriedPlacement(texture_.width, texture_.height);
      aim_->set(*a, entering_placement(*b, *a, edits_.shots.back()));
    }
    if (frames.empty()) {
      CutReport report;
      report.cut = cut;
      cuts_.push_back(report);
      return;
    }
    for (Transition::Frame& frame : frames) frame.a.placement = aim_->placement_of(*frame.sprite_a);
    closing_.emplace(texture_, scales_, std::move(frames), options_, job_.jobs);
    closing_->report().cut = cut;
    cuts_.push_back(closing_->report());
  }

  void aim_at_start(const FilmFrame& now) {
    const int length = closing_ ? closing_->report().transition_frames : 0;
    const int left = edits_.shots.back().last - (length + 1) / 2 - now.frame + 1;
    carried_.aim(aim_->offset_x(), aim_->offset_y(), aim_->scale(), std::max(1, left));
  }

  Sprite show_transition(const FilmFrame& now) {
    const bool closes = edits_.loop && now.cut + 1 == static_cast<int>(edits_.cuts.size());
    if (!closes && shown_cut_ != now.cut) start_transition(now.cut);
    shown_cut_ = now.cut;
    const Transition& transition = closes ? *closing_ : *transition_;
    const int length = transition.report().transition_frames;
    const int k = static_cast<int>(now.weight * (length + 1) + 0.5) - 1;
    Sprite sprite = transition.frame(k);
    if (k + 1 == length && !closes) carried_ = entering_;
    if (k + 1 == length) before_ = sprites_.sprite(now.next_frame), before_frame_ = now.next_frame;
    return sprite;
  }

  const PeopleTexture& texture_;
  SpriteSource& sprites_;
  const EditList& edits_;
  RenderFilmOptions options_;
  JobContext job_;
  std::vector<FilmFrame> film_;
  SecondDifferenceScales scales_;
  std::size_t position_ = 0;
  std::shared_ptr<const Sprite> before_;
  int before_frame_ = -1;
  CarriedPlacement carried_;             // of the take that plays
  CarriedPlacement entering_{0, 0};      // of the one that a transition enters
  std::optional<CarriedPlacement> aim_;  // of the take that ends a loop
  std::optional<Transition> transition_, closing_;
  int shown_cut_ = -1;
  std::vector<CutReport> cuts_;
};

FilmRenderer::FilmRenderer(const PeopleTexture& texture, SpriteSource& sprites, const EditList& edits,
                           const RenderFilmOptions& options, const JobContext& job)
    : playback_(std::make_unique<Playback>(texture, sprites, edits, options, job)) {}
FilmRenderer::~FilmRenderer() = default;

int FilmRenderer::num_frames() const { return playback_->num_frames(); }
bool FilmRenderer::next(Sprite& sprite) { return playback_->next(sprite); }
const std::vector<CutReport>& FilmRenderer::cuts() const { return playback_->cuts(); }

}  // namespace motex
