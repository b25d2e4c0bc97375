#include "devices/plugin/plugin_projector.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/plugin/library.h"
#include "devices/plugin/plugin_seat.h"
#include "devices/plugin/projector_books.h"
#include "devices/plugin/table_calls.h"
#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// The ABI's.
constexpr double configure_s = 3.0;
constexpr double start_s = 1.0;
constexpr double submit_s = 0.1;
// So long a picture may wait for room: by then the plugin should long have had it.
constexpr double room_s = 0.5;
constexpr std::int64_t acquire_ns = 5'000'000;
// Of the 200 ms within which `dark` has to be through.
constexpr double dark_s = 0.15;
constexpr std::uint32_t most_px = 32768;

std::int64_t ns_of(double s) { return static_cast<std::int64_t>(std::llround(s * 1e9)); }

/// A table of calls and the books: what calls that outlive the role still use.
struct Desk {
  PluginProjectorSettings settings;
  const focalstage_projector* table = nullptr;
  ProjectorBooks books;
};

struct ProjectorKind {
  using Table = focalstage_projector;
  using Device = focalstage_projector_device;
  using Abilities = focalstage_projector_abilities;
  using Counts = focalstage_projector_counts;
};
using Calls = TableCalls<ProjectorKind>;

focalstage_projector_device* device_of(void* device) { return Calls::device_of(device); }

Fault eye_safety_fault(const std::string& library) {
  return {"plugin.eye-safety", library, "nobody has vouched for the light of this projector",
          "have it measured (IEC 62471; no laser, no ultraviolet), then set eye_safe in its settings"};
}

bool believable(const focalstage_projector_abilities& said) {
  const bool sized = said.width_px >= 1 && said.width_px <= most_px && said.height_px >= 1 && said.height_px <= most_px;
  return sized && said.most_periods_ahead >= 2 && said.most_bits >= 1 && said.most_bits <= 8;
}

Result<void*> open_device(Desk& desk) {
  if (!desk.settings.eye_safe) return eye_safety_fault(desk.settings.plugin.library.string());
  const auto table = load_projector_plugin(desk.settings.plugin.library);
  if (!table) return table.fault();
  desk.table = *table;
  focalstage_projector_abilities abilities{};
  const auto device = Calls::open(**table, desk.settings.plugin, abilities, "projector", believable);
  if (!device) return device.fault();
  desk.books.set_abilities(abilities);
  return static_cast<void*>(*device);
}

PluginWord ask_status(Desk& desk, void* device) {
  const std::uint64_t run = desk.books.run();
  focalstage_projector_counts counts{};
  PluginWord word = Calls::status(*desk.table, device, counts);
  if (word.code == FOCALSTAGE_OK) word.lie = desk.books.told(run, counts, ns_of(monotonic_s()));
  return word;
}

PluginCalls calls_of(const std::shared_ptr<Desk>& desk) {
  PluginCalls calls = Calls::of(desk);
  calls.open = [desk] { return open_device(*desk); };
  calls.status = [desk](void* device) { return ask_status(*desk, device); };
  calls.make_safe = [desk](void* device) { return desk->table->blank(device_of(device)) == FOCALSTAGE_OK; };
  return calls;
}

std::int32_t configure(const Desk& desk, void* device, const Exposures& exposures, char* error) {
  std::vector<std::int64_t> starts;
  for (const double s : exposures.start_s) starts.push_back(ns_of(s));
  const focalstage_exposures told{exposures.period_s * 1e9,
                                  ns_of(exposures.exposure_s),
                                  static_cast<std::uint32_t>(exposures.form.channels),
                                  static_cast<std::uint32_t>(exposures.form.bits),
                                  static_cast<std::uint32_t>(starts.size()),
                                  starts.data()};
  desk.table->stop(device_of(device));
  return desk.table->configure(device_of(device), &told, error);
}

