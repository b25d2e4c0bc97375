#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/runtime/rate_limit.h"
#include "io/rig_config/rig_config.h"

namespace grpc {
class ServerContext;
}

namespace focalstage {

enum class Right { watch, push, control };

/// Asks each call who it comes from. Without certificates (on loopback alone) everybody may do everything; with them a
/// client may do what the configuration says of it, so many calls a second.
class Guard {
 public:
  Guard(const NetworkConfig& network, std::vector<ClientConfig> clients);

  /// "rig.unauthorised" names client and right; "rig.busy" where it calls too often. `counts`: against the rate.
  Status admit(const grpc::ServerContext& context, Right right, bool counts = true);

  /// The rights of a client by its certificate: of the first entry that it matches.
  Rights rights_of(const std::string& name, const std::string& fingerprint) const;

 private:
  bool in_time(const std::string& fingerprint);

  bool everybody_;
  double calls_per_s_;
  std::vector<ClientConfig> clients_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<RateLimit>> rates_;  ///< by fingerprint, of clients that are listed
};

}  // namespace focalstage
