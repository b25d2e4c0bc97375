#include <algorithm>
#include <cmath>

#include <spdlog/spdlog.h>

#include "devices/runtime/rig_service.h"
#include "devices/runtime/self_test.h"

// The call of RigService by which the rig measures itself.

namespace focalstage {

namespace {

SelfTestSettings settings_of(const v1::SelfTestRequest& request) {
  SelfTestSettings settings;
  const double asked_hz = request.frequency_hz();
  if (asked_hz != 0.0) settings.frequency_hz = asked_hz;
  if (request.harmonics() != 0) settings.harmonics = request.harmonics();
  return settings;
}

Status check(const SelfTestSettings& settings) {
  if (!(settings.frequency_hz >= 44.0 && settings.frequency_hz <= 125.0)) {
    return Fault{"rig.request", "frequency_hz", "a rig sweeps between 44 and 125 Hz", "ask for 60"};
  }
  if (settings.harmonics < 1 || settings.harmonics > 24) {
    return Fault{"rig.request", "harmonics", "1 to 24 of a lens can be measured", "ask for 4"};
  }
  return {};
}

Fault busy(const char* with) {
  return {"rig.refused", "rig", std::string("it is busy with ") + with, "end that, or wait for it"};
}

/// True for whoever set it first, until it goes.
class Alone {
 public:
  explicit Alone(std::atomic<bool>& taken) : taken_(taken), mine_(!taken.exchange(true)) {}
  ~Alone() {
    if (mine_) taken_ = false;
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

  bool mine() const { return mine_; }

 private:
  std::atomic<bool>& taken_;
  bool mine_;
};

}  // namespace

Status RigService::not_measuring() const {
  if (!measuring_) return {};
  return busy("measuring itself");
}

grpc::Status RigService::SelfTest(grpc::ServerContext* context, const v1::SelfTestRequest* request,
                                  grpc::ServerWriter<v1::SelfTestReply>* writer) {
  if (Status may = guard_.admit(*context, Right::control); !may) return refused("self-test", may.fault());
  if (Status mine = desk_.use(request->token()); !mine) return status_from(mine.fault());
  const SelfTestSettings settings = settings_of(*request);
  if (Status sound = check(settings); !sound) return refused("self-test", sound.fault());
  if (!settings_.rig.light_sensor) return refused("self-test", no_light_sensor());
  const Alone alone(measuring_);
  if (!alone.mine()) return refused("self-test", busy("measuring itself"));
  if (live_) return refused("self-test", busy("a live link"));
  spdlog::info("the rig measures itself, for {}", desk_.holder());
  const auto may_go_on = [&]() -> Status {
    if (stopping_ || context->IsCancelled()) {
      return Fault{"rig.cancelled", "self-test", "whoever asked for it is gone", "ask again"};
    }
    return desk_.use(request->token());
  };
  const auto tell = [&](const std::string& doing, double share) {
    v1::SelfTestReply reply;
    reply.mutable_step()->set_doing(doing);
    reply.mutable_step()->set_share(share);
    writer->Write(reply);
  };
  const Result<RigMeasurement> measured =
      focalstage::SelfTest(rig_, settings_.rig, settings_.limits, settings, may_go_on, tell).run();
  if (!measured) return refused("self-test", measured.fault());
  if (!request->dry_run()) {
    if (Status kept = measured_.keep(*measured); !kept) return refused("self-test", kept.fault());
  }
  spdlog::info("the rig has measured itself");
  v1::SelfTestReply reply;
  *reply.mutable_measurement() = message_from(*measured);
  writer->Write(reply);
  return grpc::Status::OK;
}

}  // namespace focalstage
