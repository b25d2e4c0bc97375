#include "devices/runtime/runtime.h"

#include <utility>

#include "devices/roles/clock.h"
#include "devices/runtime/rig_service.h"
#include "devices/runtime/server.h"
#include "io/models/models.h"

namespace focalstage {

namespace {

/// How long a pose may take to become light before it is measured: the sweeps that are handed over ahead, at 60 Hz, and
/// a compile.
double guessed_lead_s(const RigThreadSettings& rig) { return rig.sweeps_ahead / 60.0 + 0.02; }

}  // namespace

struct Runtime::State {
  State(const RuntimeOptions& options, std::unique_ptr<ShowStore> shows, std::unique_ptr<AssetStore> blobs,
        std::unique_ptr<MeasuredValues> values)
      : store(std::move(shows)),
        assets(std::move(blobs)),
        measured(std::move(values)),
        frames(options.store),
        desk(options.lease),
        rig(options.rig),
        guard(options.network, options.clients),
        tracking(options.tracker.tracker
                     ? std::make_unique<LiveTracking>(options.tracker, guessed_lead_s(options.rig),
                                                      [this](const Fault& fault) { rig.doubt_what_plays(fault); })
                     : nullptr),
        service(options.rig, *store, *assets, frames, rig, desk, guard, options.drivers,
                options.network.push_bytes_per_s, tracking.get(), *measured) {}

  std::unique_ptr<ShowStore> store;  // holds the folder's lock
  std::unique_ptr<AssetStore> assets;
  std::unique_ptr<MeasuredValues> measured;
  LiveFrames frames;
  LeaseDesk desk;
  RigThread rig;
  Guard guard;
  std::unique_ptr<LiveTracking> tracking;
  RigService service;
  std::unique_ptr<RigServer> server;
};

namespace {

constexpr double most_silent_s = 2.0;

}  // namespace

Result<Runtime> Runtime::start(const RuntimeOptions& asked) {
  if (Status may = may_listen(asked.listen, asked.network); !may) return may.fault();
  auto models = known_models();
  if (!models) return models.fault();
  RuntimeOptions options = asked;
  options.rig.models = *std::move(models);
  Result<std::unique_ptr<ShowStore>> store = ShowStore::open(options.store);
  if (!store) return store.fault();
  Result<std::unique_ptr<AssetStore>> assets = AssetStore::open(options.store);
  if (!assets) return assets.fault();
  Result<std::unique_ptr<MeasuredValues>> measured = MeasuredValues::open(
      options.store, [rig = options.rig](double hz) { return rig.rig.describe(rig.limits, hz); },
      options.rig.rig.lenses_share_drive);
  if (!measured) return measured.fault();
  auto state = std::make_unique<State>(options, std::move(*store), std::move(*assets), std::move(*measured));
  if (state->tracking) {
    if (Status started = state->tracking->start(); !started) return started.fault();
  }
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
