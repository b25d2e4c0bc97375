// What surfaces cannot send back, and how dark black is (docs/colour.md).
#include <array>
#include <map>

#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/optics/projector_model.h"

namespace focalstage {
namespace {

std::string name_of(const Project& project, std::size_t surface) {
  return "\"" + (surface < project.surfaces.size() ? project.surfaces[surface].name : std::to_string(surface)) + "\"";
}

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// The channel in which most pixels ask too much; nothing where there is one channel, or none stands out.
std::string mostly_in(const Project& project, const std::array<std::uint64_t, 3>& counts) {
  if (project.projectors.front().color == ColorMode::gray) return "";
  constexpr std::array<const char*, 3> names{"red", "green", "blue"};
  std::size_t most = 0;
  for (std::size_t c = 1; c < 3; ++c) most = counts[c] > counts[most] ? c : most;
  if (counts[0] == counts[1] && counts[1] == counts[2]) return "";
  return std::string(", most in ") + names[most];
}

/// A surface's frame in which the greatest share of its pixels asks too much.
struct WorstFrame {
  SurfaceAsked asked;
  std::size_t frame = 0;
  double share = 0.0;
};

template <class Count>
std::map<std::size_t, WorstFrame> worst_frames(const Measured& measured, Count count) {
  std::map<std::size_t, WorstFrame> worst;  // by surface
  for (std::size_t frame = 0; frame < measured.frames.size(); ++frame) {
    for (const SurfaceAsked& asked : measured.frames[frame].surfaces) {
      const double share = share_of(count(asked), asked.lit_pixels);
      if (share > worst[asked.index].share) worst[asked.index] = {asked, frame, share};
    }
  }
  std::erase_if(worst, [](const auto& entry) { return !(entry.second.share > 0.0); });
  return worst;
}

std::string of_pixels_on(const Project& project, std::size_t index, const WorstFrame& worst) {
  return percent(worst.share) + " of the lit pixels on surface " + name_of(project, index) + " want ";
}

std::string in_frame(const WorstFrame& worst) { return " (frame " + std::to_string(worst.frame) + ")"; }

void check_bright(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  for (const auto& [index, worst] : worst_frames(measured, [](auto& asked) { return asked.too_bright; })) {
    findings.push_back({Severity::warning,
                        "light.clipped",
                        item_pointer("surfaces", index),
                        of_pixels_on(project, index, worst) + "more light than the projector has, up to " +
                            words(worst.asked.most) + " times it" + mostly_in(project, worst.asked.bright_in) +
                            in_frame(worst),
                        Amount{worst.share, 0.0, "share"},
                        {}});
  }
}

void check_dark(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  for (const auto& [index, worst] : worst_frames(measured, [](auto& asked) { return asked.too_dark; })) {
    findings.push_back({Severity::warning,
                        "light.below-black",
                        item_pointer("surfaces", index),
                        of_pixels_on(project, index, worst) + "less light than leaks through black, by up to " +
                            percent(-worst.asked.least) + " of white" + mostly_in(project, worst.asked.dark_in) +
                            in_frame(worst),
                        Amount{worst.share, 0.0, "share"},
                        {}});
  }
}

void check_contrast(const Project& project, const Measured& measured, const Schedule& schedule,
                    std::vector<Finding>& findings) {
  for (const SurfaceContrast& contrast : contrasts_of(project, schedule, measured.lit)) {
    if (!contrast.knows_ambient || !(contrast.ratio() < least_contrast)) continue;
    findings.push_back({Severity::warning,
                        "light.contrast",
                        item_pointer("surfaces", contrast.index),
                        "on surface " + name_of(project, contrast.index) + " white is only " + words(contrast.ratio()) +
                            " times as bright as black: " + percent(contrast.leak) + " of white leaks in " +
                            std::to_string(contrast.exposures) + " exposures, " + percent(contrast.ambient) +
                            " is the room's own light",
                        Amount{contrast.ratio(), least_contrast, "to 1"},
                        {}});
  }
}

void check_known(const Project& project, std::vector<Finding>& findings) {
  const Projector& projector = project.projectors.front();
  if (!(project.ambient_lux > 0.0) || projector.lumens) return;
  findings.push_back({Severity::info,
                      "light.ambient-unknown",
                      "/ambient_lux",
                      "the room's " + words(project.ambient_lux) + " lx are left out: how bright \"" + projector.name +
                          "\" is nobody said (lumens)",
                      std::nullopt,
                      {}});
}

}  // namespace

std::vector<LitSurface> surfaces_in_light(const Project& project, const Stage& stage) {
  if (project.projectors.empty()) return {};
  const Projector& projector = project.projectors.front();
  if (!(projector.black_level > 0.0) && !(project.ambient_lux > 0.0)) return {};
  return lit_surfaces(stage, projector_model(projector));
}

std::vector<Finding> light_findings(const Project& project, const Measured& measured, const Schedule& schedule) {
  std::vector<Finding> findings;
  if (project.projectors.empty()) return findings;
  check_bright(project, measured, findings);
  check_dark(project, measured, findings);
  check_contrast(project, measured, schedule, findings);
  check_known(project, findings);
  return findings;
}

}  // namespace focalstage
