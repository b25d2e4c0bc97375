#pragma once

#include <string>

#include "core/base/result.h"

namespace focalstage {

struct HostPort {
  std::string host;  ///< an IPv6 address without its brackets
  int port = 0;
};

/// "HOST:PORT", with an IPv6 address in brackets. "runtime.address".
Result<HostPort> host_port(const std::string& listen);

/// Only this machine reaches it: localhost, 127.0.0.1, ::1.
bool is_loopback(const HostPort& address);

/// The other way round.
std::string text_of(const HostPort& address);

/// Host and port of an address that only this machine can reach; else "runtime.not-loopback".
Result<std::string> loopback_address(const std::string& listen);

}  // namespace focalstage
