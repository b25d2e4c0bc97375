#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "devices/runtime/admission.h"
#include "devices/runtime/asset_store.h"
#include "devices/runtime/lease.h"
#include "devices/runtime/live_arrivals.h"
#include "devices/runtime/live_frames.h"
#include "devices/runtime/live_outbox.h"
#include "devices/runtime/live_thread.h"
#include "devices/runtime/rig_thread.h"
#include "focalstage/v1/rig.grpc.pb.h"

namespace focalstage {

/// What a live link works on.
struct LiveBench {
  RigThread& rig;
  LeaseDesk& desk;
  AssetStore& assets;
  LiveTracking* tracking;  ///< null: no tracker
  LiveFrames& frames;
  RigTerms terms;
  RigClock clock = RigClock::real_time;
  std::function<v1::RigState()> state;
  const std::atomic<bool>& stopping;
};

/// One live link, from its first message to its end. Reading has a thread of its own and never waits for anything but
/// the editor: what takes time (hashes, meshes, compiling) happens in the LiveThread, what is said in the writer.
class LiveSession {
 public:
  using Stream = grpc::ServerReaderWriter<v1::LiveReply, v1::LiveRequest>;

  LiveSession(LiveBench& bench, grpc::ServerContext& context, Stream& stream)
      : bench_(bench), context_(context), stream_(stream), outbox_(std::make_shared<LiveOutbox>()) {}

  grpc::Status run(const v1::LiveBegin& begin);

 private:
  enum class End { said, broken };

  Result<End> listen(const std::string& token, const std::function<void()>& heard, LiveThread& thread);
  Status take(const v1::LiveRequest& request, LiveThread& thread);
  Status take(const v1::LiveProject& message, double received_s, LiveThread& thread);
  Status take(const v1::LiveEdits& message, double received_s, LiveThread& thread);
  Status take(const v1::LiveChunk& message, LiveThread& thread);
  Result<std::vector<LiveFile>> expect(const google::protobuf::RepeatedPtrField<v1::LiveAsset>& assets,
                                       v1::LiveWanted& wanted, LiveThread& thread);
  void ask_for(v1::LiveWanted wanted);
  void present(const LiveSnapshot& snapshot, LiveMade made, bool share);
  void write();

  LiveBench& bench_;
  grpc::ServerContext& context_;
  Stream& stream_;
  std::shared_ptr<LiveOutbox> outbox_;  ///< outlives the link in the shows that it made
  LiveArrivals arrivals_;
  std::shared_ptr<std::atomic<bool>> appeared_;  ///< whether the newest revision was said to be in light
};

}  // namespace focalstage
