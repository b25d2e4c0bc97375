#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/rigid.h"
#include "core/scene/value.h"

namespace focalstage {

// What is done to a mesh after it was read: each step takes what the one before it made (core/process).

/// Vertices this near to each other become one.
struct WeldStep {
  double tolerance_mm = 0.0;
  bool operator==(const WeldStep&) const = default;
};
/// Triangles without area and doubles go.
struct CleanStep {
  bool operator==(const CleanStep&) const = default;
};
/// Sheets that hang on an edge of others go.
struct DropFinsStep {
  bool operator==(const DropFinsStep&) const = default;
};
/// Loose bits go that are small against the largest one.
struct DropBitsStep {
  double least_share = 0.01;  ///< of its area
  bool operator==(const DropBitsStep&) const = default;
};
/// Neighbours wind alike, closed bodies outwards.
struct FixWindingStep {
  bool operator==(const FixWindingStep&) const = default;
};
/// The back becomes the front.
struct FlipStep {
  bool operator==(const FlipStep&) const = default;
};
struct FillHolesStep {
  std::optional<double> longest_mm;  ///< around; without: what is a hole by its shape
  bool operator==(const FillHolesStep&) const = default;
};
/// Only one of the parts between the folds, the largest is 0.
struct KeepPartStep {
  int part = 0;
  double fold_deg = 30.0;
  bool operator==(const KeepPartStep&) const = default;
};
/// Down to so many triangles, or by so much error.
struct DecimateStep {
  std::optional<int> triangles;
  std::optional<double> error_mm;
  bool operator==(const DecimateStep&) const = default;
};
struct SmoothStep {
  int rounds = 10;
  double feature_deg = 30.0;  ///< edges this sharp stay
  bool operator==(const SmoothStep&) const = default;
};
enum class Subdivision { loop, sqrt3 };
struct SubdivideStep {
  Subdivision scheme = Subdivision::loop;
  int rounds = 1;
  bool operator==(const SubdivideStep&) const = default;
};

/// New texture coordinates: the picture lies on a plane and goes straight through the mesh. It stands as a primitive
/// plane does, along the thing's own axes and in metres of the room: u along its +X, v along +Y.
struct UvPlaneStep {
  Rigid pose;                        ///< where the middle of the picture is
  std::optional<glm::dvec2> size_m;  ///< of the picture; without: what the mesh fills of the plane
  bool operator==(const UvPlaneStep&) const = default;
};
/// New texture coordinates: each place has the pixel with which a projector without distortion lights it. The lens is
/// that of a `Projector`, the pose in the thing's own axes and metres of the room, so that the picture stays on the
/// thing.
struct UvProjectorStep {
  Rigid pose;
  int width_px = 1024;
  int height_px = 768;
  double fx_px = 1400.0;
  double fy_px = 1400.0;
  double cx_px = 512.0;
  double cy_px = 384.0;
  bool operator==(const UvProjectorStep&) const = default;
};

using ProcessKind =
    std::variant<WeldStep, CleanStep, DropFinsStep, DropBitsStep, FixWindingStep, FlipStep, FillHolesStep, KeepPartStep,
                 DecimateStep, SmoothStep, SubdivideStep, UvPlaneStep, UvProjectorStep>;

struct ProcessStep {
  ProcessKind kind;
  Value::Object unknown{};
  bool operator==(const ProcessStep&) const = default;
};

}  // namespace focalstage
