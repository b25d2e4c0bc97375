#include "devices/catalog/tracker_catalog.h"

#include <utility>

#include "devices/aruco/aruco_tracker.h"
#include "devices/camera/recorded_camera.h"
#include "devices/camera/v4l2_camera.h"
#include "devices/catalog/settings_reader.h"
#include "devices/natnet/receiver.h"
#include "devices/recording/recorded_tracker.h"

namespace focalstage {

namespace {

constexpr const char* tracker_place = "/devices/tracker";
constexpr const char* camera_place = "/devices/tracker/camera";

Fault refusal(const std::string& where, const std::string& message, const std::string& remedy) {
  return {"rig.config", std::string(tracker_place) + where, message, remedy};
}

std::string body_place(std::size_t i) { return "/bodies/" + std::to_string(i); }

/// What only a tracker that looks through a camera has.
Status without_markers(const TrackerConfig& config) {
  const std::string remedy = "take it out, or choose the driver aruco";
  if (config.camera) return refusal("/camera", "this tracker looks through none", remedy);
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    const BodyConfig& body = config.bodies[i];
    if (!body.markers.empty()) return refusal(body_place(i) + "/markers", "this tracker looks for none", remedy);
    if (body.board) return refusal(body_place(i) + "/board", "this tracker looks for none", remedy);
  }
  return {};
}

/// Only a NatNet server numbers its bodies itself.
Status without_numbers(const TrackerConfig& config) {
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    if (config.bodies[i].id) return refusal(body_place(i) + "/id", "only natnet takes numbers", "leave it out");
  }
  return {};
}

Status without_file(const TrackerConfig& config) {
  if (config.file.empty()) return {};
  return refusal("/file", "this tracker replays none", "take it out, or choose the driver recording");
}

Result<std::shared_ptr<Tracker>> natnet(const TrackerConfig& config) {
  SettingsReader reader(config.device, tracker_place);
  NatNetSettings settings;
  settings.server = config.device.address;
  reader.choose("cast", settings.cast, {{"multicast", NatNetCast::multicast}, {"unicast", NatNetCast::unicast}});
  reader.take("local", settings.local);
  reader.take("group", settings.group);
  int command_port = settings.command_port;
  int data_port = settings.data_port;
  reader.take("command_port", command_port, 1, 65535);
  reader.take("data_port", data_port, 0, 65535);
  settings.command_port = static_cast<std::uint16_t>(command_port);
  settings.data_port = static_cast<std::uint16_t>(data_port);
  reader.choose("axes", settings.axes, {{"y_up", NatNetAxes::y_up}, {"z_up", NatNetAxes::z_up}});
  reader.choose("description_size", settings.description_size,
                {{"after_type", NatNetDescriptionSize::after_type}, {"none", NatNetDescriptionSize::none}});
  reader.take("ping_s", settings.ping_s, 0.01, 10.0);
  reader.take("keep_alive_s", settings.keep_alive_s, 0.01, 60.0);
  reader.take("silence_s", settings.silence_s, 0.02, 0.1);
  if (Status read = reader.done(); !read) return read.fault();
  if (settings.server.empty()) return refusal("/address", "is missing", "give the server's address, IPv4 in dots");
  if (Status plain = without_markers(config); !plain) return plain.fault();
  if (Status plain = without_file(config); !plain) return plain.fault();
  for (const BodyConfig& body : config.bodies) {
    if (body.id) settings.names[*body.id] = body.name;
  }
  return std::shared_ptr<Tracker>(std::make_shared<NatNetReceiver>(settings));
}

Result<std::shared_ptr<Tracker>> recording(const TrackerConfig& config) {
  SettingsReader reader(config.device, tracker_place);
  ReplaySettings settings;
  settings.loop = true;
  reader.take("silence_s", settings.silence_s, 0.02, 0.1);
  if (Status read = reader.done(); !read) return read.fault();
  if (config.file.empty()) return refusal("/file", "is missing", "name the recording that is to be replayed");
  if (Status plain = without_markers(config); !plain) return plain.fault();
  if (Status plain = without_numbers(config); !plain) return plain.fault();
  Result<TrackerRecording> frames = read_recording_file(config.file.string());
  if (!frames) return frames.fault();
  return std::shared_ptr<Tracker>(std::make_shared<RecordedTracker>(std::move(*frames), settings));
}

Result<std::shared_ptr<Camera>> v4l2(const TrackerConfig& config) {
  SettingsReader reader(*config.camera, camera_place, "camera");
  V4l2Settings settings;
  if (!config.camera->address.empty()) settings.address = config.camera->address;
  reader.take("bus", settings.bus);
  reader.take("width_px", settings.width_px, 16, 16384);
  reader.take("height_px", settings.height_px, 16, 16384);
  reader.take("rate_hz", settings.rate_hz, 1.0, 1000.0);
  reader.take("exposure_s", settings.exposure_s, 0.0, 1.0);
  if (Status read = reader.done(); !read) return read.fault();
  if (!config.camera_folder.empty()) {
    return refusal("/camera/folder", "a camera shows none", "take it out, or choose the driver pictures");
  }
  return std::shared_ptr<Camera>(std::make_shared<V4l2Camera>(settings));
}

