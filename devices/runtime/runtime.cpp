#include "devices/runtime/runtime.h"

#include <utility>

#include "devices/roles/clock.h"
#include "devices/runtime/rig_service.h"
#include "devices/runtime/server.h"

namespace focalstage {

struct Runtime::State {
  State(const RuntimeOptions& options, std::unique_ptr<ShowStore> shows, std::unique_ptr<AssetStore> blobs)
      : store(std::move(shows)),
        assets(std::move(blobs)),
        frames(options.store),
        desk(options.lease),
        rig(options.rig),
        guard(options.network, options.clients),
        service(options.rig, *store, *assets, frames, rig, desk, guard, options.network.push_bytes_per_s) {}

  std::unique_ptr<ShowStore> store;  // holds the folder's lock
  std::unique_ptr<AssetStore> assets;
  LiveFrames frames;
  LeaseDesk desk;
  RigThread rig;
  Guard guard;
  RigService service;
  std::unique_ptr<RigServer> server;
};

namespace {

constexpr double most_silent_s = 2.0;

}  // namespace

Result<Runtime> Runtime::start(const RuntimeOptions& options) {
  if (const Result<HostPort> address = host_port(options.listen); !address) return address.fault();
  Result<std::unique_ptr<ShowStore>> store = ShowStore::open(options.store);
  if (!store) return store.fault();
  Result<std::unique_ptr<AssetStore>> assets = AssetStore::open(options.store);
  if (!assets) return assets.fault();
  auto state = std::make_unique<State>(options, std::move(*store), std::move(*assets));
  auto server = RigServer::start(options.listen, options.network, state->service);
  if (!server) return server.fault();
  state->server = std::move(*server);
  return Runtime(std::move(state));
}

Runtime::Runtime(std::unique_ptr<State> state) : state_(std::move(state)) {}
Runtime::Runtime(Runtime&&) noexcept = default;
Runtime& Runtime::operator=(Runtime&&) noexcept = default;

Runtime::~Runtime() {
  if (!state_) return;
  state_->rig.blackout();
  state_->service.stop();
  state_->server.reset();
}

const std::string& Runtime::address() const { return state_->server->address(); }

RuntimeFigures Runtime::figures() const {
  RuntimeFigures figures = state_->service.figures();
  figures.connections = state_->server->doorman().connections();
  figures.turned_away = state_->server->doorman().turned_away();
  return figures;
}

Status Runtime::operate(const DeskCommand& command, bool despite_lease) const {
  return state_->service.operate(command, despite_lease);
}

bool Runtime::keeps_time() const { return monotonic_s() - state_->rig.last_beat_s() < most_silent_s; }

}  // namespace focalstage
