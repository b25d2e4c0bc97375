#include "tests/devices/natnet/emulator/server_bytes.h"

#include <cstring>

namespace focalstage::natnet_emulator {

namespace {

void append(Bytes& to, const Bytes& more) {
  for (const std::uint8_t byte : more) to.push_back(byte);
}

/// Appends a value's bytes, lowest first.
template <class T>
void put(Bytes& to, T value) {
  std::array<std::uint8_t, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));  // x86: the wire's own order
  for (const std::uint8_t byte : raw) to.push_back(byte);
}

void put_text(Bytes& to, const std::string& text) {
  for (const char letter : text) to.push_back(static_cast<std::uint8_t>(letter));
  to.push_back(0);
}

template <class Array>
void put_all(Bytes& to, const Array& values) {
  for (const auto& value : values) put(to, value);
}

Bytes with_header(std::uint16_t id, const Bytes& payload) {
  Bytes all;
  put<std::uint16_t>(all, id);
  put<std::uint16_t>(all, static_cast<std::uint16_t>(payload.size()));
  append(all, payload);
  return all;
}

bool sized(const Dialect& dialect) { return dialect.major > 4 || (dialect.major == 4 && dialect.minor >= 1); }

void put_section(Bytes& to, const Dialect& dialect, std::int32_t count, const Bytes& content) {
  put<std::int32_t>(to, count);
  if (sized(dialect)) put<std::int32_t>(to, static_cast<std::int32_t>(content.size()));
  append(to, content);
}

void put_body(Bytes& to, const Body& body) {
  put(to, body.id);
  put_all(to, body.position);
  put_all(to, body.xyzw);
  put(to, body.error);
  put(to, body.param);
}

void put_labelled(Bytes& to, const Body& body, std::int32_t id) {
  put(to, id);
  put_all(to, body.position);
  put(to, 0.014F);
  put<std::int16_t>(to, 2);
  put(to, 0.0005F);
}

Bytes marker_sets() {
  Bytes bytes;
  put_text(bytes, "all");
  put<std::int32_t>(bytes, 2);
  put_all(bytes, std::array<float, 6>{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F});
  put_text(bytes, "");
  put<std::int32_t>(bytes, 0);
  return bytes;
}

Bytes skeleton() {
  Bytes bytes;
  put<std::int32_t>(bytes, 3);
  put<std::int32_t>(bytes, 2);
  put_body(bytes, {900, "", {}, {}, 0.0F, 1});
  put_body(bytes, {901, "", {}, {}, 0.0F, 0});
  return bytes;
}

Bytes asset() {
  Bytes bytes;
  put<std::int32_t>(bytes, 4);
  put<std::int32_t>(bytes, 1);
  put_body(bytes, {902, "", {}, {}, 0.0F, 1});
  put<std::int32_t>(bytes, 1);
  put_labelled(bytes, {}, 5);
  return bytes;
}

/// Two channels, with one value and with none.
Bytes plate() {
  Bytes bytes;
  put<std::int32_t>(bytes, 11);
  put<std::int32_t>(bytes, 2);
  put<std::int32_t>(bytes, 1);
  put(bytes, 9.81F);
  put<std::int32_t>(bytes, 0);
  return bytes;
}

void put_suffix(Bytes& to, const Dialect& dialect, const Moment& moment) {
  put<std::uint32_t>(to, 0);
  put<std::uint32_t>(to, 0);
  put(to, moment.timestamp);
  put(to, moment.exposed);
  put(to, moment.received);
  put(to, moment.sent);
  if (dialect.major >= 4 && dialect.stamp) put<std::uint64_t>(to, 0);
  put(to, moment.param);
  if (dialect.end_tag) put<std::int32_t>(to, 0);
}

Bytes marker_set_description() {
  Bytes bytes;
  put_text(bytes, "all");
  put<std::int32_t>(bytes, 2);
  put_text(bytes, "m1");
  put_text(bytes, "m2");
  return bytes;
}

Bytes body_description(const Dialect& dialect, const Body& body) {
  Bytes bytes;
  put_text(bytes, body.name);
  put(bytes, body.id);
  put<std::int32_t>(bytes, -1);
  put_all(bytes, std::array<float, 3>{});
  put<std::int32_t>(bytes, 2);
  put_all(bytes, std::array<float, 6>{0.1F, 0.0F, 0.0F, 0.0F, 0.1F, 0.0F});
  put_all(bytes, std::array<std::int32_t, 2>{1, 2});
  if (dialect.major < 4) return bytes;
  put_text(bytes, "m1");
  put_text(bytes, "m2");
  return bytes;
}

void put_description(Bytes& to, const Dialect& dialect, std::int32_t type, const Bytes& content) {
  put(to, type);
  if (sized(dialect) && dialect.description_sizes) put<std::int32_t>(to, static_cast<std::int32_t>(content.size()));
  append(to, content);
}

}  // namespace

Bytes server_info(const Dialect& dialect, std::uint64_t ticks_per_s, std::uint16_t data_port, bool multicast) {
  Bytes bytes;
  put_text(bytes, "Motive");
  bytes.resize(256, 0);
  put_all(bytes, std::array<std::uint8_t, 4>{3, 1, 0, 0});
  put_all(bytes, std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(dialect.major),
                                             static_cast<std::uint8_t>(dialect.minor), 0, 0});
  put(bytes, ticks_per_s);
  put(bytes, data_port);
  put<std::uint8_t>(bytes, multicast ? 1 : 0);
  put_all(bytes, std::array<std::uint8_t, 4>{239, 255, 42, 99});
  return with_header(1, bytes);
}

Bytes frame(const Dialect& dialect, const Moment& moment) {
  const bool crowded = moment.crowded;
  Bytes bytes;
  put(bytes, moment.number);
  put_section(bytes, dialect, crowded ? 2 : 0, crowded ? marker_sets() : Bytes{});
  put_section(bytes, dialect, crowded ? 1 : 0, crowded ? Bytes(12, 0x3f) : Bytes{});
  Bytes bodies;
  for (const Body& body : moment.bodies) put_body(bodies, body);
  put_section(bytes, dialect, static_cast<std::int32_t>(moment.bodies.size()), bodies);
  put_section(bytes, dialect, crowded ? 1 : 0, crowded ? skeleton() : Bytes{});
  if (sized(dialect)) put_section(bytes, dialect, crowded ? 1 : 0, crowded ? asset() : Bytes{});
  Bytes markers;
  if (moment.labelled) put_labelled(markers, moment.bodies.at(0), 0x00070001);
  put_section(bytes, dialect, moment.labelled ? 1 : 0, markers);
  put_section(bytes, dialect, crowded ? 1 : 0, crowded ? plate() : Bytes{});
  put_section(bytes, dialect, crowded ? 1 : 0, crowded ? plate() : Bytes{});
  put_suffix(bytes, dialect, moment);
  return with_header(7, bytes);
}

Bytes descriptions(const Dialect& dialect, const std::vector<Body>& bodies) {
  Bytes bytes;
  put<std::int32_t>(bytes, static_cast<std::int32_t>(bodies.size()) + 1);
  put_description(bytes, dialect, 0, marker_set_description());
  for (const Body& body : bodies) put_description(bytes, dialect, 1, body_description(dialect, body));
  return with_header(5, bytes);
}

}  // namespace focalstage::natnet_emulator
