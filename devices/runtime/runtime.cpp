#include "devices/runtime/runtime.h"

#include <utility>

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include "devices/roles/clock.h"
#include "devices/runtime/rig_service.h"
#include "io/protocol/limits.h"

namespace focalstage {

struct Runtime::State {
  State(const RuntimeOptions& options, std::unique_ptr<ShowStore> shows, std::unique_ptr<AssetStore> blobs)
      : store(std::move(shows)),
        assets(std::move(blobs)),
        frames(options.store),
        desk(options.lease),
        rig(options.rig),
        service(options.rig, *store, *assets, frames, rig, desk) {}

  std::unique_ptr<ShowStore> store;  // holds the folder's lock
  std::unique_ptr<AssetStore> assets;
  LiveFrames frames;
  LeaseDesk desk;
  RigThread rig;
  RigService service;
  std::unique_ptr<grpc::Server> server;
  std::string address;
};

namespace {

constexpr double most_silent_s = 2.0;

/// Builds a server that takes its port for itself: a second runtime on it is an error, not a sharer.
std::unique_ptr<grpc::Server> build_server(const std::string& address, grpc::Service& service, int& port) {
  silence_grpc();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.SetMaxReceiveMessageSize(message_limit_bytes);
  builder.SetMaxSendMessageSize(message_limit_bytes);
  builder.AddListeningPort(address, grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&service);
  return builder.BuildAndStart();
}

}  // namespace

Result<Runtime> Runtime::start(const RuntimeOptions& options) {
  const Result<std::string> address = loopback_address(options.listen);
  if (!address) return address.fault();
  Result<std::unique_ptr<ShowStore>> store = ShowStore::open(options.store);
  if (!store) return store.fault();
  Result<std::unique_ptr<AssetStore>> assets = AssetStore::open(options.store);
  if (!assets) return assets.fault();
  auto state = std::make_unique<State>(options, std::move(*store), std::move(*assets));
  int port = 0;
  state->server = build_server(*address, state->service, port);
  if (!state->server || port == 0) {
    return Fault{"runtime.address-in-use", *address, "another program listens there, or this address can't be had",
                 "stop the other runtime, or choose another --listen"};
  }
  state->address = address->substr(0, address->rfind(':') + 1) + std::to_string(port);
  return Runtime(std::move(state));
}

Runtime::Runtime(std::unique_ptr<State> state) : state_(std::move(state)) {}
Runtime::Runtime(Runtime&&) noexcept = default;
Runtime& Runtime::operator=(Runtime&&) noexcept = default;

Runtime::~Runtime() {
  if (!state_) return;
  state_->rig.blackout();
  state_->service.stop();
  if (state_->server) state_->server->Shutdown(std::chrono::system_clock::now() + std::chrono::milliseconds(200));
}

const std::string& Runtime::address() const { return state_->address; }

RuntimeFigures Runtime::figures() const { return state_->service.figures(); }

Status Runtime::operate(const DeskCommand& command, bool despite_lease) const {
  return state_->service.operate(command, despite_lease);
}

bool Runtime::keeps_time() const { return monotonic_s() - state_->rig.last_beat_s() < most_silent_s; }

}  // namespace focalstage
