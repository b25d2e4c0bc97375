// The steps of a script that take and compare pictures.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "editor/window/app/editor.h"
#include "editor/window/app/script_player.h"
#include "editor/window/base/widget_registry.h"
#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

/// Codes further apart than this are seen.
constexpr int visible_codes = 32;
/// Set: what is seen becomes what is approved.
constexpr const char* approve = "FOCALSTAGE_APPROVE_PICTURES";

/// How many pixels of `seen` differ visibly from `approved`, as a share.
double differing(const std::vector<std::uint8_t>& seen, const Texture& approved) {
  std::size_t count = 0;
  const std::size_t pixels = seen.size() / 3;
  for (std::size_t p = 0; p < pixels; ++p) {
    int apart = 0;
    for (std::size_t c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(int(seen[3 * p + c]) - int(approved.rgba[4 * p + c])));
    count += apart > visible_codes ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(pixels, 1));
}

}  // namespace

Result<ScriptPlayer::Shot> ScriptPlayer::shoot(const std::vector<std::string>& widgets) {
  settle();
  const glm::ivec2 window_px = editor_.painter().size_px();
  glm::vec2 min(0.0f), max(window_px);
  if (!widgets.empty()) std::swap(min, max);
  for (const std::string& name : widgets) {
    const SeenWidget* widget = seen_widget(name);
    if (widget == nullptr || !widget->visible) return wrong("\"" + name + "\" is not to be seen");
    min = glm::min(min, widget->min);
    max = glm::max(max, widget->max);
  }
  const glm::ivec2 from = glm::clamp(glm::ivec2(glm::floor(min)), glm::ivec2(0), window_px);
  const glm::ivec2 to = glm::clamp(glm::ivec2(glm::ceil(max)), from, window_px);
  const std::vector<std::uint8_t> all = editor_.painter().pixels();
  Shot shot{to - from, {}};
  for (int y = from.y; y < to.y; ++y) {
    const auto begin = all.begin() + (static_cast<std::ptrdiff_t>(y) * window_px.x + from.x) * 3;
    shot.rgb.insert(shot.rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(shot.size_px.x) * 3);
  }
  return shot;
}

Status ScriptPlayer::act(const TakeScreenshot& step) {
  const auto shot = shoot(step.of);
  if (!shot) return shot.fault();
  const std::filesystem::path path(step.path);  // absolute, or where the program was started
  std::error_code problem;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), problem);
  return write_png(path, shot->size_px.x, shot->size_px.y, 3, shot->rgb);
}

Status ScriptPlayer::act(const ExpectPicture& step) {
  const auto shot = shoot(step.picture.of);
  if (!shot) return shot.fault();
  const std::filesystem::path approved = folder_ / step.picture.path;
  if (std::getenv(approve) != nullptr) return write_png(approved, shot->size_px.x, shot->size_px.y, 3, shot->rgb);
  const std::string seen = approved.stem().string() + ".seen.png";
  const auto bytes = read_file(approved, 64u << 20);
  if (!bytes) return wrong(approved.string() + " cannot be read; set " + approve + "=1 to approve what is seen");
  const auto picture = decode_image(*bytes, approved.string());
  if (!picture) return picture.fault();
  const bool same_size = picture->width_px == shot->size_px.x && picture->height_px == shot->size_px.y;
  const double share = same_size ? differing(shot->rgb, *picture) : 1.0;
  if (share <= step.share) return {};
  (void)write_png(seen, shot->size_px.x, shot->size_px.y, 3, shot->rgb);
  return wrong(std::to_string(100.0 * share) + " % of the pixels differ from " + approved.string() + "; look at " +
               seen);
}

}  // namespace focalstage
