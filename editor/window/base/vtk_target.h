#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include <glm/vec2.hpp>

#include "editor/window/base/picture.h"

class vtkGenericOpenGLRenderWindow;
class vtkRenderer;

namespace focalstage {

/// A VTK render window whose picture is a texture of the window's GL context. All calls but the constructor need that
/// context current; `finalize` comes before the context goes.
class VtkTarget {
 public:
  VtkTarget();
  ~VtkTarget();
  VtkTarget(const VtkTarget&) = delete;
  VtkTarget& operator=(const VtkTarget&) = delete;

  vtkRenderer* renderer() const;
  vtkGenericOpenGLRenderWindow* window() const;

  /// Renders at `supersample` times the size (2: a picture at rest, smoothed when drawn at half; line widths and point
  /// sizes are the caller's to double). `scale`: the window's content scale, for VTK's text. Below 1 pixel: nothing.
  void render(glm::ivec2 size_px, int supersample = 1, double scale = 1.0);

  /// What was rendered last; texture 0 before the first time.
  Picture picture() const;
  unsigned texture() const { return picture().texture; }

  /// Releases what belongs to the GL context; it renders no more afterwards.
  void finalize();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Where VTK's errors and warnings go instead of standard error; null: nowhere. For the whole program.
void send_vtk_messages_to(std::function<void(std::string_view)> sink);

}  // namespace focalstage
