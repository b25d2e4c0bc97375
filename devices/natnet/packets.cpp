#include "devices/natnet/packets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "devices/natnet/byte_reader.h"

namespace focalstage {

namespace {

constexpr std::size_t header_bytes = 4;
constexpr std::size_t name_bytes = 256;
constexpr std::size_t least_text = 1;  // its NUL
// i32 id, 3 float position, 4 float rotation, float error, i16 parameter
constexpr std::size_t body_bytes = 38;
// i32 id, 3 float position, float size, i16 parameter, float residual
constexpr std::size_t marker_bytes = 26;
constexpr NatNetVersion sizes_since{4, 1};

Fault damaged(const std::string& what, std::size_t byte, const std::string& message) {
  return {"natnet.damaged", what + ": byte " + std::to_string(byte), message,
          "look for a switch or cable that loses data"};
}

Fault ends_early(const std::string& what, const ByteReader& reader) {
  return damaged(what, reader.at(), "the message ends early or a count in it cannot be");
}

NatNetBody read_body(ByteReader& reader) {
  NatNetBody body;
  body.id = reader.i32();
  for (float& value : body.position_m) value = reader.f32();
  for (float& value : body.rotation_xyzw) value = reader.f32();
  body.mean_error_m = reader.f32();
  body.valid = (reader.u16() & 1U) != 0;
  return body;
}

void skip_marker_set(ByteReader& reader) {
  reader.text();
  reader.skip_each(reader.count(12), 12);
}

void skip_skeleton(ByteReader& reader) {
  reader.skip(4);
  reader.skip_each(reader.count(body_bytes), body_bytes);
}

/// Force plates and devices.
void skip_channels(ByteReader& reader) {
  reader.skip(4);
  const std::size_t channels = reader.count(4);
  for (std::size_t i = 0; i < channels && reader.ok(); ++i) reader.skip_each(reader.count(4), 4);
}

/// One counted section of a frame: with its size behind the count where the version has one, else element by element.
template <class SkipOne>
void skip_section(ByteReader& reader, bool sized, std::size_t least, SkipOne&& skip_one) {
  const std::size_t count = reader.count(sized ? 1 : least);
  if (sized) return reader.skip(reader.count(1));
  for (std::size_t i = 0; i < count && reader.ok(); ++i) skip_one(reader);
}

std::vector<NatNetBody> read_bodies(ByteReader& reader, bool sized) {
  const std::size_t count = reader.count(body_bytes);
  const std::size_t size = sized ? reader.count(1) : count * body_bytes;
  // A later version may add to the end of each body.
  const std::size_t stride = count > 0 ? size / count : body_bytes;
  if (stride < body_bytes || stride * count != size) reader.fail();
  std::vector<NatNetBody> bodies;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    bodies.push_back(read_body(reader));
    reader.skip(stride - body_bytes);
  }
  return bodies;
}

/// Timecode, times, and the frame's parameter. Whether the stamp of precision (8 bytes) is sent differs among servers
/// of one version: what is left tells. The end tag (4 bytes) may lack.
void read_suffix(ByteReader& reader, NatNetFrame& frame) {
  reader.skip(8);
  frame.timestamp_s = reader.f64();
  if (!std::isfinite(frame.timestamp_s)) reader.fail();
  frame.exposed_ticks = reader.u64();
  reader.skip(8);
  frame.sent_ticks = reader.u64();
  const std::size_t left = reader.left();
  const bool stamped = left == 10 || left == 14;
  if (!stamped && left != 2 && left != 6) reader.fail();
  if (stamped) reader.skip(8);
  frame.models_changed = (reader.u16() & 2U) != 0;
}

NatNetName read_body_name(ByteReader& reader, const NatNetVersion& version) {
  NatNetName body;
  body.name = reader.text();
  body.id = reader.i32();
  reader.skip(4 + 12);  // parent, offset
  const std::size_t markers = reader.count(12 + 4);
  reader.skip_each(markers, 12 + 4);
  for (std::size_t i = 0; version.major >= 4 && i < markers && reader.ok(); ++i) reader.text();
  return body;
}

void skip_marker_names(ByteReader& reader) {
  reader.text();
  const std::size_t markers = reader.count(least_text);
  for (std::size_t i = 0; i < markers && reader.ok(); ++i) reader.text();
}

NatNetBytes message(NatNetMessage id, std::string_view text) {
  NatNetBytes bytes(header_bytes + text.size() + 1, 0);
  bytes[0] = static_cast<std::uint8_t>(id);
  bytes[2] = static_cast<std::uint8_t>(text.size() + 1);
  std::copy(text.begin(), text.end(), bytes.begin() + header_bytes);
  return bytes;
}

}  // namespace

