#pragma once

#include <string>

#include "core/base/result.h"
#include "devices/runtime/address.h"

namespace focalstage {

struct BoundSocket {
  int descriptor = -1;
  std::string address;  ///< with the port it got
};

/// A socket bound to a numeric address, listening where `type` is SOCK_STREAM; the caller closes it.
/// "runtime.address", "runtime.address-in-use".
Result<BoundSocket> bind_socket(const HostPort& address, int type);

}  // namespace focalstage
