#include "io/rig_config/check_config.h"

#include <cmath>
#include <utility>

namespace focalstage {

namespace {

// Nearer than this, two known powers tell a lens's gain no better than one.
constexpr double least_between_targets_d = 0.5;

Fault fault(std::string where, std::string message, std::string remedy) {
  return {"rig.config", std::move(where), std::move(message), std::move(remedy)};
}

Status check_response(const std::vector<ResponsePoint>& points, const std::string& where) {
  if (points.front().frequency_hz != 0.0) {
    return fault(where + "/0/frequency_hz", "the first point is not at 0 Hz", "measure the lens at rest too");
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].frequency_hz > points[i - 1].frequency_hz) continue;
    return fault(where + "/" + std::to_string(i) + "/frequency_hz", "does not rise over the point before it",
                 "sort the points by frequency, each frequency once");
  }
  return {};
}

Status check_measured(const MeasuredRig& measured) {
  const std::string glasses = "/measured/glasses";
  for (const Side eye : both_sides) {
    const char* name = eye == Side::left ? "/left" : "/right";
    if (Status sorted = check_response(measured.response[eye], glasses + "/lens_response" + name); !sorted) {
      return sorted;
    }
  }
  if (measured.glasses.lens_range_d[0] < measured.glasses.lens_range_d[1]) return {};
  return fault(glasses + "/lens_max_d", "is not above lens_min_d", "give the lens's lowest and highest power");
}

Status check_devices(const RigConfig& config) {
  const std::string wanted = "a rig made of devices has one";
  if (!config.devices.projector) return fault("/devices/projector", "is missing: " + wanted, "name its driver");
  if (!config.devices.lens_drive) return fault("/devices/lens_drive", "is missing: " + wanted, "name its driver");
  if (!config.devices.trigger_board) return fault("/devices/trigger_board", "is missing: " + wanted, "name its driver");
  if (config.measured) return {};
  return fault("/measured", "is missing: shows are compiled for what was measured of the rig",
               "measure projector and glasses and write down what was found");
}

/// What a pose's schema cannot say: a rotation of four zeros has no direction.
bool sound(const Rigid& pose) {
  const double length = glm::length(pose.rotation);
  return length > 0.9 && length < 1.1;
}

Status check_tracker(const TrackerConfig& tracker) {
  const std::string place = "/devices/tracker";
  const auto no_turn = [](const std::string& where) {
    return fault(where + "/rotation_xyzw", "is no rotation", "give a unit quaternion, the real part last");
  };
  if (!sound(tracker.world_from_tracker)) return no_turn(place + "/world_from_tracker");
  for (std::size_t i = 0; i < tracker.bodies.size(); ++i) {
    const BodyConfig& body = tracker.bodies[i];
    const std::string where = place + "/bodies/" + std::to_string(i);
    for (std::size_t k = 0; k < i; ++k) {
      if (tracker.bodies[k].name != body.name) continue;
      return fault(where + "/name", "is that of /devices/tracker/bodies/" + std::to_string(k) + " again",
                   "list each body once");
    }
    if (!sound(body.body_from_thing)) return no_turn(where + "/body_from_thing");
    for (std::size_t k = 0; k < body.markers.size(); ++k) {
      if (sound(body.markers[k].body_from_marker)) continue;
      return no_turn(where + "/markers/" + std::to_string(k) + "/body_from_marker");
    }
  }
  return {};
}

Status check_light_sensor(const LightSensorConfig& sensor) {
  const std::string place = "/devices/light_sensor/targets";
  for (std::size_t i = 0; i < sensor.targets.size(); ++i) {
    const LightTargetConfig& target = sensor.targets[i];
    const std::string where = place + "/" + std::to_string(i);
    for (const Side eye : both_sides) {
      const std::array<int, 4>& rectangle = target.rectangle_px[eye];
      if (rectangle[2] > 0 && rectangle[3] > 0) continue;
      return fault(where + (eye == Side::left ? "/left_px" : "/right_px"), "has no pixels",
                   "give left, top, width and height, the last two above 0");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (std::abs(sensor.targets[k].power_d - target.power_d) >= least_between_targets_d) continue;
      return fault(where + "/power_d", "is that of " + place + "/" + std::to_string(k) + " again, or nearly",
                   "put the lines at different distances: powers 0.5 D apart or more");
    }
  }
  return {};
}

Status check_network(const NetworkConfig& network) {
  const int given = !network.certificate.empty() + !network.key.empty() + !network.client_ca.empty();
  if (given == 0 || given == 3) return {};
  return fault("/network", "certificate, key and client_ca come together or not at all",
               "focalstage pair init DIR makes all three");
}

Status check_clients(const std::vector<ClientConfig>& clients) {
  for (std::size_t i = 0; i < clients.size(); ++i) {
    const std::string where = "/clients/" + std::to_string(i);
    if (clients[i].name.empty() && clients[i].fingerprint.empty()) {
      return fault(where, "says nothing that a client is known by", "give its name, its fingerprint, or both");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (clients[k].name != clients[i].name || clients[k].fingerprint != clients[i].fingerprint) continue;
      return fault(where, "is the client of /clients/" + std::to_string(k) + " again", "list each client once");
    }
  }
  return {};
}

}  // namespace

Status check_config(const RigConfig& config) {
  if (config.kind == RigKind::devices) {
    if (Status devices = check_devices(config); !devices) return devices;
  }
  if (config.devices.tracker) {
    if (Status tracker = check_tracker(*config.devices.tracker); !tracker) return tracker;
  }
  if (config.devices.light_sensor) {
    if (Status sensor = check_light_sensor(*config.devices.light_sensor); !sensor) return sensor;
  }
  if (config.measured) {
    if (Status measured = check_measured(*config.measured); !measured) return measured;
  }
  if (Status network = check_network(config.network); !network) return network;
  return check_clients(config.clients);
}

}  // namespace focalstage
