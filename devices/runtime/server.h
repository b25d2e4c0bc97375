#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "devices/runtime/address.h"
#include "devices/runtime/doorman.h"
#include "io/credentials/credentials.h"
#include "io/rig_config/rig_config.h"

namespace grpc {
class Server;
class Service;
}  // namespace grpc

namespace focalstage {

/// "runtime.address" where that is none; "runtime.not-loopback" where it lies beyond loopback and there are no
/// certificates.
Status may_listen(const std::string& listen, const NetworkConfig& network);

/// The gRPC server of a runtime, behind its doorman.
class RigServer {
 public:
  /// Beyond loopback only with certificates: "runtime.not-loopback"; "runtime.address", "runtime.address-in-use",
  /// "credentials.*".
  static Result<std::unique_ptr<RigServer>> start(const std::string& listen, const NetworkConfig& network,
                                                  grpc::Service& service);
  ~RigServer();  ///< calls that do not end by themselves are ended

  const std::string& address() const { return address_; }
  const Doorman& doorman() const { return *doorman_; }

 private:
  RigServer() = default;

  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<Doorman> doorman_;
  std::string address_;
};

}  // namespace focalstage
