#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "devices/roles/rig.h"
#include "devices/sim/sim_lens.h"
#include "devices/sim/sim_light.h"
#include "devices/sim/sim_projector.h"
#include "devices/sim/sim_shutter.h"

namespace focalstage {

/// The rig that is simulated. The two lenses are not ideal, and not alike.
struct SimSettings {
  PerEye<SimLensSettings> lens{{38.0, 0.0006, 0.0001}, {37.5, 0.00065, 0.0001}};
  SimShutterSettings shutter;
  SimProjectorSettings projector;
  std::optional<SimLightSettings> light = SimLightSettings{};  ///< none: no light sensor
  int width_px = 1024;
  int height_px = 768;
};

/// What may go wrong in it, and what nobody is told.
struct SimFaults {
  double lens_lag_s = 0.0;  ///< more lag than described
  double lens_gain = 1.0;   ///< times the gain described
  PerEye<double> shutter_late_s;
  std::optional<std::uint64_t> drop_trigger;  ///< the one after this many
};

/// A rig without hardware: it is given what hardware is given and nothing else, and remembers the light it gave.
/// Deterministic; its clock is moved on by `run_until` alone.
class SimRig final : public Rig {
 public:
  /// `sensor`: looks at its light; none: nobody does.
  explicit SimRig(const SimSettings& settings = {}, const SimFaults& faults = {},
                  std::shared_ptr<SimLightSensor> sensor = nullptr);

  void set_exposure(double exposure_s, PictureForm) override;
  void announce_triggers(std::span<const double>) override {}  // it waits for each
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override;
  void post_images(std::vector<Picture> pictures) override;
  void sync_edge(double time_s) override;
  void trigger(double time_s) override;
  void shutter(Side eye, ShutterLevel level, double time_s) override;
  void dark(double time_s) override;

  int settle_sweeps() const override { return 2; }
  bool retimes_at_once() const override { return true; }
  Status ready() override { return {}; }
  double edge_near_s(double planned_s) const override { return planned_s; }
  void run_until(double time_s) override;
  bool sees_light() const override { return true; }
  std::vector<DeliveredExposure> take_delivered() override;
  std::optional<Fault> doubt() const override { return std::nullopt; }
  std::vector<RigPart> parts() const override;

  double power_d(Side eye, double time_s) { return lens_[eye].power_d(time_s); }
  double shutter_transmission(Side eye, double time_s) const { return shutter_[eye].at(time_s); }

 private:
  struct Drive {
    std::vector<double> drive_a;
    double step_s = 0.0;
  };
  struct EdgeEvent {
    PerEye<std::optional<Drive>> drive;
    bool posted = false;
    std::optional<double> exposure_s;
  };
  struct TriggerEvent {};
  struct ShutterEvent {
    Side eye;
    ShutterLevel level;
  };
  using Event = std::variant<EdgeEvent, TriggerEvent, ShutterEvent>;

  void happen(double time_s, EdgeEvent& edge);
  void happen(double time_s, TriggerEvent& trigger);
  void happen(double time_s, ShutterEvent& shutter);
  void end_exposures(double time_s);
  double smear_d(Side eye, double from_s, double to_s);
  double seen(Side eye, double time_s);

  PerEye<SimLens> lens_;
  PerEye<SimShutter> shutter_;
  SimProjector projector_;
  EdgeEvent next_edge_;
  std::multimap<double, Event> events_;
  std::vector<StartedExposure> running_;
  std::vector<DeliveredExposure> delivered_;

  /// What a sensor may still look at.
  struct Lit {
    StartedExposure exposure;
    std::optional<SimBrightness> brightness;  ///< once somebody looked
  };
  std::shared_ptr<SimLightSensor> sensor_;
  int width_px_;
  int height_px_;
  PictureForm form_;
  std::deque<Lit> lit_;
};

}  // namespace focalstage
