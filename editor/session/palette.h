#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/value.h"

namespace focalstage {

class Session;

/// Something the palette offers: a command, a thing to select, a project to open.
struct PaletteEntry {
  std::string title;
  std::string help;
  std::string shortcut;
  std::string icon;
  std::string unavailable;  ///< why it cannot be done now; empty: it can
  std::string command;      ///< to run, with
  Value args;
  std::vector<std::size_t> matched;  ///< bytes of the title that the query found
};

/// What fits `query`, the best first; what can be done before what cannot. All commands in their order for an empty
/// query.
std::vector<PaletteEntry> palette_entries(const Session& session, std::string_view query);

}  // namespace focalstage
