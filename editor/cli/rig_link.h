#pragma once

#include <string>

#include "core/scene/value.h"
#include "io/protocol/client.h"

namespace CLI {
class App;
}

namespace focalstage {

/// Where a rig listens unless told otherwise.
inline constexpr const char* default_rig = "127.0.0.1:7360";

/// Connects within a few seconds or says why not.
Result<RigClient> connect_to_rig(const std::string& host_port);

/// Adds `--to HOST:PORT`.
void add_rig_option(CLI::App& app, std::string& host_port);

/// The state as the object that `--json` prints, and for people: a line or two and the slot report as a table.
Value value_of(const RigState& state);
std::string state_text(const RigState& state);

}  // namespace focalstage