/// One picture, or black, into the plugin; waits for room as long as this run goes on.
std::int32_t submit(Desk& desk, void* device, std::uint64_t run, std::uint64_t period, std::uint32_t exposure,
                    const Picture* picture, char* error) {
  const double until_s = monotonic_s() + room_s;
  while (desk.books.run() == run && monotonic_s() < until_s) {
    std::uint8_t* buffer = nullptr;
    if (picture != nullptr) {
      const std::int32_t code = desk.table->acquire(device_of(device), &buffer, acquire_ns, error);
      if (code == FOCALSTAGE_NOT_YET) continue;
      if (code != FOCALSTAGE_OK) return desk.books.run() == run ? code : FOCALSTAGE_OK;
      std::memcpy(buffer, picture->codes.data(), picture->codes.size());
    }
    desk.books.submitting(run);
    const std::int32_t code = desk.table->submit(device_of(device), buffer, period, exposure, error);
    if (code == FOCALSTAGE_NOT_YET) {
      desk.books.refused(run);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    return desk.books.run() == run ? code : FOCALSTAGE_OK;
  }
  if (desk.books.run() != run) return FOCALSTAGE_OK;
  std::snprintf(error, FOCALSTAGE_ERROR_BYTES, "it has no room for pictures that it said it can hold");
  return FOCALSTAGE_UNABLE;
}

class PluginProjector final : public ProjectorDevice {
 public:
  explicit PluginProjector(const PluginProjectorSettings& settings)
      : desk_(std::make_shared<Desk>()), seat_(settings.plugin, calls_of(desk_), "projector") {
    desk_->settings = settings;
  }
  ~PluginProjector() override { desk_->books.end(); }

  Status open() override { return seat_.open(); }
  void close() override {
    desk_->books.end();
    seat_.close();
  }
  DeviceId id() const override { return seat_.id(); }
  DeviceState state() const override { return seat_.state(); }
  Status identify() override { return seat_.identify(); }
  ProjectorAbilities abilities() const override { return desk_->books.abilities(); }
  ProjectorReport report() const override { return desk_->books.report(); }

  Status arm(const Exposures& exposures) override {
    if (desk_->books.run() != 0) (void)dark();
    if (exposures.start_s.empty() || !(exposures.period_s > 0.0) ||
        (exposures.form.channels != 1 && exposures.form.channels != 3)) {
      return Fault{"projector.unable", seat_.where(), "there is nothing to show", "give it exposures and a period"};
    }
    desk_->books.set_exposures(exposures);
    return seat_.work(
        [desk = desk_, exposures](void* device, char* error) { return configure(*desk, device, exposures, error); },
        configure_s, "projector.unable");
  }

  Status start() override {
    const std::uint64_t darkened = darkened_;
    const auto call = [desk = desk_](void* device, char* error) {
      desk->table->stop(device_of(device));
      const std::int32_t code = desk->table->start(device_of(device), error);
      // Counts of an earlier run are told no more, and this one's only from here on.
      if (code == FOCALSTAGE_OK) desk->books.begin(monotonic_s());
      return code;
    };
    Status started = seat_.work(call, start_s, "projector.unable");
    if (started && darkened == darkened_) {
      seat_.set_running(true);
      return {};
    }
    (void)dark();  // told meanwhile, or gone wrong halfway
    return started ? Fault{"projector.dark", seat_.where(), "it was made dark meanwhile", "start it again"} : started;
  }

  Status post(std::vector<Picture> pictures) override {
    const Exposures exposures = desk_->books.exposures();
    const ProjectorAbilities able = abilities();
    const std::size_t bytes = static_cast<std::size_t>(able.width_px) * static_cast<std::size_t>(able.height_px) *
                              static_cast<std::size_t>(exposures.form.channels);
    const bool sized = std::ranges::all_of(pictures, [&](const Picture& p) { return p.codes.size() == bytes; });
    if (!sized || (!pictures.empty() && pictures.size() != exposures.start_s.size())) {
      return Fault{"projector.unable", seat_.where(), "these are not the pictures of one period", "arm it for them"};
    }
    const std::uint64_t run = desk_->books.run();
    const auto period = desk_->books.post();
    if (!period) return period.fault();
    const auto kept = std::make_shared<const std::vector<Picture>>(std::move(pictures));
    for (std::uint32_t i = 0; i < exposures.start_s.size(); ++i) {
      const auto call = [desk = desk_, kept, run, number = *period, i](void* device, char* error) {
        const Picture* picture = kept->empty() ? nullptr : &(*kept)[i];
        return submit(*desk, device, run, number, i, picture, error);
      };
      seat_.post(call, room_s + submit_s);
    }
    return {};
  }

  bool dark() noexcept override {
    ++darkened_;
    desk_->books.end();
    return seat_.make_safe(dark_s);
  }

 private:
  std::shared_ptr<Desk> desk_;
  std::atomic<std::uint64_t> darkened_ = 0;
  PluginSeat seat_;
};

}  // namespace

std::unique_ptr<ProjectorDevice> make_plugin_projector(const PluginProjectorSettings& settings) {
  return std::make_unique<PluginProjector>(settings);
}

}  // namespace focalstage
