#include "devices/service/service_manager.h"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

/// What systemd listens on.
class Manager {
 public:
  explicit Manager(const std::string& path) : descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    if (path[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
    REQUIRE(::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  }
  ~Manager() { ::close(descriptor_); }

  /// The next message; empty where none comes within `patience_ms`.
  std::string next(int patience_ms = 2000) {
    const timeval patience{patience_ms / 1000, 1000 * (patience_ms % 1000)};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    char bytes[512];
    const ssize_t count = ::recv(descriptor_, bytes, sizeof bytes, 0);
    return count > 0 ? std::string(bytes, static_cast<std::size_t>(count)) : std::string();
  }

 private:
  int descriptor_;
};

TEST_CASE("says that it is ready, feeds the watchdog while it is alive and only then, and says that it stops") {
  const TemporaryFolder folder;
  for (const std::string& path : {(folder / "notify").string(), "@focalstage-test-" + std::to_string(getpid())}) {
    CAPTURE(path);
    Manager systemd(path);
    std::atomic<bool> alive = true;
    ServiceManager manager(path, std::chrono::milliseconds(200));
    manager.ready("listening on x", [&] { return alive.load(); });
    CHECK(systemd.next() == "READY=1\nSTATUS=listening on x\n");
    CHECK(systemd.next() == "WATCHDOG=1\n");
    CHECK(systemd.next(190) == "WATCHDOG=1\n");
    alive = false;
    while (!systemd.next(150).empty()) continue;  // those on their way
    CHECK(systemd.next(400).empty());
    alive = true;
    CHECK(systemd.next() == "WATCHDOG=1\n");
    alive = false;
    while (!systemd.next(150).empty()) continue;
    manager.stopping();
    CHECK(systemd.next() == "STOPPING=1\n");
  }
}

TEST_CASE("what the environment asks for is done, what it does not ask for is not") {
  const TemporaryFolder folder;
  const std::string path = (folder / "notify").string();
  Manager systemd(path);
  ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  ::setenv("WATCHDOG_USEC", "200000", 1);
  ::setenv("WATCHDOG_PID", "1", 1);  // another's
  ServiceManager::from_environment().ready("x", [] { return true; });
  CHECK(systemd.next() == "READY=1\nSTATUS=x\n");
  CHECK(systemd.next(300).empty());
  ::setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  {
    ServiceManager ours = ServiceManager::from_environment();
    ours.ready("x", [] { return true; });
    CHECK(systemd.next() == "READY=1\nSTATUS=x\n");
    CHECK(systemd.next() == "WATCHDOG=1\n");
  }
  ::unsetenv("NOTIFY_SOCKET");
  while (!systemd.next(100).empty()) continue;
  ServiceManager::from_environment().ready("x", [] { return true; });
  CHECK(systemd.next(200).empty());
  ::unsetenv("WATCHDOG_USEC");
  ::unsetenv("WATCHDOG_PID");
}

}  // namespace
}  // namespace focalstage
