#pragma once

#include <cstdint>
#include <span>

#include <glm/vec2.hpp>

namespace focalstage {

/// A texture to be shown as it is, opaque: what VTK rendered, or codes of our own.
struct Picture {
  enum class Rows { from_top, from_bottom };
  enum class Filter { nearest, linear };

  unsigned texture = 0;
  glm::ivec2 size_px{0};
  Rows rows = Rows::from_top;
  Filter filter = Filter::nearest;
};

/// Puts the picture into the current ImGui window's draw list at `min`, `size` large, without blending: each code
/// reaches the screen unchanged where sizes agree. Texture 0 draws nothing.
void draw_picture(const Picture& picture, glm::vec2 min, glm::vec2 size);

/// The part of it between `uv_min` and `uv_max`, both counted from the top left of the picture as a person sees it.
void draw_picture(const Picture& picture, glm::vec2 min, glm::vec2 size, glm::vec2 uv_min, glm::vec2 uv_max);

/// A GL texture of 8-bit codes. Needs the window's GL context for every call but the constructor; `release` before it
/// goes.
class CodesTexture {
 public:
  CodesTexture() = default;
  ~CodesTexture() { release(); }
  CodesTexture(const CodesTexture&) = delete;
  CodesTexture& operator=(const CodesTexture&) = delete;

  /// Rows from the top, 1 channel (shown gray), 3 or 4. A picture of the same size replaces the last in place.
  void set(glm::ivec2 size_px, int channels, std::span<const std::uint8_t> codes);

  Picture picture() const { return {texture_, size_px_, Picture::Rows::from_top, Picture::Filter::nearest}; }
  void release();

 private:
  unsigned texture_ = 0;
  glm::ivec2 size_px_{0};
  int channels_ = 0;
};

}  // namespace focalstage
