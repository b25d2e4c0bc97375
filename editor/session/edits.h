#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "editor/session/thing.h"

namespace focalstage {

/// Keys less than this apart are the same key.
inline constexpr double same_key_s = 1e-4;
inline bool same_key(double a_s, double b_s) { return std::abs(a_s - b_s) < same_key_s; }

Value value_of(const glm::dvec3& v);
Value value_of(const glm::dquat& q);  ///< x y z w

/// Sets one key of a thing.
Edit set_edit(const Thing& thing, std::string key, Value value);

/// Where a thing stands at a moment of the show.
Rigid pose_of(const Project& project, const Thing& thing, double time_s);

/// How a thing moves; null for what has no keys. `thing` may be null.
const Placement* placement_of(const Project& project, const Thing* thing);

/// Whether the thing has a key at that moment. `thing` may be null.
bool has_key_at(const Project& project, const Thing* thing, double time_s);

/// The keys of a placement as its edit carries them.
Value keys_value(const std::vector<Keyframe>& keys);

/// The whole item as the project file would have it; null where it is not in a list.
Value item_of(const Project& project, const Thing& thing);

/// Items of a list by name, as copy and paste carry them.
Edit add_edit(const std::string& list, const std::string& name, Value item);

}  // namespace focalstage
