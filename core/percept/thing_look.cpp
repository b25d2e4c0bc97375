#include "core/percept/thing_look.h"

#include <cmath>
#include <numbers>

#include "core/base/luminance.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

/// Luminance of a picture by pixels.
class Luminance {
 public:
  explicit Luminance(const RetinaImage& image) : image_(image) {}

  double at(int x, int y) const {
    const float* rgb = &image_.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width_px) +
                                        static_cast<std::size_t>(x))];
    return luminance<double>(rgb[0], rgb[1], rgb[2]);
  }

  /// Squared, between the pixel's neighbours; none at the picture's edge.
  double gradient_squared(int x, int y) const {
    if (x < 1 || y < 1 || x + 1 >= image_.width_px || y + 1 >= image_.height_px) return 0.0;
    const double across = at(x + 1, y) - at(x - 1, y), down = at(x, y + 1) - at(x, y - 1);
    return across * across + down * down;
  }

 private:
  const RetinaImage& image_;
};

/// Sums over the pixels of one thing.
struct Sums {
  int pixels = 0;
  double light = 0.0, candela = 0.0;
  double gradient = 0.0, pinhole_gradient = 0.0;
  double driven = 0.0, radius_squared = 0.0;
};

ThingLook look_of(std::size_t thing, const Sums& sums) {
  constexpr double least_gradient = 1e-9;  // per pixel: below a hundredth of a code
  ThingLook look;
  look.thing = thing;
  look.pixels = sums.pixels;
  if (sums.pixels == 0) return look;
  const bool contrast = sums.pinhole_gradient > least_gradient * sums.pixels;
  look.sharpness = contrast ? std::sqrt(sums.gradient / sums.pinhole_gradient) : std::nan("");
  look.light = sums.light / sums.pixels;
  look.candela_per_m2 = sums.candela / sums.pixels;
  constexpr double arcmin_per_rad = 60.0 * 180.0 / std::numbers::pi;
  if (sums.driven > 0.0) look.blur_radius_arcmin = std::sqrt(sums.radius_squared / sums.driven) * arcmin_per_rad;
  return look;
}

}  // namespace

std::vector<ThingLook> thing_looks(const ThingMap& things, const RetinaImage& seen, const RetinaImage& pinhole,
                                   const DrivenFocus& focus, const RetinaInput& input, const RetinaView& view) {
  const Luminance own(seen), sharp(pinhole);
  const double focus_d = vergence_at_pupil_d(view.focus_d, input.lens_to_pupil_m);
  std::vector<Sums> sums(things.things.size());
  for (int y = 0; y < things.height_px; ++y) {
    for (int x = 0; x < things.width_px; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(things.width_px) + static_cast<std::size_t>(x);
      if (things.thing[i] == ThingMap::nothing) continue;
      Sums& sum = sums[static_cast<std::size_t>(things.thing[i])];
      ++sum.pixels;
      sum.light += own.at(x, y);
      sum.candela += own.at(x, y) * things.candela_per_light[i];
      sum.gradient += own.gradient_squared(x, y);
      sum.pinhole_gradient += sharp.gradient_squared(x, y);
      if (!(focus.luminance[i] > 0.0f)) continue;
      const double off_d = vergence_at_pupil_d(focus.vergence_d[i], input.lens_to_pupil_m) - focus_d;
      const double spread_d = focus.spread_d[i];
      sum.driven += focus.luminance[i];
      sum.radius_squared +=
          focus.luminance[i] * view.pupil_m * view.pupil_m / 4.0 * (off_d * off_d + spread_d * spread_d);
    }
  }
  std::vector<ThingLook> looks;
  for (std::size_t i = 0; i < sums.size(); ++i) looks.push_back(look_of(i, sums[i]));
  return looks;
}

}  // namespace focalstage
