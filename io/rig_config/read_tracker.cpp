#include "io/rig_config/read_tracker.h"

namespace focalstage {

namespace {

std::string text_at(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  return value == nullptr ? "" : *value->text();
}

double number_at(const Value& object, std::string_view key) { return *object.find(key)->number(); }

int count_at(const Value& object, std::string_view key) { return static_cast<int>(number_at(object, key)); }

double at(const Value& list, std::size_t i) { return *(*list.array())[i].number(); }

Rigid rigid_at(const Value& object, std::string_view key) {
  const Value* value = object.find(key);
  Rigid rigid;
  if (value == nullptr) return rigid;
  if (const Value* position = value->find("position_m")) {
    rigid.position_m = {at(*position, 0), at(*position, 1), at(*position, 2)};
  }
  if (const Value* turn = value->find("rotation_xyzw")) {
    rigid.rotation = glm::dquat(at(*turn, 3), at(*turn, 0), at(*turn, 1), at(*turn, 2));
  }
  return rigid;
}

BodyConfig body_from(const Value& value) {
  BodyConfig body;
  body.name = text_at(value, "name");
  if (value.find("id") != nullptr) body.id = count_at(value, "id");
  if (const Value* markers = value.find("markers")) {
    for (const Value& marker : *markers->array()) {
      body.markers.push_back(
          {count_at(marker, "marker"), number_at(marker, "size_m"), rigid_at(marker, "body_from_marker")});
    }
  }
  if (const Value* board = value.find("board")) {
    body.board = {count_at(*board, "squares_x"), count_at(*board, "squares_y"), number_at(*board, "square_m"),
                  number_at(*board, "marker_m")};
  }
  body.body_from_thing = rigid_at(value, "body_from_thing");
  return body;
}

std::filesystem::path path_at(const Value& object, std::string_view key, const std::filesystem::path& folder) {
  const std::string text = text_at(object, key);
  return text.empty() ? std::filesystem::path() : folder / text;
}

}  // namespace

DeviceConfig device_from(const Value& value) {
  DeviceConfig device{text_at(value, "driver"), text_at(value, "serial"), text_at(value, "address"), {}};
  if (const Value* settings = value.find("settings")) device.settings = *settings->object();
  return device;
}

TrackerConfig tracker_from(const Value& value, const std::filesystem::path& folder) {
  TrackerConfig tracker;
  tracker.device = device_from(value);
  tracker.file = path_at(value, "file", folder);
  if (const Value* camera = value.find("camera")) {
    tracker.camera = device_from(*camera);
    tracker.camera_folder = path_at(*camera, "folder", folder);
  }
  tracker.world_from_tracker = rigid_at(value, "world_from_tracker");
  if (const Value* bodies = value.find("bodies")) {
    for (const Value& body : *bodies->array()) tracker.bodies.push_back(body_from(body));
  }
  return tracker;
}

}  // namespace focalstage
