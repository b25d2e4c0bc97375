#include "core/schedule/projector_models.h"

#include <algorithm>

namespace focalstage {
namespace {

const DepthRate* rate_of(const ProjectorModelData& model, int bits) {
  const auto deep_enough = [&](const DepthRate& rate) { return rate.bits >= bits; };
  const auto found = std::find_if(model.rates.begin(), model.rates.end(), deep_enough);
  return found == model.rates.end() ? nullptr : &*found;
}

double exposures(ColorMode color) { return color == ColorMode::rgb ? 3.0 : 1.0; }

}  // namespace

const ProjectorModelData* find_model(std::span<const ProjectorModelData> models, std::string_view name) {
  const auto found = std::find_if(models.begin(), models.end(), [&](const auto& model) { return model.name == name; });
  return found == models.end() ? nullptr : &*found;
}

std::optional<double> fastest_rate(const ProjectorModelData& model, int bits, ColorMode color) {
  const DepthRate* rate = rate_of(model, bits);
  if (rate == nullptr) return std::nullopt;
  return rate->frames_per_second / exposures(color);
}

std::optional<double> least_exposure_ms(const ProjectorModelData& model, int bits, ColorMode color) {
  const DepthRate* rate = rate_of(model, bits);
  if (rate == nullptr) return std::nullopt;
  const double of_one_ms = rate->least_exposure_ms > 0.0 ? rate->least_exposure_ms : 1000.0 / rate->frames_per_second;
  return of_one_ms * exposures(color);
}

}  // namespace focalstage
