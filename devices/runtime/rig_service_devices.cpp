#include "devices/runtime/rig_service.h"

// The calls of RigService that go to drivers, which may take their time: the rig's thread knows nothing of them.

namespace focalstage {

namespace {

Fault drivers_busy() { return {"rig.busy", "drivers", "somebody else is asking for devices", "ask again in a moment"}; }

}  // namespace

grpc::Status RigService::ListDevices(grpc::ServerContext* context, const v1::ListDevicesRequest*,
                                     v1::DeviceList* reply) {
  if (Status may = guard_.admit(*context, Right::watch); !may) return refused("devices", may.fault());
  const std::unique_lock alone(asking_drivers_, std::try_to_lock);
  if (!alone) return refused("devices", drivers_busy());
  DeviceListing listing;
  for (const auto& [name, driver] : drivers_) {
    const auto found = driver.probe();
    if (!found) {
      listing.failures.push_back({name, found.fault()});
      continue;
    }
    for (const DeviceId& id : *found) listing.devices.push_back({name, id.model, id.serial, id.address});
  }
  *reply = message_from(listing);
  return grpc::Status::OK;
}

grpc::Status RigService::Identify(grpc::ServerContext* context, const v1::IdentifyRequest* request,
                                  v1::IdentifyReply*) {
  if (Status may = guard_.admit(*context, Right::control); !may) return refused("identify", may.fault());
  if (Status mine = desk_.use(request->token()); !mine) return status_from(mine.fault());
  const auto driver = drivers_.find(request->driver());
  if (driver == drivers_.end()) {
    return refused("identify", {"rig.request", request->driver(), "this rig has no such driver",
                                "choose one that focalstage devices lists"});
  }
  const std::string now = rig_.state().state;
  if (now == "playing" || now == "holding") {
    return refused("identify", {"rig.refused", request->driver(), "the rig is " + now, "black it out first"});
  }
  const std::unique_lock alone(asking_drivers_, std::try_to_lock);
  if (!alone) return refused("identify", drivers_busy());
  if (Status shown = driver->second.identify(request->serial()); !shown) return refused("identify", shown.fault());
  return grpc::Status::OK;
}

}  // namespace focalstage
