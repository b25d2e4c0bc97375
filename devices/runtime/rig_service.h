#pragma once

#include <atomic>
#include <mutex>
#include <utility>

#include "devices/catalog/device_drivers.h"
#include "devices/runtime/admission.h"
#include "devices/runtime/asset_store.h"
#include "devices/runtime/desk_command.h"
#include "devices/runtime/figures.h"
#include "devices/runtime/guard.h"
#include "devices/runtime/lease.h"
#include "devices/runtime/live_frames.h"
#include "devices/runtime/live_tracking.h"
#include "devices/runtime/measured_values.h"
#include "devices/runtime/rig_thread.h"
#include "devices/runtime/show_store.h"
#include "focalstage/v1/rig.grpc.pb.h"
#include "io/protocol/convert.h"

namespace focalstage {

/// The calls of rig.proto, each turned into one step of store, lease or rig.
class RigService final : public v1::Rig::Service {
 public:
  RigService(const RigThreadSettings& settings, ShowStore& store, AssetStore& assets, LiveFrames& frames,
             RigThread& rig, LeaseDesk& desk, Guard& guard, DeviceDrivers drivers, double push_bytes_per_s,
             LiveTracking* tracking, MeasuredValues& measured)
      : settings_(settings),
        store_(store),
        assets_(assets),
        frames_(frames),
        rig_(rig),
        desk_(desk),
        guard_(guard),
        drivers_(std::move(drivers)),
        push_pace_(push_bytes_per_s, push_bytes_per_s),
        tracking_(tracking),
        measured_(measured) {}

  /// Ends all watching and live links, so that the server can go.
  void stop() { stopping_ = true; }

  RuntimeFigures figures() const;

  /// A command from beside the protocol. "rig.held" while an editor holds the rig, unless `despite_lease`; blackout
  /// always.
  Status operate(const DeskCommand& command, bool despite_lease);

  grpc::Status Describe(grpc::ServerContext*, const v1::DescribeRequest*, v1::RigDescription*) override;
  grpc::Status Acquire(grpc::ServerContext*, const v1::AcquireRequest*, v1::Lease*) override;
  grpc::Status Release(grpc::ServerContext*, const v1::ReleaseRequest*, v1::ReleaseReply*) override;
  grpc::Status BeginPush(grpc::ServerContext*, const v1::BeginPushRequest*, v1::PushProgress*) override;
  grpc::Status PushChunk(grpc::ServerContext*, const v1::PushChunkRequest*, v1::PushProgress*) override;
  grpc::Status FinishPush(grpc::ServerContext*, const v1::FinishPushRequest*, v1::PushVerified*) override;
  grpc::Status Activate(grpc::ServerContext*, const v1::ActivateRequest*, v1::RigState*) override;
  grpc::Status Play(grpc::ServerContext*, const v1::PlayRequest*, v1::RigState*) override;
  grpc::Status Hold(grpc::ServerContext*, const v1::HoldRequest*, v1::RigState*) override;
  grpc::Status Cue(grpc::ServerContext*, const v1::CueRequest*, v1::RigState*) override;
  grpc::Status Next(grpc::ServerContext*, const v1::NextRequest*, v1::RigState*) override;
  grpc::Status Back(grpc::ServerContext*, const v1::BackRequest*, v1::RigState*) override;
  grpc::Status Go(grpc::ServerContext*, const v1::GoRequest*, v1::RigState*) override;
  grpc::Status Blackout(grpc::ServerContext*, const v1::BlackoutRequest*, v1::RigState*) override;
  grpc::Status ListDevices(grpc::ServerContext*, const v1::ListDevicesRequest*, v1::DeviceList*) override;
  grpc::Status Identify(grpc::ServerContext*, const v1::IdentifyRequest*, v1::IdentifyReply*) override;
  grpc::Status SelfTest(grpc::ServerContext*, const v1::SelfTestRequest*,
                        grpc::ServerWriter<v1::SelfTestReply>*) override;
  grpc::Status GetState(grpc::ServerContext*, const v1::GetStateRequest*, v1::RigState*) override;
  grpc::Status Watch(grpc::ServerContext*, const v1::WatchRequest*, grpc::ServerWriter<v1::RigState>*) override;
  grpc::Status Live(grpc::ServerContext*, grpc::ServerReaderWriter<v1::LiveReply, v1::LiveRequest>*) override;

 private:
  RigState values() const;
  v1::RigState state() const { return message_from(values()); }
  grpc::Status refused(const char* call, const Fault& fault);
  RigTerms terms() const;
  Status not_measuring() const;
  void keep_pace(const grpc::ServerContext& context, std::size_t bytes);
  template <class Step>
  grpc::Status held(const grpc::ServerContext* context, const std::string& token, v1::RigState* reply, Step step);

  RigThreadSettings settings_;
  ShowStore& store_;
  AssetStore& assets_;
  LiveFrames& frames_;
  RigThread& rig_;
  LeaseDesk& desk_;
  Guard& guard_;
  DeviceDrivers drivers_;
  std::mutex asking_drivers_;
  RateLimit push_pace_;
  LiveTracking* tracking_;  ///< null: no tracker
  MeasuredValues& measured_;
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> live_ = false;
  std::atomic<bool> measuring_ = false;
  std::atomic<int> watchers_ = 0;
  std::atomic<std::uint64_t> push_bytes_ = 0;
  FaultTally refusals_;
};

}  // namespace focalstage
