#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "devices/plugin/call_lane.h"
#include "devices/plugin/plugin_words.h"
#include "devices/plugin/settings.h"
#include "devices/roles/device.h"

namespace focalstage {

/// What its `status` told.
struct PluginWord {
  std::int32_t code = FOCALSTAGE_LOST;
  PluginWords words{};
  std::int64_t told_ns = 0;
  double temperature_c = 0.0;
  std::optional<Fault> lie;  ///< what was told cannot be
};

/// The calls that plugins of every kind have; each owns what it uses.
struct PluginCalls {
  std::function<Result<void*>()> open;  ///< loads the library too
  std::function<DeviceId(void*)> describe;
  std::function<std::int32_t(void*, char*)> identify;
  std::function<PluginWord(void*)> status;
  std::function<bool(void*)> make_safe;
  std::function<void(void*)> close;
};

/// A plugin's device in its place: makes every call in the thread that the ABI promises, asks how it stands, makes it
/// safe by itself when it falls silent, hangs or lies, and says so. What projectors and lens drives share.
class PluginSeat {
 public:
  PluginSeat(const PluginSettings& settings, PluginCalls calls, std::string temperature_of);
  ~PluginSeat();

  Status open();
  void close();
  DeviceId id() const;
  DeviceState state() const;
  Status identify();

  /// Makes this call in the work thread and waits for it as long as the ABI gives it. Faults: "plugin.closed",
  /// "plugin.hung", and what `plugin_fault` says.
  Status work(std::function<std::int32_t(void* device, char* error)> call, double due_s, const char* unable);

  /// The same without waiting; a code that is no success makes it lost.
  void post(std::function<std::int32_t(void* device, char* error)> call, double due_s);

  /// The safety call, and all that waits is forgotten; `wait_s` at most. False: it could not be told.
  bool make_safe(double wait_s) noexcept;

  /// It gives something out, or no longer does.
  void set_running(bool running);
  bool answers() const;
  std::string where() const;

 private:
  struct Shared;

  bool release(double wait_s);
  void watch(const std::stop_token& stop);
  void look();

  std::shared_ptr<Shared> shared_;
  PluginSettings settings_;
  std::mutex opening_;  ///< open and close, one after the other
  CallLane work_;
  CallLane status_;
  CallLane safety_;
  std::jthread watch_;
};

}  // namespace focalstage
