#include "devices/sample/sample_input.h"

#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/sample/packets.h"

namespace focalstage {

namespace {

class SampleInput final : public MotionInput {
 public:
  explicit SampleInput(SampleSettings settings) : settings_(std::move(settings)) {}
  ~SampleInput() override { close(); }

  Status open() override {
    const std::lock_guard opening(opening_);
    if (answers()) return {};
    thread_ = {};  // of what was lost
    if (Status looked = look("input.absent"); !looked) return looked;
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested() && look("input.lost")) sleep_until(monotonic_s() + settings_.poll_s);
    });
    return {};
  }

  void close() override {
    const std::lock_guard opening(opening_);
    thread_ = {};
    const std::lock_guard lock(mutex_);
    state_ = {};
    deflection_ = {};
  }

  DeviceId id() const override {
    return {"sample", "motion from a file", settings_.file.stem().string(), settings_.file.string()};
  }

  DeviceState state() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  Status identify() override {
    return Fault{"input.unable", settings_.file.string(), "a file has no lamp", "look into it"};
  }

  Deflection deflection() const override {
    const std::lock_guard lock(mutex_);
    return deflection_;
  }

 private:
  bool answers() const {
    const std::lock_guard lock(mutex_);
    return state_.phase == DevicePhase::ready;
  }

  /// Reads the file without the lock: whoever asks how things stand waits for no disk.
  Status look(const char* gone) {
    std::ifstream file(settings_.file);
    std::optional<Deflection> read;
    for (std::string line; std::getline(file, line);) read = sample_deflection(line);
    if (!file.is_open()) return lose({gone, settings_.file.string(), "there is no such file", "write it again"});
    if (!read) return lose({"input.damaged", settings_.file.string(), "its last line is no motion", "see the README"});
    const std::lock_guard lock(mutex_);
    deflection_ = *read;
    state_ = {DevicePhase::ready, {}, monotonic_s(), {}};
    return {};
  }

  /// A hand that cannot be seen pushes nothing.
  Status lose(const Fault& fault) {
    const std::lock_guard lock(mutex_);
    deflection_ = {};
    state_.phase = DevicePhase::lost;
    state_.fault = fault;
    return fault;
  }

  SampleSettings settings_;
  std::mutex opening_;        ///< open and close, one after the other
  mutable std::mutex mutex_;  ///< what follows; never held while a file is read
  DeviceState state_;
  Deflection deflection_;
  std::jthread thread_;
};

}  // namespace

std::unique_ptr<MotionInput> make_sample_input(const SampleSettings& settings) {
  return std::make_unique<SampleInput>(settings);
}

}  // namespace focalstage
