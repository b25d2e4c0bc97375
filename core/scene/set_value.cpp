#include "core/scene/set_value.h"

#include <algorithm>

#include "core/scene/mesh_codec.h"
#include "core/scene/pointer.h"
#include "core/scene/process_codec.h"

namespace focalstage {
namespace {

using Steps = std::vector<std::string>;

Fault no_such_key(const std::string& key, const std::string& step) {
  return {"edit.key", key, "there is no \"" + step + "\" here", "name a key of the item; steps are parted by slashes"};
}

/// The member or item of `here` named `step`; null where it cannot be. What an object lacks is made: a list where
/// `next` is the first of one, else an object.
Value* enter(Value& here, const std::string& step, const std::string& next) {
  if (Value::Array* items = here.array()) {
    const auto index = index_in(step);
    return index && *index < items->size() ? &(*items)[*index] : nullptr;
  }
  if (!here.object()) return nullptr;
  if (!here.find(step)) here.set(step, next == "0" ? Value(Value::Array{}) : Value(Value::Object{}));
  return here.find(step);
}

/// Sets or removes the last step; in a list, the index after the last one appends.
bool put(Value& here, const std::string& step, const Value& value) {
  if (Value::Array* items = here.array()) {
    const auto index = index_in(step);
    if (!index || *index > items->size() || (value.is_null() && *index == items->size())) return false;
    if (value.is_null()) {
      items->erase(items->begin() + static_cast<std::ptrdiff_t>(*index));
    } else if (*index == items->size()) {
      items->push_back(value);
    } else {
      (*items)[*index] = value;
    }
    return true;
  }
  if (!here.object()) return false;
  if (value.is_null()) {
    here.erase(step);
  } else {
    here.set(step, value);
  }
  return true;
}

/// lens_response and waveform stand once for both eyes until one of them differs.
void part_the_eyes(Value& item, const Steps& steps) {
  if (steps.size() < 2 || (steps[0] != "lens_response" && steps[0] != "waveform")) return;
  if (steps[1] != "left" && steps[1] != "right") return;
  const Value* both = item.find(steps[0]);
  if (both && (both->find("left") || both->find("right"))) return;
  const Value one = both ? *both : Value(Value::Array{});
  item.set(steps[0], Value(Value::Object{{"left", one}, {"right", one}}));
}

void drop_former_shape(Value& item, const Steps& steps) {
  if (steps.size() != 2 || steps[0] != "mesh" || (steps[1] != "file" && steps[1] != "primitive")) return;
  Value* mesh = item.find("mesh");
  if (!mesh) return;
  for (const std::string_view key : shape_keys(*mesh)) mesh->erase(key);
}

void drop_former_step(Value& item, const Steps& steps) {
  if (steps.size() != 4 || steps[0] != "mesh" || steps[1] != "process" || steps[3] != "step") return;
  Value* mesh = item.find("mesh");
  Value* process = mesh ? mesh->find("process") : nullptr;
  Value* step = process ? enter(*process, steps[2], "") : nullptr;
  if (!step) return;
  for (const std::string_view key : step_keys(*step)) step->erase(key);
}

void drop_former_appearance(Value& item, const Steps& steps) {
  if (steps.size() < 2 || steps[0] != "appearance") return;
  Value* appearance = item.find("appearance");
  if (!appearance) return;
  if (steps[1] == "unlit") appearance->erase("checker");
  if (steps[1] == "checker") appearance->erase("unlit");
}

}  // namespace

Status set_value(Value& item, const std::string& key, const Value& value) {
  const Steps steps = pointer_steps(key);
  if (steps.empty()) return Fault{"edit.key", "", "names no key", "say which key to set"};
  part_the_eyes(item, steps);
  if (!value.is_null()) {
    drop_former_shape(item, steps);
    drop_former_step(item, steps);
    drop_former_appearance(item, steps);
  }
  Value* here = &item;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    here = enter(*here, steps[i], steps[i + 1]);
    if (!here) return no_such_key(key, steps[i]);
  }
  if (!put(*here, steps.back(), value)) return no_such_key(key, steps.back());
  return {};
}

}  // namespace focalstage
