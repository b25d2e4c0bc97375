#include "editor/rig/live_stream.h"

#include <utility>

#include "core/scene/edits_between.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"

namespace focalstage {

Status LiveStream::start(RigClient& rig, const LiveWish& wish) {
  auto loaded = load_assets(*wish.project, wish.folder);
  if (!loaded) return loaded.fault();
  sent_files_.clear();
  for (const AssetFile& file : loaded->files) sent_files_.insert(file.sha256);
  auto link = LiveLink::start(rig, {wish.revision, project_text(*wish.project), std::move(loaded->files), wish.frame});
  if (!link) return link.fault();
  link_ = std::move(*link);
  sent_ = wish;
  compiled_ = ready_ = false;
  return {};
}

Status LiveStream::show(const LiveWish& wish) {
  if (!link_ || !wish.project) return {};
  if (wish.frame != sent_.frame) {
    sent_.frame = wish.frame;
    if (Status shown = link_->show_frame(wish.frame); !shown) return shown;
  }
  if (wish.revision == sent_.revision) return {};
  std::vector<AssetFile> fresh;
  if (asset_files(*wish.project) != asset_files(*sent_.project)) {
    auto loaded = load_assets(*wish.project, wish.folder);
    if (!loaded) return loaded.fault();
    for (AssetFile& file : loaded->files) {
      if (sent_files_.insert(file.sha256).second) fresh.push_back(std::move(file));
    }
  }
  const std::vector<Edit> edits = edits_between(*sent_.project, *wish.project);
  sent_ = wish;
  return link_->send(wish.revision, edits, std::move(fresh));
}

bool LiveStream::take_answers(RigStatus& status) {
  if (!link_) return false;
  const std::vector<LiveAnswer> answers = link_->poll();
  for (const LiveAnswer& answer : answers) {
    if (std::holds_alternative<LiveCompiled>(answer)) {
      ready_ = !std::exchange(compiled_, true) || ready_;
    } else if (const auto* appeared = std::get_if<LiveAppeared>(&answer)) {
      status.live_revision = appeared->revision;
      status.edit_to_light_ms = appeared->edit_to_light_ms;
      status.fault.reset();
    } else if (const auto* refused = std::get_if<LiveRefused>(&answer)) {
      status.fault = refused->fault;
    } else if (const auto* state = std::get_if<RigState>(&answer)) {
      status.state = *state;
    } else if (const auto* ended = std::get_if<LiveEnded>(&answer)) {
      status.fault = ended->fault;
      link_.reset();
    }
  }
  status.live = link_.has_value();
  return !answers.empty();
}

}  // namespace focalstage
