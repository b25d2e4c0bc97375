#include "tests/devices/plugin/emulator/wire_talk.h"

#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace focalstage::wire_emulator {

int listen_at(const std::string& path, int flags) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return -1;
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  ::unlink(path.c_str());
  const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | flags, 0);
  if (listener < 0) return -1;
  const bool bound = ::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (bound && ::listen(listener, 4) == 0) return listener;
  const int why = errno;
  ::close(listener);
  errno = why;
  return -1;
}

WireReader::Got WireReader::receive(int connection) {
  if (in_body_) {
    const Got got = fill(connection, body_, Got::message);
    in_body_ = got != Got::message;
    return got;
  }
  const Got got = fill(connection, {reinterpret_cast<std::uint8_t*>(&header_), sizeof header_}, Got::header);
  if (got == Got::header) {
    body_.resize(header_.bytes);
    in_body_ = true;
  }
  return got;
}

WireReader::Got WireReader::fill(int connection, std::span<std::uint8_t> bytes, Got whole) {
  while (filled_ < bytes.size()) {
    const ssize_t got = ::recv(connection, bytes.data() + filled_, bytes.size() - filled_, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return Got::nothing;
    if (got <= 0) return Got::end;
    filled_ += static_cast<std::size_t>(got);
  }
  filled_ = 0;
  return whole;
}

}  // namespace focalstage::wire_emulator
