#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/rigid.h"
#include "core/scene/value.h"

namespace focalstage {

/// One device as the file names it. The settings are the driver's own: texts, numbers and booleans in the file's order.
struct DeviceConfig {
  std::string driver;
  std::string serial;   ///< empty: the only one there is
  std::string address;  ///< empty: found by the serial
  Value::Object settings;

  bool operator==(const DeviceConfig&) const = default;
};

/// A marker that a body carries.
struct BodyMarkerConfig {
  int marker = 0;  ///< its number in the dictionary
  double size_m = 0.0;
  Rigid body_from_marker;

  bool operator==(const BodyMarkerConfig&) const = default;
};

/// A body that is a ChArUco board.
struct BodyBoardConfig {
  int squares_x = 0;
  int squares_y = 0;
  double square_m = 0.0;
  double marker_m = 0.0;

  bool operator==(const BodyBoardConfig&) const = default;
};

/// What the file says of one body: how it is known, what it carries, how a thing is fixed to it.
struct BodyConfig {
  std::string name;
  std::optional<int> id;                  ///< the tracker's own number
  std::vector<BodyMarkerConfig> markers;  ///< markers or a board: for a tracker that looks for them
  std::optional<BodyBoardConfig> board;
  Rigid body_from_thing;

  bool operator==(const BodyConfig&) const = default;
};

/// A tracker, where it stands, and the bodies that the file says something of. Rotations are as the file has them: of
/// length 1 to about a tenth.
struct TrackerConfig {
  DeviceConfig device;
  std::filesystem::path file;           ///< what a recording is replayed from
  std::optional<DeviceConfig> camera;   ///< that a tracker of markers looks through
  std::filesystem::path camera_folder;  ///< of the pictures that stand for one
  Rigid world_from_tracker;
  std::vector<BodyConfig> bodies;

  bool operator==(const TrackerConfig&) const = default;
};

}  // namespace focalstage
