#include "editor/window/views/room_scene.h"

#include <vtkCamera.h>
#include <vtkCollection.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "editor/session/session.h"
#include "editor/tools/known_bounds.h"
#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

void add_light(vtkRenderer& renderer, const glm::dvec3& from, const glm::dvec3& colour, double intensity) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();  // it stays with the eye of the beholder: no side is ever black
  light->SetPosition(from.x, from.y, from.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetColor(colour.r, colour.g, colour.b);
  light->SetIntensity(intensity);
  renderer.AddLight(light);
}

Bounds rough_bounds(const Stage& stage) {
  Bounds all{stage.world_from_viewer.position_m, stage.world_from_viewer.position_m};
  const auto include = [&](const std::vector<Drawable>& drawables) {
    const Bounds own = rough_world_bounds(drawables);
    if (!own.empty()) all = {glm::min(all.min_m, own.min_m), glm::max(all.max_m, own.max_m)};
  };
  for (const StagedSurface& surface : stage.surfaces) include(surface.drawables);
  for (const StagedObject& object : stage.objects) include(object.drawables);
  return all;
}

ObjectTint tint_wanted(const ViewState& view) {
  if (view.tint_by_slice) return ObjectTint::slices;
  return view.conflict ? ObjectTint::conflict : ObjectTint::none;
}

}  // namespace

RoomScene::RoomScene()
    : actors_(*target_.renderer()),
      surfaces_(*target_.renderer()),
      ground_(*target_.renderer()),
      sheet_faces_(*target_.renderer()) {
  vtkRenderer& renderer = *target_.renderer();
  renderer.GetCullers()->RemoveAllItems();  // they don't know our projection
  renderer.GradientBackgroundOn();
  renderer.SetBackground(0.068, 0.071, 0.080);   // below
  renderer.SetBackground2(0.125, 0.131, 0.147);  // above
  renderer.AutomaticLightCreationOff();
  add_light(renderer, {-0.7, 1.1, 0.9}, {1.0, 0.97, 0.92}, 0.95);
  add_light(renderer, {1.0, -0.2, 0.6}, {0.80, 0.88, 1.0}, 0.30);
}

RoomScene::~RoomScene() = default;

void RoomScene::forget_stale_tints(const Project& project, const Stage& stage, ObjectTint kind) {
  if (tinted_kind_ == kind && tinted_slices_ == project.slices && tinted_surfaces_ == stage.surfaces &&
      tinted_viewer_ == stage.world_from_viewer) {
    return;
  }
  tints_.clear();
  tinted_kind_ = kind;
  tinted_slices_ = project.slices;
  tinted_surfaces_ = stage.surfaces;
  tinted_viewer_ = stage.world_from_viewer;
}

const std::vector<Rgb>& RoomScene::tint_of(const Project& project, const Stage& stage, const StagedObject& object,
                                           std::size_t part, const Drawable& shown) {
  Tinted& tinted = tints_[{object.name, part}];
  if (tinted.colours.empty() || tinted.drawable != shown || tinted.depth != object.depth) {
    tinted = {object_tint(tinted_kind_, project, stage, object, shown, picker_), shown, object.depth};
  }
  return tinted.colours;
}

void RoomScene::take_objects(const Session& session, const Project& project, const Stage& stage) {
  const ObjectTint kind = tint_wanted(session.view());
  const bool tint = kind != ObjectTint::none && !project.slices.powers_d.empty();
  if (tint) {
    forget_stale_tints(project, stage, kind);
  } else {
    tints_.clear();
  }
  static const std::vector<Rgb> no_tint;
  meshes_.budget_for(stage);
  actors_.begin();
  for (const StagedObject& object : stage.objects) {
    for (std::size_t i = 0; i < object.drawables.size(); ++i) {
      const Drawable shown = meshes_.shown(object.drawables[i]);
      if (!shown.mesh) continue;  // its stand-in is being made
      actors_.show(meshes_, {"objects", object.name}, i, shown,
                   tint ? tint_of(project, stage, object, i, shown) : no_tint);
    }
  }
  for (const Fixture& fixture : fixtures(session)) {
    for (std::size_t i = 0; i < fixture.drawables.size(); ++i) {
      actors_.show(meshes_, fixture.thing, i, fixture.drawables[i], no_tint);
    }
  }
  actors_.end();
}

