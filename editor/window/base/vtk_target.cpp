#include "editor/window/base/vtk_target.h"

#include <vtkAutoInit.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>

// VTK's own way to have its factories registered without a start-up call.
VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingUI);

namespace focalstage {

struct VtkTarget::State {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  Picture picture;
  bool finalized = false;
};

VtkTarget::VtkTarget() : state_(std::make_unique<State>()) {
  vtkGenericOpenGLRenderWindow& window = *state_->window;
  window.SetFrameBlitModeToNoBlit();  // the render framebuffer's own texture is the picture: no copy
  window.SetMultiSamples(0);
  window.SetSwapBuffers(0);
  window.SetIsCurrent(true);  // without it Render does nothing, silently
  window.SetSupportsOpenGL(1);
  window.SetMapped(1);
  state_->renderer->SetBackgroundAlpha(1.0);
  window.AddRenderer(state_->renderer);
}

VtkTarget::~VtkTarget() { finalize(); }

vtkRenderer* VtkTarget::renderer() const { return state_->renderer; }
vtkGenericOpenGLRenderWindow* VtkTarget::window() const { return state_->window; }

void VtkTarget::render(glm::ivec2 size_px, int supersample, double scale) {
  if (size_px.x < 1 || size_px.y < 1 || state_->finalized) return;
  vtkGenericOpenGLRenderWindow& window = *state_->window;
  window.SetSize(size_px.x * supersample, size_px.y * supersample);
  window.SetDPI(static_cast<int>(72.0 * scale * supersample + 0.5));
  window.Render();
  vtkTextureObject* texture = window.GetRenderFramebuffer()->GetColorAttachmentAsTextureObject(0);
  state_->picture.texture = texture != nullptr ? texture->GetHandle() : 0;
  state_->picture.size_px = size_px * supersample;
  state_->picture.rows = Picture::Rows::from_bottom;
  state_->picture.filter = supersample > 1 ? Picture::Filter::linear : Picture::Filter::nearest;
}

Picture VtkTarget::picture() const { return state_->picture; }

void VtkTarget::finalize() {
  if (state_->finalized) return;
  state_->finalized = true;
  state_->picture = {};
  state_->window->Finalize();
}

}  // namespace focalstage
