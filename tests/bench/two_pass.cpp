#include "tests/bench/two_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "core/mesh/measure.h"
#include "core/optics/eye.h"
#include "core/optics/look.h"
#include "tests/bench/gl_program.h"

namespace focalstage::bench {
namespace {

constexpr double near_m = 0.016;
constexpr double far_m = 100.0;
constexpr GLuint position_at = 0;
constexpr GLuint uv_at = 1;

/// A rectangle of the eye's tangent plane.
struct Window {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

/// Clip space of a window of the tangent plane; the first row of the image is its lowest.
glm::dmat4 clip_from_eye(const Window& window) {
  const glm::dvec2 size = window.high - window.low, sum = window.high + window.low;
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / size.x;
  clip[1][1] = 2.0 / size.y;
  clip[2] = {sum.x / size.x, sum.y / size.y, -(far_m + near_m) / (far_m - near_m), -1.0};
  clip[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return clip;
}

/// Clip space of the projector's image; its first row is its top, so that bytes are read back in the show's order.
glm::dmat4 clip_from_projector(const ProjectorModel& projector) {
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 * projector.focal_px.x / projector.width_px;
  clip[1][1] = -2.0 * projector.focal_px.y / projector.height_px;
  clip[2] = {1.0 - 2.0 * projector.centre_px.x / projector.width_px,
             1.0 - 2.0 * projector.centre_px.y / projector.height_px, -(far_m + near_m) / (far_m - near_m), -1.0};
  clip[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return clip;
}

/// A mesh in the driver's memory.
struct Upload {
  GLuint array = 0;
  std::array<GLuint, 3> buffers{};
  GLsizei count = 0;
  const Drawable* drawable = nullptr;
  bool closed = false;  ///< its backs need not be drawn
};

Upload upload(const Drawable& drawable) {
  const Mesh& mesh = *drawable.mesh;
  Upload up;
  up.drawable = &drawable;
  up.count = static_cast<GLsizei>(3 * mesh.triangles.size());
  up.closed = is_closed(mesh);
  std::vector<glm::vec3> positions(mesh.positions_m.begin(), mesh.positions_m.end());
  std::vector<glm::vec2> uvs(mesh.uvs.begin(), mesh.uvs.end());
  uvs.resize(positions.size());
  const auto bytes = [](const auto& list) { return static_cast<GLsizeiptr>(list.size() * sizeof(list[0])); };
  glGenVertexArrays(1, &up.array);
  glBindVertexArray(up.array);
  glGenBuffers(3, up.buffers.data());
  glBindBuffer(GL_ARRAY_BUFFER, up.buffers[0]);
  glBufferData(GL_ARRAY_BUFFER, bytes(positions), positions.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(position_at, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(position_at);
  glBindBuffer(GL_ARRAY_BUFFER, up.buffers[1]);
  glBufferData(GL_ARRAY_BUFFER, bytes(uvs), uvs.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(uv_at, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(uv_at);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, up.buffers[2]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(mesh.triangles), mesh.triangles.data(), GL_STATIC_DRAW);
  return up;
}

/// Images to draw into, with a depth buffer.
struct Target {
  GLuint framebuffer = 0;
  GLuint depth = 0;
  std::vector<GLuint> images;
};

Target target(int width_px, int height_px, GLenum format, std::size_t count) {
  Target made;
  glGenFramebuffers(1, &made.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, made.framebuffer);
  made.images.resize(count);
  glGenTextures(static_cast<GLsizei>(count), made.images.data());
  std::vector<GLenum> all;
  for (std::size_t i = 0; i < count; ++i) {
    glBindTexture(GL_TEXTURE_2D, made.images[i]);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width_px, height_px, 0, GL_RED, GL_FLOAT, nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
      glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);  // light and depth of two surfaces must not mix
    }
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
      glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    }
    all.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glFramebufferTexture2D(GL_FRAMEBUFFER, all.back(), GL_TEXTURE_2D, made.images[i], 0);
  }
  glGenRenderbuffers(1, &made.depth);
  glBindRenderbuffer(GL_RENDERBUFFER, made.depth);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_px, height_px);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, made.depth);
  glDrawBuffers(static_cast<GLsizei>(count), all.data());
  return made;
}

void forget(const Target& target) {
  glDeleteFramebuffers(1, &target.framebuffer);
  glDeleteRenderbuffers(1, &target.depth);
  glDeleteTextures(static_cast<GLsizei>(target.images.size()), target.images.data());
}

template <class Thing>
std::vector<Upload> upload_all(const std::vector<Thing>& things) {
  std::vector<Upload> all;
  for (const Thing& thing : things) {
    for (const Drawable& drawable : thing.drawables) all.push_back(upload(drawable));
  }
  return all;
}

void set(GLuint program, const char* name, const glm::dmat4& matrix) {
  const glm::mat4 m(matrix);
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(m));
}
void set(GLuint program, const char* name, double value) {
  glUniform1f(glGetUniformLocation(program, name), static_cast<float>(value));
}
void set(GLuint program, const char* name, const glm::dvec2& value) {
  glUniform2f(glGetUniformLocation(program, name), static_cast<float>(value.x), static_cast<float>(value.y));
}

double gray(const glm::dvec3& colour) { return 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z; }

}  // namespace

struct TwoPass::State {
  explicit State(const BenchScene& of);
  ~State();

