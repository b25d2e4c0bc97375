#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/value.h"

// Reading of values that a schema took: what is there has the right type, and what is not keeps its default.
namespace focalstage {

inline std::string text_of(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  return value ? *value->text() : std::string();
}

inline double number_of(const Value& object, std::string_view key, double otherwise = 0.0) {
  const Value* value = object.find(key);
  return value ? *value->number() : otherwise;
}

inline void read(const Value& object, std::string_view key, double& into) { into = number_of(object, key, into); }

inline void read(const Value& object, std::string_view key, int& into) {
  into = static_cast<int>(number_of(object, key, into));
}

inline void read(const Value& object, std::string_view key, bool& into) {
  if (const Value* value = object.find(key)) into = *value->boolean();
}

inline void read(const Value& object, std::string_view key, std::string& into) {
  if (const Value* value = object.find(key)) into = *value->text();
}

template <class T>
void read(const Value& object, std::string_view key, std::optional<T>& into) {
  if (object.find(key)) read(object, key, into.emplace());
}

/// The items of a list, each made by `make`.
template <class Item, class Make>
std::vector<Item> list_of(const Value& object, std::string_view key, Make make) {
  std::vector<Item> items;
  const Value* list = object.find(key);
  if (list == nullptr) return items;
  for (const Value& value : *list->array()) items.push_back(make(value));
  return items;
}

inline std::vector<std::string> texts_of(const Value& object, std::string_view key) {
  return list_of<std::string>(object, key, [](const Value& item) { return *item.text(); });
}

}  // namespace focalstage
