// What is wrong with each of several projectors, and between them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check/candidates.h"
#include "core/check/check.h"
#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

/// How far the smears of one image may lie apart.
constexpr double most_apart_d = 0.1;

std::string quoted(const Projector& projector) { return "\"" + projector.name + "\""; }

bool shows(const Schedule& schedule, const Slot& wanted) {
  return std::any_of(schedule.slots.begin(), schedule.slots.end(),
                     [&](const Slot& slot) { return slot.image == wanted.image && slot.eye == wanted.eye; });
}

/// Exposures of `one` that `other` has not.
std::size_t missing(const Schedule& one, const Schedule& other) {
  return static_cast<std::size_t>(
      std::count_if(one.slots.begin(), one.slots.end(), [&](const Slot& slot) { return !shows(other, slot); }));
}

/// How far the smears of images that both show lie apart at most.
double smears_apart_d(const Schedule& one, const Schedule& other) {
  double apart_d = 0.0;
  for (const Slot& a : one.slots) {
    for (const Slot& b : other.slots) {
      if (a.image == b.image && a.eye == b.eye) apart_d = std::max(apart_d, std::abs(a.smear_d - b.smear_d));
    }
  }
  return apart_d;
}

void compare(const Project& project, std::size_t i, const Schedule& first, const Schedule& other,
             std::vector<Finding>& findings) {
  const Projector &a = project.projectors[0], &b = project.projectors[i];
  const std::size_t lost = missing(first, other) + missing(other, first);
  if (lost > 0) {
    findings.push_back({Severity::error,
                        "schedule.projectors-differ",
                        item_pointer("projectors", i),
                        std::to_string(lost) + " of the exposures of " + quoted(a) + " and " + quoted(b) +
                            " cannot be shown by both: where they overlap, a share of the light would be missing",
                        Amount{static_cast<double>(lost), 0.0, "exposures"},
                        {}});
  }
  const double apart_d = smears_apart_d(first, other);
  if (!(apart_d > most_apart_d + rounding)) return;
  const double a_ms = exposure_s(a) * 1000.0, b_ms = exposure_s(b) * 1000.0;
  const std::string& longer = a_ms > b_ms ? a.name : b.name;
  findings.push_back({Severity::warning,
                      "schedule.projectors-differ",
                      item_pointer("projectors", i),
                      "an exposure lasts " + words(a_ms) + " ms on " + quoted(a) + " and " + words(b_ms) + " ms on " +
                          quoted(b) + ": the power changes by " + words(apart_d) +
                          " D more during the longer, and where they overlap one blurs what the other shows sharp",
                      Amount{apart_d, most_apart_d, "D"},
                      {set_edit("projectors", longer, "exposure_ms", std::min(a_ms, b_ms))}});
}

/// The project as if projector `i` were its first, and what was measured of it.
std::pair<Project, Measured> led_by(std::size_t i, const Project& project, const Measured& measured) {
  std::pair<Project, Measured> led{project, {}};
  std::swap(led.first.projectors[0], led.first.projectors[i]);
  if (i <= measured.others.size()) led.second.frames = measured.others[i - 1];
  return led;
}

/// A pointer into such a project, in the project itself.
std::string renamed(const std::string& where, std::size_t i) {
  const auto moved = [&](std::size_t from, std::size_t to) -> std::string {
    const std::string at = item_pointer("projectors", from);
    if (where.compare(0, at.size(), at) != 0) return "";
    if (where.size() > at.size() && where[at.size()] != '/') return "";
    return item_pointer("projectors", to) + where.substr(at.size());
  };
  const std::string own = moved(0, i);
  if (!own.empty()) return own;
  const std::string first = moved(i, 0);
  return first.empty() ? where : first;
}

}  // namespace

std::vector<Finding> check(const Project& project, const std::vector<ScheduleResult>& schedules,
                           const Measured& measured, std::span<const ProjectorModelData> models) {
  std::vector<Finding> findings = check(project, schedules.at(0), measured, models);
  for (std::size_t i = 1; i < std::min(schedules.size(), project.projectors.size()); ++i) {
    const auto [led, own] = led_by(i, project, measured);
    for (Finding& finding : check(led, schedules[i], own, models)) {
      finding.where = renamed(finding.where, i);
      const bool known = std::any_of(findings.begin(), findings.end(), [&](const Finding& other) {
        return other.code == finding.code && other.where == finding.where;
      });
      if (!known) findings.push_back(std::move(finding));
    }
    compare(project, i, schedules[0].schedule, schedules[i].schedule, findings);
  }
  sort_findings(findings);
  return findings;
}

}  // namespace focalstage
