#include "io/protocol/client.h"
#include "io/protocol/connection.h"

namespace focalstage {

Result<RigMeasurement> RigClient::self_test(const SelfTestAsked& asked,
                                            const std::function<void(const std::string& doing, double share)>& seen,
                                            std::stop_token stop) {
  const Result<std::string> token = connection_->token();
  if (!token) return token.fault();
  v1::SelfTestRequest request;
  request.set_token(*token);
  request.set_frequency_hz(asked.frequency_hz);
  request.set_harmonics(asked.harmonics);
  request.set_dry_run(asked.dry_run);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::hours(2));
  const std::stop_callback on_stop(stop, [&] { context.TryCancel(); });
  const auto reader = connection_->stub().SelfTest(&context, request);
  std::optional<RigMeasurement> measured;
  v1::SelfTestReply reply;
  while (reader->Read(&reply)) {
    if (reply.has_step() && seen) seen(reply.step().doing(), reply.step().share());
    if (reply.has_measurement()) measured = measurement_from(reply.measurement());
  }
  const grpc::Status status = reader->Finish();
  if (stop.stop_requested()) {
    return Fault{"rig.cancelled", connection_->address(), "the self-test was stopped", "the rig is dark: say go"};
  }
  if (!status.ok()) {
    Fault fault = fault_from(status, connection_->address());
    if (fault.code == "rig.lease") connection_->forget(*token);
    return fault;
  }
  if (measured) return *measured;
  return Fault{"rig.refused", connection_->address(), "the rig ended its self-test without a result",
               "look at the rig's log"};
}

}  // namespace focalstage
