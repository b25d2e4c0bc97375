#pragma once

#include <string>
#include <string_view>
#include <vector>

struct ImFont;

namespace focalstage {

/// Builds the window's fonts for a content scale (1 to 3) into ImGui's atlas: Inter in four cuts, with icons, and the
/// glyphs of other scripts that were asked for by `want_glyphs`. Between frames only; the caller then renews the
/// atlas's texture. Returns what could not be found, in words; without Inter the best font there is takes its place.
std::vector<std::string> build_fonts(double scale);

/// Text that will be shown. Scripts that Inter lacks (Japanese, Chinese, Hebrew...) are added to the fonts only when a
/// text needs them: all of them would cost 60 ms and 2 MB at every start.
void want_glyphs(std::string_view utf8);

/// Whether `build_fonts` should run again before the next frame.
bool glyphs_are_wanting();

ImFont* ui_font();      ///< 15 px at scale 1
ImFont* strong_font();  ///< 15 px semibold: headings
ImFont* title_font();   ///< 22 px semibold
ImFont* small_font();   ///< 13 px: chips, axes, what explains

}  // namespace focalstage
