#include <algorithm>

#include "core/check/proposal.h"
#include "core/check/words.h"
#include "core/schedule/schedule.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

using Limit = SolveTrouble::Limit;
using Change = NearestSetting::Change;

Finding error(std::string code, std::string where, std::string message) {
  return {Severity::error, std::move(code), std::move(where), std::move(message), {}, {}};
}

Finding error(std::string code, std::string where, std::string message, double value, double limit, const char* unit) {
  Finding finding = error(std::move(code), std::move(where), std::move(message));
  finding.amount = Amount{value, limit, unit};
  return finding;
}

std::string waveform_where(const Project& project) {
  const Result<PowerCurve> left = PowerCurve::make(project.sweep, Side::left);
  return project.sweep.waveform.left || project.sweep.waveform.right
             ? waveform_pointer(project.sweep, left ? Side::right : Side::left)
             : std::string("/sweep");
}

Finding bad_waveform(const Project& project) {
  std::string why;
  for (const Side eye : both_sides) {
    const Result<PowerCurve> curve = PowerCurve::make(project.sweep, eye);
    if (!curve && why.empty()) why = curve.fault().message;
  }
  return error("schedule.waveform", waveform_where(project), why + "; nothing can be timed");
}

std::string object_words(const Project& project, std::size_t index) {
  return index < project.objects.size() ? "object \"" + project.objects[index].name + "\"" : "an object";
}

/// A limit in words, without a remedy.
Finding described(const Project& project, const SolveTrouble& trouble) {
  const double amount = trouble.amount;
  const double allowed = trouble.allowed;
  switch (trouble.limit) {
    case Limit::bad_project:
      return error("solve.settings", "/projectors/0",
                   "the solver needs a projector, exposures, shutters and a lens range that are sensible numbers, and "
                   "wishes above zero, for 64 slices at most");
    case Limit::bad_waveform:
      return bad_waveform(project);
    case Limit::nothing_needed:
      return error("solve.nothing", "/objects",
                   "nothing asks for a power: no object stands before the eyes; place one where the viewer looks");
    case Limit::unserved:
      return error("solve.unserved", "/surfaces",
                   "no object's picture falls on a surface that the projector lights; put a surface behind the "
                   "objects, where viewer and projector both see it");
    case Limit::pinned_slice:
      return error("depth.out-of-range", item_pointer("objects", trouble.object) + "/depth/index",
                   object_words(project, trouble.object) + " is to focus in slice " + words(amount) +
                       "; the last one is " + words(allowed - 1.0),
                   amount, allowed - 1.0, "slice");
    case Limit::lens_range:
      return error("optics.lens-range", "/glasses/lens_range_d",
                   "the sweep would have to reach " + words(amount) + " D; the lens ends at " + words(allowed) + " D",
                   amount, allowed, "D");
    case Limit::fixed_sweep:
      return error("slices.outside-sweep", waveform_where(project),
                   "a picture needs " + words(amount) +
                       " D; the measured sweep, which stays as it is, shows slices "
                       "up to " +
                       words(allowed) + " D",
                   amount, allowed, "D");
    case Limit::dead_time:
      return error("schedule.hidden-by-shutter", "/glasses/shutter_open_ms",
                   "shutters and an exposure take " + words(amount * 1000.0) + " ms of a half period of " +
                       words(allowed * 1000.0) + " ms: no time is left in which the power changes",
                   amount * 1000.0, allowed * 1000.0, "ms");
    case Limit::smear:
      return error(
          "schedule.smear", "/projectors/0",
          "the power would change by " + words(amount) + " D during an exposure; " + words(allowed) + " D is allowed",
          amount, allowed, "D");
    case Limit::overlap:
      return error("schedule.overlap", "/projectors/0",
                   "exposures would follow each other in " + words(amount * 1000.0) + " ms; the projector takes " +
                       words(allowed * 1000.0) + " ms",
                   amount * 1000.0, allowed * 1000.0, "ms");
    case Limit::spacing:
      return error("slices.spacing", "/slices/powers_d",
                   "the slices that can be shown lie " + words(amount) + " D apart; " + words(allowed) + " D is wanted",
                   amount, allowed, "D");
    case Limit::count:
      return error("slices.spacing", "/slices/powers_d",
                   allowed > amount ? words(amount) + " slices do not reach everything; it takes " + words(allowed)
                                    : words(amount) + " slices cannot be shown; " + words(allowed) + " are enough",
                   amount, allowed, "slices");
    case Limit::unknown:
      return error("solve.gave-up", "/slices", "no slices were found, nor one limit that is to blame");
    case Limit::gave_up:
      return error("solve.gave-up", "/slices", "the search reached its bound before it found an answer");
    case Limit::stopped:
      return error("solve.gave-up", "/slices", "the search was stopped before it found an answer");
  }
  return {};
}

/// Which changes answer a limit, the best first.
std::vector<Change> answers_to(Limit limit) {
  switch (limit) {
    case Limit::lens_range:
    case Limit::fixed_sweep:
      return {Change::exposure, Change::range};
    case Limit::dead_time:
    case Limit::smear:
      return {Change::exposure, Change::range};
    case Limit::overlap:
      return {Change::exposure, Change::spacing, Change::slices, Change::range};
    case Limit::spacing:
      return {Change::spacing, Change::slices, Change::exposure};
    case Limit::count:
      return {Change::slices, Change::spacing};
    default:
      return {};
  }
}

}  // namespace

std::vector<Finding> solve_findings(const Project& project, const SolveResult& result,
                                    const std::vector<NearestProposal>& nearest) {
  std::vector<Finding> findings;
  for (const SolveTrouble& trouble : result.troubles) {
    Finding finding = described(project, trouble);
    for (const Change change : answers_to(trouble.limit)) {
      const auto answer = std::find_if(nearest.begin(), nearest.end(),
                                       [&](const NearestProposal& one) { return one.setting.change == change; });
      if (answer == nearest.end()) continue;
      finding.message += "; possible: " + answer->words;
      finding.remedy = answer->edits;
      break;
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace focalstage
