#include "core/check/check.h"

#include <algorithm>
#include <tuple>

#include "core/check/remedies.h"
#include "core/check/rules.h"
#include "core/schedule/projector_models.h"

namespace focalstage {
namespace {

void append(std::vector<Finding>& all, std::vector<Finding> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

void sort_findings(std::vector<Finding>& findings) {
  const auto order = [](const Finding& finding) { return std::tie(finding.severity, finding.code, finding.where); };
  std::stable_sort(findings.begin(), findings.end(),
                   [&](const Finding& a, const Finding& b) { return order(a) < order(b); });
}

std::vector<Finding> planned_findings(const Project& project, const std::vector<SlotTrouble>& troubles,
                                      std::span<const ProjectorModelData> models) {
  std::vector<Finding> findings = slice_findings(project);
  append(findings, sweep_findings(project));
  append(findings, optics_findings(project));
  append(findings, projector_findings(project, models));
  append(findings, schedule_findings(project, troubles));
  return findings;
}

std::vector<Finding> check(const Project& project, const ScheduleResult& schedule, const Measured& measured,
                           std::span<const ProjectorModelData> models) {
  const std::vector<Finding> planned = planned_findings(project, schedule.troubles, models);
  std::vector<Finding> findings = planned;
  append(findings, view_findings(project, measured));
  append(findings, light_findings(project, measured, schedule.schedule));
  for (Finding& finding : findings) finding.remedy = remedy_for(project, finding, measured, planned, models);
  append(findings, mesh_findings(project, measured.meshes));
  sort_findings(findings);
  return findings;
}

}  // namespace focalstage
