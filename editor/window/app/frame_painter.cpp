#include "editor/window/app/frame_painter.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>

#include "editor/window/base/theme.h"

namespace focalstage {
namespace {

bool is_empty(const glm::vec4& box) { return box.z <= box.x || box.w <= box.y; }

glm::vec4 both(const glm::vec4& a, const glm::vec4& b) {
  if (is_empty(a)) return b;
  if (is_empty(b)) return a;
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}

glm::vec4 intersection(const glm::vec4& a, const glm::vec4& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)};
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
  return hash ^ (hash >> 29);
}

std::uint64_t mixed_bytes(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t word = 0;
  for (; size >= sizeof(word); bytes += sizeof(word), size -= sizeof(word)) {
    std::memcpy(&word, bytes, sizeof(word));
    hash = mixed(hash, word);
  }
  word = 0;
  std::memcpy(&word, bytes, size);
  return mixed(hash, word + size);
}

std::uint64_t hash_of(const ImDrawList& list) {
  std::uint64_t hash = mixed_bytes(1, list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
  hash = mixed_bytes(hash, list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
  for (const ImDrawCmd& command : list.CmdBuffer) {
    hash = mixed_bytes(hash, &command.ClipRect, sizeof(command.ClipRect));
    hash = mixed(hash, reinterpret_cast<std::uintptr_t>(command.TextureId));
    hash = mixed(hash, command.ElemCount);
    hash = mixed(hash, reinterpret_cast<std::uintptr_t>(command.UserCallbackData));
  }
  return hash;
}

glm::vec4 box_of(const ImDrawList& list) {
  glm::vec4 box{0.0f};
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.ElemCount == 0) continue;
    const ImVec4& clip = command.ClipRect;
    box = both(box, {clip.x, clip.y, clip.z, clip.w});
  }
  return box;
}

std::uint64_t name_of(const ImDrawList& list) {
  const char* name = list._OwnerName != nullptr ? list._OwnerName : "";
  return mixed_bytes(7, name, std::strlen(name));
}

}  // namespace

void FramePainter::touch(glm::vec2 min, glm::vec2 max) { touched_ = both(touched_, {min.x, min.y, max.x, max.y}); }

void FramePainter::make_framebuffer(glm::ivec2 size_px) {
  if (size_px == size_px_ && framebuffer_ != 0) return;
  release();
  size_px_ = size_px;
  whole_ = true;
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_px.x, size_px.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
}

glm::vec4 FramePainter::changed_box(const ImDrawData& data) {
  std::unordered_map<std::uint64_t, Part> now;
  std::vector<std::uint64_t> order;
  glm::vec4 changed = touched_;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    const std::uint64_t name = name_of(list);
    const Part part{hash_of(list), box_of(list)};
    const auto before = parts_.find(name);
    if (before == parts_.end()) {
      changed = both(changed, part.box);
    } else if (before->second.hash != part.hash) {
      changed = both(both(changed, part.box), before->second.box);
    }
    now[name] = part;
    order.push_back(name);
  }
  for (const auto& [name, part] : parts_) {
    if (!now.contains(name)) changed = both(changed, part.box);
  }
  // Windows that came before or behind one another, or share a name: the whole.
  const bool shuffled = std::ranges::equal(order, order_) ? false : order.size() == order_.size();
  if (shuffled || now.size() != order.size()) whole_ = true;
  parts_ = std::move(now);
  order_ = std::move(order);
  touched_ = glm::vec4(0.0f);
  return changed;
}

void FramePainter::draw(ImDrawData& data, glm::vec4 box) const {
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      const glm::vec4 cut = intersection({clip.x, clip.y, clip.z, clip.w}, box);
      command.ClipRect = {cut.x, cut.y, cut.z, cut.w};
    }
  }
  const auto x = static_cast<GLint>(box.x);
  const auto y = size_px_.y - static_cast<GLint>(box.w);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_px_.x, size_px_.y);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, static_cast<GLint>(box.z - box.x), static_cast<GLint>(box.w - box.y));
  const glm::vec3 gap = theme::rgb(theme::gap);
  glClearColor(gap.r, gap.g, gap.b, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  ImGui_ImplOpenGL3_RenderDrawData(&data);
}

bool FramePainter::paint(ImDrawData& data, glm::ivec2 size_px) {
  if (size_px.x < 1 || size_px.y < 1) return false;
  make_framebuffer(size_px);
  const glm::vec4 all(0.0f, 0.0f, static_cast<float>(size_px.x), static_cast<float>(size_px.y));
  const glm::vec4 changed = intersection(changed_box(data), all);
  if (!whole_ && is_empty(changed)) return false;
  const glm::vec4 outward(std::floor(changed.x), std::floor(changed.y), std::ceil(changed.z), std::ceil(changed.w));
  draw(data, whole_ ? all : outward);
  whole_ = false;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_px.x, size_px.y, 0, 0, size_px.x, size_px.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return true;
}

std::vector<std::uint8_t> FramePainter::pixels() const {
  const auto row = static_cast<std::size_t>(size_px_.x) * 3;
  std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(size_px_.y));
  if (framebuffer_ == 0) return bottom_up;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  std::vector<std::uint8_t> top_down;
  top_down.reserve(bottom_up.size());
  for (std::size_t y = static_cast<std::size_t>(size_px_.y); y-- > 0;) {
    const auto from = bottom_up.begin() + static_cast<std::ptrdiff_t>(y * row);
    top_down.insert(top_down.end(), from, from + static_cast<std::ptrdiff_t>(row));
  }
  return top_down;
}

void FramePainter::release() {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  framebuffer_ = texture_ = 0;
  size_px_ = {0, 0};
}

}  // namespace focalstage
