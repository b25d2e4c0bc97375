#pragma once

#include <cstddef>
#include <vector>

#include <epoxy/gl.h>

namespace focalstage::bench {

/// First pass: light and depth of the objects. 0 where it does not build.
GLuint object_program_gl();

/// Second pass for some slices at once, each into a target of its own, and the depth of the surfaces from the eye.
struct SurfaceProgram {
  GLuint id = 0;
  GLuint depth_id = 0;
};

SurfaceProgram surface_program(const std::vector<double>& powers_d, const std::vector<std::size_t>& slices,
                               double lens_to_pupil_m, bool surfaces_hide);

}  // namespace focalstage::bench
