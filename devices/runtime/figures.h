#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/protocol/rig_values.h"

namespace focalstage {

/// What a runtime counts, for those who watch over it.
struct RuntimeFigures {
  RigState state;
  std::uint64_t push_bytes = 0;
  int watchers = 0;  ///< open watch streams and live links
  int connections = 0;
  std::uint64_t turned_away = 0;                ///< connections beyond the bound
  std::map<std::string, std::uint64_t> faults;  ///< by code: darkness and refusals
};

}  // namespace focalstage
