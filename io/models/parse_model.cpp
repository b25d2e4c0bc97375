#include "core/scene/words.h"
#include "io/json/json.h"
#include "io/models/models.h"
#include "io/project/validate.h"

namespace focalstage {
namespace {

constexpr std::size_t size_limit = 1u << 20;

std::string text_of(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  return value ? *value->text() : std::string();
}

double number_of(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  return value ? *value->number() : 0.0;
}

/// Rate and exposure stand for each other where one of them is missing.
DepthRate rate_from(const Value& value) {
  DepthRate rate;
  rate.bits = static_cast<int>(number_of(value, "bits"));
  rate.frames_per_second = number_of(value, "frames_per_second");
  rate.least_exposure_ms = number_of(value, "least_exposure_ms");
  if (rate.frames_per_second == 0.0) rate.frames_per_second = 1000.0 / rate.least_exposure_ms;
  if (rate.least_exposure_ms == 0.0) rate.least_exposure_ms = 1000.0 / rate.frames_per_second;
  return rate;
}

/// Of a value that the schema took: what is there has the right type.
ProjectorModelData model_from(const Value& value) {
  ProjectorModelData model;
  model.name = text_of(value, "name");
  model.width_px = static_cast<int>(number_of(value, "width_px"));
  model.height_px = static_cast<int>(number_of(value, "height_px"));
  if (text_of(value, "pixel_layout") == word_of(PixelLayout::diamond)) model.layout = PixelLayout::diamond;
  if (text_of(value, "clock") == "master") model.clock = ProjectorClock::master;
  if (value.find("planes_per_frame")) model.planes_per_frame = static_cast<int>(number_of(value, "planes_per_frame"));
  for (const Value& depth : *value.find("depths")->array()) model.rates.push_back(rate_from(depth));
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

Fault in_file(Fault fault, const std::string& source) {
  fault.where = fault.where.empty() ? source : source + ": " + fault.where;
  return fault;
}

}  // namespace

Result<ProjectorModelData> parse_model(std::string_view text, const std::string& source) {
  const auto value = parse_json(text, source, {size_limit, 16});
  if (!value) return value.fault();
  if (const auto refused = schema_fault(*value, model_schema(), "model")) return in_file(*refused, source);
  ProjectorModelData model = model_from(*value);
  if (const auto wrong = order_fault(model)) return in_file(*wrong, source);
  return model;
}

}  // namespace focalstage
