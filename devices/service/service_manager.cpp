#include "devices/service/service_manager.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string_view>
#include <utility>

namespace focalstage {

namespace {

std::optional<long long> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  const std::string_view view(text);
  long long value = 0;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), value);
  if (error != std::errc() || end != view.data() + view.size() || value <= 0) return std::nullopt;
  return value;
}

}  // namespace

ServiceManager ServiceManager::from_environment() {
  const char* socket = std::getenv("NOTIFY_SOCKET");
  if (socket == nullptr || (*socket != '/' && *socket != '@')) return {};
  const std::optional<long long> usec = number_in("WATCHDOG_USEC");
  const std::optional<long long> process = number_in("WATCHDOG_PID");
  const bool ours = !process || *process == getpid();
  std::optional<std::chrono::microseconds> watchdog;
  if (usec && ours) watchdog = std::chrono::microseconds(*usec);
  return {socket, watchdog};
}

void ServiceManager::tell(const std::string& message) const {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_.empty() || socket_.size() >= sizeof address.sun_path) return;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_.front() == '@') address.sun_path[0] = '\0';  // of the abstract kind
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return;
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  (void)sendto(descriptor, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
               reinterpret_cast<const sockaddr*>(&address), size);
  close(descriptor);
}

void ServiceManager::ready(const std::string& status, std::function<bool()> alive) {
  if (socket_.empty()) return;
  tell("READY=1\nSTATUS=" + status + "\n");
  if (!watchdog_) return;
  feeder_ = std::jthread([socket = socket_, every = *watchdog_ / 4, alive = std::move(alive)](std::stop_token stop) {
    const ServiceManager manager(socket, std::nullopt);
    std::mutex mutex;
    std::condition_variable_any ended;
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      if (alive()) manager.tell("WATCHDOG=1\n");
      ended.wait_for(lock, stop, every, [] { return false; });
    }
  });
}

void ServiceManager::stopping() {
  feeder_ = {};
  tell("STOPPING=1\n");
}

}  // namespace focalstage
