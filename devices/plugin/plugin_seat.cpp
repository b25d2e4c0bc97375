#include "devices/plugin/plugin_seat.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// The ABI's: so long a call may take, and so long after that it counts as hung.
constexpr double open_s = 3.0;
constexpr double close_s = 1.0;
constexpr double identify_s = 2.0;
constexpr double status_s = 0.010;
constexpr double safety_s = 0.100;
constexpr double grace_s = 1.0;
// Between two looks where nothing is open.
constexpr double at_rest_s = 0.020;

Fault hung_fault(const std::string& where) {
  return {"plugin.hung", where, "a call of this plugin does not return",
          "see its vendor's documentation; starting the runtime anew always helps"};
}

/// Waiting does not mend these.
bool is_final(const Fault& fault) { return fault.code != "plugin.absent" && fault.code != "plugin.lost"; }

}  // namespace

struct PluginSeat::Shared {
  PluginCalls calls;
  std::string library;
  std::string temperature_of;
  mutable std::mutex mutex;  // never held during a call of the plugin
  void* device = nullptr;    ///< open; any lane may use it
  void* parted = nullptr;    ///< to be closed as soon as no lane is in it
  DevicePhase phase = DevicePhase::off;
  bool running = false;
  std::optional<Fault> fault;
  bool safety_due = false;
  std::uint64_t openings = 0;
  double heard_s = 0.0;
  double temperature_c = std::nan("");
  DeviceId id{"plugin", "", "", ""};

  void* open_device() const {
    const std::lock_guard lock(mutex);
    return device;
  }

  std::string where() const {
    const std::lock_guard lock(mutex);
    return id.model.empty() ? library : id.model;
  }

  void lose(const Fault& why) {
    const std::lock_guard lock(mutex);
    if (device == nullptr || phase == DevicePhase::lost) return;
    phase = DevicePhase::lost;
    running = false;
    fault = why;
    safety_due = true;
  }

  /// Takes up what `open` brought, also where nobody waited for it any more.
  void opened(void* opened_device, bool awaited) {
    const DeviceId its = calls.describe(opened_device);
    const std::lock_guard lock(mutex);
    (awaited ? device : parted) = opened_device;
    if (!awaited) return;
    id = its;
    ++openings;
    safety_due = false;  // that was for the one before
    phase = DevicePhase::ready;
    running = false;
    fault.reset();
    heard_s = monotonic_s();
    temperature_c = std::nan("");
  }

  void listen() {
    void* const asked = open_device();
    if (asked == nullptr) return;
    const PluginWord word = calls.status(asked);
    const bool answered = word.code == FOCALSTAGE_OK;
    if (word.lie) return lose(*word.lie);
    if (!answered) return lose(plugin_fault(word.code, word.words, where(), "plugin.fault"));
    const std::lock_guard lock(mutex);
    if (device != asked) return;
    heard_s = std::max(heard_s, std::min(1e-9 * static_cast<double>(word.told_ns), monotonic_s()));
    temperature_c = word.temperature_c;
  }
};

PluginSeat::PluginSeat(const PluginSettings& settings, PluginCalls calls, std::string temperature_of)
    : shared_(std::make_shared<Shared>()), settings_(settings) {
  shared_->calls = std::move(calls);
  shared_->library = settings.library.string();
  shared_->temperature_of = std::move(temperature_of);
  shared_->id.address = shared_->library;
  watch_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

PluginSeat::~PluginSeat() {
  close();
  watch_.request_stop();
  watch_.join();
}

/// Closes what was open, unless a call still hangs in it.
bool PluginSeat::release(double wait_s) {
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->device != nullptr) shared_->parted = std::exchange(shared_->device, nullptr);
    shared_->running = false;
  }
  const double until_s = monotonic_s() + wait_s;
  const auto left_s = [&] { return std::max(0.0, until_s - monotonic_s()); };
  if (!status_.idle(left_s()) || !safety_.idle(left_s()) || !work_.idle(left_s())) return false;
  return work_.run(
      [shared = shared_] {
        void* parted = nullptr;
        {
          const std::lock_guard lock(shared->mutex);
          parted = std::exchange(shared->parted, nullptr);
        }
        if (parted != nullptr) shared->calls.close(parted);
      },
      close_s, close_s);
}

Status PluginSeat::open() {
  const std::lock_guard opening(opening_);
  if (answers()) return {};
  const double until_s = monotonic_s() + open_s;
  (void)make_safe(safety_s);
  struct Answer {
    std::mutex mutex;
    bool awaited = true;
    std::optional<Result<void*>> result;
  };
  const auto answer = std::make_shared<Answer>();
  const auto call = [answer, shared = shared_] {
    Result<void*> result = shared->calls.open();
    const std::lock_guard lock(answer->mutex);
    if (result) shared->opened(*result, answer->awaited);
    answer->result = std::move(result);
  };
  std::optional<Fault> fault;
  if (!release(0.5) || !work_.run(call, open_s, std::max(0.0, until_s - monotonic_s()))) {
    const std::lock_guard lock(answer->mutex);
    answer->awaited = false;
    if (!answer->result) fault = hung_fault(shared_->where());
  }
  const std::lock_guard answering(answer->mutex);
  if (answer->result && !*answer->result) fault = answer->result->fault();
  if (!fault) return {};
  const std::lock_guard lock(shared_->mutex);
  shared_->phase = fault->code != "plugin.hung" && is_final(*fault) ? DevicePhase::refused : DevicePhase::lost;
  shared_->fault = fault;
  return *fault;
}

