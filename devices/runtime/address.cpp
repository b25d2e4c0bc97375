#include "devices/runtime/address.h"

#include <charconv>

namespace focalstage {

Result<HostPort> host_port(const std::string& listen) {
  const Fault fault{"runtime.address", listen, "this is not HOST:PORT", "listen on 127.0.0.1:50371"};
  const std::size_t colon = listen.rfind(':');
  if (colon == std::string::npos || colon == 0) return fault;
  HostPort address{listen.substr(0, colon), -1};
  const char* const end = listen.data() + listen.size();
  const auto [read, error] = std::from_chars(listen.data() + colon + 1, end, address.port);
  if (error != std::errc() || read != end || address.port < 0 || address.port > 65535) return fault;
  if (address.host.front() == '[' && address.host.back() == ']') {
    address.host = address.host.substr(1, address.host.size() - 2);
  } else if (address.host.find(':') != std::string::npos) {
    return fault;
  }
  if (address.host.empty()) return fault;
  if (address.host == "localhost") address.host = "127.0.0.1";
  return address;
}

bool is_loopback(const HostPort& address) { return address.host == "127.0.0.1" || address.host == "::1"; }

std::string text_of(const HostPort& address) {
  const bool v6 = address.host.find(':') != std::string::npos;
  return (v6 ? "[" + address.host + "]" : address.host) + ":" + std::to_string(address.port);
}

Result<std::string> loopback_address(const std::string& listen) {
  const Result<HostPort> address = host_port(listen);
  if (!address) return address.fault();
  if (is_loopback(*address)) return text_of(*address);
  return Fault{"runtime.not-loopback", listen, "this is reached from its own machine only", "listen on 127.0.0.1"};
}

}  // namespace focalstage
