#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace focalstage {

/// Calls `visit` with a fresh value of every kind that a variant may hold.
template <class Variant, class Visit>
void each_alternative(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (visit(std::variant_alternative_t<I, Variant>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

}  // namespace focalstage