void PluginSeat::close() {
  const std::lock_guard opening(opening_);
  (void)make_safe(safety_s);
  (void)release(0.5);
  const std::lock_guard lock(shared_->mutex);
  shared_->phase = DevicePhase::off;
  shared_->fault.reset();
}

DeviceId PluginSeat::id() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->id;
}

DeviceState PluginSeat::state() const {
  const std::lock_guard lock(shared_->mutex);
  DeviceState state{shared_->phase, shared_->fault, shared_->heard_s, {}};
  if (state.phase == DevicePhase::ready && shared_->running) state.phase = DevicePhase::running;
  if (std::isfinite(shared_->temperature_c)) {
    state.temperatures.push_back({shared_->temperature_of, shared_->temperature_c});
  }
  return state;
}

Status PluginSeat::identify() {
  if (state().phase == DevicePhase::running) {
    return Fault{"plugin.running", where(), "it is running", "make it dark first"};
  }
  return work([shared = shared_](void* device, char* error) { return shared->calls.identify(device, error); },
              identify_s, "plugin.unable");
}

bool PluginSeat::answers() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->device != nullptr && shared_->phase == DevicePhase::ready;
}

std::string PluginSeat::where() const { return shared_->where(); }

void PluginSeat::set_running(bool running) {
  const std::lock_guard lock(shared_->mutex);
  shared_->running = running;
}

Status PluginSeat::work(std::function<std::int32_t(void*, char*)> call, double due_s, const char* unable) {
  if (!answers()) return Fault{"plugin.closed", where(), "it is not open", "see its state"};
  struct Answer {
    std::int32_t code = FOCALSTAGE_LOST;
    PluginWords words{};
  };
  const auto answer = std::make_shared<Answer>();
  const auto made = [answer, shared = shared_, call = std::move(call)] {
    void* const device = shared->open_device();
    if (device != nullptr) answer->code = call(device, answer->words.data());
  };
  if (!work_.run(made, due_s, due_s)) return hung_fault(where());
  if (answer->code == FOCALSTAGE_OK) return {};
  const Fault fault = plugin_fault(answer->code, answer->words, where(), unable);
  if (answer->code == FOCALSTAGE_LOST) shared_->lose(fault);
  return fault;
}

void PluginSeat::post(std::function<std::int32_t(void*, char*)> call, double due_s) {
  work_.post(
      [shared = shared_, call = std::move(call)] {
        void* const device = shared->open_device();
        if (device == nullptr) return;
        PluginWords words{};
        const std::int32_t code = call(device, words.data());
        if (code != FOCALSTAGE_OK) shared->lose(plugin_fault(code, words, shared->where(), "plugin.unable"));
      },
      due_s);
}

bool PluginSeat::make_safe(double wait_s) noexcept {
  try {
    work_.forget();
    set_running(false);
    if (shared_->open_device() == nullptr) return true;
    const auto safe = std::make_shared<std::atomic<bool>>(false);
    const auto call = [safe, shared = shared_] {
      void* const device = shared->open_device();
      *safe = device == nullptr || shared->calls.make_safe(device);
    };
    return safety_.run(call, safety_s, wait_s) && *safe;
  } catch (...) {  // no memory, no thread: whatever else makes it dark is needed
    return false;
  }
}

void PluginSeat::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const bool open = shared_->open_device() != nullptr;
    if (open) look();
    sleep_until(monotonic_s() + (open ? settings_.poll_s : at_rest_s));
  }
}

void PluginSeat::look() {
  if (status_.idle()) status_.post([shared = shared_] { shared->listen(); }, status_s);
  if (work_.overdue_s() > grace_s) shared_->lose(hung_fault(where()));
  const double silence_s = monotonic_s() - state().heard_s;
  if (silence_s > settings_.silent_s) {
    shared_->lose({"plugin.silent", where(),
                   "it has not been heard of for " + std::to_string(settings_.silent_s) + " s",
                   "see that it is plugged in and switched on"});
  }
  std::uint64_t opening = 0;
  {
    const std::lock_guard lock(shared_->mutex);
    if (!std::exchange(shared_->safety_due, false)) return;
    opening = shared_->openings;
  }
  const auto call = [shared = shared_, opening] {
    void* device = nullptr;
    {
      const std::lock_guard lock(shared->mutex);
      if (shared->openings == opening) device = shared->device;
    }
    if (device != nullptr) (void)shared->calls.make_safe(device);
  };
  safety_.post(call, safety_s);
}

}  // namespace focalstage
