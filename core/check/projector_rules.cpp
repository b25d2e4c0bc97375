#include "core/check/rules.h"
#include "core/check/words.h"

namespace focalstage {
namespace {

std::string depth_words(const Projector& projector) {
  return std::to_string(projector.bits) + (projector.color == ColorMode::rgb ? " bits a colour" : " bits");
}

void check_rate(const Projector& projector, double rate, double fastest, const std::string& where,
                std::vector<Finding>& findings) {
  if (!(rate > fastest * (1.0 + rounding))) return;
  findings.push_back({Severity::error,
                      "schedule.bit-depth",
                      where,
                      "projector \"" + projector.name + "\" is to show " + words(rate) + " images a second at " +
                          depth_words(projector) + "; a " + projector.model + " shows " + words(fastest),
                      Amount{rate, fastest, "1/s"},
                      {}});
}

}  // namespace

std::vector<Finding> projector_findings(const Project& project, std::span<const ProjectorModelData> models) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < project.projectors.size(); ++i) {
    const Projector& projector = project.projectors[i];
    const ProjectorModelData* model = find_model(models, projector.model);
    if (model == nullptr || model->rates.empty()) continue;  // nothing is known of it
    const std::string where = item_pointer("projectors", i);
    const std::optional<double> fastest = fastest_rate(*model, projector.bits, projector.color);
    if (!fastest) {
      const int deepest = model->rates.back().bits;
      findings.push_back({Severity::error,
                          "schedule.bit-depth",
                          where + "/bits",
                          "projector \"" + projector.name + "\" has " + std::to_string(projector.bits) + " bits; a " +
                              projector.model + " has no more than " + std::to_string(deepest),
                          Amount{static_cast<double>(projector.bits), static_cast<double>(deepest), "bits"},
                          {}});
      continue;
    }
    check_rate(projector, projector.frames_per_second, *fastest, where + "/frames_per_second", findings);
    // An exposure shorter than the model's shortest at this depth is the same wish in other words.
    if (projector.exposure_ms && *projector.exposure_ms > 0.0) {
      check_rate(projector, 1000.0 / *projector.exposure_ms, *fastest, where + "/exposure_ms", findings);
    }
  }
  return findings;
}

}  // namespace focalstage
