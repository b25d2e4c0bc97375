#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/mesh/smooth_parts.h"
#include "core/reference/samples.h"
#include "tests/exact/room_of.h"
#include "tests/support/shapes.h"

// On the retina the pictures of all slices add up, each from its own place on the real surface. Seen in one direction,
// their weights must make one.

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr int directions_per_side = 160;

struct RetinaScene {
  std::string name;
  Stage stage;
  CompileSettings settings;
  double most_off = 1e-6;       ///< from one
  double most_excluded = 0.01;  ///< share of directions that meet several faces
};

/// Directions of one scene, counted.
struct RetinaReport {
  std::uint64_t summed = 0;
  std::uint64_t excluded = 0;  ///< the slices' looks meet different faces
  std::uint64_t outside = 0;   ///< some slice is not lit, not seen or seen at a graze
  double worst_off = 0.0;
  double worst_look = 0.0;  ///< how far a slice's look lies from the direction it was asked for

  double excluded_share() const { return static_cast<double>(excluded) / static_cast<double>(excluded + summed); }
};

RetinaScene scene(std::string name, const Drawable& surface, double most_off, double most_excluded) {
  RetinaScene made;
  made.name = std::move(name);
  made.most_off = most_off;
  made.most_excluded = most_excluded;
  made.stage.surfaces = {support::surface_of(surface)};
  const Rigid slanted{{0.0, 0.0, -0.75}, glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, 0.0)))};
  made.stage.objects = {support::object_of(support::standing(support::rectangle({9.0, 9.0}), slanted))};
  Project project;
  Projector projector;
  projector.fx_px = projector.fy_px = 900.0;
  projector.pose = support::looking({0.1, 0.15, 0.05}, {0.0, 0.0, -0.5});
  project.projectors.push_back(projector);
  project.slices.powers_d = {0.5, -1.5, -0.5, 1.5};
  made.settings = compile_settings(project);
  return made;
}

std::vector<RetinaScene> retina_scenes() {
  using namespace support;
  const auto at = [](double x, double z, double turn = 0.0) {
    return Rigid{{x, 0.0, z}, glm::angleAxis(turn, glm::normalize(glm::dvec3(0.1, 1.0, 0.0)))};
  };
  return {scene("plane", standing(rectangle({1.6, 1.2}), at(0.0, -0.5, 0.6)), 1e-6, 0.0),
          scene("corner", standing(fold({0.8, 1.2}, 90.0), at(0.15, -0.7)), 1e-6, 0.01),
          scene("step", standing(step({1.6, 1.2}, 0.1), at(0.03, -0.5)), 1e-6, 0.01),
          scene("waves of 20,000 triangles", standing(bumpy({1.4, 1.1}, 0.03, 100, 1.5), at(0.0, -0.52)), 2e-3, 0.0),
          scene("bowl of 20,000 triangles", standing(bumpy({1.4, 1.1}, 0.15, 100, 0.5), at(0.0, -0.6)), 2e-3, 0.0),
          // What is left falls with the size of the facets to 1e-3, the bend of the surface itself: 6 mm facets here;
          // a ball of 0.3 m from as many, with 9 mm facets, is 2.2e-3 off.
          scene("ball of 30,000 triangles", standing(blob(0.2, 50, 0.0, 3), at(0.0, -0.7)), 2e-3, 0.0)};
}

/// What an eye meets in one direction through one slice.
struct Met {
  std::uint32_t part = 0;
  double weight = 0.0;
  glm::dvec2 look{0.0};
};

/// Follows a direction out of the pupil through the thin lens to the surface, and asks the reference what is shown
/// there.
class Retina {
 public:
  explicit Retina(const RetinaScene& scene)
      : scene_(scene),
        samples_(*Samples::of(scene.stage, scene.settings)),
        room_(room_of(scene.stage, scene.settings)),
        parts_(smooth_parts(*scene.stage.surfaces[0].drawables[0].mesh)) {}

