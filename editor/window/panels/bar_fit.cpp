#include "editor/window/panels/bar_fit.h"

#include <optional>

namespace focalstage {
namespace {

float total(std::span<const BarItem> items, const std::vector<std::size_t>& forms, float gap) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const float width = items[i].widths.empty() ? 0.0f : items[i].widths[forms[i]];
    if (width > 0.0f) sum += width + gap;
  }
  return sum;
}

}  // namespace

std::vector<std::size_t> fit_bar(std::span<const BarItem> items, float room, float gap) {
  std::vector<std::size_t> forms(items.size(), 0);
  while (total(items, forms, gap) > room) {
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (forms[i] >= items[i].gives.size()) continue;
      if (!next || items[i].gives[forms[i]] < items[*next].gives[forms[*next]]) next = i;
    }
    if (!next) break;
    ++forms[*next];
  }
  return forms;
}

}  // namespace focalstage
