#include <algorithm>
#include <cctype>

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

/// A name as part of a file's.
std::string file_word(std::string name) {
  const auto stays = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c >= 128;
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !stays(static_cast<unsigned char>(c)); }, '-');
  return name;
}

std::string names_of(std::span<const ProjectorModelData> models) {
  std::string names;
  for (const ProjectorModelData& model : models) names += (names.empty() ? "" : ", ") + model.name;
  return names;
}

Finding unknown_model(const Projector& projector, std::span<const ProjectorModelData> models,
                      const std::string& where) {
  const std::string known = models.empty() ? "none is" : names_of(models) + (models.size() == 1 ? " is" : " are");
  return {Severity::warning,
          "projector.unknown-model",
          where + "/model",
          "projector \"" + projector.name + "\" is a \"" + projector.model + "\", which no model file describes (" +
              known + " known): what it can show is not checked; describe it in a file beside the project, models/" +
              file_word(projector.model) + ".json",
          std::nullopt,
          {}};
}

const char* word(PixelLayout layout) { return layout == PixelLayout::diamond ? "a diamond" : "a square"; }

Finding wrong_lattice(const Projector& projector, const ProjectorModelData& model, const std::string& where) {
  return {Severity::warning,
          "projector.pixel-layout",
          where + "/pixel_layout",
          "projector \"" + projector.name + "\" has " + word(projector.pixel_layout) +
              " lattice of pixels in the project, a " + projector.model + " " + word(model.layout) +
              " one: every other row would be off by half a pixel",
          std::nullopt,
          {}};
}

void check_model(const Projector& projector, const ProjectorModelData& model, const std::string& where,
                 std::vector<Finding>& findings) {
  if (projector.pixel_layout != model.layout) findings.push_back(wrong_lattice(projector, model, where));
  const std::optional<double> fastest = fastest_rate(model, projector.bits, projector.color);
  if (!fastest) {
    const int deepest = model.rates.back().bits;
    findings.push_back({Severity::error,
                        "schedule.bit-depth",
                        where + "/bits",
                        "projector \"" + projector.name + "\" has " + std::to_string(projector.bits) + " bits; a " +
                            projector.model + " has no more than " + std::to_string(deepest),
                        Amount{static_cast<double>(projector.bits), static_cast<double>(deepest), "bits"},
                        {}});
    return;
  }
  check_rate(projector, projector.frames_per_second, *fastest, where + "/frames_per_second", findings);
  // An exposure shorter than the model's shortest at this depth is the same wish in other words.
  if (projector.exposure_ms && *projector.exposure_ms > 0.0) {
    const double least_ms = *least_exposure_ms(model, projector.bits, projector.color);
    check_rate(projector, 1000.0 / *projector.exposure_ms, 1000.0 / least_ms, where + "/exposure_ms", findings);
  }
}

/// The solver of optimal slices steps from pixel to pixel and row to row, which a diamond lattice does not.
void check_assignment(const Project& project, std::vector<Finding>& findings) {
  if (project.slices.assignment != Assignment::optimal || project.projectors.empty()) return;
  const Projector& projector = project.projectors.front();
  if (projector.pixel_layout == PixelLayout::square) return;
  findings.push_back({Severity::warning,
                      "slices.optimal-lattice",
                      "/slices/assignment",
                      "optimal slices are solved on a square lattice of pixels alone; on the diamond one of \"" +
                          projector.name + "\" they stay as linear leaves them",
                      std::nullopt,
                      {}});
}

}  // namespace

std::vector<Finding> projector_findings(const Project& project, std::span<const ProjectorModelData> models) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < project.projectors.size(); ++i) {
    const Projector& projector = project.projectors[i];
    const std::string where = item_pointer("projectors", i);
    const ProjectorModelData* model = find_model(models, projector.model);
    if (model == nullptr) {
      findings.push_back(unknown_model(projector, models, where));
    } else if (!model->rates.empty()) {
      check_model(projector, *model, where, findings);
    }
  }
  check_assignment(project, findings);
  return findings;
}

}  // namespace focalstage
