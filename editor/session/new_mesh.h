#pragma once

#include <string>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// A primitive as a newcomer would have it: about 10 cm across (teapot and rabbit 1 m, as they are), or a wall for
/// what is to be a surface. Fault "command.argument" for a kind there is not.
Result<Value> new_mesh(const std::string& kind, bool surface);

/// Whether the primitive is 1 m high whatever one says, so that it is its scale that makes it fit the room.
bool is_metre_high(const std::string& kind);

}  // namespace focalstage
