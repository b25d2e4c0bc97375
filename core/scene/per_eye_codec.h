#pragma once

#include "core/base/sides.h"
#include "core/scene/fields.h"

namespace focalstage {

/// What may stand once for both eyes or as {"left": .., "right": ..}. `One` reads a single one; what stands beside left
/// and right goes to the struct's `unknown` member for it.
template <class Struct, class T, PerEye<T> Struct::*eyes, Value::Object Struct::*unknown, class One>
struct PerEyeCodec {
  static bool read(Reading& reading, const Value& value, Struct& out, const Rule& rule) {
    const bool apart = value.find("left") || value.find("right");
    (out.*unknown).clear();
    if (!apart) {
      if (!One::read(reading, value, (out.*eyes).left, rule)) return false;
      (out.*eyes).right = (out.*eyes).left;
      return true;
    }
    if (!read_side(reading, value, "left", (out.*eyes).left, rule)) return false;
    if (!read_side(reading, value, "right", (out.*eyes).right, rule)) return false;
    keep_unknown(reading, value, {"left", "right"}, out.*unknown);
    return true;
  }

  static Value write(const Struct& thing) {
    const PerEye<T>& both = thing.*eyes;
    if (both.left == both.right && (thing.*unknown).empty()) return One::write(both.left);
    Value::Object object{{"left", One::write(both.left)}, {"right", One::write(both.right)}};
    write_unknown(object, thing.*unknown);
    return Value(std::move(object));
  }

  static void keys(KeyList& list) {
    One::keys(list);
    list.add("left", [](KeyList& below) { One::keys(below); });
    list.add("right", [](KeyList& below) { One::keys(below); });
  }

 private:
  static bool read_side(Reading& reading, const Value& value, std::string_view side, T& out, const Rule& rule) {
    const Value* one = value.find(side);
    if (!one) return reading.fail_at(side, "project.missing", "is missing", "give both \"left\" and \"right\"");
    const Reading::Step step(reading, side);
    return One::read(reading, *one, out, rule);
  }
};

}  // namespace focalstage
