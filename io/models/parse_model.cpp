#include "core/scene/words.h"
#include "io/json/checked_value.h"
#include "io/models/models.h"
#include "io/project/validate.h"

namespace focalstage {
namespace {

constexpr std::size_t size_limit = 1u << 20;

/// Rate and exposure stand for each other where one of them is missing.
DepthRate rate_from(const Value& value) {
  DepthRate rate;
  read(value, "bits", rate.bits);
  read(value, "frames_per_second", rate.frames_per_second);
  read(value, "least_exposure_ms", rate.least_exposure_ms);
  if (rate.frames_per_second == 0.0) rate.frames_per_second = 1000.0 / rate.least_exposure_ms;
  if (rate.least_exposure_ms == 0.0) rate.least_exposure_ms = 1000.0 / rate.frames_per_second;
  return rate;
}

ProjectorModelData model_from(const Value& value) {
  ProjectorModelData model;
  read(value, "name", model.name);
  read(value, "width_px", model.width_px);
  read(value, "height_px", model.height_px);
  if (text_of(value, "pixel_layout") == word_of(PixelLayout::diamond)) model.layout = PixelLayout::diamond;
  if (text_of(value, "clock") == "master") model.clock = ProjectorClock::master;
  read(value, "planes_per_frame", model.planes_per_frame);
  model.rates = list_of<DepthRate>(value, "depths", rate_from);
  return model;
}

/// Which depth serves an image is told by their order, so that must be one: deeper never is faster.
std::optional<Fault> order_fault(const ProjectorModelData& model) {
  for (std::size_t i = 1; i < model.rates.size(); ++i) {
    const DepthRate &before = model.rates[i - 1], &here = model.rates[i];
    const std::string where = "/depths/" + std::to_string(i);
    if (here.bits <= before.bits) {
      return Fault{"model.depths", where + "/bits", "is not above the depth before", "list each depth once, rising"};
    }
    if (here.frames_per_second > before.frames_per_second) {
      return Fault{"model.depths", where + "/frames_per_second",
                   "is above the rate at " + std::to_string(before.bits) + " bits, which are fewer",
                   "correct the rates: what shows deeper images shows the others at least as fast"};
    }
    if (here.least_exposure_ms < before.least_exposure_ms) {
      return Fault{"model.depths", where + "/least_exposure_ms",
                   "is below the exposure at " + std::to_string(before.bits) + " bits, which are fewer",
                   "correct the exposures: what shows deeper images shows the others at least as briefly"};
    }
  }
  return std::nullopt;
}

}  // namespace

Result<ProjectorModelData> parse_model(std::string_view text, const std::string& source) {
  const auto value = parse_checked(text, source, size_limit, model_schema(), "model");
  if (!value) return value.fault();
  ProjectorModelData model = model_from(*value);
  if (const auto wrong = order_fault(model)) return in_file(*wrong, source);
  return model;
}

}  // namespace focalstage
