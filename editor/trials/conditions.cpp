#include "editor/trials/conditions.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "editor/pipeline/compile_show.h"
#include "io/project/project_file.h"
#include "io/protocol/show_chunks.h"
#include "io/show/reader.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

std::string frame_cue(int frame) { return "frame " + std::to_string(frame); }

std::string place_of(std::size_t condition) { return "/conditions/" + std::to_string(condition); }

/// Why a rig would refuse the show, whichever rig it is.
Status check_findings(const std::vector<Finding>& findings, const Condition& condition, std::size_t index) {
  for (const Finding& finding : findings) {
    if (finding.severity != Severity::error) continue;
    return Fault{"study.condition", place_of(index), "a rig would refuse it: " + finding.message,
                 "focalstage check " + condition.project + " says more"};
  }
  return {};
}

Status compile_condition(const Study& study, std::size_t index, const fs::path& folder, const fs::path& show,
                         const std::optional<double>& interpupillary_mm, const FrameProgress& progress,
                         const std::stop_token& stop) {
  const Condition& condition = study.conditions[index];
  auto source = open_project(folder / condition.project);
  if (!source) return source.fault();
  std::vector<Edit> edits = variant_edits(source->project, condition.variant);
  const std::vector<Edit> cues = cue_edits(source->project, study);
  edits.insert(edits.end(), cues.begin(), cues.end());
  if (interpupillary_mm && *interpupillary_mm != source->project.viewer.interpupillary_mm) {
    edits.push_back({Edit::Kind::set, "viewer", "", "interpupillary_mm", *interpupillary_mm});
  }
  if (!edits.empty()) {
    auto changed = apply_all(source->project, edits);
    if (!changed) return changed.fault();
    source->project = std::move(*changed);
    source->text = project_text(source->project);
  }
  CompileJob job;
  job.show = show;
  const auto compiled = compile_show(*source, job, progress, stop);
  if (!compiled) return compiled.fault();
  return check_findings(compiled->findings, condition, index);
}

Result<ShownTarget> find_target(const ShowHeader& header, const StudyTarget& target, std::size_t index,
                                const fs::path& show) {
  const auto shown = std::ranges::find_if(header.cues, [&](const ShowCue& cue) {
    return target.cue.empty() ? cue.frame == target.frame : cue.name == target.cue;
  });
  if (shown != header.cues.end()) return ShownTarget{shown->name, shown->frame};
  const std::string wanted =
      target.cue.empty() ? "a cue at frame " + std::to_string(target.frame) : "a cue \"" + target.cue + "\"";
  return Fault{"study.target", "/targets/" + std::to_string(index), show.string() + " has not " + wanted,
               "add the cue to the project, or correct the target"};
}

Result<ReadyCondition> look_into(const Study& study, const fs::path& show, const std::stop_token& stop) {
  const auto reader = ShowReader::open(show);
  if (!reader) return reader.fault();
  const auto project = parse_project(reader->header().project_text, show.string());
  if (!project) return project.fault();
  ReadyCondition ready;
  ready.show = show;
  ready.interpupillary_mm = project->project.viewer.interpupillary_mm;
  for (std::size_t t = 0; t < study.targets.size(); ++t) {
    const auto target = find_target(reader->header(), study.targets[t], t, show);
    if (!target) return target.fault();
    ready.targets.push_back(*target);
  }
  const auto chunks = ShowChunks::open(show, stop);
  if (!chunks) return chunks.fault();
  ready.sha256 = chunks->sha256();
  return ready;
}

}  // namespace

std::vector<Edit> variant_edits(const Project& project, ConditionVariant variant) {
  if (variant == ConditionVariant::multifocal) return {};
  std::vector<Edit> edits{{Edit::Kind::set, "slices", "", "powers_d", Value::Array{0.0}}};
  for (const Object& object : project.objects) {
    Value depth;
    depth.set("mode", "slice");
    depth.set("index", 0);
    edits.push_back({Edit::Kind::set, "objects", object.name, "depth", std::move(depth)});
  }
  return edits;
}

std::vector<Edit> cue_edits(const Project& project, const Study& study) {
  std::vector<Edit> edits;
  for (const StudyTarget& target : study.targets) {
    if (!target.cue.empty() || target.frame >= project.frames.count) continue;
    const double time_s = target.frame / project.frames.rate_hz;
    const auto is_there = [&](const Cue& cue) { return std::abs(cue.time_s - time_s) * project.frames.rate_hz < 0.5; };
    if (std::ranges::any_of(project.cues, is_there)) continue;
    Value cue;
    cue.set("name", frame_cue(target.frame));
    cue.set("time_s", time_s);
    edits.push_back({Edit::Kind::add, "cues", frame_cue(target.frame), "", std::move(cue)});
  }
  return edits;
}

Result<std::vector<ReadyCondition>> make_conditions(const Study& study, const fs::path& folder, const fs::path& shows,
                                                    const std::optional<double>& interpupillary_mm,
                                                    const FrameProgress& progress, const std::stop_token& stop) {
  std::error_code problem;
  fs::create_directories(shows, problem);
  if (problem) return Fault{"file.unwritable", shows.string(), problem.message(), "choose another folder with --out"};
  std::vector<ReadyCondition> conditions;
  for (std::size_t k = 0; k < study.conditions.size(); ++k) {
    const Condition& condition = study.conditions[k];
    fs::path show = folder / condition.show;
    if (condition.show.empty()) {
      show = shows / ("condition-" + std::to_string(k + 1) + ".h5");
      const Status compiled = compile_condition(study, k, folder, show, interpupillary_mm, progress, stop);
      if (!compiled) return compiled.fault();
    }
    auto ready = look_into(study, show, stop);
    if (!ready) return ready.fault();
    if (interpupillary_mm && ready->interpupillary_mm != *interpupillary_mm) {
      return Fault{"study.condition", place_of(k), show.string() + " is made for eyes another distance apart",
                   "name the project in place of the show, or leave out --interpupillary-mm"};
    }
    conditions.push_back(std::move(*ready));
  }
  return conditions;
}

}  // namespace focalstage
