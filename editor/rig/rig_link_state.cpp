#include "editor/rig/rig_link_state.h"

namespace focalstage {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds connect_deadline{1500};
constexpr milliseconds watch_interval{100};
constexpr milliseconds retry_pause{300};
constexpr milliseconds live_interval{20};

}  // namespace

void RigLink::State::order(std::function<void()> what) {
  const std::lock_guard lock(mutex);
  orders.push_back(std::move(what));
  arrived.notify_one();
}

void RigLink::State::run() {
  for (;;) {
    std::function<void()> next;
    {
      std::unique_lock lock(mutex);
      const auto something = [&] { return ending || !orders.empty(); };
      if (status.live_wanted) {
        arrived.wait_for(lock, live_interval, something);
      } else {
        arrived.wait(lock, something);
      }
      if (ending) break;
      if (!orders.empty()) {
        next = std::move(orders.front());
        orders.pop_front();
      }
    }
    if (next) next();
    stay_live();
  }
  leave();
}

/// Begins what is wanted and not there yet, sends the newest revision, takes what the rig answered.
void RigLink::State::stay_live() {
  LiveWish wish;
  bool wanted = false;
  {
    const std::lock_guard lock(mutex);
    wanted = status.live_wanted && status.phase == RigStatus::Phase::connected;
    wish = live_wish;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!wanted && stream.open()) {
    stream.stop();
    publish([](RigStatus& shown) { shown.live = false; });
  }
  if (wanted && !stream.open() && client && wish.project && now >= live_again) {
    const Status begun = stream.start(*client, wish);
    live_again = now + retry_pause;
    publish([&](RigStatus& shown) {
      shown.live = begun.ok();
      shown.fault.reset();
      if (!begun) shown.fault = begun.fault();
    });
  }
  if (!stream.open()) return;
  if (const Status sent = stream.show(wish); !sent) {
    publish([&](RigStatus& shown) { shown.fault = sent.fault(); });
  }
  bool changed = false;
  {
    const std::lock_guard lock(mutex);
    changed = stream.take_answers(status);
  }
  // Live means light: what is compiled first is played, unless the rig is dark and waits for a go.
  if (stream.take_ready()) tell(client->play());
  if (changed) wake();
}

/// Blackout is a call of its own, which needs no hold on the rig. Pressed again while one is under way: one more.
void RigLink::State::stand_by() {
  for (;;) {
    std::string address;
    {
      std::unique_lock lock(mutex);
      urgent.wait(lock, [&] { return ending || blackout_wanted; });
      if (ending) return;
      blackout_wanted = false;
      address = status.address;
    }
    auto own = RigClient::connect(address, connect_deadline);
    tell(own ? own->blackout() : Status(own.fault()));
  }
}

void RigLink::State::leave() {
  stream.stop();
  watcher = {};
  client.reset();
  simulated.reset();
}

void RigLink::State::tell(const Status& done) {
  publish([&](RigStatus& now) {
    now.fault.reset();
    if (!done) now.fault = done.fault();
  });
}

void RigLink::State::connect_to(const std::string& address, bool own) {
  publish([&](RigStatus& now) {
    now = RigStatus{};
    now.phase = RigStatus::Phase::connecting;
    now.address = address;
    now.simulated = own;
  });
  auto made = RigClient::connect(address, connect_deadline);
  if (!made) {
    publish([&](RigStatus& now) {
      now.phase = RigStatus::Phase::none;
      now.fault = made.fault();
    });
    return;
  }
  client = std::move(*made);
  auto description = client->describe();
  publish([&](RigStatus& now) {
    now.phase = RigStatus::Phase::connected;
    if (description) now.description = *description;
  });
  watcher = std::jthread([this, address](std::stop_token stop) { watch(address, std::move(stop)); });
}

void RigLink::State::begin_simulated() {
  auto rig = SimulatedRig::start(folder / "simulated-rig");
  if (!rig) {
    publish([&](RigStatus& now) {
      now.phase = RigStatus::Phase::none;
      now.fault = rig.fault();
    });
    return;
  }
  simulated = std::move(*rig);
  connect_to(simulated->address(), true);
}

/// A simulated rig of ours that died is started again; a real one comes back by itself, or does not.
void RigLink::State::revive() {
  if (!simulated || simulated->running()) return;
  const bool was_live = [&] {
    const std::lock_guard lock(mutex);
    return status.live_wanted;
  }();
  leave();
  begin_simulated();
  publish([&](RigStatus& now) { now.live_wanted = was_live; });
}

void RigLink::State::watch(const std::string& address, std::stop_token stop) {
  while (!stop.stop_requested()) {
    auto watching = RigClient::connect(address, retry_pause);
    if (!watching) {
      publish([&](RigStatus& now) {
        now.phase = RigStatus::Phase::lost;
        now.live = false;
        now.fault = watching.fault();
      });
      order([this] { revive(); });
      continue;
    }
    const Status ended = watching->watch(watch_interval, [&](const RigState& seen) {
      publish([&](RigStatus& now) {
        if (now.phase == RigStatus::Phase::lost) now.fault.reset();
        now.phase = RigStatus::Phase::connected;
        now.state = seen;
      });
      return !stop.stop_requested();
    });
    if (!ended && !stop.stop_requested()) {
      publish([&](RigStatus& now) {
        now.phase = RigStatus::Phase::lost;
        now.fault = ended.fault();
      });
      std::this_thread::sleep_for(retry_pause);
    }
  }
}

void RigLink::State::push(const MakeShow& make, std::stop_token stop) {
  const auto step = [this](const char* words) {
    return [this, words](double share) {
      publish([&](RigStatus& now) {
        now.push_step = words;
        now.push_share = share;
      });
    };
  };
  const auto show = make(step("Compiling"), stop);
  Status pushed = show ? client->push(*show, true, step("Sending"), stop) : Status(show.fault());
  auto seen = pushed ? client->state() : Result<RigState>(RigState{});
  publish([&](RigStatus& now) {
    now.pushing = false;
    now.push_share = -1.0;
    now.push_step.clear();
    now.fault.reset();
    if (!pushed) now.fault = pushed.fault();
    if (pushed && seen) {
      now.pushed_sha256 = seen->show_sha256;
      now.state = *seen;
    }
  });
}

}  // namespace focalstage
