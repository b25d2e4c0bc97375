#include "tests/bench/gl_context.h"

#include <cstdlib>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace focalstage::bench {
namespace {

Fault no_gl(const char* what) {
  return {"bench.opengl", "", what, "install Mesa's software OpenGL (libgl1-mesa-dri, libegl1)"};
}

}  // namespace

Result<std::shared_ptr<GlContext>> GlContext::make() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // the comparison is between processors
  const std::shared_ptr<GlContext> made(new GlContext);
  made->display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (made->display_ == EGL_NO_DISPLAY || !eglInitialize(made->display_, nullptr, nullptr)) {
    return no_gl("EGL has no surfaceless display");
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  made->context_ = eglCreateContext(made->display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (made->context_ == EGL_NO_CONTEXT) return no_gl("EGL makes no OpenGL 3.3 context");
  if (!eglMakeCurrent(made->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, made->context_)) {
    return no_gl("the OpenGL context cannot be used without a surface");
  }
  return made;
}

GlContext::~GlContext() {
  if (!display_) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_) eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string GlContext::renderer() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace focalstage::bench
