#pragma once

#include "core/scene/fields.h"
#include "core/scene/project.h"
#include "core/scene/rules.h"

namespace focalstage {

template <>
struct Table<Keyframe> {
  static constexpr auto fields =
      std::make_tuple(field("time_s", at(&Keyframe::time_s), Presence::required, time_s),
                      field("position_m", at(&Keyframe::pose, &Rigid::position_m), Presence::always, anywhere_m),
                      field("rotation_xyzw", at(&Keyframe::pose, &Rigid::rotation), Presence::always));
};

/// The keys of a placement. A key that leaves out its position or rotation has that of the thing itself.
struct PlacementKeysCodec {
  static bool read(Reading& reading, const Value& value, Placement& out, const Rule& rule);
  static Value write(const Placement& placement) { return Codec<std::vector<Keyframe>>::write(placement.keys); }
  static void keys(KeyList& list) { Codec<std::vector<Keyframe>>::keys(list); }
};

}  // namespace focalstage
