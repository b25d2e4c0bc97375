#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <epoxy/gl.h>

#include "core/stage/stage.h"

namespace focalstage::bench {

/// A mesh in the driver's memory.
struct Upload {
  GLuint array = 0;
  std::array<GLuint, 3> buffers{};
  GLsizei count = 0;
  const Drawable* drawable = nullptr;
  bool closed = false;  ///< its backs need not be drawn
};

Upload upload(const Drawable& drawable);
void forget(const Upload& upload);

/// Images to draw into, with a depth buffer.
struct Target {
  GLuint framebuffer = 0;
  GLuint depth = 0;
  std::vector<GLuint> images;
};

Target target(int width_px, int height_px, GLenum format, std::size_t count);
void forget(const Target& target);

}  // namespace focalstage::bench