  void draw_objects(Side side) const;
  void draw_surface_depth(Side side) const;
  void draw_surfaces(Side side, const SurfaceProgram& program, const Target& into) const;

  const BenchScene* scene;
  int width_px, height_px;
  std::vector<Upload> surfaces, objects;
  PerEye<Eye> eyes;
  PerEye<Window> windows;  ///< all that the eye can look at
  Target eye_image, surface_depth, one, all;
  GLuint object_program = 0;
  std::vector<SurfaceProgram> one_slice;
  SurfaceProgram all_slices;
};

namespace {

/// All looks through all slices at what the projector lights. A pixel in eight each way is enough for smooth surfaces;
/// a margin makes up for the rest.
Window window_of(const BenchScene& scene, const Eye& eye, const std::vector<glm::dvec3>& lit_m) {
  Window window;
  for (const glm::dvec3& world_m : lit_m) {
    const glm::dvec3 point_m = eye.eye_from_world.point(world_m);
    for (const double power_d : scene.settings.slices.powers_d) {
      const glm::dvec2 look =
          straight_look(point_m) * look_stretch(power_d, -point_m.z - eye.lens_to_pupil_m, eye.lens_to_pupil_m);
      window.low = glm::min(window.low, look);
      window.high = glm::max(window.high, look);
    }
  }
  const glm::dvec2 margin = 0.01 * (window.high - window.low);
  return {window.low - margin, window.high + margin};
}

/// Where the corners of the image meet the nearest and farthest planes on which the surfaces lie.
std::vector<glm::dvec3> lit_corners(const BenchScene& scene) {
  const Rigid& world_from_projector = scene.settings.projector.world_from_projector;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (const StagedSurface& surface : scene.stage.surfaces) {
    for (const Drawable& drawable : surface.drawables) {
      for (const glm::dvec3& position : drawable.mesh->positions_m) {
        const double z = (drawable.world_from_mesh * glm::dvec4(position, 1.0)).z;
        low_m = std::min(low_m, z);
        high_m = std::max(high_m, z);
      }
    }
  }
  std::vector<glm::dvec3> corners;
  const ProjectorModel& projector = scene.settings.projector;
  for (const double x : {0, projector.width_px}) {
    for (const double y : {0, projector.height_px}) {
      const glm::dvec3 ray = world_from_projector.direction({tangent_of_pixel(projector, {x, y}), -1.0});
      for (const double z : {low_m, high_m}) {
        corners.push_back(world_from_projector.position_m + ray * ((z - world_from_projector.position_m.z) / ray.z));
      }
    }
  }
  return corners;
}

}  // namespace

TwoPass::State::State(const BenchScene& of)
    : scene(&of),
      width_px(of.settings.projector.width_px),
      height_px(of.settings.projector.height_px),
      surfaces(upload_all(of.stage.surfaces)),
      objects(upload_all(of.stage.objects)),
      eyes(eyes_of(of.stage.world_from_viewer, of.stage.interpupillary_m, of.settings.lens_to_pupil_m)),
      eye_image(target(width_px, height_px, GL_RG32F, 1)),
      surface_depth(target(width_px, height_px, GL_R32F, 1)),
      one(target(width_px, height_px, GL_R8, 1)),
      all(target(width_px, height_px, GL_R8, of.settings.slices.powers_d.size())),
      object_program(object_program_gl()) {
  const std::vector<double>& powers_d = of.settings.slices.powers_d;
  for (std::size_t n = 0; n < powers_d.size(); ++n) {
    one_slice.push_back(surface_program(powers_d, {n}, of.settings.lens_to_pupil_m, of.surfaces_hide));
  }
  std::vector<std::size_t> every(powers_d.size());
  for (std::size_t n = 0; n < every.size(); ++n) every[n] = n;
  all_slices = surface_program(powers_d, every, of.settings.lens_to_pupil_m, of.surfaces_hide);
  for (const Side side : both_sides) windows[side] = window_of(of, eyes[side], lit_corners(of));
  glViewport(0, 0, width_px, height_px);
  glEnable(GL_DEPTH_TEST);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

TwoPass::State::~State() {
  for (const auto* list : {&surfaces, &objects}) {
    for (const Upload& up : *list) {
      glDeleteVertexArrays(1, &up.array);
      glDeleteBuffers(3, up.buffers.data());
    }
  }
  for (const Target* made : {&eye_image, &surface_depth, &one, &all}) forget(*made);
  for (const SurfaceProgram& program : one_slice) glDeleteProgram(program.id);
  glDeleteProgram(all_slices.id);
  glDeleteProgram(object_program);
}

void TwoPass::State::draw_objects(Side side) const {
  glBindFramebuffer(GL_FRAMEBUFFER, eye_image.framebuffer);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(object_program);
  set(object_program, "clip_from_eye", clip_from_eye(windows[side]));
  for (const Upload& up : objects) {
    const Finish& finish = up.drawable->finish;
    const bool checker = finish.kind == Finish::Kind::checker;
    set(object_program, "eye_from_mesh", eyes[side].eye_from_world.matrix() * up.drawable->world_from_mesh);
    set(object_program, "first", gray(finish.a));
    set(object_program, "second", gray(checker ? finish.b : finish.a));
    set(object_program, "squares", glm::dvec2(finish.squares));
    (up.closed ? glEnable : glDisable)(GL_CULL_FACE);
    glBindVertexArray(up.array);
    glDrawElements(GL_TRIANGLES, up.count, GL_UNSIGNED_INT, nullptr);
  }
  glDisable(GL_CULL_FACE);
}

void TwoPass::State::draw_surface_depth(Side side) const {
  if (!scene->surfaces_hide) return;
  glBindFramebuffer(GL_FRAMEBUFFER, surface_depth.framebuffer);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(all_slices.depth_id);
  set(all_slices.depth_id, "clip_from_eye", clip_from_eye(windows[side]));
  for (const Upload& up : surfaces) {
    set(all_slices.depth_id, "eye_from_mesh", eyes[side].eye_from_world.matrix() * up.drawable->world_from_mesh);
    glBindVertexArray(up.array);
    glDrawElements(GL_TRIANGLES, up.count, GL_UNSIGNED_INT, nullptr);
  }
}

void TwoPass::State::draw_surfaces(Side side, const SurfaceProgram& program, const Target& into) const {
  glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(program.id);
  const Rigid projector_from_world = scene->settings.projector.world_from_projector.inverse();
  set(program.id, "low", windows[side].low);
  set(program.id, "per_size", 1.0 / (windows[side].high - windows[side].low));
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, surface_depth.images[0]);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, eye_image.images[0]);
  for (const Upload& up : surfaces) {
    set(program.id, "clip_from_mesh",
        clip_from_projector(scene->settings.projector) * projector_from_world.matrix() * up.drawable->world_from_mesh);
    set(program.id, "eye_from_mesh", eyes[side].eye_from_world.matrix() * up.drawable->world_from_mesh);
    glBindVertexArray(up.array);
    glDrawElements(GL_TRIANGLES, up.count, GL_UNSIGNED_INT, nullptr);
  }
}

