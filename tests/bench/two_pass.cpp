#include "tests/bench/two_pass.h"

#include <utility>

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "core/optics/eye.h"
#include "tests/bench/gl_objects.h"
#include "tests/bench/gl_program.h"
#include "tests/bench/views.h"

namespace focalstage::bench {
namespace {

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
  for (const Side side : both_sides) windows[side] = window_of(of, eyes[side]);
  glViewport(0, 0, width_px, height_px);
  glEnable(GL_DEPTH_TEST);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

TwoPass::State::~State() {
  for (const auto* list : {&surfaces, &objects}) {
    for (const Upload& up : *list) forget(up);
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
