#include "devices/natnet/session.h"

#include <cmath>
#include <utility>

#include "devices/natnet/bodies.h"

namespace focalstage {

namespace {

// A server answers within milliseconds; so long without an answer is worth telling.
constexpr double answer_within_s = 1.0;

/// Whether to do again what was done last at `last_s`; remembers that it was.
bool again(std::optional<double>& last_s, double every_s, double now_s) {
  if (last_s && now_s - *last_s < every_s) return false;
  last_s = now_s;
  return true;
}

}  // namespace

NatNetSession::NatNetSession(const NatNetSettings& settings, double now_s)
    : settings_(settings), begun_s_(now_s), names_(settings.names) {}

void NatNetSession::take(std::span<const std::uint8_t> bytes, double now_s) {
  const auto datagram = read_datagram(bytes);
  if (!datagram) {
    ++counts_.damaged;
    return;
  }
  switch (static_cast<NatNetMessage>(datagram->id)) {
    case NatNetMessage::server_info:
      return take_server(datagram->payload);
    case NatNetMessage::model:
      return take_names(datagram->payload);
    case NatNetMessage::frame:
      return take_frame(datagram->payload, now_s);
    default:
      return;  // texts and answers to what others asked
  }
}

std::vector<NatNetBytes> NatNetSession::due(double now_s) {
  std::vector<NatNetBytes> messages;
  if (!fresh(now_s) && again(pinged_s_, settings_.ping_s, now_s)) messages.push_back(ping_message());
  if (!server_ || !natnet_version_known(server_->version)) return messages;
  if (!names_known_ && again(asked_names_s_, settings_.ping_s, now_s)) messages.push_back(model_request_message());
  if (again(kept_alive_s_, settings_.keep_alive_s, now_s)) messages.push_back(keep_alive_message());
  return messages;
}

TrackerState NatNetSession::state(double now_s) const {
  TrackerState state = counts_;
  if (server_ && !natnet_version_known(server_->version)) {
    state.phase = TrackerPhase::refused;
    state.fault = Fault{"natnet.version", where(),
                        "the server speaks NatNet " + std::to_string(server_->version.major) + "." +
                            std::to_string(server_->version.minor) + ", of which the layout is not known",
                        "let it stream NatNet 3 or 4"};
  } else if (!newest_) {
    state.phase = TrackerPhase::seeking;
    state.fault = seeking_fault(now_s);
  } else if (fresh(now_s)) {
    state.phase = TrackerPhase::tracking;
  } else {
    state.phase = TrackerPhase::lost;
    const auto silent_ms = std::lround((now_s - newest_->arrival_s) * 1e3);
    state.fault = Fault{"tracker.lost", where(), "no frame came for " + std::to_string(silent_ms) + " ms",
                        "see whether the server still streams and the network still carries it"};
  }
  return state;
}

void NatNetSession::take_server(std::span<const std::uint8_t> payload) {
  auto server = read_server(payload);
  if (!server) {
    ++counts_.damaged;
    return;
  }
  if (server_ && *server_ == *server) return;
  server_ = std::move(server).value();
  names_known_ = false;
}

void NatNetSession::take_names(std::span<const std::uint8_t> payload) {
  if (!server_) return;
  // What cannot be read once cannot be read again: ids stay without a name, but for those of the settings.
  names_known_ = true;
  const auto names = read_names(payload, server_->version, settings_.description_size);
  if (!names) {
    ++counts_.damaged;
    return;
  }
  names_ = settings_.names;
  for (const NatNetName& body : names->bodies) names_.emplace(body.id, body.name);
}

void NatNetSession::take_frame(std::span<const std::uint8_t> payload, double now_s) {
  if (!server_ || !natnet_version_known(server_->version)) return;
  const auto frame = read_frame(payload, server_->version);
  if (!frame) {
    ++counts_.damaged;
    return;
  }
  // Once the stream was lost any frame is newer: the server may have started again.
  if (fresh(now_s) && overtaken(*frame)) {
    ++counts_.late;
    return;
  }
  if (frame->models_changed) names_known_ = false;
  newest_ = std::make_shared<const TrackedFrame>(tracked_frame(*frame, *server_, names_, settings_.axes, now_s));
  newest_number_ = frame->number;
  newest_ticks_ = frame->sent_ticks;
  ++counts_.frames;
}

bool NatNetSession::fresh(double now_s) const { return newest_ && now_s - newest_->arrival_s < settings_.silence_s; }

/// By the server's clock where it is told: the count starts again when a recording is played in a loop.
bool NatNetSession::overtaken(const NatNetFrame& frame) const {
  if (newest_ticks_ != 0 && frame.sent_ticks != 0) return frame.sent_ticks <= newest_ticks_;
  return frame.number <= newest_number_;
}

std::string NatNetSession::where() const {
  return "natnet: " + settings_.server + ":" + std::to_string(settings_.command_port);
}

std::optional<Fault> NatNetSession::seeking_fault(double now_s) const {
  if (now_s - begun_s_ < answer_within_s) return std::nullopt;
  if (!server_) {
    return Fault{"natnet.no-answer", where(), "the server does not answer", "see its address, port and firewall"};
  }
  return Fault{"natnet.no-frames", where(), "the server answers but no frame comes",
               "see whether it streams rigid bodies, and " +
                   std::string(settings_.cast == NatNetCast::multicast ? "by multicast to " + settings_.group
                                                                       : std::string("by unicast")) +
                   " as set here"};
}

}  // namespace focalstage
