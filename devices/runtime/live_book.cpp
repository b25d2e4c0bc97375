#include "devices/runtime/live_book.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/scene/edit.h"
#include "io/json/json.h"
#include "io/project/project_file.h"

namespace focalstage {

namespace {

Result<std::vector<Edit>> edits_of(const std::vector<std::string>& lines) {
  std::vector<Edit> edits;
  for (const std::string& line : lines) {
    const std::string place = "edit " + std::to_string(edits.size());
    const Result<Value> value = parse_json(line, place);
    if (!value) return value.fault();
    Result<Edit> edit = edit_from(*value);
    if (!edit) {
      Fault fault = edit.fault();
      fault.where = fault.where.empty() ? place : place + ": " + fault.where;
      return fault;
    }
    edits.push_back(std::move(*edit));
  }
  return edits;
}

/// The frame to show of a project that may have fewer of them by now.
int frame_within(const Project& project, int frame) { return std::clamp(frame, 0, project.frames.count - 1); }

}  // namespace

Status LiveBook::check_order(std::uint64_t revision) {
  if (revision <= last_seen_) {
    return Fault{"live.order", "revision " + std::to_string(revision),
                 "revision " + std::to_string(last_seen_) + " came before it", "number revisions upwards"};
  }
  last_seen_ = revision;
  return {};
}

void LiveBook::keep(LiveSnapshot snapshot) {
  const std::uint64_t revision = snapshot.revision;
  revisions_.emplace(revision, std::move(snapshot));
  if (revisions_.size() > kept_revisions) revisions_.erase(revisions_.begin());
}

Status LiveBook::begin(const ProjectChange& change, std::string_view text) {
  if (Status order = check_order(change.revision); !order) return order;
  Result<LoadedProject> loaded = parse_project(text, "project");
  if (!loaded) return loaded.fault();
  LiveSnapshot snapshot{change.revision, change.received_s, frame_within(loaded->project, change.frame), {}, {}};
  snapshot.project = std::make_shared<const Project>(std::move(loaded->project));
  for (const LiveFile& file : change.files) snapshot.files[file.path] = file.sha256;
  revisions_.clear();
  keep(std::move(snapshot));
  return {};
}

Status LiveBook::edit(const EditsChange& change) {
  if (Status order = check_order(change.revision); !order) return order;
  const auto base = revisions_.find(change.base_revision);
  if (base == revisions_.end()) {
    return Fault{"live.base", "revision " + std::to_string(change.base_revision),
                 "it was refused or is too old to build upon", "send the whole project"};
  }
  const Result<std::vector<Edit>> edits = edits_of(change.edits);
  if (!edits) return edits.fault();
  Result<Project> project = apply_all(*base->second.project, *edits);
  if (!project) return project.fault();
  LiveSnapshot snapshot = base->second;
  snapshot.revision = change.revision;
  snapshot.received_s = change.received_s;
  snapshot.frame = frame_within(*project, newest().frame);
  snapshot.project = std::make_shared<const Project>(std::move(*project));
  for (const LiveFile& file : change.files) snapshot.files[file.path] = file.sha256;
  keep(std::move(snapshot));
  return {};
}

Status LiveBook::show(const FrameChange& change) {
  const Fault none{"live.frame", "frame " + std::to_string(change.frame), "the project has no such frame",
                   "choose one of its frames"};
  if (empty() || change.frame < 0 || change.frame >= newest().project->frames.count) return none;
  LiveSnapshot& snapshot = revisions_.rbegin()->second;
  snapshot.frame = change.frame;
  snapshot.received_s = change.received_s;
  return {};
}

}  // namespace focalstage
