#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

struct ImDrawData;
struct ImDrawList;

namespace focalstage {

/// Puts ImGui's frame on the screen. The picture is kept in a framebuffer of its own: of a frame in which one pane
/// changed, only that rectangle is drawn again, which on a machine without a GPU is most of the cost.
class FramePainter {
 public:
  FramePainter() = default;
  ~FramePainter() { release(); }
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  /// The pixels between have a new picture though ImGui draws them with the same commands. Until the next `paint`.
  void touch(glm::vec2 min, glm::vec2 max);

  /// Forgets what is there: the next frame is drawn whole.
  void touch_all() { whole_ = true; }

  /// Draws what changed and copies it to the back buffer. False: nothing changed, nothing to swap.
  bool paint(ImDrawData& data, glm::ivec2 size_px);

  /// The picture as RGB rows from the top.
  std::vector<std::uint8_t> pixels() const;
  glm::ivec2 size_px() const { return size_px_; }

  void release();

 private:
  struct Part {
    std::uint64_t hash = 0;
    glm::vec4 box{0.0f};  ///< min, max
  };

  void make_framebuffer(glm::ivec2 size_px);
  glm::vec4 changed_box(const ImDrawData& data);
  void draw(ImDrawData& data, glm::vec4 box) const;

  unsigned framebuffer_ = 0;
  unsigned texture_ = 0;
  glm::ivec2 size_px_{0};
  bool whole_ = true;
  glm::vec4 touched_{0.0f};
  std::vector<std::uint64_t> order_;
  std::unordered_map<std::uint64_t, Part> parts_;
};

}  // namespace focalstage
