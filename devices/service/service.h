#pragma once

#include <memory>

#include "devices/runtime/runtime.h"
#include "devices/service/http_responder.h"
#include "devices/service/osc_desk.h"
#include "devices/service/service_manager.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// The runtime and all that stands around it: what a gallery needs to leave it alone.
class Service {
 public:
  /// Faults of the runtime and of the addresses in the file.
  static Result<std::unique_ptr<Service>> start(const RigConfig& config, const RuntimeOptions& options,
                                                ServiceManager manager = {});
  ~Service();

  const Runtime& runtime() const { return runtime_; }
  /// Where metrics are; empty where the file asks for none.
  std::string metrics_address() const { return metrics_ ? metrics_->address() : std::string(); }
  /// Where a control desk is heard; empty where the file asks for none.
  std::string osc_address() const { return osc_ ? osc_->address() : std::string(); }

 private:
  Service(Runtime runtime, ServiceManager manager);
  Status begin(const RigConfig& config);

  Runtime runtime_;
  std::unique_ptr<HttpResponder> metrics_;
  std::unique_ptr<OscDesk> osc_;
  ServiceManager manager_;  ///< asks the runtime: gone before it
};

}  // namespace focalstage
