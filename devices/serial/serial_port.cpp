#include "devices/serial/serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

std::string words_for(int error) { return std::error_code(error, std::generic_category()).message(); }

std::optional<speed_t> speed_of(int baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    case 460800:
      return B460800;
    case 921600:
      return B921600;
    default:
      return std::nullopt;
  }
}

Fault open_fault(const std::string& path, int error) {
  if (error == EBUSY || error == EWOULDBLOCK) {
    return {"serial.busy", path, "another program uses this port", "close that program; ModemManager may be one"};
  }
  std::string remedy = "plug it in, or see which name it has now";
  if (error == EACCES || error == EPERM) remedy = "install the driver's udev rule, or join the group dialout";
  return {"serial.open", path, "the port cannot be opened: " + words_for(error), remedy};
}

bool make_raw(int descriptor, speed_t speed) {
  termios line{};
  if (::tcgetattr(descriptor, &line) != 0) return false;
  ::cfmakeraw(&line);
  // Without HUPCL, so that DTR stays up when the port is closed and an Arduino is not reset by every opening.
  line.c_cflag = CS8 | CREAD | CLOCAL;
  // Nothing there is EAGAIN; with 0 it would look like the end.
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  return ::cfsetispeed(&line, speed) == 0 && ::cfsetospeed(&line, speed) == 0 &&
         ::tcsetattr(descriptor, TCSANOW, &line) == 0;
}

/// Until the port can do this, or the deadline. What it cannot do for ever it says when asked.
void await(int descriptor, short what, double deadline_s) {
  const double left_s = std::clamp(deadline_s - monotonic_s(), 0.0, 3600.0);
  const double whole_s = std::floor(left_s);
  const timespec left{static_cast<time_t>(whole_s), static_cast<long>((left_s - whole_s) * 1e9)};
  pollfd polled{descriptor, what, 0};
  ::ppoll(&polled, 1, &left, nullptr);
}

bool is_patience(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

Result<SerialPort> SerialPort::open(const std::string& path, int baud) {
  const std::optional<speed_t> speed = speed_of(baud);
  if (!speed) {
    return Fault{"serial.baud", path, std::to_string(baud) + " baud is no rate of a serial port", "115200 is usual"};
  }
  SerialPort port(path, ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  const int fd = port.descriptor_;
  if (fd < 0) return open_fault(path, errno);
  // Neither is known everywhere, and a port that knows neither is as good; only "taken" counts.
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return open_fault(path, EBUSY);
  (void)::ioctl(fd, TIOCEXCL);
  if (!make_raw(fd, *speed)) return open_fault(path, errno);
  port.discard_input();
  return port;
}

SerialPort::SerialPort(SerialPort&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

SerialPort& SerialPort::operator=(SerialPort&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

SerialPort::~SerialPort() {
  if (descriptor_ < 0) return;
  (void)::ioctl(descriptor_, TIOCNXCL);
  ::close(descriptor_);
}

Status SerialPort::write_all(std::span<const std::uint8_t> bytes, double deadline_s) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(descriptor_, bytes.data(), bytes.size());
    if (sent < 0 && !is_patience(errno)) return gone(errno);
    if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
    if (bytes.empty()) break;
    if (monotonic_s() >= deadline_s) {
      return Fault{"serial.timeout", path_, "the port does not take what is sent", "unplug the device and plug it in"};
    }
    await(descriptor_, POLLOUT, deadline_s);
  }
  return {};
}

Status SerialPort::write_all(std::string_view text, double deadline_s) {
  return write_all(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), deadline_s);
}

Result<std::size_t> SerialPort::read_some(std::span<std::uint8_t> buffer, double deadline_s) {
  for (;;) {
    const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
    if (got > 0 || buffer.empty()) return static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    if (got == 0 || !is_patience(errno)) return gone(got == 0 ? EIO : errno);
    if (monotonic_s() >= deadline_s) return std::size_t{0};
    await(descriptor_, POLLIN, deadline_s);
  }
}

void SerialPort::discard_input() { (void)::tcflush(descriptor_, TCIFLUSH); }

Fault SerialPort::gone(int error) const {
  return {"serial.gone", path_, "the port is gone: " + words_for(error), "plug the device in again"};
}

}  // namespace focalstage
