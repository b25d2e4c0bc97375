#include "devices/runtime/runtime.h"

#include <charconv>
#include <utility>

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include "devices/runtime/rig_service.h"
#include "io/protocol/limits.h"

namespace focalstage {

namespace {

/// How long a pose may take to become light before it is measured: the sweeps that are handed over ahead, at 60 Hz, and
/// a compile.
double guessed_lead_s(const RigThreadSettings& rig) { return rig.sweeps_ahead / 60.0 + 0.02; }

}  // namespace

struct Runtime::State {
  State(const RuntimeOptions& options, std::unique_ptr<ShowStore> shows, std::unique_ptr<AssetStore> blobs)
      : store(std::move(shows)),
        assets(std::move(blobs)),
        frames(options.store),
        desk(options.lease),
        rig(options.rig),
        tracking(options.tracker.tracker
                     ? std::make_unique<LiveTracking>(options.tracker, guessed_lead_s(options.rig),
                                                      [this](const Fault& fault) { rig.doubt_what_plays(fault); })
                     : nullptr),
        service(options.rig, *store, *assets, frames, rig, desk, tracking.get()) {}

  std::unique_ptr<ShowStore> store;  // holds the folder's lock
  std::unique_ptr<AssetStore> assets;
  LiveFrames frames;
  LeaseDesk desk;
  RigThread rig;
  std::unique_ptr<LiveTracking> tracking;
  RigService service;
  std::unique_ptr<grpc::Server> server;
  std::string address;
};

Result<std::string> loopback_address(const std::string& listen) {
  const std::size_t colon = listen.rfind(':');
  const std::string host = colon == std::string::npos ? listen : listen.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
  int number = -1;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || number < 0 || number > 65535) {
    return Fault{"runtime.address", listen, "this is not HOST:PORT", "listen on 127.0.0.1:50371"};
  }
  if (host == "localhost") return "127.0.0.1:" + port;
  if (host == "127.0.0.1" || host == "[::1]") return host + ":" + port;
  return Fault{"runtime.not-loopback", listen, "without certificates a rig is reached from its own machine only",
               "listen on 127.0.0.1"};
}

namespace {

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
  if (state->tracking) {
    if (Status started = state->tracking->start(); !started) return started.fault();
  }
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

}  // namespace focalstage
