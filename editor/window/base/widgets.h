#pragma once

// Everything panels and panes are made of. Each widget has a name; the registry knows it under that name within the
// NameScopes around it.

#include <cstdint>
#include <string_view>

#include "editor/window/base/button.h"
#include "editor/window/base/fields.h"
#include "editor/window/base/list_row.h"
#include "editor/window/base/number_field.h"
#include "editor/window/base/theme.h"
#include "editor/window/base/tip.h"
#include "editor/window/base/widget_registry.h"

namespace focalstage {

/// One line of text; glyphs beyond Inter's are fetched for the next frame.
void text_line(std::string_view text, std::uint32_t colour = theme::text);

/// The same, with "…" where it would be wider than `width_px` (0: the rest of the line), and itself as the tooltip
/// then.
void elided_line(std::string_view text, float width_px = 0.0f, std::uint32_t colour = theme::text);

/// `text` cut to `width_px` of the present font, ending in "…" if anything had to go.
std::string elided(std::string_view text, float width_px);

/// Text that wraps at the end of the region.
void paragraph(std::string_view text, std::uint32_t colour = theme::text);

/// The name of what a panel shows.
void title_line(std::string_view text);

/// A semibold heading that folds what follows. True while open.
bool section(std::string_view title, bool open_at_first = true);

/// The dim label of a property; the widget drawn next stands in the right column and fills it.
void property_row(std::string_view label, const Tip& tip = {});

/// A property that can only be read, right in its column.
void property_value(std::string_view label, std::string_view value, std::uint32_t colour = theme::text);

/// `share` 0..1, or negative: it runs, nobody knows how far. `width_px` 0: the rest of the line.
void progress_bar(double share, float width_px = 0.0f);

}  // namespace focalstage