const std::vector<Fixture>& RoomScene::fixtures(const Session& session) {
  if (session.stage() && (session.stage() != fixed_stage_ || session.revision() != fixed_revision_)) {
    fixtures_ = focalstage::fixtures(session.project(), *session.stage());
    fixed_stage_ = session.stage();
    fixed_revision_ = session.revision();
  }
  return fixtures_;
}

void RoomScene::take(const Session& session) {
  const std::shared_ptr<const Stage> stage = session.stage() ? session.stage() : std::make_shared<const Stage>();
  const Project& project = session.project();
  const auto slices = session.slices();
  const ObjectTint tint = tint_wanted(session.view());
  const bool same_room =
      taken_stage_ && stage == taken_stage_ && session.revision() == taken_revision_ && !meshes_.take_news();
  if (same_room && slices == taken_slices_ && tint == taken_tint_) return;
  if (!same_room) {
    picker_.keep_only(*stage);
    sheets_ = slice_sheets(project, *stage, picker_);
    if (!session.dragging()) floor_ = floor_below(rough_bounds(*stage));
    ground_.show(floor_);
  }
  if (!same_room || tint != taken_tint_) {
    take_objects(session, project, *stage);
    meshes_.forget_unused();
  }
  surfaces_.show(*stage, project, slices, picker_, meshes_);

  taken_stage_ = stage;
  taken_revision_ = session.revision();
  taken_slices_ = slices;
  taken_tint_ = tint;
}

void RoomScene::set_camera(const RoomView& view) {
  vtkCamera& camera = *target_.renderer()->GetActiveCamera();
  const Rigid& pose = view.world_from_camera;
  const glm::dvec3 ahead_m = pose.point({0.0, 0.0, -1.0});
  const glm::dvec3 up = pose.direction({0.0, 1.0, 0.0});
  camera.SetPosition(pose.position_m.x, pose.position_m.y, pose.position_m.z);
  camera.SetFocalPoint(ahead_m.x, ahead_m.y, ahead_m.z);
  camera.SetViewUp(up.x, up.y, up.z);
  camera.SetClippingRange(view.near_m, view.far_m);
  const glm::dmat4 clip = clip_from_camera(view);
  vtkNew<vtkMatrix4x4> projection;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) projection->SetElement(row, column, clip[column][row]);
  }
  camera.SetExplicitProjectionTransformMatrix(projection);
  camera.UseExplicitProjectionTransformMatrixOn();
}

std::vector<Drawable> RoomScene::light(std::vector<Drawable> drawables) {
  for (Drawable& drawable : drawables) {
    if (const Drawable shown = meshes_.shown(drawable); shown.mesh) drawable = shown;
  }
  return drawables;
}

void RoomScene::render(const RoomView& view, const Session& session, int supersample, double scale) {
  set_camera(view);
  const ViewState& state = session.view();
  const bool through_viewer =
      state.look_through == LookThrough::left_eye || state.look_through == LookThrough::right_eye;
  actors_.set_visible("viewer", !through_viewer);
  actors_.set_visible("projectors", state.look_through != LookThrough::projector);
  if (state.show_sheets && state.look_through == LookThrough::nothing) {
    sheet_faces_.show(sheets_, session.project().slices.powers_d, view);
  } else {
    sheet_faces_.hide();
  }
  const double width_px = std::max(1.0, std::round(scale)) * supersample;
  ground_.set_line_width(width_px);
  sheet_faces_.set_line_width(width_px);
  target_.render(glm::ivec2(view.size_px), supersample, scale);
}

}  // namespace focalstage
