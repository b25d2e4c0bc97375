#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/fields.h"

namespace focalstage {

/// Calls `visit` with a fresh value of every kind that a variant may hold.
template <class Variant, class Visit>
void each_alternative(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (visit(std::variant_alternative_t<I, Variant>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

/// The kind that is called `name`, fresh; nothing where none is. `word_of` calls each kind; "" is no name.
template <class Variant, class WordOf>
std::optional<Variant> alternative_named(std::string_view name, const WordOf& word_of) {
  std::optional<Variant> named;
  each_alternative<Variant>([&](const auto& kind) {
    const std::string_view word = word_of(kind);
    if (!word.empty() && word == name) named = kind;
  });
  return named;
}

/// What the kinds are called, those without a name left out.
template <class Variant, class WordOf>
std::vector<std::string_view> alternative_words(const WordOf& word_of) {
  std::vector<std::string_view> words;
  each_alternative<Variant>([&](const auto& kind) {
    if (const std::string_view word = word_of(kind); !word.empty()) words.push_back(word);
  });
  return words;
}

/// The keys of the kind that it holds.
template <class Variant>
std::vector<std::string_view> keys_of_alternative(const Variant& held) {
  std::vector<std::string_view> keys;
  std::visit([&]<class Kind>(const Kind&) { each_field<Kind>([&](const auto& field) { keys.push_back(field.key); }); },
             held);
  return keys;
}

}  // namespace focalstage
