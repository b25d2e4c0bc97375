#include "editor/session/session_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/trigonometric.hpp>

#include "core/scene/sequence.h"
#include "core/stage/stage.h"
#include "editor/session/edits.h"
#include "editor/tools/pick.h"
#include "editor/tools/room_camera.h"
#include "io/models/models.h"

namespace focalstage {
namespace {

constexpr std::size_t longest_log = 1000;
/// A view's size where it is not known yet.
constexpr glm::dvec2 usual_pane_px(640.0, 480.0);
/// Of the eye's view: a lens of 16 mm at 15 mm shows 56 degrees.
constexpr double narrowest_deg = 20.0, widest_deg = 60.0;

/// The project without what cannot be stood up for want of its file.
Project without_missing(const Project& project, const Assets& assets, double time_s) {
  Project shown = project;
  const auto is_there = [&](const MeshSource& mesh) {
    const auto* file = std::get_if<FileMesh>(&mesh.shape);
    return !file || assets.models.contains(file->file);
  };
  for (Surface& surface : shown.surfaces) {
    surface.hidden = surface.hidden || !is_there(surface.mesh);
    const auto* paint = std::get_if<FileAlbedo>(&surface.albedo);
    if (paint && !assets.pictures.contains(paint->file)) surface.albedo = PlainAlbedo{};
  }
  const auto has_pictures = [&](const Appearance& appearance) {
    const auto* image = std::get_if<ImageAppearance>(&appearance);
    const std::optional<int> index = image ? picture_at(*image, time_s) : std::nullopt;
    return !index || assets.pictures.contains(picture_file(*image, *index));
  };
  for (Object& object : shown.objects) {
    object.hidden = object.hidden || !is_there(object.mesh) || !has_pictures(object.appearance);
  }
  return shown;
}

}  // namespace

Session::State::State(std::function<void()> wake_up, UserFolders user_folders)
    : wake([this, up = std::move(wake_up)] {
        news = true;
        up();
      }),
      folders(std::move(user_folders)),
      recent(recent_projects(folders)),
      left_behind(recoveries(folders, recent)),
      recent_rigs(focalstage::recent_rigs(folders)),
      sample_cards(make_sample_cards()),
      preview(wake),
      reader(wake),
      rig(wake, folders.state),
      jobs(wake) {}

void Session::State::say(LogLine::Kind kind, std::string text) {
  log.push_back({kind, text, now_s});
  if (log.size() > longest_log) log.pop_front();
  notice = log.back();
}

Status Session::State::apply(std::string words, std::vector<Edit> edits, Joining joining) {
  if (!document) return Fault{"session.nothing-open", "", "no project is open", "open one first"};
  if (edits.empty()) return {};
  if (Status applied = document->apply({std::move(words), std::move(edits)}, joining); !applied) {
    say(LogLine::Kind::fault, describe(applied.fault()));
    return applied;
  }
  tidy();
  restage();
  wish_preview();
  return {};
}

void Session::State::tidy() {
  std::erase_if(selection.things, [&](const Thing& thing) { return !exists(project(), thing); });
  view.frame = std::clamp(view.frame, 0, std::max(0, project().frames.count - 1));
  if (view.renaming && !exists(project(), *view.renaming)) view.renaming.reset();
  if (view.key_time_s && !has_key_at(project(), selection.primary(), *view.key_time_s)) view.key_time_s.reset();
}

/// Behind the window; until then the rest of the room stands without them.
void Session::State::read_files(const std::vector<AssetReference>& wanted) {
  if (wanted.empty() || reading) return;
  reading = true;
  jobs.start("Read " + wanted.front().file + (wanted.size() > 1 ? " and others" : ""),
             [this, folder = document->folder(), wanted](const Jobs::Progress&, std::stop_token) -> Jobs::Finish {
               auto read = std::make_shared<AssetShelf::Read>(AssetShelf::read(folder, wanted));
               return [this, folder, read] {
                 reading = false;
                 if (!document || document->folder() != folder) return;
                 document->shelf().put(std::move(*read));
                 staged_frame = -1;
                 restage();
                 wish_preview();
               };
             });
}

void Session::State::restage() {
  if (!document) {
    stage = nullptr;
    return;
  }
  if (staged_revision == revision() && staged_frame == view.frame && stage) return;
  read_files(document->shelf().unread(project()));
  asset_findings = document->shelf().findings(project());
  const Assets& assets = document->shelf().assets();
  auto stood = focalstage::stage(without_missing(project(), assets, frame_time_s()), assets, frame_time_s());
  if (!stood) {
    const Fault& fault = stood.fault();
    asset_findings.push_back({Severity::error, fault.code, fault.where, fault.message, {}, {}});
    if (!stage) stage = std::make_shared<const Stage>();
  } else {
    stage = std::make_shared<const Stage>(std::move(*stood));
  }
  staged_revision = revision();
  staged_frame = view.frame;
}

std::shared_ptr<const SeenRig> Session::State::seen_rig() {
  if (view.rig_errors.empty()) return nullptr;
  if (off_rig && off_rig_stage == stage && off_rig_errors == view.rig_errors) return off_rig;
  const RealRig real = real_rig(project(), view.rig_errors);
  const Assets& assets = document->shelf().assets();
  const double time_s = frame_time_s() + real.late_s;
  auto stood = focalstage::stage(without_missing(real.project, assets, time_s), assets, time_s);
  if (!stood) return nullptr;  // restaging says why
  off_rig_stage = stage;
  off_rig_errors = view.rig_errors;
  off_rig = std::make_shared<const SeenRig>(SeenRig{std::make_shared<const Stage>(std::move(*stood)),
                                                    real.project.projectors.front().pose,
                                                    real.project.glasses.lens_to_pupil_mm / 1000.0, real.power_d});
  return off_rig;
}

void Session::State::wish_preview() {
  if (!document || !stage || project().projectors.empty() || project().slices.powers_d.empty()) return;
  PreviewWish wish;
  wish.revision = revision();
  wish.frame = view.frame;
  wish.project = document->history().now();
  wish.stage = stage;
  wish.models = models;
  wish.moving = dragging || view.playing;
  wish.uncompensated = view.compensation != ShownBreathing::on;
  wish.eye = eye_wish(view, eye_size_px);
  wish.eye.sweep_time_s = view.sweep_time_s;
  wish.eye.rig = seen_rig();
  wish.focus_at = focus_question;
  preview.want(std::move(wish));
  rig.show({revision(), view.frame, document->history().now(), document->folder()});
}

void Session::State::take(Document opened) {
  revision_base = revision() + 1;
  document.emplace(std::move(opened));
  selection = {};
  const ViewState fresh;
  view.renaming.reset();
  view.key_time_s.reset();
  view.frame = 0;
  view.playing = false;
  view.filled = fresh.filled;
  view.sweep_time_s.reset();
  view.rig_errors.clear();
  view.image = 0;
  staged_frame = -1;
  stage = nullptr;
  preview.clear();
  recent = recent_projects(folders);
  read_models();
  restage();
  fit_views();
  wish_preview();
  for (const Finding& note : document->notes()) say(LogLine::Kind::info, note.where + ": " + note.message);
}

void Session::State::read_models() {
  auto known = known_models(document->folder(), folders.config);
  if (!known) {
    say(LogLine::Kind::fault, describe(known.fault()));
    known = shipped_models();
  }
  models = std::make_shared<const ProjectorModels>(known ? *std::move(known) : ProjectorModels{});
}

/// The room's camera and the eye's field such that everything is seen at first.
void Session::State::fit_views() {
  const ViewState fresh;
  view.camera = fresh.camera;
  view.fov_deg = fresh.fov_deg;
  if (!stage_bounds(*stage).empty()) view.camera = fitted(fresh.camera, usual_pane_px, stage_bounds(*stage, {}, true));
  double slope = 0.0;
  const Rigid viewer_from_world = stage->world_from_viewer.inverse();
  const auto include = [&](const std::vector<Drawable>& drawables) {
    const Bounds bounds = world_bounds(drawables);
    for (int corner = 0; corner < 8 && !bounds.empty(); ++corner) {
      const glm::dvec3 at((corner & 1) != 0 ? bounds.max_m.x : bounds.min_m.x,
                          (corner & 2) != 0 ? bounds.max_m.y : bounds.min_m.y,
                          (corner & 4) != 0 ? bounds.max_m.z : bounds.min_m.z);
      const glm::dvec3 seen = viewer_from_world.point(at);
      if (seen.z < -0.05) {
        slope =
            std::max({slope, std::abs(seen.x / seen.z), usual_pane_px.x / usual_pane_px.y * std::abs(seen.y / seen.z)});
      }
    }
  };
  for (const StagedObject& object : stage->objects) include(object.drawables);
  if (slope > 0.0) view.fov_deg = std::clamp(glm::degrees(2.0 * std::atan(1.1 * slope)), narrowest_deg, widest_deg);
}

void Session::State::close_document() {
  if (!document) return;
  document->close();
  revision_base = revision() + 1;
  document.reset();
  selection = {};
  stage = nullptr;
  asset_findings.clear();
  preview.clear();
  recent = recent_projects(folders);
  left_behind = recoveries(folders, recent);
}

void Session::State::leave_then(std::function<void()> next) {
  if (!document || !document->unsaved()) {
    next();
    return;
  }
  asked = Asked{{"Save the changes to " + project().name + "?",
                 document->untitled() ? "It has never been saved." : "They are lost otherwise.",
                 {document->untitled() ? "Save As..." : "Save", "Discard", "Cancel"}},
                {}};
  const auto save = [this, next] {
    if (document->untitled()) {
      file_wish = FileWish::save_as;
      after_save = next;
      return;
    }
    if (Status saved = document->save(); !saved) {
      say(LogLine::Kind::fault, describe(saved.fault()));
      return;
    }
    next();
  };
  asked->answers = {save, next};
}

}  // namespace focalstage
