#pragma once

#include <glm/vec2.hpp>

namespace focalstage {

class Session;
struct OutlineRow;

/// The lock and the eye of a row, from `min` to the right, each `size_px`. What is locked or hidden shows it; the rest
/// while the pointer is `over` the row. They act on their row alone, whatever is selected.
void draw_toggles(Session& session, const OutlineRow& row, glm::vec2 min, glm::vec2 size_px, bool over);

}  // namespace focalstage
