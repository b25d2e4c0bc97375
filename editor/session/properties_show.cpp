// Viewer, lights, slices, frames, and the project itself.
#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "core/optics/vergence.h"
#include "editor/session/angles.h"
#include "editor/session/edits.h"
#include "editor/session/property_rows.h"
#include "editor/tools/sight_frame.h"

namespace focalstage {
namespace {

// Lights --------------------------------------------------------------------------------------------------------------

const Light* light_of(const PropertyScope& scope, const Thing& thing) {
  const auto& lights = scope.project.lights;
  const auto at = std::find_if(lights.begin(), lights.end(), [&](const Light& one) { return one.name == thing.name; });
  return at == lights.end() ? nullptr : &*at;
}

/// Straight up or down the azimuth would be lost.
constexpr double highest_deg = 89.9;

/// Whichever of the two angles the row is, the other stays.
std::vector<Edit> set_source(const PropertyScope& scope, const Thing& thing, const Property& row, const Value& value) {
  const Light* light = light_of(scope, thing);
  if (!light || !value.number()) return {};
  glm::dvec2 angles_deg = source_of(light->direction);
  angles_deg.y = std::clamp(angles_deg.y, -highest_deg, highest_deg);
  (row.id == "azimuth" ? angles_deg.x : angles_deg.y) = *value.number();
  return {set_edit(thing, "direction", value_of(direction_from(angles_deg)))};
}

void add_source_rows(PropertyRows& rows, const Light& light) {
  rows.group("Direction");
  const glm::dvec2 angles_deg = source_of(light.direction);
  const auto add = [&](const char* label, double value, double most, const char* help) {
    Property& row = rows.add(Property::Kind::number, label, Value(value));
    row.unit = "°";
    row.digits = 1;
    row.step = 0.5;
    row.least = -most;
    row.most = most;
    row.key = "direction";
    row.edits = set_source;
    row.help = help;
  };
  add("azimuth", angles_deg.x, 360.0, "Where the light comes from: 0 from behind the viewer, 90 from the right.");
  add("elevation", angles_deg.y, highest_deg, "How high above the horizon the light comes from.");
}

// Slices --------------------------------------------------------------------------------------------------------------

/// The distance of the surface most of the picture is on, from the lens.
std::optional<double> surface_distance_m(const PropertyScope& scope) {
  if (!scope.stage || !scope.picker) return std::nullopt;
  const SightFrame sight = sight_frame(scope.project, *scope.stage);
  const StagedSurface* surface = main_surface(sight, *scope.stage, *scope.picker);
  return surface ? mean_axial_m(sight, *surface) : std::nullopt;
}

void add_power_rows(PropertyRows& rows) {
  const std::vector<double>& powers_d = rows.scope().project.slices.powers_d;
  const auto surface_m = surface_distance_m(rows.scope());
  // At 1/d_e the lens's image meets the pupil, where no power can be meant (core/scene refuses it).
  const double limit_d = 1000.0 / rows.scope().project.glasses.lens_to_pupil_mm - 0.01;
  KeyFacts facts;
  facts.fresh = Value(0.0);
  facts.least = -limit_d;
  facts.most = limit_d;
  rows.group("Powers");
  for (std::size_t i = 0; i < powers_d.size(); ++i) {
    const std::string index = std::to_string(i);
    Property& row = rows.number_with(facts, "slice " + index, "powers_d/" + index, {"D", 2, 0.01});
    row.removable = powers_d.size() > 1;
    if (surface_m) row.other = distance_text(image_vergence_d(*surface_m, powers_d[i]));
    row.help = "The lens's power at which this slice is shown, and where its picture then floats.";
  }
  rows.action("Add a slice", "add.slice");
}

// Frames --------------------------------------------------------------------------------------------------------------

std::vector<Edit> set_cue_time(const PropertyScope&, const Thing&, const Property& row, const Value& value) {
  const Thing cue{"cues", *row.args.text()};
  if (value.is_null()) return {{Edit::Kind::remove, cue.list, cue.name, "", {}}};
  return {set_edit(cue, "time_s", value)};
}

void add_cue_rows(PropertyRows& rows) {
  rows.group("Cues");
  const KeyFacts facts = key_facts<Cue>("time_s");
  for (const Cue& cue : rows.scope().project.cues) {
    Property& row = rows.add(Property::Kind::number, cue.name, Value(cue.time_s));
    row.id = "cue " + cue.name;
    row.unit = "s";
    row.step = 0.01;
    row.least = facts.least;
    row.most = facts.most;
    row.removable = true;
    row.key = "time_s";
    row.args = Value(cue.name);
    row.edits = set_cue_time;
    row.other = "frame " + std::to_string(std::llround(cue.time_s * rows.scope().project.frames.rate_hz));
  }
  rows.action("Add a cue at this frame", "cue.add");
}

std::string sweeps_text(double sweep_hz, double rate_hz) {
  const double sweeps = sweep_hz / rate_hz;
  const double whole = std::round(sweeps);
  if (std::abs(sweeps - whole) > 1e-6) return fixed_text(sweeps, 2) + " sweeps";
  return whole == 1.0 ? "every sweep" : "every " + fixed_text(whole, 0) + " sweeps";
}

void add_compensation_rows(PropertyRows& rows) {
  rows.group("Surface colour");
  Property& mode = rows.choice(
      "make up for", "compensation/mode",
      {{Value("off"), "nothing"}, {Value("albedo"), "paint and black"}, {Value("even"), "paint, black and distance"}});
  if (mode.value.is_null()) mode.value = Value("off");  // a project does not say it
  mode.help = "Codes such that the light wanted is what comes back from the surfaces.";
  rows.number<Compensation>("white", "compensation/white", {"", 3, 0.002}).help =
      "What a wanted 1 comes back as; less leaves room for dark paint.";
  Property& reference = rows.number<Compensation>("reference", "compensation/reference_m", {"m", 2, 0.01});
  reference.fresh = Value(1.0);
  reference.help = "How far from the projector light counts as 1. Not set: its focus, or 1 m.";
}

}  // namespace

void add_viewer_rows(PropertyRows& rows) {
  add_pose_rows(rows);
  rows.group("Eyes");
  rows.number<Viewer>("between pupils", "interpupillary_mm", {"mm", 1, 0.1});
  add_movement_rows(rows);
}

void add_light_rows(PropertyRows& rows) {
  const Light* light = light_of(rows.scope(), rows.thing());
  if (light && light->kind == LightKind::point) add_pose_rows(rows);
  if (light && light->kind == LightKind::sun) add_source_rows(rows, *light);
  rows.group("Light");
  rows.choice("kind", "kind",
              {{Value("sun"), "sun"}, {Value("point"), "point"}, {Value("sky"), "sky, from everywhere"}});
  rows.colour("colour", "color", Value(Value::Array{1.0, 1.0, 1.0}));
  rows.number<Light>("intensity", "intensity", {"", 2, 0.005}).help =
      "On a surface that faces it; of a point, at one metre.";
  rows.group("In the project");
  add_name_row(rows);
}

void add_slices_rows(PropertyRows& rows) {
  add_power_rows(rows);
  rows.group("Compiling");
  rows.choice("assignment", "assignment",
              {{Value("nearest"), "nearest slice"}, {Value("linear"), "linear"}, {Value("optimal"), "optimal"}})
      .help = "How depths between two slices are shared by them.";
  rows.choice("breathing", "breathing", {{Value("exact"), "exact"}, {Value("planar"), "planar"}, {Value("off"), "off"}})
      .help = "How the lens's change of size with its power is made up for.";
  rows.choice("samples", "samples_per_pixel",
              {{Value(1.0), "1 per pixel"}, {Value(4.0), "4"}, {Value(9.0), "9"}, {Value(16.0), "16"}})
      .help = "More make edges smoother and compiling slower.";
  add_compensation_rows(rows);
}

void add_frames_rows(PropertyRows& rows) {
  const Project& project = rows.scope().project;
  rows.group("Frames");
  Property& count = rows.number<Frames>("frames", "count", {"", 0, 0.2});
  count.other = fixed_text(project.frames.count / project.frames.rate_hz, 2) + " s";
  Property& rate = rows.number<Frames>("rate", "rate_hz", {"Hz", 2, 0.1});
  rate.other = sweeps_text(project.sweep.frequency_hz, project.frames.rate_hz);
  rate.help = "Frames in a second. A frame lasts a whole number of sweeps.";
  add_cue_rows(rows);
}

void add_project_rows(PropertyRows& rows) {
  const Project& project = rows.scope().project;
  rows.group("Project");
  rows.text("name", "name");
  rows.number<Project>("light of the room", "ambient_lux", {"lx", 1, 0.1}).help =
      "On every surface, all the time; previews show it where the projector's lumens are known.";
  rows.group("Holds");
  const auto count = [&](const char* label, std::size_t number) { rows.shown(label, grouped_text(number)); };
  count("surfaces", project.surfaces.size());
  count("objects", project.objects.size());
  count("lights", project.lights.size());
  count("projectors", project.projectors.size());
  count("slices", project.slices.powers_d.size());
  count("frames", static_cast<std::size_t>(std::max(project.frames.count, 0)));
  count("cues", project.cues.size());
  if (!rows.scope().stage) return;
  std::size_t triangles = 0;
  for (const StagedSurface& surface : rows.scope().stage->surfaces) triangles += triangles_of(surface.drawables);
  for (const StagedObject& object : rows.scope().stage->objects) triangles += triangles_of(object.drawables);
  count("triangles", triangles);
}

}  // namespace focalstage
