#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/scene/reading.h"
#include "core/scene/value.h"

namespace focalstage {

/// What is allowed in a field: the range of each of its numbers, and the count of a list's items or a text's bytes.
struct Rule {
  double low = -1e9;
  double high = 1e9;
  bool above_low = false;  ///< `low` itself is refused
  std::size_t least = 0;
  std::size_t most = 1'000'000;
};

/// Collects the key patterns that a table knows: "/objects/*/depth/mode".
struct KeyList {
  std::string prefix;
  std::set<std::string> keys;

  /// Adds `key` below the prefix, and with `below` what lies under it.
  template <class Below>
  void add(std::string_view key, Below&& below) {
    const std::string outer = prefix;
    prefix = pointer_into(prefix, key);
    keys.insert(prefix);
    below(*this);
    prefix = outer;
  }
  /// Stands at the items of a list while `below` runs.
  template <class Below>
  void each(Below&& below) {
    const std::string outer = prefix;
    prefix += "/*";
    below(*this);
    prefix = outer;
  }
};

/// How a type stands in the file. `read` checks against the rule and reports to the reading; `keys` lists what is
/// below.
template <class T>
struct Codec;

/// A type without keys below it.
struct PlainCodec {
  static void keys(KeyList&) {}
};

template <>
struct Codec<double> : PlainCodec {
  static bool read(Reading& reading, const Value& value, double& out, const Rule& rule);
  static Value write(double number) { return Value(number); }
};

template <>
struct Codec<int> : PlainCodec {
  static bool read(Reading& reading, const Value& value, int& out, const Rule& rule);
  static Value write(int number) { return Value(number); }
};

template <>
struct Codec<bool> : PlainCodec {
  static bool read(Reading& reading, const Value& value, bool& out, const Rule& rule);
  static Value write(bool flag) { return Value(flag); }
};

/// Text; with `least` 1 it is a name: not empty, and without control characters.
template <>
struct Codec<std::string> : PlainCodec {
  static bool read(Reading& reading, const Value& value, std::string& out, const Rule& rule);
  static Value write(const std::string& text) { return Value(text); }
};

/// [x, y, z, w]; of length one within 1e-3, and normalised.
template <>
struct Codec<glm::dquat> : PlainCodec {
  static bool read(Reading& reading, const Value& value, glm::dquat& out, const Rule& rule);
  static Value write(const glm::dquat& q);
};

/// A value whose absence is a value of its own; when there, it is written.
template <class T>
struct Codec<std::optional<T>> {
  static bool read(Reading& reading, const Value& value, std::optional<T>& out, const Rule& rule) {
    return Codec<T>::read(reading, value, out.emplace(), rule);
  }
  static Value write(const std::optional<T>& value) { return value ? Codec<T>::write(*value) : Value(); }
  static void keys(KeyList& list) { Codec<T>::keys(list); }
};

/// True if `value` is a list of exactly `count` items.
bool is_list_of(Reading& reading, const Value& value, std::size_t count);
/// True if `value` is a list of as many items as the rule allows.
bool is_list(Reading& reading, const Value& value, const Rule& rule);

/// A fixed number of numbers: the vectors of GLM and std::array.
template <class T, int N, class Element>
struct TupleCodec : PlainCodec {
  static bool read(Reading& reading, const Value& value, T& out, const Rule& rule) {
    if (!is_list_of(reading, value, N)) return false;
    for (int i = 0; i < N; ++i) {
      const Reading::Step step(reading, static_cast<std::size_t>(i));
      if (!Codec<Element>::read(reading, (*value.array())[static_cast<std::size_t>(i)], out[index(i)], rule)) {
        return false;
      }
    }
    return true;
  }
  static Value write(const T& tuple) {
    Value::Array items;
    for (int i = 0; i < N; ++i) items.push_back(Codec<Element>::write(tuple[index(i)]));
    return Value(std::move(items));
  }

 private:
  /// GLM counts in int, std::array in size_t.
  static auto index(int i) {
    if constexpr (requires { typename T::size_type; }) {
      return static_cast<typename T::size_type>(i);
    } else {
      return i;
    }
  }
};

template <>
struct Codec<glm::dvec2> : TupleCodec<glm::dvec2, 2, double> {};
template <>
struct Codec<glm::dvec3> : TupleCodec<glm::dvec3, 3, double> {};
template <>
struct Codec<glm::ivec2> : TupleCodec<glm::ivec2, 2, int> {};
template <>
struct Codec<std::array<double, 2>> : TupleCodec<std::array<double, 2>, 2, double> {};

/// A list of anything; the rule counts its items and bounds its numbers.
template <class T>
struct Codec<std::vector<T>> {
  static bool read(Reading& reading, const Value& value, std::vector<T>& out, const Rule& rule) {
    if (!is_list(reading, value, rule)) return false;
    out.clear();
    out.reserve(value.array()->size());
    for (const Value& item : *value.array()) {
      const Reading::Step step(reading, out.size());
      if (!Codec<T>::read(reading, item, out.emplace_back(), rule)) return false;
    }
    return true;
  }
  static Value write(const std::vector<T>& list) {
    Value::Array items;
    items.reserve(list.size());
    for (const T& item : list) items.push_back(Codec<T>::write(item));
    return Value(std::move(items));
  }
  static void keys(KeyList& list) {
    list.each([](KeyList& below) { Codec<T>::keys(below); });
  }
};

/// "\"x\" is not one of a, b, c".
bool not_one_of(Reading& reading, const std::string& text, const std::vector<std::string_view>& names);

/// A word for each value of an enumeration; `Words::words` lists (word, value).
template <class Enum, class Words>
struct WordCodec : PlainCodec {
  static bool read(Reading& reading, const Value& value, Enum& out, const Rule&) {
    if (!value.text()) return reading.wrong_type(value, "text");
    std::vector<std::string_view> names;
    for (const auto& [word, meaning] : Words::words) {
      if (word == *value.text()) {
        out = meaning;
        return true;
      }
      names.push_back(word);
    }
    return not_one_of(reading, *value.text(), names);
  }
  static Value write(Enum meant) {
    for (const auto& [word, meaning] : Words::words) {
      if (meaning == meant) return Value(word);
    }
    return Value();
  }
};

}  // namespace focalstage
