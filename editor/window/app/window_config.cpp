#include "editor/window/app/window_config.h"

#include <cmath>
#include <string_view>

#include "core/scene/value.h"
#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr const char* file_name = "window.json";

void take(const Value& object, std::string_view key, double least, double most, double& into) {
  const Value* member = object.find(key);
  const double* number = member != nullptr ? member->number() : nullptr;
  if (number != nullptr && *number >= least && *number <= most) into = *number;
}

void take(const Value& object, std::string_view key, bool& into) {
  const Value* member = object.find(key);
  const bool* flag = member != nullptr ? member->boolean() : nullptr;
  if (flag != nullptr) into = *flag;
}

}  // namespace

WindowConfig load_window_config(const std::filesystem::path& folder) {
  WindowConfig config;
  const auto bytes = read_file(folder / file_name, 1 << 16);
  if (!bytes) return config;
  const auto value = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file_name);
  if (!value) return config;
  take(*value, "outline", 50.0, 2000.0, config.splits.outline);
  take(*value, "properties", 50.0, 2000.0, config.splits.properties);
  take(*value, "bottom", 50.0, 2000.0, config.splits.bottom);
  take(*value, "across", 0.1, 0.9, config.splits.across);
  take(*value, "down", 0.1, 0.9, config.splits.down);
  double width = config.size_px.x;
  double height = config.size_px.y;
  take(*value, "width_px", 320.0, 16384.0, width);
  take(*value, "height_px", 200.0, 16384.0, height);
  config.size_px = {static_cast<int>(width), static_cast<int>(height)};
  take(*value, "space_mouse_sensitivity", least_sensitivity, most_sensitivity, config.steer.sensitivity);
  take(*value, "space_mouse_invert_push", config.steer.invert_push);
  take(*value, "space_mouse_invert_turn", config.steer.invert_turn);
  take(*value, "space_mouse_flies", config.steer.fly);
  return config;
}

Status save_window_config(const WindowConfig& config, const std::filesystem::path& folder) {
  Value object;
  object.set("outline", config.splits.outline);
  object.set("properties", config.splits.properties);
  object.set("bottom", config.splits.bottom);
  object.set("across", config.splits.across);
  object.set("down", config.splits.down);
  object.set("width_px", config.size_px.x);
  object.set("height_px", config.size_px.y);
  object.set("space_mouse_sensitivity", config.steer.sensitivity);
  object.set("space_mouse_invert_push", config.steer.invert_push);
  object.set("space_mouse_invert_turn", config.steer.invert_turn);
  object.set("space_mouse_flies", config.steer.fly);
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  return write_file_atomically(folder / file_name, write_json(object) + "\n");
}

}  // namespace focalstage