bool natnet_version_known(const NatNetVersion& version) { return version.major == 3 || version.major == 4; }

Result<NatNetDatagram> read_datagram(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  const std::uint16_t id = reader.u16();
  const std::size_t size = reader.u16();
  if (!reader.ok() || reader.left() != size) {
    return damaged("natnet message", bytes.size(), "the datagram has not the length that its header tells");
  }
  return NatNetDatagram{id, bytes.subspan(header_bytes)};
}

Result<NatNetServer> read_server(std::span<const std::uint8_t> payload) {
  if (payload.size() < name_bytes + 8) {
    return damaged("natnet server information", payload.size(), "the message ends early");
  }
  NatNetServer server;
  const auto name = payload.first(name_bytes);
  server.application.assign(name.begin(), std::find(name.begin(), name.end(), std::uint8_t{0}));
  ByteReader reader(payload.subspan(name_bytes + 4));
  server.version.major = reader.u8();
  server.version.minor = reader.u8();
  reader.skip(2);
  server.ticks_per_s = reader.u64();  // older servers end before: none
  return server;
}

Result<NatNetFrame> read_frame(std::span<const std::uint8_t> payload, const NatNetVersion& version) {
  const bool sized = version >= sizes_since;
  ByteReader reader(payload);
  NatNetFrame frame;
  frame.number = reader.i32();
  skip_section(reader, sized, least_text + 4, skip_marker_set);
  skip_section(reader, sized, 12, [](ByteReader& r) { r.skip(12); });
  frame.bodies = read_bodies(reader, sized);
  skip_section(reader, sized, 8, skip_skeleton);
  if (sized) skip_section(reader, sized, 1, [](ByteReader&) {});  // assets
  skip_section(reader, sized, marker_bytes, [](ByteReader& r) { r.skip(marker_bytes); });
  skip_section(reader, sized, 8, skip_channels);
  skip_section(reader, sized, 8, skip_channels);
  read_suffix(reader, frame);
  if (!reader.ok()) return ends_early("natnet frame", reader);
  return frame;
}

Result<NatNetNames> read_names(std::span<const std::uint8_t> payload, const NatNetVersion& version,
                               NatNetDescriptionSize size) {
  const bool sized = version >= sizes_since && size == NatNetDescriptionSize::after_type;
  ByteReader reader(payload);
  NatNetNames names;
  const std::size_t count = reader.count(4);
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    const std::int32_t type = reader.i32();
    const std::size_t bytes = sized ? reader.count(1) : 0;
    if (!reader.ok()) break;
    ByteReader inside(sized ? payload.subspan(reader.at(), bytes) : payload.subspan(reader.at()));
    if (type == 1) {
      names.bodies.push_back(read_body_name(inside, version));
    } else if (!sized && type == 0) {
      skip_marker_names(inside);
    } else if (!sized) {
      names.whole = false;
      return names;
    }
    if (!inside.ok()) reader.fail();
    reader.skip(sized ? bytes : inside.at());
  }
  if (!reader.ok()) return ends_early("natnet model descriptions", reader);
  return names;
}

NatNetBytes ping_message() { return message(NatNetMessage::connect, "Ping"); }
NatNetBytes model_request_message() { return message(NatNetMessage::request_model, ""); }
NatNetBytes keep_alive_message() { return message(NatNetMessage::keep_alive, ""); }

}  // namespace focalstage
