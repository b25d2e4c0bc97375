#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "io/credentials/credentials.h"

namespace focalstage {

/// Why no connection comes about: tries a TLS handshake of its own, because gRPC only says that it failed.
/// "rig.unreachable" (nobody there), "rig.unpaired" (it wants a certificate, and there is none here), "rig.certificate"
/// (expired, of another authority, for another host, or refused by the rig).
Fault diagnose_connection(const std::string& host_port, const std::optional<Credentials>& credentials,
                          std::chrono::milliseconds patience);

}  // namespace focalstage
