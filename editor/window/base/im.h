#pragma once

#include <imgui.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace focalstage {

inline ImVec2 to_im(const glm::vec2& v) { return {v.x, v.y}; }
inline glm::vec2 from_im(const ImVec2& v) { return {v.x, v.y}; }

}  // namespace focalstage
