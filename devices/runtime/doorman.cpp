#include "devices/runtime/doorman.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <utility>

namespace focalstage {

namespace {

std::string ip_of(const sockaddr_storage& from) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const void* address = from.ss_family == AF_INET
                            ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in*>(&from)->sin_addr)
                            : static_cast<const void*>(&reinterpret_cast<const sockaddr_in6*>(&from)->sin6_addr);
  inet_ntop(from.ss_family, address, text.data(), text.size());
  return text.data();
}

}  // namespace

Doorman::Doorman(int socket, const Settings& settings, std::function<void(int connection)> let_in)
    : socket_(socket),
      settings_(settings),
      let_in_(std::move(let_in)),
      events_(epoll_create1(EPOLL_CLOEXEC)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Doorman::~Doorman() {
  thread_.request_stop();
  thread_.join();
  for (const auto& [watched, peer] : inside_) close(watched);
  close(events_);
  close(socket_);
}

void Doorman::run(const std::stop_token& stop) {
  fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
  epoll_event wanted{EPOLLIN, {.fd = socket_}};
  epoll_ctl(events_, EPOLL_CTL_ADD, socket_, &wanted);
  std::array<epoll_event, 32> happened{};
  while (!stop.stop_requested()) {
    const int count = epoll_wait(events_, happened.data(), static_cast<int>(happened.size()), 100);
    // Those who left first, so that there is room for those who come.
    for (int i = 0; i < count; ++i) {
      const int descriptor = happened[static_cast<std::size_t>(i)].data.fd;
      if (descriptor != socket_) leave(descriptor);
    }
    for (int i = 0; i < count; ++i) {
      if (happened[static_cast<std::size_t>(i)].data.fd == socket_) accept_one();
    }
  }
}

void Doorman::accept_one() {
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  const int connection = accept4(socket_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (connection < 0) {
    // Out of descriptors, or gone already; not in a whirl.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return;
  }
  const std::string peer = ip_of(from);
  // A second descriptor of the connection stays here: it tells when the server shut it.
  const bool room =
      std::cmp_less(inside_.size(), settings_.connections_max) && of_a_peer_[peer] < settings_.connections_per_peer_max;
  const int watched = room ? fcntl(connection, F_DUPFD_CLOEXEC, 0) : -1;
  if (watched < 0) {
    ++turned_away_;
    if (of_a_peer_[peer] == 0) of_a_peer_.erase(peer);
    close(connection);
    return;
  }
  const int yes = 1;
  setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  inside_.emplace(watched, peer);
  ++of_a_peer_[peer];
  ++connections_;
  let_in_(connection);
  epoll_event over{0, {.fd = watched}};  // both ends shut is always told
  epoll_ctl(events_, EPOLL_CTL_ADD, watched, &over);
}

void Doorman::leave(int watched) {
  const auto gone = inside_.find(watched);
  if (gone == inside_.end()) return;
  if (--of_a_peer_[gone->second] == 0) of_a_peer_.erase(gone->second);
  inside_.erase(gone);
  --connections_;
  epoll_ctl(events_, EPOLL_CTL_DEL, watched, nullptr);
  close(watched);
}

}  // namespace focalstage
