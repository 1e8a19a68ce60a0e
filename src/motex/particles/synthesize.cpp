// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/synthesize.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/particles/birth_process.h"
#include "motex/particles/population.h"

namespace motex {
namespace {

void check_request(const TexturedMotion& model, const SynthesizeParticlesOptions& options) {
  check_options(options);
  if (model.width <= 0 || model.height <= 0 || model.num_frames <= 0)
    throw InvalidInput("the model has no picture size or no frames; learn it again");
  if (!std::isfinite(options.wind_x) || !std::isfinite(options.wind_y))
    throw InvalidInput("the wind must be two finite numbers, pixels a frame");
  for (const Plane* map : {&options.sink_map, &options.hazard_map})
    if (!map->values.empty() && (map->width != model.width || map->height != model.height))
      throw InvalidInput("the map of deaths has another size than the model's picture");
  if (!options.sink_map.values.empty() && !options.hazard_map.values.empty())
    throw InvalidInput("a map of sinks and one of the hazard exclude each other");
  const TexturedMotion& looks = options.looks_of != nullptr ? *options.looks_of : model;
  const auto num_templates = static_cast<int>(looks.templates.size());
  if (options.looks_of_species >= num_templates)
    throw InvalidInput("there is no template " + std::to_string(options.looks_of_species) + "; the model has " +
                       std::to_string(num_templates) + ", counted from 0");
  if (options.appearance == ParticleAppearance::kTemplates && num_templates == 0 && !looks.cables.empty())
    throw InvalidInput("the model has no templates; use appearance 'replay'");
}

}  // namespace

CableSynthesizer::CableSynthesizer(const TexturedMotion& model, const SynthesizeParticlesOptions& options,
                                   std::int64_t loop_frames, const JobContext& job) {
  check_request(model, options);
  if (options.loop && loop_frames < 1) throw InvalidInput("a loop needs a number of frames");
  population_ = std::make_unique<Population>(model, options, options.loop ? loop_frames : 0);
  population_->settle(job);
}

CableSynthesizer::~CableSynthesizer() = default;

bool CableSynthesizer::next_frame(MovetonFrame& frame) {
  population_->draw(frame);
  population_->advance();
  return true;
}

void CableSynthesizer::insert(const InsertedElement& element) { population_->insert(element); }

void CableSynthesizer::check(const InsertedElement& element) const {
  static_cast<void>(population_->examples_for(element));
}

const SynthesizeParticlesReport& CableSynthesizer::report() const { return population_->report(); }

std::vector<Cable> collect_cables(MovetonSource& source, std::int64_t num_frames, const JobContext& job) {
  std::vector<Cable> cables;
  std::map<std::int64_t, std::size_t> place_of_track;
  MovetonFrame frame;
  for (std::int64_t t = 0; t < num_frames && source.next_frame(frame); ++t) {
    job.check_cancelled();
    for (const Moveton& moveton : frame.movetons) {
      const auto [place, is_new] = place_of_track.try_emplace(moveton.track, cables.size());
      if (is_new) {
        cables.emplace_back().first_frame = t;
        cables.back().species = moveton.species;
        cables.back().coils.resize(moveton.num_bases - 1);
      }
      Cable& cable = cables[place->second];
      if (cable.end_frame() != t) continue;  // a gap would shift what follows
      const std::span<const Base> bases = frame.bases_of(moveton);
      cable.core.push_back(bases[0]);
      for (std::size_t k = 0; k < cable.coils.size(); ++k) cable.coils[k].push_back(bases[k + 1]);
      cable.poses.push_back(moveton.pose);
    }
  }
  return cables;
}

std::vector<Cable> synthesize_cables(const TexturedMotion& model, const SynthesizeParticlesOptions& options,
                                     std::int64_t num_frames, const JobContext& job,
                                     SynthesizeParticlesReport* report) {
  if (num_frames < 1) throw InvalidInput("at least one frame is to be synthesized");
  CableSynthesizer synthesizer(model, options, num_frames, job);
  if (report != nullptr) *report = synthesizer.report();
  return collect_cables(synthesizer, num_frames, job);
}

}  // namespace motex
