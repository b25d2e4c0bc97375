#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/optics/image_plan.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

using Kind = SlotTrouble::Kind;

/// Turns the troubles of exposures into findings about what the designer wrote: the slice of an image, or the surface
/// that wants light.
class TroubleReader {
 public:
  explicit TroubleReader(const Project& project) : project_(project), images_(image_plan(project)) {}

  Finding finding(const SlotTrouble& trouble) const {
    switch (trouble.kind) {
      case Kind::outside_sweep:
        return outside_sweep(trouble);
      case Kind::hidden_by_shutter:
        return hidden(trouble);
      case Kind::overlap:
        return overlap(trouble);
      case Kind::smear:
        return smear(trouble);
      case Kind::no_zero_crossing:
        return no_zero_crossing(trouble);
      case Kind::bad_waveform:
        return bad_waveform(trouble);
    }
    return {};
  }

  /// How bad, to keep the worst of one culprit.
  static double badness(const SlotTrouble& trouble) {
    return trouble.kind == Kind::overlap ? trouble.limit - trouble.amount : std::abs(trouble.amount - trouble.limit);
  }

 private:
  const ImageSpec& spec(int image) const { return images_.at(static_cast<std::size_t>(image)); }

  std::string where(int image) const {
    if (spec(image).slice >= 0) return slice_pointer(static_cast<std::size_t>(spec(image).slice));
    const auto lit = [](const Surface& surface) { return !surface.hidden && surface.illumination > 0.0; };
    const auto found = std::find_if(project_.surfaces.begin(), project_.surfaces.end(), lit);
    return item_pointer("surfaces", static_cast<std::size_t>(found - project_.surfaces.begin())) + "/illumination";
  }

  std::string what(int image) const {
    return spec(image).slice >= 0 ? "the slice at " + words(spec(image).power_d) + " D"
                                  : "the light for surfaces at 0 D";
  }

  Finding outside_sweep(const SlotTrouble& trouble) const {
    return {Severity::error,
            "slices.outside-sweep",
            where(trouble.image),
            what(trouble.image) + " is never reached by the sweep, which ends at " + words(trouble.limit) + " D",
            Amount{trouble.amount, trouble.limit, "D"},
            {}};
  }

  Finding hidden(const SlotTrouble& trouble) const {
    return {Severity::error,
            "schedule.hidden-by-shutter",
            where(trouble.image),
            what(trouble.image) + " is too near to an end of the sweep: a shutter still moves during " +
                words(trouble.amount * 1000.0) + " ms of its exposure",
            Amount{trouble.amount * 1000.0, 0.0, "ms"},
            {}};
  }

  Finding overlap(const SlotTrouble& trouble) const {
    // The later of the two in the designer's list; the light has no place there.
    const bool other_later = spec(trouble.other_image).slice > spec(trouble.image).slice;
    const int later = other_later ? trouble.other_image : trouble.image;
    const int earlier = other_later ? trouble.image : trouble.other_image;
    const std::string pair = trouble.image == trouble.other_image || spec(later).slice == spec(earlier).slice
                                 ? what(later) + " for one eye and the same for the other"
                                 : what(later) + " and " + what(earlier);
    return {Severity::error,
            "schedule.overlap",
            where(later),
            pair + " follow each other in " + words(trouble.amount * 1000.0) + " ms; the projector takes " +
                words(trouble.limit * 1000.0) + " ms",
            Amount{trouble.amount * 1000.0, trouble.limit * 1000.0, "ms"},
            {}};
  }

  Finding smear(const SlotTrouble& trouble) const {
    return {Severity::warning,
            "schedule.smear",
            where(trouble.image),
            "the power changes by " + words(trouble.amount) + " D during the exposure of " + what(trouble.image),
            Amount{trouble.amount, trouble.limit, "D"},
            {}};
  }

  Finding no_zero_crossing(const SlotTrouble& trouble) const {
    const bool measured = project_.sweep.waveform[trouble.eye].has_value();
    const std::string extreme = trouble.amount > 0.0 ? "/sweep/min_power_d" : "/sweep/max_power_d";
    return {Severity::error,
            "schedule.no-zero-crossing",
            measured ? waveform_pointer(project_.sweep, trouble.eye) : extreme,
            "a surface is lit, which is done at zero power, but the sweep ends at " + words(trouble.amount) + " D",
            Amount{trouble.amount, 0.0, "D"},
            {}};
  }

  Finding bad_waveform(const SlotTrouble& trouble) const {
    const Result<PowerCurve> curve = PowerCurve::make(project_.sweep, trouble.eye);
    const bool measured = project_.sweep.waveform[trouble.eye].has_value() && project_.sweep.frequency_hz > 0.0;
    const std::string why = curve ? std::string("the sweep is no usable curve") : curve.fault().message;
    return {Severity::error,
            "schedule.waveform",
            measured ? waveform_pointer(project_.sweep, trouble.eye) : "/sweep",
            why + ": nothing can be timed",
            std::nullopt,
            {}};
  }

  const Project& project_;
  std::vector<ImageSpec> images_;
};

}  // namespace

std::vector<Finding> schedule_findings(const Project& project, const std::vector<SlotTrouble>& troubles) {
  const TroubleReader reader(project);
  std::map<std::pair<std::string, std::string>, std::pair<double, Finding>> worst;  // by code and place
  for (const SlotTrouble& trouble : troubles) {
    Finding finding = reader.finding(trouble);
    const double badness = TroubleReader::badness(trouble);
    const auto [entry, fresh] = worst.try_emplace({finding.code, finding.where}, badness, finding);
    if (!fresh && badness > entry->second.first) entry->second = {badness, std::move(finding)};
  }
  std::vector<Finding> findings;
  for (auto& [key, entry] : worst) findings.push_back(std::move(entry.second));
  return findings;
}

}  // namespace focalstage