  std::optional<Met> met(Side side, const glm::dvec2& direction, std::size_t n) const {
    const double lens_to_pupil_m = scene_.settings.lens_to_pupil_m;
    const Rigid world_from_eye = samples_.eye(side).eye_from_world.inverse();
    // Backwards through the lens: the slope beyond it is that before it less the height times the power.
    const glm::dvec2 height = direction * lens_to_pupil_m;
    const glm::dvec2 beyond = direction - height * scene_.settings.slices.powers_d[n];
    const glm::dvec3 from_m = world_from_eye.point({height, -lens_to_pupil_m});
    const glm::dvec3 along = world_from_eye.direction({beyond, -1.0});
    const auto first = room_.surfaces.first(from_m, along, 0.0);
    if (!first) return std::nullopt;
    const glm::dvec3 spot_m = from_m + along * first->along;
    const ProjectorModel& projector = scene_.settings.projector;
    const glm::dvec3 seen_m = projector.world_from_projector.inverse().point(spot_m);
    if (seen_m.z >= 0.0) return std::nullopt;
    const glm::dvec2 pixel = pixel_of_tangent(projector, glm::dvec2(seen_m) / -seen_m.z);
    if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x > projector.width_px || pixel.y > projector.height_px) {
      return std::nullopt;
    }
    const auto lit = samples_.lit(pixel);
    if (!lit || glm::length(lit->world_m - spot_m) > 1e-6) return std::nullopt;
    const auto eye = samples_.seen(side, *lit);
    if (!eye || !upright(*eye)) return std::nullopt;
    const auto sample = samples_.slice(side, *eye, n);
    if (!sample) return std::nullopt;
    return Met{parts_.part_of_triangle[lit->face], sample->weight, sample->look};
  }

 private:
  /// Under 65 degrees off the surface's normal.
  static bool upright(const EyePoint& eye) {
    constexpr double cos_65_deg = 0.42261826174069944;
    const double cosine = glm::dot(eye.normal, eye.point_m) / (glm::length(eye.normal) * glm::length(eye.point_m));
    return std::abs(cosine) > cos_65_deg;
  }

  const RetinaScene& scene_;
  Samples samples_;
  forward::Room room_;
  SmoothParts parts_;
};

void look_there(const Retina& retina, Side side, const glm::dvec2& direction, std::size_t slices,
                RetinaReport& report) {
  double sum = 0.0, off_look = 0.0;
  std::optional<std::uint32_t> part;
  bool several = false;
  for (std::size_t n = 0; n < slices; ++n) {
    const auto met = retina.met(side, direction, n);
    if (!met) {
      ++report.outside;
      return;
    }
    several = several || (part && *part != met->part);
    part = met->part;
    sum += met->weight;
    off_look = std::max(off_look, glm::length(met->look - direction));
  }
  ++(several ? report.excluded : report.summed);
  report.worst_look = std::max(report.worst_look, off_look);
  if (!several) report.worst_off = std::max(report.worst_off, std::abs(sum - 1.0));
}

RetinaReport looked_around(const RetinaScene& scene) {
  const Retina retina(scene);
  RetinaReport report;
  for (const Side side : both_sides) {
    for (int y = 0; y < directions_per_side; ++y) {
      for (int x = 0; x < directions_per_side; ++x) {
        const glm::dvec2 direction{-0.6 + 1.2 * (x + 0.37) / directions_per_side,
                                   -0.5 + 1.0 * (y + 0.61) / directions_per_side};
        look_there(retina, side, direction, scene.settings.slices.powers_d.size(), report);
      }
    }
  }
  return report;
}

}  // namespace

TEST_CASE("seen in one direction, the weights of all slices make one") {
  for (const RetinaScene& scene : retina_scenes()) {
    INFO(scene.name);
    const RetinaReport report = looked_around(scene);
    MESSAGE(scene.name << ": " << report.summed << " directions, sum off by at most " << report.worst_off << ", "
                       << 100.0 * report.excluded_share() << " % excluded for meeting several faces, " << report.outside
                       << " outside");
    CHECK(report.summed > 5000);
    CHECK(report.worst_off <= scene.most_off);
    CHECK(report.excluded_share() <= scene.most_excluded);
    CHECK(report.worst_look < 1e-9);  // the look of a slice is the direction from which its light arrives
  }
}

TEST_CASE("on planes the nearest rule makes one, too") {
  RetinaScene scene = retina_scenes()[0];
  scene.settings.slices.assignment = Assignment::nearest;
  CHECK(looked_around(scene).worst_off <= 1e-6);
}

TEST_CASE("without the lens' breathing the looks part and the sums fail") {
  RetinaScene scene = retina_scenes()[0];
  scene.settings.slices.breathing = Breathing::off;
  const RetinaReport report = looked_around(scene);
  CHECK(report.worst_look > 1e-3);
  CHECK(report.worst_off > 1e-3);
}
