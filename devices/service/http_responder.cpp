#include "devices/service/http_responder.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "devices/runtime/address.h"
#include "devices/runtime/sockets.h"

namespace focalstage {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t most_request_bytes = 4096;

/// Waits for `events` until then; false when it is over.
bool wait(int socket, short events, Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
  pollfd watched{socket, events, 0};
  return left > 0 && poll(&watched, 1, static_cast<int>(left)) > 0;
}

/// The head of a request, as far as it came; none where it is too long or too slow.
std::optional<std::string> read_head(int socket, Clock::time_point until) {
  std::string head;
  char bytes[1024];
  while (head.find("\r\n\r\n") == std::string::npos) {
    if (head.size() > most_request_bytes || !wait(socket, POLLIN, until)) return std::nullopt;
    const ssize_t count = recv(socket, bytes, sizeof bytes, MSG_DONTWAIT);
    if (count <= 0) return std::nullopt;
    head.append(bytes, static_cast<std::size_t>(count));
  }
  return head;
}

void write_all(int socket, std::string_view text, Clock::time_point until) {
  while (!text.empty() && wait(socket, POLLOUT, until)) {
    const ssize_t count = send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

std::string response(const char* status, const std::string& type, const std::string& body) {
  return std::string("HTTP/1.0 ") + status + "\r\nContent-Type: " + type +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" + body;
}

std::string refusal(const char* status) { return response(status, "text/plain", std::string(status) + "\n"); }

}  // namespace

Result<std::unique_ptr<HttpResponder>> HttpResponder::start(Settings settings, std::function<std::string()> body) {
  const Result<std::string> loopback = loopback_address(settings.listen);
  if (!loopback) return loopback.fault();
  Result<BoundSocket> socket = bind_socket(*host_port(*loopback), SOCK_STREAM);
  if (!socket) return socket.fault();
  return std::unique_ptr<HttpResponder>(
      new HttpResponder(std::move(settings), std::move(body), socket->descriptor, socket->address));
}

HttpResponder::HttpResponder(Settings settings, std::function<std::string()> body, int socket, std::string address)
    : settings_(std::move(settings)),
      body_(std::move(body)),
      socket_(socket),
      address_(std::move(address)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

HttpResponder::~HttpResponder() {
  thread_.request_stop();
  shutdown(socket_, SHUT_RDWR);
  thread_.join();
  close(socket_);
}

void HttpResponder::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd watched{socket_, POLLIN, 0};
    if (poll(&watched, 1, 200) <= 0) continue;
    const int connection = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));  // out of descriptors: not in a whirl
      continue;
    }
    answer(connection);
    close(connection);
  }
}

void HttpResponder::answer(int connection) {
  const Clock::time_point until = Clock::now() + settings_.patience;
  const std::optional<std::string> head = read_head(connection, until);
  if (!head) return write_all(connection, refusal("400 Bad Request"), until);
  const std::string line = head->substr(0, head->find("\r\n"));
  const std::size_t first = line.find(' ');
  const std::size_t second = line.find(' ', first + 1);
  if (first == std::string::npos || second == std::string::npos) {
    return write_all(connection, refusal("400 Bad Request"), until);
  }
  if (line.substr(0, first) != "GET") return write_all(connection, refusal("405 Method Not Allowed"), until);
  const std::string target = line.substr(first + 1, second - first - 1);
  if (target.substr(0, target.find('?')) != settings_.path) {
    return write_all(connection, refusal("404 Not Found"), until);
  }
  write_all(connection, response("200 OK", settings_.content_type, body_()), until);
}

}  // namespace focalstage
