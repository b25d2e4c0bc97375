#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/check/check.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"
#include "tests/support/models.h"

namespace focalstage::testing {

/// A project without a finding: the paper's rig, three slices half a dioptre apart, one screen, one object.
inline Project quiet_project() {
  Project project;
  project.name = "Quiet";
  Projector projector;
  projector.name = "main";
  projector.latency_ms = 0.15;
  project.projectors = {projector};
  project.slices.powers_d = {-0.5, 0.0, 0.5};
  Surface screen;
  screen.name = "screen";
  screen.placement.pose.position_m = {0.0, 0.0, -0.5};
  project.surfaces = {screen};
  Object object;
  object.name = "near";
  object.placement.pose.position_m = {0.0, 0.0, -0.45};
  project.objects = {object};
  return project;
}

inline std::vector<Finding> check_of(const Project& project, const Measured& measured = {}) {
  return check(project, make_schedule(project, image_plan(project)), measured, support::models());
}

inline std::vector<std::string> codes(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) all.push_back(finding.code);
  return all;
}

inline std::size_t count(const std::vector<Finding>& findings, const std::string& code) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.code == code; }));
}

using Codes = std::vector<std::string>;

}  // namespace focalstage::testing
