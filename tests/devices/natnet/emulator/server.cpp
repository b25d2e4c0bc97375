#include "tests/devices/natnet/emulator/server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <thread>

namespace focalstage::natnet_emulator {

namespace {

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

sockaddr_in address_of(const std::string& dots, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  ::inet_pton(AF_INET, dots.c_str(), &address.sin_addr);
  address.sin_port = htons(port);
  return address;
}

sockaddr* plain(sockaddr_in* address) { return reinterpret_cast<sockaddr*>(address); }

class UdpServer final : public Server {
 public:
  UdpServer(const Options& options, int descriptor)
      : options_(options),
        dialect_(options.dialect),
        descriptor_(descriptor),
        begun_s_(steady_s()),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  ~UdpServer() override {
    thread_.request_stop();
    thread_.join();
    ::close(descriptor_);
  }

  std::uint16_t command_port() const override {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(descriptor_, plain(&address), &size);
    return ntohs(address.sin_port);
  }

  void misbehave(const Misbehaviour& how) override {
    const std::lock_guard lock(mutex_);
    how_ = how;
  }

  void speak(const Dialect& dialect) override {
    const std::lock_guard lock(mutex_);
    dialect_ = dialect;
  }

  Record record() const override {
    const std::lock_guard lock(mutex_);
    return record_;
  }

 private:
  void run(const std::stop_token& stop) {
    double next_s = begun_s_;
    while (!stop.stop_requested()) {
      pollfd polled{descriptor_, POLLIN, 0};
      ::poll(&polled, 1, 1);
      const std::lock_guard lock(mutex_);
      answer_all();
      const double now_s = steady_s();
      if (now_s < next_s) continue;
      stream(now_s);
      // What was missed is not made up for.
      next_s = std::max(next_s + 1.0 / options_.frames_per_s, now_s - 0.01);
    }
  }

  void answer_all() {
    std::array<std::uint8_t, 2048> buffer{};
    sockaddr_in from{};
    socklen_t size = sizeof from;
    ssize_t got = 0;
    while ((got = ::recvfrom(descriptor_, buffer.data(), buffer.size(), MSG_DONTWAIT, plain(&from), &size)) >= 0) {
      if (got < 4 || how_.deaf) continue;
      client_ = from;
      heard_s_ = steady_s();
      answer(buffer[0] | buffer[1] << 8, from);
    }
  }

  void answer(int id, const sockaddr_in& to) {
    if (id == 0) {
      ++record_.pings;
      send(server_info(dialect_, ticks_per_s, options_.data_port, !options_.group.empty()), to);
    } else if (id == 4) {
      ++record_.model_requests;
      send(descriptions(dialect_, {{7, "Head"}, {8, "Box"}}), to);
    } else if (id == 10) {
      ++record_.keep_alives;
    } else {
      ++record_.unknown;
      send({100, 0, 0, 0}, to);
    }
  }

  std::optional<sockaddr_in> destination(double now_s) const {
    if (!options_.group.empty()) return address_of(options_.group, options_.data_port);
    if (!client_ || now_s - heard_s_ > options_.patience_s) return std::nullopt;
    sockaddr_in to = *client_;
    if (options_.stream_to_data_port) to.sin_port = htons(options_.data_port);
    return to;
  }

  Moment moment(double now_s) const {
    Moment moment;
    moment.number = record_.frames_made;
    moment.timestamp = now_s - begun_s_ - latency_s;
    const auto at = head_position(moment.timestamp);
    Body head{7, "Head", {}, {0.0F, 0.0F, 0.0F, 1.0F}, 0.0002F, 1};
    for (std::size_t i = 0; i < 3; ++i) head.position[i] = static_cast<float>(at[i]);
    if (how_.tracking_lost) head.param = 0;
    if (how_.nan_pose) head.position[0] = std::numeric_limits<float>::quiet_NaN();
    moment.bodies = {head, {8, "Box", {0.0F, 0.5F, -1.0F}}};
    moment.crowded = true;
    moment.labelled = true;
    moment.sent = static_cast<std::uint64_t>((now_s - begun_s_ + 1000.0) * static_cast<double>(ticks_per_s));
    moment.exposed = moment.sent - static_cast<std::uint64_t>(latency_s * static_cast<double>(ticks_per_s));
    moment.received = moment.exposed + 1;
    return moment;
  }

  void stream(double now_s) {
    const auto to = destination(now_s);
    if (!to || how_.silent || how_.deaf) return;
    ++record_.frames_made;
    Bytes bytes = frame(dialect_, moment(now_s));
    bytes.resize(bytes.size() - static_cast<std::size_t>(how_.cut_bytes));
    if (how_.drop_every > 0 && record_.frames_made % how_.drop_every == 0) return;
    if (how_.swap_pairs && held_.empty()) {
      held_ = std::move(bytes);
      return;
    }
    send_frame(bytes, *to, now_s);
    if (!held_.empty()) send_frame(held_, *to, now_s);
    held_.clear();
  }

  void send_frame(const Bytes& bytes, const sockaddr_in& to, double now_s) {
    send(bytes, to);
    ++record_.frames_sent;
    record_.last_sent_s = now_s;
  }

  void send(const Bytes& bytes, sockaddr_in to) const {
    (void)::sendto(descriptor_, bytes.data(), bytes.size(), 0, plain(&to), sizeof to);
  }

  Options options_;
  Dialect dialect_;
  int descriptor_;
  double begun_s_;
  mutable std::mutex mutex_;
  Misbehaviour how_;
  Record record_;
  Bytes held_;
  std::optional<sockaddr_in> client_;
  double heard_s_ = 0.0;
  std::jthread thread_;
};

}  // namespace

std::array<double, 3> head_position(double timestamp_s) {
  const double turn = 2.0 * std::numbers::pi * 0.5 * timestamp_s;
  return {0.3 * std::sin(turn), 1.6, 0.3 * std::cos(turn)};
}

std::unique_ptr<Server> Server::start(const Options& options) {
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = address_of(options.address, options.command_port);
  if (descriptor < 0 || ::bind(descriptor, plain(&address), sizeof address) != 0) {
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  const in_addr through = address.sin_addr;
  ::setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_IF, &through, sizeof through);
  return std::make_unique<UdpServer>(options, descriptor);
}

}  // namespace focalstage::natnet_emulator
