#include "devices/rig/device_rig.h"

#include <chrono>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr std::chrono::milliseconds between_steps{1};

Fault going_dark(const std::string& name) {
  return {"rig.device", name, "it is still being made dark", "say go again in a moment"};
}

Fault own_time() {
  return {"rig.device", "projector", "it keeps its own time, and the lens drive cannot follow it",
          "use a projector that waits for triggers, or the lens drive mcc1208"};
}

bool is_master(const RigDevices& devices) { return devices.projector->abilities().pacing == Pacing::master; }

}  // namespace

DeviceRig::DeviceRig(RigDevices devices, const DeviceRigSettings& settings)
    : settings_(settings),
      devices_(std::move(devices)),
      settle_sweeps_(is_master(devices_) ? settings.following_sweeps : settings.settle_sweeps),
      projector_("projector", devices_.projector, [this] { return devices_.projector->dark(); }),
      board_("trigger board", devices_.board, [this] { return devices_.board->dark(); }),
      lens_("lens drive", devices_.lens, [this] { return stop_lens(); }),
      leader_([this](const std::stop_token& stop) { lead(stop); }) {}

DeviceRig::~DeviceRig() {
  leader_.request_stop();
  leader_.join();
  darken(std::nullopt);  // in its order: the hands end one after the other
}

/// After the light: what is still shown while the lenses go to rest would stand at a wrong depth.
bool DeviceRig::stop_lens() {
  for (const double until_s = monotonic_s() + settings_.light_goes_first_s; monotonic_s() < until_s;) {
    if (projector_.settled() && board_.settled()) break;
    std::this_thread::sleep_for(between_steps);
  }
  return devices_.lens->stop();
}

/// The sweep before is whole once the next one's images come.
void DeviceRig::post_images(std::vector<Picture> pictures) {
  hand_on();
  gatherer_.post_images(std::move(pictures));
}

void DeviceRig::run_until(double) { hand_on(); }

void DeviceRig::hand_on() {
  std::optional<HandedSweep> sweep = gatherer_.take();
  if (!sweep) return;
  const std::lock_guard lock(mutex_);
  if (!doubt_) handed_.push_back(std::move(*sweep));
}

void DeviceRig::dark(double) {
  gatherer_.forget();
  darken(std::nullopt);
}

void DeviceRig::darken(const std::optional<Fault>& doubt) {
  const std::lock_guard lock(mutex_);
  ++darkness_;
  handed_.clear();
  if (!doubt_) doubt_ = doubt;
  for (DeviceHand* hand : {&projector_, &board_, &lens_}) hand->darken();
}

Status DeviceRig::ready() {
  for (DeviceHand* hand : {&projector_, &board_, &lens_}) {
    if (!hand->settled()) return going_dark(hand->name());
    if (Status fit = hand->fit(); !fit) return fit;
  }
  if (is_master(devices_) && !devices_.lens->abilities().steers) return own_time();
  const std::lock_guard lock(mutex_);
  doubt_.reset();
  return {};
}

double DeviceRig::edge_near_s(double planned_s) const { return focalstage::edge_near_s(devices_, planned_s); }

std::optional<Fault> DeviceRig::doubt() const {
  const std::lock_guard lock(mutex_);
  return doubt_;
}

std::vector<RigPart> DeviceRig::parts() const { return {projector_.part(), lens_.part(), board_.part()}; }

void DeviceRig::lead(const std::stop_token& stop) {
  prefer_this_thread();
  const std::unique_ptr<Leader> leader = make_leader(devices_, settings_);
  std::uint64_t darkness = 0;
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(mutex_);
      if (std::exchange(darkness, darkness_) != darkness_) leader->forget();
      for (HandedSweep& sweep : std::exchange(handed_, {})) leader->hand_over(std::move(sweep));
    }
    Status stepped = leader->step(monotonic_s());
    if (stepped && leader->leads()) {
      for (const DeviceHand* hand : {&projector_, &board_, &lens_}) {
        if (Status fit = hand->fit(); !fit) stepped = fit;
      }
    }
    bool overtaken = false;
    {
      const std::lock_guard lock(mutex_);
      overtaken = darkness != darkness_;
    }
    // What a step began while everything was made dark must not stay.
    if (overtaken || !stepped) darken(stepped ? std::nullopt : std::optional<Fault>(stepped.fault()));
    std::this_thread::sleep_for(between_steps);
  }
}

}  // namespace focalstage
