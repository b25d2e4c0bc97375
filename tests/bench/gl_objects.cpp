#include "tests/bench/gl_objects.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/measure.h"

namespace focalstage::bench {
namespace {

constexpr GLuint position_at = 0;  // as the shaders say
constexpr GLuint uv_at = 1;

}  // namespace

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

void forget(const Upload& upload) {
  glDeleteVertexArrays(1, &upload.array);
  glDeleteBuffers(static_cast<GLsizei>(upload.buffers.size()), upload.buffers.data());
}

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

}  // namespace focalstage::bench
