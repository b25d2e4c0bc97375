#include "core/scene/codec.h"

#include <algorithm>
#include <cmath>

#include "core/scene/number_text.h"

namespace focalstage {
namespace {

std::string allowed(const Rule& rule) {
  return (rule.above_low ? "more than " : "at least ") + number_text(rule.low) + " and at most " +
         number_text(rule.high);
}

bool in_range(Reading& reading, double number, const Rule& rule) {
  const bool low_enough = number <= rule.high;
  const bool high_enough = rule.above_low ? number > rule.low : number >= rule.low;
  if (low_enough && high_enough) return true;  // false for NaN
  return reading.fail("project.range", number_text(number) + " is out of range",
                      "choose a number that is " + allowed(rule));
}

}  // namespace

bool Codec<double>::read(Reading& reading, const Value& value, double& out, const Rule& rule) {
  if (!value.number()) return reading.wrong_type(value, "a number");
  if (!in_range(reading, *value.number(), rule)) return false;
  out = *value.number();
  return true;
}

bool Codec<int>::read(Reading& reading, const Value& value, int& out, const Rule& rule) {
  if (!value.number()) return reading.wrong_type(value, "a whole number");
  const double number = *value.number();
  if (!in_range(reading, number, rule)) return false;
  if (number != std::floor(number)) {
    return reading.fail("project.type", number_text(number) + " is not a whole number", "write a whole number here");
  }
  out = static_cast<int>(number);  // |rule| <= 1e9 keeps it within int
  return true;
}

bool Codec<bool>::read(Reading& reading, const Value& value, bool& out, const Rule&) {
  if (!value.boolean()) return reading.wrong_type(value, "true or false");
  out = *value.boolean();
  return true;
}

bool Codec<std::string>::read(Reading& reading, const Value& value, std::string& out, const Rule& rule) {
  if (!value.text()) return reading.wrong_type(value, "text");
  const std::string& text = *value.text();
  if (text.size() < rule.least) return reading.fail("project.name", "is empty", "write a name that is not empty");
  if (rule.least > 0 && std::any_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; })) {
    return reading.fail("project.name", "holds a control character", "write a name on one line, without tabs");
  }
  out = text;
  return true;
}

bool Codec<glm::dquat>::read(Reading& reading, const Value& value, glm::dquat& out, const Rule& rule) {
  std::array<double, 4> xyzw{};
  if (!TupleCodec<std::array<double, 4>, 4, double>::read(reading, value, xyzw, rule)) return false;
  const glm::dquat q{xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
  const double length = std::sqrt(glm::dot(q, q));
  if (!(std::abs(length - 1.0) <= 1e-3)) {
    return reading.fail("project.rotation", "is not a rotation: its length is " + number_text(length) + ", not 1",
                        "write a unit quaternion [x, y, z, w]; [0, 0, 0, 1] is no rotation");
  }
  // What is already unit to the last digits stays as written, so that reading and writing settle.
  out = std::abs(length - 1.0) > 1e-14 ? q / length : q;
  return true;
}

Value Codec<glm::dquat>::write(const glm::dquat& q) { return Value(Value::Array{q.x, q.y, q.z, q.w}); }

bool is_list_of(Reading& reading, const Value& value, std::size_t count) {
  const std::string wanted = "a list of " + std::to_string(count) + " numbers";
  if (!value.array()) return reading.wrong_type(value, wanted);
  if (value.array()->size() == count) return true;
  return reading.fail("project.type", "must be " + wanted + ", but has " + std::to_string(value.array()->size()),
                      "write " + wanted + " here");
}

bool is_list(Reading& reading, const Value& value, const Rule& rule) {
  if (!value.array()) return reading.wrong_type(value, "a list");
  const std::size_t count = value.array()->size();
  if (count >= rule.least && count <= rule.most) return true;
  return reading.fail("project.count", "has " + std::to_string(count) + " items",
                      "write " + std::to_string(rule.least) + " to " + std::to_string(rule.most) + " of them");
}

bool not_one_of(Reading& reading, const std::string& text, const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return reading.fail("project.word", "\"" + text + "\" is not known here", "choose one of " + list);
}

}  // namespace focalstage
