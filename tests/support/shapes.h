#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"
#include "core/stage/stage.h"

namespace focalstage::support {

using SharedMesh = std::shared_ptr<const Mesh>;

/// A sheet of `columns` x `rows` cells: `place` maps the unit square to space. UV is the unit square, normals smooth.
SharedMesh sheet(int columns, int rows, const std::function<glm::dvec3(double u, double v)>& place);

/// A rectangle of `size_m` in local XY, facing +Z.
SharedMesh rectangle(const glm::dvec2& size_m);

/// A rectangle that swells towards +Z in waves of `height_m`, 2 * cells^2 triangles.
SharedMesh bumpy(const glm::dvec2& size_m, double height_m, int cells, double waves = 1.0);

/// x < 0 at z = 0, x > 0 at z = -depth_m, and a wall between.
SharedMesh step(const glm::dvec2& size_m, double depth_m);

/// Two wings of `size_m` along local Y, opening towards +Z at `angle_deg`.
SharedMesh fold(const glm::dvec2& wing_m, double angle_deg);

/// A box around the origin, flat faces, no normals.
SharedMesh box(const glm::dvec3& size_m);

/// A closed lumpy ball of 12 * cells^2 triangles about the origin; `lumps` is the share by which its radius varies.
SharedMesh blob(double radius_m, int cells, double lumps, std::uint64_t seed);

/// Vertex normals as the sum of the neighbouring triangles' areas.
void smooth_normals(Mesh& mesh);

/// The drawable of a mesh where it stands.
Drawable standing(SharedMesh mesh, const Rigid& world_from_mesh = {}, double scale = 1.0);

StagedSurface surface_of(const Drawable& drawable, double illumination = 0.0);
StagedObject object_of(const Drawable& drawable, const Depth& depth = {});

/// Where something at `from` stands that looks at `to` (its -Z), turned by `roll_rad` about that line.
Rigid looking(const glm::dvec3& from_m, const glm::dvec3& to_m, double roll_rad = 0.0);

}  // namespace focalstage::support
