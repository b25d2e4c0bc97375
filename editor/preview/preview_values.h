#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/rigid.h"
#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"

namespace focalstage {

/// The frame in view, compiled: at full size (`divisor` 1), or smaller while a hand is still moving things.
struct CompiledSlices {
  std::uint64_t revision = 0;
  int frame = 0;
  int divisor = 1;
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Stage> stage;
  CompileSettings settings;  ///< with the projector at the shown size
  FrameImages images;
  FrameImages uncompensated;  ///< the same without breathing compensation; empty unless asked for
  FrameMeasure measure;
  double compile_ms = 0.0;
};

/// What the project as a whole comes to; complete at full size only.
struct CheckedProject {
  std::uint64_t revision = 0;
  bool measured = false;  ///< the findings that need a compiled frame are in
  ScheduleResult schedule;
  std::vector<ImageSpec> images;
  std::vector<Finding> findings;
};

enum class EyeLook { left, right, red_cyan, side_by_side };
/// The sweep, one slice at 0 D as a projection without it would show, or both beside each other.
enum class EyeProjection { multifocal, conventional, both };

/// The rig as it may really be, where it is not as the project says: images are made for the one, seen in the other.
struct SeenRig {
  std::shared_ptr<const Stage> stage;
  Rigid world_from_projector;
  double lens_to_pupil_m = 0.015;
  double power_d = 0.0;  ///< of the lens, beside what it is told
};

/// How to look: what of the view state the eye's picture depends on.
struct EyeWish {
  EyeLook look = EyeLook::left;
  double focus_d = 2.0;
  double pupil_mm = 4.0;
  EyeProjection projection = EyeProjection::multifocal;
  bool conflict = false;  ///< tint what vergence and accommodation disagree about
  glm::dvec3 head_offset_m{0.0};
  double fov_deg = 40.0;  ///< of each panel
  int width_px = 400;     ///< of all panels
  int height_px = 300;
  std::optional<double> sweep_time_s;  ///< only the exposure at that moment
  std::shared_ptr<const SeenRig> rig;  ///< null: as the project says
  bool operator==(const EyeWish&) const = default;
};

/// A part of the eye's picture, from left to right.
struct EyePanel {
  EyeLook look = EyeLook::left;  ///< never side_by_side
  EyeProjection projection = EyeProjection::multifocal;
  bool operator==(const EyePanel&) const = default;
};

/// The panels that a wish asks for.
std::vector<EyePanel> panels_of(const EyeWish& wish);

/// How far vergence and accommodation part over one thing, as the first panel shows it.
struct NamedConflict {
  std::string name;
  double mean_d = 0.0;  ///< positive: the focus lies further away
};

/// What is seen.
struct EyePicture {
  std::uint64_t revision = 0;
  int divisor = 1;
  int width_px = 0;
  int height_px = 0;
  double focus_d = 0.0;
  bool off = false;  ///< seen in a rig that is not as the project says
  std::vector<EyePanel> panels;
  std::vector<NamedConflict> conflicts;  ///< of what is lit, where asked for
  std::vector<std::uint8_t> rgb;         ///< rows from the top, sRGB
};

/// "Focus here": at which accommodation is what the eye's picture shows at `at` (0..1 from its top left corner) sharp?
struct FocusQuestion {
  int serial = 0;
  glm::dvec2 at{0.5};
  bool operator==(const FocusQuestion&) const = default;
};
struct FocusAnswer {
  int serial = 0;
  double focus_d = 0.0;
};

/// What the preview is to show: the newest wish is the only one.
struct PreviewWish {
  std::uint64_t revision = 0;
  int frame = 0;
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Stage> stage;
  std::shared_ptr<const ProjectorModels> models;  ///< null: none are known
  bool moving = false;                            ///< a hand is still at it: reduced size is enough
  bool uncompensated = false;
  EyeWish eye;
  std::optional<FocusQuestion> focus_at;
};

}  // namespace focalstage
