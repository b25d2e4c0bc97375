#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "devices/roles/rig_port.h"
#include "devices/sim/sim_lens.h"
#include "devices/sim/sim_projector.h"
#include "devices/sim/sim_shutter.h"

namespace focalstage {

/// The rig that is simulated. The two lenses are not ideal, and not alike.
struct SimSettings {
  PerEye<SimLensSettings> lens{{38.0, 0.0006, 0.0001}, {37.5, 0.00065, 0.0001}};
  SimShutterSettings shutter;
  SimProjectorSettings projector;
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

/// Light that left the projector, and what each eye had before it.
struct DeliveredExposure {
  Picture picture;
  double start_s = 0.0;
  double duration_s = 0.0;
  PerEye<double> power_d;             ///< at mid-exposure, through the drive really played
  PerEye<double> smear_d;             ///< the power's highest less its lowest during the exposure
  PerEye<Transmission> transmission;  ///< over the exposure
};

/// A rig without hardware: it is given what hardware is given and nothing else, and remembers the light it gave.
/// Deterministic; its clock is moved on by `run_until` alone.
class SimRig : public RigPort {
 public:
  explicit SimRig(const SimSettings& settings = {}, const SimFaults& faults = {});

  void set_exposure(double exposure_s) override;
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override;
  void post_images(std::vector<Picture> pictures) override;
  void sync_edge(double time_s) override;
  void trigger(double time_s) override;
  void shutter(Side eye, ShutterLevel level, double time_s) override;
  void dark(double time_s) override;

  /// Lets everything up to `time_s` happen. What is handed over afterwards must lie after it.
  void run_until(double time_s);

  /// The exposures that ended since the last call, in time order.
  std::vector<DeliveredExposure> take_delivered();

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

  PerEye<SimLens> lens_;
  PerEye<SimShutter> shutter_;
  SimProjector projector_;
  EdgeEvent next_edge_;
  std::multimap<double, Event> events_;
  std::vector<StartedExposure> running_;
  std::vector<DeliveredExposure> delivered_;
};

}  // namespace focalstage
