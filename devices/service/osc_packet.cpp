#include "devices/service/osc_packet.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include <lo/lo.h>

namespace focalstage {

namespace {

constexpr std::string_view bundle_head("#bundle\0", 8);
constexpr std::size_t bundle_head_bytes = 16;  // and the time tag
constexpr int most_nested = 4;

std::size_t size_at(std::span<const std::byte> bytes) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<std::size_t>(bytes[i]);
  return size;
}

std::optional<OscMessage> message_from(std::span<const std::byte> bytes) {
  std::vector<std::byte> own(bytes.begin(), bytes.end());  // the library wants to write
  const auto end = std::find(own.begin(), own.end(), std::byte{0});
  if (own.empty() || own.front() != std::byte{'/'} || end == own.end()) return std::nullopt;
  const std::unique_ptr<void, void (*)(lo_message)> message(lo_message_deserialise(own.data(), own.size(), nullptr),
                                                            lo_message_free);
  if (!message) return std::nullopt;
  OscMessage result{reinterpret_cast<const char*>(own.data()), {}, false};
  if (lo_message_get_argc(message.get()) == 0) return result;
  const lo_arg* argument = lo_message_get_argv(message.get())[0];
  switch (lo_message_get_types(message.get())[0]) {
    case LO_STRING:
    case LO_SYMBOL:
      result.text = &argument->s;
      break;
    case LO_INT32:
      result.released = argument->i == 0;
      break;
    case LO_FLOAT:
      result.released = argument->f == 0.0F;
      break;
    case LO_FALSE:
      result.released = true;
      break;
    default:
      break;
  }
  return result;
}

/// False where it is damaged.
bool gather(std::span<const std::byte> packet, int nested, std::vector<OscMessage>& messages) {
  const bool bundle =
      packet.size() >= bundle_head_bytes && std::memcmp(packet.data(), bundle_head.data(), bundle_head.size()) == 0;
  if (!bundle) {
    std::optional<OscMessage> message = message_from(packet);
    if (!message || messages.size() >= most_osc_messages) return false;
    messages.push_back(std::move(*message));
    return true;
  }
  if (nested >= most_nested) return false;
  packet = packet.subspan(bundle_head_bytes);
  while (!packet.empty()) {
    if (packet.size() < 4) return false;
    const std::size_t size = size_at(packet);
    packet = packet.subspan(4);
    if (size > packet.size() || size % 4 != 0 || !gather(packet.first(size), nested + 1, messages)) return false;
    packet = packet.subspan(size);
  }
  return true;
}

}  // namespace

std::vector<OscMessage> osc_messages(std::span<const std::byte> packet) {
  std::vector<OscMessage> messages;
  if (packet.size() > most_osc_bytes || !gather(packet, 0, messages)) return {};
  return messages;
}

std::optional<DeskCommand> desk_command(const OscMessage& message, const std::string& prefix) {
  using Kind = DeskCommand::Kind;
  static constexpr std::array<std::pair<std::string_view, Kind>, 6> plain{{{"/play", Kind::play},
                                                                           {"/hold", Kind::hold},
                                                                           {"/go", Kind::go},
                                                                           {"/next", Kind::next},
                                                                           {"/back", Kind::back},
                                                                           {"/blackout", Kind::blackout}}};
  if (message.released || !message.path.starts_with(prefix)) return std::nullopt;
  const std::string_view rest = std::string_view(message.path).substr(prefix.size());
  for (const auto& [path, kind] : plain) {
    if (rest == path) return DeskCommand{kind};
  }
  if (rest == "/cue" && message.text) return DeskCommand{Kind::cue, *message.text};
  return std::nullopt;
}

}  // namespace focalstage
