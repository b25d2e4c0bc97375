#pragma once

#include <algorithm>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/scene/codec.h"

namespace focalstage {

/// When a key must be read and is written.
enum class Presence {
  required,  ///< read and written always
  always,    ///< may be missing when read; written always
  optional   ///< written when it differs from its default
};

/// The way to a member, also of a member: at(&Viewer::placement, &Placement::pose). Empty: the thing itself.
template <class... Members>
struct Path {
  std::tuple<Members...> members;

  template <class Struct>
  constexpr auto& operator()(Struct& thing) const {
    return std::apply(
        [&](auto... member) -> auto& { return follow(thing, member...); }, members);
  }

 private:
  template <class Struct>
  static constexpr Struct& follow(Struct& thing) {
    return thing;
  }
  template <class Struct, class First, class... Rest>
  static constexpr auto& follow(Struct& thing, First first, Rest... rest) {
    return follow(thing.*first, rest...);
  }
};

template <class... Members>
constexpr Path<Members...> at(Members... members) {
  return {{members...}};
}

/// Nothing else makes the key necessary.
struct NeverNeeded {
  template <class Struct>
  constexpr bool operator()(const Struct&) const {
    return false;
  }
};

/// One key of a struct. `CodecOf` void: the codec of the member's type. `needed` makes an optional key required.
template <class CodecOf, class PathTo, class Needed>
struct Field {
  std::string_view key;
  PathTo path;
  Presence presence;
  Rule rule;
  Needed needed;
};

template <class CodecOf = void, class PathTo, class Needed = NeverNeeded>
constexpr Field<CodecOf, PathTo, Needed> field(std::string_view key, PathTo path, Presence presence, Rule rule = {},
                                               Needed needed = {}) {
  return {key, path, presence, rule, needed};
}

/// The table of a struct: `static constexpr auto fields = std::make_tuple(field(...), ...)`, and, where keys depend on
/// each other, `static bool check(Reading&, const Struct&)`. Everything that reads, writes, edits, lists or tests keys
/// goes through it.
template <class Struct>
struct Table;

template <class Struct, class Visit>
void each_field(Visit&& visit) {
  std::apply([&](const auto&... fields) { (visit(fields), ...); }, Table<Struct>::fields);
}

template <class CodecOf, class Member>
using FieldCodec = std::conditional_t<std::is_void_v<CodecOf>, Codec<std::remove_cvref_t<Member>>, CodecOf>;

template <class CodecOf, class PathTo, class Needed, class Struct>
bool read_field(Reading& reading, const Value& object, const Field<CodecOf, PathTo, Needed>& field, Struct& out) {
  using Way = FieldCodec<CodecOf, decltype(field.path(out))>;
  const Value* value = object.find(field.key);
  if (!value) {
    if (field.presence != Presence::required && !field.needed(std::as_const(out))) return true;
    return reading.fail_at(field.key, "project.missing", "is missing", "add \"" + std::string(field.key) + "\"");
  }
  const Reading::Step step(reading, field.key);
  return Way::read(reading, *value, field.path(out), field.rule);
}

template <class CodecOf, class PathTo, class Needed, class Struct>
void write_field(Value::Object& object, const Field<CodecOf, PathTo, Needed>& field, const Struct& thing) {
  using Way = FieldCodec<CodecOf, decltype(field.path(thing))>;
  static const Struct fresh{};
  Value value = Way::write(field.path(thing));
  const bool wanted = field.presence != Presence::optional || field.needed(thing);
  if (wanted || value != Way::write(field.path(fresh))) object.emplace_back(std::string(field.key), std::move(value));
}

/// Reads the members of `object` that the table knows, in the table's order, and appends their keys to `known`.
template <class Struct>
bool read_fields(Reading& reading, const Value& object, Struct& out, std::vector<std::string_view>& known) {
  bool good = true;
  each_field<Struct>([&](const auto& field) {
    known.push_back(field.key);
    good = good && read_field(reading, object, field, out);
  });
  if constexpr (requires { Table<Struct>::check(reading, out); }) good = good && Table<Struct>::check(reading, out);
  return good;
}

template <class Struct>
void write_fields(Value::Object& object, const Struct& thing) {
  each_field<Struct>([&](const auto& field) { write_field(object, field, thing); });
}

template <class Struct>
void list_fields(KeyList& list) {
  each_field<Struct>([&](const auto& field) {
    using FieldType = std::remove_cvref_t<decltype(field)>;
    list.add(field.key, [&](KeyList& below) {
      [&]<class CodecOf, class PathTo, class Needed>(const Field<CodecOf, PathTo, Needed>& f) {
        FieldCodec<CodecOf, decltype(f.path(std::declval<Struct&>()))>::keys(below);
      }(static_cast<const FieldType&>(field));
    });
  });
}

/// Keeps and notes the members of `object` that are not in `known`.
void keep_unknown(Reading& reading, const Value& object, const std::vector<std::string_view>& known,
                  Value::Object& unknown);

/// Appends what was kept.
void write_unknown(Value::Object& object, const Value::Object& unknown);

/// The codec of every struct that has a table: an object; what the table does not know goes to `unknown`.
template <class T>
struct Codec {
  static bool read(Reading& reading, const Value& value, T& out, const Rule&) {
    if (!value.object()) return reading.wrong_type(value, "an object");
    std::vector<std::string_view> known;
    if (!read_fields(reading, value, out, known)) return false;
    keep_unknown(reading, value, known, out.unknown);
    return true;
  }
  static Value write(const T& thing) {
    Value::Object object;
    write_fields(object, thing);
    write_unknown(object, thing.unknown);
    return Value(std::move(object));
  }
  static void keys(KeyList& list) { list_fields<T>(list); }
};

}  // namespace focalstage
