#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace focalstage {

/// A widget as it was last drawn. Scripts and tests find what they press by its name: "toolbar/Push",
/// "outline/rabbit", "properties/position x".
struct SeenWidget {
  std::string name;
  glm::vec2 min{0.0f};  ///< clipped to what is seen of it
  glm::vec2 max{0.0f};
  bool enabled = true;
  bool visible = true;  ///< false: scrolled or clipped away

  glm::vec2 centre() const { return 0.5f * (min + max); }
};

/// Puts "part/" before the names of all widgets drawn while it lives.
class NameScope {
 public:
  explicit NameScope(std::string_view part);
  ~NameScope();
  NameScope(const NameScope&) = delete;
  NameScope& operator=(const NameScope&) = delete;

 private:
  std::size_t length_before_;
};

/// Forgets the last frame's; once at the start of each.
void forget_widgets();

/// Every widget tells where it is, in ImGui's pixels.
void see_widget(std::string_view name, glm::vec2 min, glm::vec2 max, bool enabled = true);

/// The same for ImGui's last item.
void see_last_item(std::string_view name, bool enabled = true);

const std::vector<SeenWidget>& seen_widgets();

/// The first visible one of that name, else any of that name, else null.
const SeenWidget* seen_widget(std::string_view name);

}  // namespace focalstage