Result<std::shared_ptr<Camera>> pictures(const TrackerConfig& config) {
  SettingsReader reader(*config.camera, camera_place, "camera");
  RecordedCameraSettings settings;
  settings.folder = config.camera_folder.string();
  settings.loop = true;
  reader.take("rate_hz", settings.rate_hz, 1.0, 1000.0);
  if (Status read = reader.done(); !read) return read.fault();
  if (settings.folder.empty()) return refusal("/camera/folder", "is missing", "name the folder of the pictures");
  return std::shared_ptr<Camera>(std::make_shared<RecordedCamera>(settings));
}

Result<std::shared_ptr<Camera>> camera_of(const TrackerConfig& config) {
  if (!config.camera) return refusal("/camera", "is missing", "name the camera that sees the markers");
  if (config.camera->driver == "v4l2") return v4l2(config);
  if (config.camera->driver == "pictures") return pictures(config);
  return refusal("/camera/driver", "no driver \"" + config.camera->driver + "\" does this", "choose v4l2 or pictures");
}

/// The camera as it was calibrated: what OpenCV calls k1, k2, p1, p2, k3 .. k6, as many as there are.
void take_lens(SettingsReader& reader, CameraModel& camera) {
  reader.take("fx_px", camera.fx_px, 1.0, 1e6);
  reader.take("fy_px", camera.fy_px, 1.0, 1e6);
  reader.take("cx_px", camera.cx_px, -1e6, 1e6);
  reader.take("cy_px", camera.cy_px, -1e6, 1e6);
  const char* names[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  std::vector<double> distortion(std::size(names), 0.0);
  std::size_t told = 0;
  for (std::size_t i = 0; i < std::size(names); ++i) {
    reader.take(names[i], distortion[i], -1e6, 1e6);
    if (distortion[i] != 0.0) told = i + 1;
  }
  distortion.resize(told == 0 ? 0 : told <= 4 ? 4 : told == 5 ? 5 : 8);
  camera.distortion = std::move(distortion);
}

Status take_bodies(const TrackerConfig& config, ArucoSettings& settings) {
  for (std::size_t i = 0; i < config.bodies.size(); ++i) {
    const BodyConfig& body = config.bodies[i];
    const auto id = static_cast<std::int32_t>(i);
    if (body.board && body.markers.empty()) {
      settings.boards.push_back(
          {id, body.name, body.board->squares_x, body.board->squares_y, body.board->square_m, body.board->marker_m});
    } else if (!body.markers.empty() && !body.board) {
      MarkerBody& carrier = settings.bodies.emplace_back(MarkerBody{id, body.name, {}});
      for (const BodyMarkerConfig& marker : body.markers) {
        Rigid pose = marker.body_from_marker;
        pose.rotation = glm::normalize(pose.rotation);
        carrier.markers.push_back({marker.marker, marker.size_m, pose});
      }
    } else {
      return refusal(body_place(i), "carries nothing that can be seen, or two kinds of it",
                     "give it markers or a board");
    }
  }
  if (!config.bodies.empty()) return {};
  return refusal("/bodies", "is missing", "say which bodies carry which markers");
}

Result<std::shared_ptr<Tracker>> aruco(const TrackerConfig& config) {
  SettingsReader reader(config.device, tracker_place);
  ArucoSettings settings;
  take_lens(reader, settings.camera);
  reader.take("dictionary", settings.dictionary);
  reader.take("most_error_px", settings.most_error_px, 0.01, 100.0);
  reader.take("least_ratio", settings.least_ratio, 1.0, 100.0);
  reader.take("alike_deg", settings.alike_deg, 0.0, 180.0);
  if (Status read = reader.done(); !read) return read.fault();
  if (!config.device.address.empty()) return refusal("/address", "the camera has it", "give the camera's in camera");
  if (Status plain = without_file(config); !plain) return plain.fault();
  if (Status plain = without_numbers(config); !plain) return plain.fault();
  if (Status bodies = take_bodies(config, settings); !bodies) return bodies.fault();
  const auto camera = camera_of(config);
  if (!camera) return camera.fault();
  return std::shared_ptr<Tracker>(std::make_shared<ArucoTracker>(*camera, std::move(settings)));
}

}  // namespace

Result<std::shared_ptr<Tracker>> make_tracker(const TrackerConfig& config) {
  if (config.device.driver == "natnet") return natnet(config);
  if (config.device.driver == "recording") return recording(config);
  if (config.device.driver == "aruco") return aruco(config);
  return refusal("/driver", "no driver \"" + config.device.driver + "\" does this",
                 "choose natnet, recording or aruco");
}

}  // namespace focalstage
