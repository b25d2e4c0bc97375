#pragma once

#include <string>

#include <glm/vec2.hpp>

namespace focalstage {

class Session;

/// What opens below the rig's state: how it is, what to connect to, and what can be done with it.
class RigMenu {
 public:
  /// `open`: it was just asked for, by what stands between `min` and `max`.
  void draw(Session& session, bool open, glm::vec2 min, glm::vec2 max);

 private:
  void draw_address(Session& session);

  std::string address_;
};

}  // namespace focalstage
