#include "devices/plugin/plugin_lens_drive.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "devices/plugin/drive_samples.h"
#include "devices/plugin/library.h"
#include "devices/plugin/plugin_seat.h"
#include "devices/plugin/table_calls.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// The ABI's.
constexpr double start_s = 1.0;
// Of the 100 ms within which `stop` has to be through.
constexpr double stop_s = 0.1;
constexpr std::int64_t clock_slack_ns = 1'000'000;

struct DriveKind {
  using Table = focalstage_lens_drive;
  using Device = focalstage_drive_device;
  using Abilities = focalstage_drive_abilities;
  using Counts = focalstage_drive_counts;
};
using Calls = TableCalls<DriveKind>;

focalstage_drive_device* device_of(void* device) { return Calls::device_of(device); }

/// What calls that outlive the role still use.
struct Desk {
  PluginDriveSettings settings;
  const focalstage_lens_drive* table = nullptr;
  mutable std::mutex mutex;
  focalstage_drive_abilities abilities{};
  bool running = false;
  std::uint64_t run = 0;
  std::int64_t begun_ns = 0;
  std::uint64_t clamped = 0;
  focalstage_drive_counts counts{};

  double most_a() const {
    const std::lock_guard lock(mutex);
    return std::max(0.0, std::min(settings.most_a, abilities.most_a));
  }
};

Result<void*> open_device(Desk& desk) {
  const auto table = load_lens_drive_plugin(desk.settings.plugin.library);
  if (!table) return table.fault();
  desk.table = *table;
  focalstage_drive_abilities abilities{};
  const auto device = Calls::open(**table, desk.settings.plugin, abilities, "currents",
                                  [](const focalstage_drive_abilities& said) { return said.most_a > 0.0; });
  if (!device) return device.fault();
  const std::lock_guard lock(desk.mutex);
  desk.abilities = abilities;
  return static_cast<void*>(*device);
}

/// Takes what was told of the run that is under way; a Fault where that cannot be, or where there was a gap.
std::optional<Fault> take(Desk& desk, std::uint64_t run, const focalstage_drive_counts& counts) {
  const auto now_ns = static_cast<std::int64_t>(monotonic_s() * 1e9);
  const std::lock_guard lock(desk.mutex);
  if (counts.told_ns > now_ns + clock_slack_ns || counts.newest_period_ns > now_ns + clock_slack_ns) {
    return Fault{"plugin.counts", "lens drive", "its counts are of a moment that is still to come",
                 "this plugin is broken: do not use it"};
  }
  if (!desk.running || run != desk.run || counts.told_ns < desk.begun_ns) return std::nullopt;
  if (counts.periods < desk.counts.periods || counts.underruns < desk.counts.underruns) {
    return Fault{"plugin.counts", "lens drive", "its counts went back", "this plugin is broken: do not use it"};
  }
  desk.counts = counts;
  if (counts.underruns == 0) return std::nullopt;
  return Fault{"drive.underrun", "lens drive", "the waveform had a gap: this machine came too late",
               "see that nothing else keeps this machine busy"};
}

PluginWord ask_status(Desk& desk, void* device) {
  std::uint64_t run = 0;
  {
    const std::lock_guard lock(desk.mutex);
    run = desk.run;
  }
  focalstage_drive_counts counts{};
  PluginWord word = Calls::status(*desk.table, device, counts);
  if (word.code == FOCALSTAGE_OK) word.lie = take(desk, run, counts);
  return word;
}

PluginCalls calls_of(const std::shared_ptr<Desk>& desk) {
  PluginCalls calls = Calls::of(desk);
  calls.open = [desk] { return open_device(*desk); };
  calls.status = [desk](void* device) { return ask_status(*desk, device); };
  calls.make_safe = [desk](void* device) { return desk->table->stop(device_of(device)) == FOCALSTAGE_OK; };
  return calls;
}

class PluginLensDrive final : public LensDrive {
 public:
  explicit PluginLensDrive(const PluginDriveSettings& settings)
      : desk_(std::make_shared<Desk>()), seat_(settings.plugin, calls_of(desk_), "lens") {
    desk_->settings = settings;
  }

  Status open() override { return seat_.open(); }
  void close() override {
    end();
    seat_.close();
  }
  DeviceId id() const override { return seat_.id(); }
  DeviceState state() const override { return seat_.state(); }
  Status identify() override { return seat_.identify(); }

  DriveAbilities abilities() const override {
    DriveAbilities able;
    able.most_a = desk_->most_a();
    const std::lock_guard lock(desk_->mutex);
    able.eyes_apart = desk_->abilities.eyes_apart != 0;
    able.sync_edge = desk_->abilities.sync_edge != 0;
    if (desk_->abilities.most_samples > 0) able.most_samples = static_cast<int>(desk_->abilities.most_samples);
    return able;
  }

  Status start(const DrivePeriod& period) override {
    (void)stop();
    const auto samples = samples_of(period);
    if (!samples) return samples.fault();
    const std::uint64_t stopped = stopped_;
    const auto call = [desk = desk_, kept = *samples](void* device, char* error) {
      const focalstage_drive_period told = kept.told();
      const auto before_ns = static_cast<std::int64_t>(monotonic_s() * 1e9);
      const std::int32_t code = desk->table->start(device_of(device), &told, error);
      if (code != FOCALSTAGE_OK) return code;
      const std::lock_guard lock(desk->mutex);
      desk->running = true;
      ++desk->run;
      desk->begun_ns = before_ns;
      desk->clamped = kept.clamped;
      desk->counts = {};
      desk->counts.period_ns = kept.period_ns;
      return code;
    };
    Status started = seat_.work(call, start_s, "drive.unable");
    if (started && stopped == stopped_) {
      seat_.set_running(true);
      return {};
    }
    (void)stop();
    return started ? Fault{"drive.stopped", seat_.where(), "it was stopped meanwhile", "start it again"} : started;
  }

  Result<std::uint64_t> refill(const DrivePeriod& period) override {
    const auto samples = samples_of(period);
    if (!samples) return samples.fault();
    const auto from = std::make_shared<std::uint64_t>(0);
    const auto call = [desk = desk_, kept = *samples, from](void* device, char* error) {
      const focalstage_drive_period told = kept.told();
      const std::int32_t code = desk->table->refill(device_of(device), &told, from.get(), error);
      const std::lock_guard lock(desk->mutex);
      if (code == FOCALSTAGE_OK) desk->clamped += kept.clamped;
      return code;
    };
    if (Status refilled = seat_.work(call, start_s, "drive.unable"); !refilled) return refilled.fault();
    return *from;
  }

  bool stop() noexcept override {
    ++stopped_;
    end();
    return seat_.make_safe(stop_s);
  }

  DriveReport report() const override {
    const std::lock_guard lock(desk_->mutex);
    const focalstage_drive_counts& counts = desk_->counts;
    return {counts.periods, 1e-9 * static_cast<double>(counts.newest_period_ns), 1e-9 * counts.period_ns,
            counts.underruns, desk_->clamped};
  }

 private:
  void end() noexcept {
    const std::lock_guard lock(desk_->mutex);
    desk_->running = false;
  }

  Result<DriveSamples> samples_of(const DrivePeriod& period) const {
    return drive_samples(period, abilities(), seat_.where());
  }

  std::shared_ptr<Desk> desk_;
  std::atomic<std::uint64_t> stopped_ = 0;
  PluginSeat seat_;
};

}  // namespace

std::unique_ptr<LensDrive> make_plugin_lens_drive(const PluginDriveSettings& settings) {
  return std::make_unique<PluginLensDrive>(settings);
}

}  // namespace focalstage
