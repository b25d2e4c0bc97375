#pragma once

#include <string>

#include "core/base/result.h"
#include "core/scene/value.h"

namespace focalstage {

/// Sets the member at the key path `key` of an item written as a value; null removes it. What contradicts it goes: the
/// parameters of a mesh's former shape, the former appearance. What stands once for both eyes comes apart where `key`
/// names one eye.
Status set_value(Value& item, const std::string& key, const Value& value);

}  // namespace focalstage
