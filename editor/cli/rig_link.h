#pragma once

#include <string>

#include "core/scene/value.h"
#include "io/protocol/client.h"

namespace CLI {
class App;
}

namespace focalstage {

/// Connects within a few seconds or says why not.
Result<RigClient> connect_to_rig(const std::string& host_port);

/// Adds `--to HOST:PORT`.
void add_rig_option(CLI::App& app, std::string& host_port);

Value value_of(const DeviceReport& device);

/// The state as the object that `--json` prints; for people as one line, or with the slot report as a table.
Value value_of(const RigState& state);
std::string state_line(const RigState& state);
std::string state_text(const RigState& state);

}  // namespace focalstage
