#include "editor/rig/rig_link.h"

#include <utility>

#include "editor/rig/rig_link_state.h"

namespace focalstage {

RigLink::RigLink(std::function<void()> wake, std::filesystem::path state_folder) : state_(std::make_unique<State>()) {
  state_->wake = std::move(wake);
  state_->folder = std::move(state_folder);
  state_->worker = std::thread([this] { state_->run(); });
  state_->lifeguard = std::thread([this] { state_->stand_by(); });
}

RigLink::~RigLink() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->ending = true;
    state_->push_stop.request_stop();
  }
  state_->arrived.notify_all();
  state_->urgent.notify_all();
  state_->lifeguard.join();
  state_->worker.join();
}

void RigLink::connect(std::string address) {
  state_->order([this, address = std::move(address)] {
    state_->leave();
    state_->connect_to(address, false);
  });
}

void RigLink::simulate() {
  state_->publish([](RigStatus& now) { now.phase = RigStatus::Phase::connecting; });
  state_->order([this] {
    state_->leave();
    state_->begin_simulated();
  });
}

void RigLink::disconnect() {
  state_->order([this] {
    state_->leave();
    state_->publish([](RigStatus& now) { now = RigStatus{}; });
  });
}

void RigLink::push(MakeShow make) {
  std::stop_token stop;
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->status.pushing) return;
    state_->status.pushing = true;
    state_->push_stop = std::stop_source();
    stop = state_->push_stop.get_token();
  }
  state_->order([this, make = std::move(make), stop] {
    if (state_->client) {
      state_->push(make, stop);
    } else {
      state_->publish([](RigStatus& now) { now.pushing = false; });
    }
  });
}

void RigLink::cancel_push() {
  const std::lock_guard lock(state_->mutex);
  state_->push_stop.request_stop();
}

void RigLink::live(bool on) {
  state_->publish([&](RigStatus& now) { now.live_wanted = on; });
  state_->order([] {});
}

void RigLink::show(LiveWish wish) {
  const std::lock_guard lock(state_->mutex);
  if (wish.revision == state_->live_wish.revision && wish.frame == state_->live_wish.frame) return;
  state_->live_wish = std::move(wish);
  if (state_->status.live_wanted) state_->orders.push_back([] {});
  state_->arrived.notify_one();
}

void RigLink::play() {
  state_->order([this] {
    if (state_->client) state_->tell(state_->client->play());
  });
}

void RigLink::hold() {
  state_->order([this] {
    if (state_->client) state_->tell(state_->client->hold());
  });
}

void RigLink::go() {
  state_->order([this] {
    if (state_->client) state_->tell(state_->client->go());
  });
}

void RigLink::blackout() {
  const std::lock_guard lock(state_->mutex);
  if (state_->status.address.empty()) return;
  state_->blackout_wanted = true;
  state_->urgent.notify_one();
}

RigStatus RigLink::status() const {
  const std::lock_guard lock(state_->mutex);
  return state_->status;
}

}  // namespace focalstage
