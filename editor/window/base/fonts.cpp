#include "editor/window/base/fonts.h"

#include <imgui.h>
#include <imgui_freetype.h>
#include <imgui_internal.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>

namespace focalstage {
namespace {

// Where Debian's packages put them; the first that is there is taken.
constexpr std::array regular_files = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr std::array strong_files = {"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                                     "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};
constexpr std::array icon_files = {"/usr/share/fonts/truetype/fork-awesome/forkawesome-webfont.ttf"};
constexpr std::array gothic_files = {"/usr/share/fonts/opentype/ipafont-gothic/ipagp.ttf",
                                     "/usr/share/fonts/opentype/ipafont-gothic/ipag.ttf",
                                     "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc"};
constexpr std::array other_files = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};

// What Inter has: Latin with all accents, Greek, Cyrillic, punctuation, arrows, the signs of mathematics.
constexpr ImWchar inter_ranges[] = {0x0020, 0x024F, 0x0300, 0x036F, 0x0370, 0x052F, 0x1E00, 0x1EFF,
                                    0x2000, 0x20CF, 0x2100, 0x214F, 0x2190, 0x21FF, 0x2200, 0x22FF,
                                    0x2300, 0x23FF, 0x25A0, 0x26FF, 0xFFFD, 0xFFFD, 0};
constexpr ImWchar icon_ranges[] = {0xF000, 0xF307, 0};

struct Faces {
  ImFont* ui = nullptr;
  ImFont* strong = nullptr;
  ImFont* title = nullptr;
  ImFont* small = nullptr;
};

Faces faces;
std::set<ImWchar> wanted;  ///< beyond Inter's ranges
bool wanting = false;

bool in_ranges(const ImWchar* ranges, unsigned code) {
  for (; *ranges != 0; ranges += 2) {
    if (code >= ranges[0] && code <= ranges[1]) return true;
  }
  return false;
}

template <std::size_t N>
const char* first_there(const std::array<const char*, N>& files) {
  std::error_code problem;
  for (const char* file : files) {
    if (std::filesystem::exists(file, problem)) return file;
  }
  return nullptr;
}

ImVector<ImWchar> ranges_of_wanted() {
  ImFontGlyphRangesBuilder builder;
  for (const ImWchar code : wanted) builder.AddChar(code);
  ImVector<ImWchar> ranges;
  builder.BuildRanges(&ranges);
  return ranges;
}

/// Adds one cut at one size, with what merges into it.
ImFont* add_face(const char* file, double size_px, double scale, const ImWchar* wanted_ranges) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  const auto size = static_cast<float>(std::round(size_px * scale));
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;
  config.PixelSnapH = true;
  config.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  if (file == nullptr) {
    config.SizePixels = size;
    return atlas.AddFontDefault(&config);
  }
  ImFont* font = atlas.AddFontFromFileTTF(file, size, &config, inter_ranges);
  config.MergeMode = true;
  if (const char* icons = first_there(icon_files)) {
    ImFontConfig icon_config = config;
    icon_config.GlyphMinAdvanceX = std::round(size * 1.2f);  // one width: labels beside icons line up
    icon_config.GlyphOffset.y = std::round(static_cast<float>(scale));
    atlas.AddFontFromFileTTF(icons, size, &icon_config, icon_ranges);
  }
  if (wanted_ranges[0] == 0) return font;
  // IPA's gothic looks 7 % larger than Inter at the same size.
  if (const char* gothic = first_there(gothic_files)) {
    atlas.AddFontFromFileTTF(gothic, std::round(size * 0.94f), &config, wanted_ranges);
  }
  if (const char* other = first_there(other_files)) atlas.AddFontFromFileTTF(other, size, &config, wanted_ranges);
  return font;
}

std::vector<std::string> missing_files() {
  std::vector<std::string> missing;
  if (!std::filesystem::exists(regular_files[0])) missing.push_back("the font Inter (Debian: fonts-inter)");
  if (first_there(icon_files) == nullptr) missing.push_back("the icons (Debian: fonts-fork-awesome)");
  if (first_there(gothic_files) == nullptr) missing.push_back("Japanese glyphs (Debian: fonts-ipafont-gothic)");
  return missing;
}

}  // namespace

std::vector<std::string> build_fonts(double scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
  const ImVector<ImWchar> ranges = ranges_of_wanted();
  const char* regular = first_there(regular_files);
  const char* strong = first_there(strong_files);
  faces.ui = add_face(regular, 15.0, scale, ranges.Data);
  faces.strong = add_face(strong, 15.0, scale, ranges.Data);
  faces.title = add_face(strong, 22.0, scale, ranges.Data);
  faces.small = add_face(regular, 13.0, scale, ranges.Data);
  atlas.Build();
  ImGui::GetIO().FontDefault = faces.ui;
  wanting = false;
  return missing_files();
}

void want_glyphs(std::string_view utf8) {
  const char* place = utf8.data();
  const char* const end = place + utf8.size();
  while (place < end) {
    if (static_cast<unsigned char>(*place) < 0x80) {
      ++place;
      continue;
    }
    unsigned code = 0;
    const int bytes = ImTextCharFromUtf8(&code, place, end);
    place += bytes > 0 ? bytes : 1;
    if (code == 0 || code > 0xFFFF || in_ranges(inter_ranges, code) || in_ranges(icon_ranges, code)) continue;
    if (wanted.insert(static_cast<ImWchar>(code)).second) wanting = true;
  }
}

bool glyphs_are_wanting() { return wanting; }

ImFont* ui_font() { return faces.ui; }
ImFont* strong_font() { return faces.strong; }
ImFont* title_font() { return faces.title; }
ImFont* small_font() { return faces.small; }

}  // namespace focalstage