TwoPass::TwoPass(std::unique_ptr<State> state) : state_(std::move(state)) {}
TwoPass::~TwoPass() = default;

Result<std::shared_ptr<TwoPass>> TwoPass::of(const BenchScene& scene) {
  auto state = std::make_unique<State>(scene);
  if (state->all_slices.id == 0 || state->object_program == 0 || glGetError() != GL_NO_ERROR) {
    return Fault{"bench.opengl", "", "the OpenGL programs of the two passes do not build here", ""};
  }
  return std::shared_ptr<TwoPass>(new TwoPass(std::move(state)));
}

void TwoPass::frame(Passes passes, std::vector<std::uint8_t>& codes) const {
  const State& state = *state_;
  const std::size_t slices = state.one_slice.size();
  const std::size_t bytes = static_cast<std::size_t>(state.width_px) * static_cast<std::size_t>(state.height_px);
  codes.resize(2 * slices * bytes);
  const auto read_back = [&](Side side, std::size_t n, std::size_t attachment) {
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    glReadPixels(0, 0, state.width_px, state.height_px, GL_RED, GL_UNSIGNED_BYTE,
                 &codes[(index_of(side) * slices + n) * bytes]);
  };
  for (const Side side : both_sides) {
    if (passes == Passes::fused) {
      state.draw_surface_depth(side);
      state.draw_objects(side);
      state.draw_surfaces(side, state.all_slices, state.all);
      for (std::size_t n = 0; n < slices; ++n) read_back(side, n, n);
      continue;
    }
    for (std::size_t n = 0; n < slices; ++n) {
      state.draw_surface_depth(side);
      state.draw_objects(side);
      state.draw_surfaces(side, state.one_slice[n], state.one);
      read_back(side, n, 0);
    }
  }
}

}  // namespace focalstage::bench
