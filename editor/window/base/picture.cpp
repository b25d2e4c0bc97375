#include "editor/window/base/picture.h"

#include <epoxy/gl.h>

#include <utility>

#include "editor/window/base/im.h"

namespace focalstage {
namespace {

// ImGui hands a draw callback one pointer: the texture's name and the filter travel in its bits.
void* packed(const Picture& picture) {
  const auto linear = static_cast<std::uintptr_t>(picture.filter == Picture::Filter::linear);
  return reinterpret_cast<void*>((static_cast<std::uintptr_t>(picture.texture) << 1) | linear);
}

void begin_opaque(const ImDrawList*, const ImDrawCmd* command) {
  const auto bits = reinterpret_cast<std::uintptr_t>(command->UserCallbackData);
  const GLint filter = (bits & 1) != 0 ? GL_LINEAR : GL_NEAREST;
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bits >> 1));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glDisable(GL_BLEND);
}

void end_opaque(const ImDrawList*, const ImDrawCmd*) { glEnable(GL_BLEND); }

GLenum format_of(int channels) { return channels == 1 ? GL_RED : channels == 3 ? GL_RGB : GL_RGBA; }

}  // namespace

void draw_picture(const Picture& picture, glm::vec2 min, glm::vec2 size) {
  draw_picture(picture, min, size, {0.0f, 0.0f}, {1.0f, 1.0f});
}

void draw_picture(const Picture& picture, glm::vec2 min, glm::vec2 size, glm::vec2 uv_min, glm::vec2 uv_max) {
  if (picture.texture == 0) return;
  if (picture.rows == Picture::Rows::from_bottom) {
    uv_min.y = 1.0f - uv_min.y;
    uv_max.y = 1.0f - uv_max.y;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture.texture));
  list.AddCallback(begin_opaque, packed(picture));
  list.AddImage(id, to_im(min), to_im(min + size), to_im(uv_min), to_im(uv_max));
  list.AddCallback(end_opaque, nullptr);
}

void CodesTexture::set(glm::ivec2 size_px, int channels, std::span<const std::uint8_t> codes) {
  const auto needed =
      static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y) * static_cast<std::size_t>(channels);
  if (size_px.x < 1 || size_px.y < 1 || codes.size() < needed) return;
  const bool fresh = texture_ == 0 || size_px != size_px_ || channels != channels_;
  if (texture_ == 0) glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (fresh) {
    constexpr GLint internal[] = {0, GL_R8, 0, GL_RGB8, GL_RGBA8};
    glTexImage2D(GL_TEXTURE_2D, 0, internal[channels], size_px.x, size_px.y, 0, format_of(channels), GL_UNSIGNED_BYTE,
                 codes.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    const bool gray = channels == 1;
    const GLint swizzle[] = {GL_RED, gray ? GL_RED : GL_GREEN, gray ? GL_RED : GL_BLUE,
                             channels == 4 ? GL_ALPHA : GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_px.x, size_px.y, format_of(channels), GL_UNSIGNED_BYTE, codes.data());
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  size_px_ = size_px;
  channels_ = channels;
}

void CodesTexture::release() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  texture_ = 0;
  size_px_ = {0, 0};
}

}  // namespace focalstage
