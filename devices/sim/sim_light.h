#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <random>
#include <vector>

#include "devices/roles/light_sensor.h"
#include "devices/roles/picture.h"

namespace focalstage {

/// A line on a card, as the sensor sees it.
struct SimLine {
  double power_d = 0.0;  ///< of the lens, at which it is sharp
  double off_d = 0.0;    ///< how far it really stands from that
};

/// Two photodiodes behind slits, one in place of each eye, and what spoils their signal. Shares of their range.
struct SimLightSettings {
  std::vector<SimLine> lines{{-1.0, 0.0}, {1.0, 0.0}};
  double spread_d = 0.01;  ///< how well the lines' powers are said to be known
  double slit_d = 0.12;    ///< so far out of focus, a line is as wide as the slit
  double white = 0.6;      ///< of all the picture at full light
  double line = 0.4;       ///< of one line at full light, sharp
  double ambient = 0.03;
  double noise = 0.002;
  double hum = 0.005;
  double hum_hz = 100.0;
  int bits = 10;
  double step_s = 26e-6;
  double rise_s = 5e-6;      ///< time constant
  double clock_off = 0.003;  ///< of its own clock: a second of it is so much longer
  int most_samples = 700;
  bool swapped = false;  ///< each is behind the other eye
};

/// Where the projector lights line number `line` for an eye: left, top, width, height.
std::array<int, 4> line_rectangle_px(std::size_t line, Side eye, int width_px, int height_px);

/// The light that reached one eye's slit at an instant.
using SimSeen = std::function<double(Side eye, double time_s)>;

/// The sensor of the simulated rig. Any thread asks; the rig's own tells it of edges and lets it look.
class SimLightSensor final : public LightSensor {
 public:
  explicit SimLightSensor(const SimLightSettings& settings) : settings_(settings) {}

  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {"sim", "simulated light sensor", "", "in this program"}; }
  DeviceState state() const override;
  Status identify() override { return {}; }
  LightAbilities abilities() const override;
  Status arm(const LightRequest& request) override;
  Result<std::optional<LightRecord>> take() override;

  void sync_edge(double time_s);
  /// What was armed and is over by `time_s` is looked at.
  void look(double time_s, const SimSeen& seen);

  /// Pulls its plug, and puts it back.
  void unplug();
  void plug();

  const SimLightSettings& settings() const { return settings_; }

 private:
  struct Armed {
    LightRequest request;
    std::optional<double> edge_s;
  };
  LightRecord record(const Armed& armed, const SimSeen& seen);

  SimLightSettings settings_;
  mutable std::mutex mutex_;
  bool plugged_ = true;
  std::optional<double> edge_s_;
  double period_s_ = 0.0;
  bool steady_ = false;  ///< the last two periods were alike
  std::optional<Armed> armed_;
  std::optional<LightRecord> done_;
  std::mt19937 random_{7};
};

/// How bright a picture is, as the sensors see it.
struct SimBrightness {
  double field = 0.0;
  std::vector<PerEye<double>> line;
};

SimBrightness brightness_of(const Picture& picture, const PictureForm& form, int width_px, int height_px,
                            std::size_t lines);

}  // namespace focalstage
