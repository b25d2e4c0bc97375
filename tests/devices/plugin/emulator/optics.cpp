#include "tests/devices/plugin/emulator/optics.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <ctime>
#include <deque>
#include <mutex>
#include <thread>

#include "tests/devices/plugin/emulator/wire_talk.h"

namespace focalstage::wire_emulator {

namespace {

using Bytes = std::span<const std::uint8_t>;

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

template <class T>
bool take(Bytes body, T& into) {
  const auto part = part_of<T>(body);
  if (part) into = *part;
  return part.has_value();
}

class Bench final : public Optics {
 public:
  Bench(const OpticsOptions& options, int listener) : options_(options), listener_(listener) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  ~Bench() override {
    thread_ = {};
    if (connection_ >= 0) ::close(connection_);
    ::close(listener_);
    ::unlink(options_.socket.c_str());
  }

  void misbehave(const OpticsFaults& faults) override {
    const std::lock_guard lock(mutex_);
    faults_ = faults;
  }

  OpticsRecord record() const override {
    const std::lock_guard lock(mutex_);
    return record_;
  }

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const OpticsFaults faults = how();
      pollfd polled{connection_ < 0 ? listener_ : connection_, POLLIN, 0};
      if (connection_ >= 0 && faults.deaf) polled.events = 0;
      const timespec tick{0, 500'000};
      const bool news = ::ppoll(&polled, 1, &tick, nullptr) > 0;
      if (news && connection_ < 0) accept();
      if (news && connection_ >= 0 && !faults.deaf) read();
      trigger_until(now_ns());
      tell();
    }
  }

  OpticsFaults how() const {
    const std::lock_guard lock(mutex_);
    return faults_;
  }

  void accept() {
    connection_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    reader_ = {};
    greeted_ = false;
    const std::lock_guard lock(mutex_);
    if (connection_ >= 0) ++record_.connections;
  }

  void read() {
    WireReader::Got got = reader_.receive(connection_);
    if (got == WireReader::Got::header) {
      if (how().hang_up_at_frame && reader_.header().type == WIRE_FRAME) return hang_up();
      got = reader_.receive(connection_);
    }
    if (got == WireReader::Got::end) hang_up();
    if (got == WireReader::Got::message) follow(reader_.header().type, reader_.body());
  }

  /// The end of the stream is darkness.
  void hang_up() {
    ::close(connection_);
    connection_ = -1;
    const std::lock_guard lock(mutex_);
    go_dark();
  }

  void go_dark() {
    record_.triggers = false;
    waiting_.clear();
  }

  void follow(std::uint32_t type, Bytes body) {
    const std::lock_guard lock(mutex_);
    switch (type) {
      case WIRE_HELLO:
        return greet(body);
      case WIRE_CONFIGURE:
        return configure(body);
      case WIRE_START:
        return start(body);
      case WIRE_FRAME:
        return frame(body);
      case WIRE_STOP:
        return go_dark();
      case WIRE_BLANK:
        return blank(body);
      case WIRE_IDENTIFY:
        ++record_.identified;
        return;
      default:
        record_.broken = "a message of type " + std::to_string(type);
    }
  }

  void greet(Bytes body) {
    wire_hello hello{};
    if (!take(body, hello) || hello.version != WIRE_VERSION) record_.broken = "another version";
    wire_geometry geometry{WIRE_VERSION, options_.width_px, options_.height_px, options_.most_periods_ahead, 0, {}};
    std::strcpy(geometry.serial, "OPTICS-1");
    say(connection_, WIRE_GEOMETRY, geometry);
    greeted_ = true;
  }

  void configure(Bytes body) {
    if (record_.triggers) record_.broken = "configured while it was started";
    if (!take(body, configured_)) record_.broken = "a short configuration";
    starts_.assign(configured_.count, 0);
    if (body.size() != sizeof configured_ + starts_.size() * sizeof starts_[0]) record_.broken = "starts are missing";
    std::memcpy(starts_.data(), body.data() + sizeof configured_, body.size() - sizeof configured_);
  }

  void start(Bytes body) {
    wire_start started{};
    if (!take(body, started) || starts_.empty()) record_.broken = "started without a configuration";
    record_.run = started.run;
    record_.shown = record_.missed = 0;
    record_.triggers = !starts_.empty();
    waiting_.clear();
    first_ns_ = now_ns() + static_cast<std::int64_t>(configured_.period_ns);
  }

  void frame(Bytes body) {
    wire_frame told{};
    if (!take(body, told)) record_.broken = "a short frame";
    const std::size_t bytes =
        told.black != 0 ? 0 : static_cast<std::size_t>(told.width_px) * told.height_px * told.channels;
    if (body.size() != sizeof told + bytes) record_.broken = "a frame of another size";
    if (told.width_px != options_.width_px || told.height_px != options_.height_px) record_.broken = "another geometry";
    const std::size_t most = static_cast<std::size_t>(options_.most_periods_ahead) * starts_.size();
    if (waiting_.size() >= most) record_.broken = "more frames than it can hold";
    if (!record_.triggers) return;  // it was made dark meanwhile
    waiting_.push_back({told.period, told.exposure, bytes > 0 ? body[sizeof told] : std::uint8_t{0}});
  }

  void blank(Bytes body) {
    wire_blank told{};
    if (!take(body, told)) record_.broken = "a short blank";
    ++record_.blanks;
    go_dark();
    if (!faults_.no_answer) say(connection_, WIRE_BLANKED, told);
  }

  void trigger_until(std::int64_t until_ns) {
    const std::lock_guard lock(mutex_);
    while (record_.triggers && !faults_.no_triggers) {
      const std::uint64_t number = record_.shown + record_.missed;
      const std::uint64_t place = number % starts_.size();
      const double periods = static_cast<double>(number / starts_.size());
      const auto at_ns = first_ns_ + static_cast<std::int64_t>(periods * configured_.period_ns) + starts_[place];
      if (at_ns > until_ns) return;
      if (waiting_.empty() || waiting_.front().exposure != place) {
        ++record_.missed;
        continue;
      }
      ++record_.shown;
      record_.light.push_back(waiting_.front());
      waiting_.pop_front();
    }
  }

  void tell() {
    const std::lock_guard lock(mutex_);
    if (connection_ < 0 || !greeted_ || faults_.mute || faults_.deaf || now_ns() < told_ns_ + 1'000'000) return;
    told_ns_ = now_ns();
    say(connection_, WIRE_COUNTS,
        wire_counts{record_.run, record_.shown, record_.missed, told_ns_, told_ns_ - first_ns_});
  }

  OpticsOptions options_;
  int listener_;
  int connection_ = -1;
  bool greeted_ = false;
  WireReader reader_;
  mutable std::mutex mutex_;
  OpticsFaults faults_;
  OpticsRecord record_;
  wire_configure configured_{};
  std::vector<std::int64_t> starts_;
  std::deque<Light> waiting_;
  std::int64_t first_ns_ = 0;
  std::int64_t told_ns_ = 0;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<Optics> Optics::start(const OpticsOptions& options) {
  const int listener = listen_at(options.socket);
  if (listener < 0) return nullptr;
  return std::make_unique<Bench>(options, listener);
}

}  // namespace focalstage::wire_emulator
