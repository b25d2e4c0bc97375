#pragma once

#include <grpcpp/support/status.h>

#include "core/base/result.h"
#include "focalstage/v1/rig.pb.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

v1::RigDescription message_from(const RigDescription& rig);
RigDescription description_from(const v1::RigDescription& message);

v1::RigMeasurement message_from(const RigMeasurement& measurement);
RigMeasurement measurement_from(const v1::RigMeasurement& message);

v1::RigState message_from(const RigState& state);
RigState state_from(const v1::RigState& message);

v1::DeviceList message_from(const DeviceListing& listing);
DeviceListing listing_from(const v1::DeviceList& message);

v1::Fault message_from(const Fault& fault);
Fault fault_from(const v1::Fault& message);

/// The fault as a status of the call, and back. A status that carries no fault of ours (the connection broke, the
/// deadline passed) becomes "rig.unreachable".
grpc::Status status_from(const Fault& fault);
Fault fault_from(const grpc::Status& status, const std::string& address);

}  // namespace focalstage
