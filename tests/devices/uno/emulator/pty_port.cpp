#include "tests/devices/uno/emulator/pty_port.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

namespace focalstage::uno_emulator {

namespace {

std::pair<int, std::string> new_pty() {
  termios raw{};
  ::cfmakeraw(&raw);
  raw.c_cflag |= CS8 | CREAD | CLOCAL;
  int master = -1;
  int slave = -1;
  std::array<char, 128> name{};
  if (::openpty(&master, &slave, name.data(), &raw, nullptr) != 0) throw std::runtime_error("no pty can be had");
  ::close(slave);
  ::fcntl(master, F_SETFL, ::fcntl(master, F_GETFL) | O_NONBLOCK);
  ::fcntl(master, F_SETFD, FD_CLOEXEC);
  return {master, name.data()};
}

}  // namespace

void PtyPort::plug_in() {
  if (plugged_in()) return;
  auto [master, name] = new_pty();
  if (name == last_) {
    const int old = master;
    std::tie(master, name) = new_pty();
    ::close(old);
  }
  master_ = master;
  path_ = last_ = name;
  update_link();
}

void PtyPort::unplug() {
  if (!plugged_in()) return;
  ::close(master_);
  master_ = -1;
  path_.clear();
  update_link();
}

void PtyPort::set_link(const std::string& link) {
  link_ = link;
  update_link();
}

void PtyPort::update_link() const {
  if (link_.empty()) return;
  std::error_code none;
  std::filesystem::remove(link_, none);
  if (plugged_in()) std::filesystem::create_symlink(path_, link_, none);
}

bool PtyPort::host_is_there() const {
  if (!plugged_in()) return false;
  pollfd polled{master_, 0, 0};
  ::poll(&polled, 1, 0);
  return (polled.revents & POLLHUP) == 0;
}

std::string PtyPort::read() const {
  std::string bytes;
  std::array<char, 512> some{};
  for (;;) {
    const ssize_t got = plugged_in() ? ::read(master_, some.data(), some.size()) : 0;
    if (got <= 0) return bytes;
    bytes.append(some.data(), static_cast<std::size_t>(got));
  }
}

void PtyPort::write(std::string_view bytes) const {
  if (!plugged_in() || !host_is_there()) return;
  [[maybe_unused]] const ssize_t sent = ::write(master_, bytes.data(), bytes.size());
}

}  // namespace focalstage::uno_emulator
