#include "tests/rig/emulator/optics.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <utility>

#include "tests/devices/plugin/emulator/wire_talk.h"

namespace focalstage::rig_emulator {

namespace {

constexpr int tick_ms = 5;

using wire_emulator::part_of;
using wire_emulator::say;
using wire_emulator::WireReader;

}  // namespace

Optics::Optics(const OpticsSettings& settings) : settings_(settings) {
  plug_in();
  thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

Optics::~Optics() {
  thread_.request_stop();
  unplug();
}

void Optics::plug_in() {
  const std::lock_guard lock(mutex_);
  if (plugged_in_) return;
  listener_ = wire_emulator::listen_at(settings_.socket, SOCK_NONBLOCK);
  if (listener_ < 0) {
    std::perror(settings_.socket.c_str());
    std::abort();
  }
  plugged_in_ = true;
}

void Optics::unplug() {
  const std::lock_guard lock(mutex_);
  if (!plugged_in_) return;
  plugged_in_ = false;
  ::close(std::exchange(listener_, -1));
  ::unlink(settings_.socket.c_str());
  if (connection_ >= 0) ::shutdown(connection_, SHUT_RDWR);
  forget();
}

void Optics::forget() {
  running_ = false;
  waiting_.clear();
}

void Optics::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    int connection = -1;
    {
      const std::lock_guard lock(mutex_);
      if (listener_ >= 0) connection = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      connection_ = connection;
    }
    if (connection < 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(tick_ms));
      continue;
    }
    talk(connection, stop);
    const std::lock_guard lock(mutex_);
    forget();
    connection_ = -1;
    ::close(connection);
  }
}

/// Until the other end is gone, or this one is to stop.
void Optics::talk(int connection, const std::stop_token& stop) {
  WireReader reader;
  while (!stop.stop_requested()) {
    pollfd poll_for{connection, POLLIN, 0};
    if (::poll(&poll_for, 1, tick_ms) == 0) continue;
    WireReader::Got got = reader.receive(connection);
    if (got == WireReader::Got::header) got = reader.receive(connection);
    if (got == WireReader::Got::end) return;
    if (got == WireReader::Got::message) take(connection, reader.header().type, reader.body());
  }
}

void Optics::take(int connection, std::uint32_t type, std::span<const std::uint8_t> body) {
  const std::lock_guard lock(mutex_);
  switch (type) {
    case WIRE_HELLO: {
      wire_geometry geometry{};
      geometry.version = WIRE_VERSION;
      geometry.width_px = settings_.width_px;
      geometry.height_px = settings_.height_px;
      geometry.most_periods_ahead = settings_.most_periods_ahead;
      geometry.latency_ns = static_cast<std::int64_t>(settings_.latency_s * 1e9 + 0.5);
      std::snprintf(geometry.serial, sizeof geometry.serial, "WIRE-1");
      say(connection, WIRE_GEOMETRY, geometry);
      break;
    }
    case WIRE_CONFIGURE:
      exposure_s_ = 1e-9 * static_cast<double>(part_of<wire_configure>(body).value_or(wire_configure{}).exposure_ns);
      forget();
      break;
    case WIRE_START:
      forget();
      running_ = true;
      run_ = part_of<wire_start>(body).value_or(wire_start{}).run;
      shown_ = missed_ = 0;
      break;
    case WIRE_FRAME: {
      const auto frame = part_of<wire_frame>(body);
      if (!frame) break;
      waiting_.push_back(frame->black != 0 ? WaitingPicture{.black = true}
                                           : picture_of(frame->exposure, body.subspan(sizeof *frame)));
      break;
    }
    case WIRE_STOP:
      forget();
      break;
    case WIRE_BLANK:
      forget();
      say(connection, WIRE_BLANKED, part_of<wire_blank>(body).value_or(wire_blank{}));
      break;
    default:
      break;
  }
}

double Optics::level_in(const PixelRectangle& region, std::span<const std::uint8_t> pixels) const {
  double sum = 0.0;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      sum += pixels[static_cast<std::size_t>(y) * settings_.width_px + static_cast<std::size_t>(x)];
    }
  }
  return sum / (255.0 * region.width * region.height);
}

/// Most pictures are those of the period before, and comparing is cheaper than summing up.
WaitingPicture Optics::picture_of(std::uint32_t exposure, std::span<const std::uint8_t> pixels) {
  Seen& seen = seen_[exposure];
  if (seen.pixels.size() != pixels.size() || std::memcmp(seen.pixels.data(), pixels.data(), pixels.size()) != 0) {
    seen.pixels.assign(pixels.begin(), pixels.end());
    seen.picture.black = std::ranges::all_of(pixels, [](std::uint8_t code) { return code == 0; });
    if (!settings_.regions.empty())
      seen.picture.mean_level =
          level_in({0, 0, static_cast<int>(settings_.width_px), static_cast<int>(settings_.height_px)}, pixels);
    seen.picture.levels.clear();
    for (const PixelRectangle& region : settings_.regions) seen.picture.levels.push_back(level_in(region, pixels));
    seen.picture.crc = static_cast<std::uint32_t>(::crc32(0, pixels.data(), static_cast<uInt>(pixels.size())));
  }
  return seen.picture;
}

void Optics::tell_counts(double device_s, double monotonic_s) {
  if (connection_ < 0) return;
  const auto ns = [](double seconds) { return static_cast<std::int64_t>(seconds * 1e9); };
  say(connection_, WIRE_COUNTS, wire_counts{run_, shown_, missed_, ns(monotonic_s), ns(device_s)});
}

void Optics::advance_to(double device_s, double monotonic_s) {
  const std::lock_guard lock(mutex_);
  tell_counts(device_s, monotonic_s);
}

void Optics::lose_next_trigger() {
  const std::lock_guard lock(mutex_);
  lose_next_ = true;
}

std::optional<Begun> Optics::trigger(double device_s) {
  const std::lock_guard lock(mutex_);
  if (!plugged_in_ || !running_ || std::exchange(lose_next_, false)) return std::nullopt;
  Begun begun{.start_s = device_s + settings_.latency_s, .exposure_s = exposure_s_, .dark = true};
  if (waiting_.empty()) {
    ++missed_;
  } else {
    begun.dark = waiting_.front().black;
    begun.crc = waiting_.front().crc;
    begun.mean_level = waiting_.front().mean_level;
    begun.levels = std::move(waiting_.front().levels);
    waiting_.pop_front();
    ++shown_;
  }
  return begun;
}

}  // namespace focalstage::rig_emulator
