#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/words.h"
#include "core/scene/words.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

/// Whole microseconds, so that the file stays readable.
double floor_us(double time_ms) { return std::floor(time_ms * 1000.0) / 1000.0; }
double ceil_us(double time_ms) { return std::ceil(time_ms * 1000.0 - 1e-6) / 1000.0; }

/// The projector that a finding is about.
const Projector* projector_of(const Project& project, const Finding& finding) {
  for (std::size_t i = 0; i < project.projectors.size(); ++i) {
    if (finding.where.starts_with(item_pointer("projectors", i) + "/")) return &project.projectors[i];
  }
  return nullptr;
}

Edit projector_edit(const Projector& projector, const std::string& key, Value value) {
  return set_edit("projectors", projector.name, key, std::move(value));
}

/// The fastest that is known to work: the model's rate, or the present one where the model is not known.
double known_rate(const Projector& projector, std::span<const ProjectorModelData> models) {
  const ProjectorModelData* model = find_model(models, projector.model);
  const auto rate = model == nullptr ? std::nullopt : fastest_rate(*model, projector.bits, projector.color);
  return rate.value_or(projector.frames_per_second);
}

/// As short as is known to work; nothing where the model is not known, and anything might.
double known_exposure_ms(const Projector& projector, std::span<const ProjectorModelData> models) {
  const ProjectorModelData* model = find_model(models, projector.model);
  if (model == nullptr) return 0.0;
  return least_exposure_ms(*model, projector.bits, projector.color).value_or(1000.0 / projector.frames_per_second);
}

/// Exposures of `wanted_ms` where the projector can have them so short.
std::optional<Edits> exposure_edits(const Projector& projector, double wanted_ms,
                                    std::span<const ProjectorModelData> models) {
  const double exposure_ms = floor_us(wanted_ms);
  if (!(exposure_ms > 0.0) || exposure_ms < known_exposure_ms(projector, models)) return std::nullopt;
  return Edits{projector_edit(projector, "exposure_ms", exposure_ms)};
}

}  // namespace

Candidates shorter_exposures(const Project& project, std::span<const ProjectorModelData> models) {
  Candidates candidates;
  if (project.projectors.empty()) return candidates;
  const Projector& projector = project.projectors.front();
  for (const double share : {0.9, 0.75, 0.5, 0.25}) {
    const auto edits = exposure_edits(projector, exposure_s(projector) * 1000.0 * share, models);
    if (edits) candidates.push_back({*edits});
  }
  return candidates;
}

Candidates overlap_candidates(const Project& project, const Finding& finding,
                              std::span<const ProjectorModelData> models) {
  Candidates candidates;
  if (project.projectors.empty() || !finding.amount) return candidates;
  const Projector& projector = project.projectors.front();
  const double apart_ms = finding.amount->value;
  if (const auto shorter = exposure_edits(projector, apart_ms, models)) candidates.push_back({*shorter});

  const double rate = std::ceil(1000.0 / apart_ms);
  if (rate <= known_rate(projector, models)) {
    Edits faster{projector_edit(projector, "frames_per_second", rate)};
    candidates.push_back({faster});
    const auto shorter = exposure_edits(projector, apart_ms, models);
    if (projector.exposure_ms && shorter) {
      faster.insert(faster.end(), shorter->begin(), shorter->end());
      candidates.push_back({faster});
    }
  }
  const std::optional<std::size_t> slice = slice_of(project, finding);
  if (!slice) return candidates;
  std::vector<double> powers_d = project.slices.powers_d;
  if (std::find(powers_d.begin(), powers_d.end(), 0.0) == powers_d.end()) {
    powers_d[*slice] = 0.0;  // a slice at zero shares the exposure of the light
    candidates.push_back({{set_edit("slices", "", "powers_d", Value(Value::Array(powers_d.begin(), powers_d.end())))}});
  }
  if (const auto fewer = drop_slices(project, {*slice})) candidates.push_back({*fewer, true});
  return candidates;
}

Candidates smear_candidates(const Project& project, const Finding& finding,
                            std::span<const ProjectorModelData> models) {
  Candidates candidates;
  if (project.projectors.empty() || !finding.amount) return candidates;
  const Projector& projector = project.projectors.front();
  const double share = finding.amount->limit / finding.amount->value;
  // The change is a little less than proportional to the exposure: shorten by somewhat more. The smaller shares serve
  // slices that smear even more.
  for (const double margin : {0.99, 0.97, 0.9, 0.8, 0.6}) {
    const auto edits = exposure_edits(projector, exposure_s(projector) * 1000.0 * share * margin, models);
    if (edits) candidates.push_back({*edits});
  }
  return candidates;
}

Candidates bit_depth_candidates(const Project& project, const Finding& finding,
                                std::span<const ProjectorModelData> models) {
  Candidates candidates;
  const Projector* projector = projector_of(project, finding);
  const ProjectorModelData* model = projector == nullptr ? nullptr : find_model(models, projector->model);
  if (model == nullptr) return candidates;

  const auto fastest = fastest_rate(*model, projector->bits, projector->color);
  if (fastest && projector->frames_per_second > *fastest) {
    candidates.push_back({{projector_edit(*projector, "frames_per_second", std::floor(*fastest))}});
  }
  if (fastest && projector->exposure_ms) {
    candidates.push_back({{projector_edit(*projector, "exposure_ms", ceil_us(known_exposure_ms(*projector, models)))}});
  }
  for (int bits = std::min(projector->bits, model->rates.back().bits + 1) - 1; bits >= 1; --bits) {
    candidates.push_back({{projector_edit(*projector, "bits", bits)}});
  }
  if (projector->color == ColorMode::rgb) candidates.push_back({{projector_edit(*projector, "color", "gray")}, true});
  return candidates;
}

/// Nobody's word but one that differs by case, blanks or dashes alone means a model that is known.
Candidates model_candidates(const Project& project, const Finding& finding,
                            std::span<const ProjectorModelData> models) {
  const auto plain = [](const std::string& name) {
    std::string letters;
    for (const char c : name) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0)
        letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return letters;
  };
  Candidates candidates;
  const Projector* projector = projector_of(project, finding);
  if (projector == nullptr) return candidates;
  for (const ProjectorModelData& model : models) {
    if (plain(model.name) != plain(projector->model)) continue;
    candidates.push_back({{projector_edit(*projector, "model", model.name)}});
  }
  return candidates;
}

Candidates pixel_layout_candidates(const Project& project, const Finding& finding,
                                   std::span<const ProjectorModelData> models) {
  const Projector* projector = projector_of(project, finding);
  const ProjectorModelData* model = projector == nullptr ? nullptr : find_model(models, projector->model);
  if (model == nullptr) return {};
  return {{{projector_edit(*projector, "pixel_layout", word_of(model->layout))}}};
}

}  // namespace focalstage
