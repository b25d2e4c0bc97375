#include <doctest/doctest.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/compile/compile.h"
#include "core/schedule/schedule.h"
#include "io/show/reader.h"
#include "io/show/writer.h"
#include "tests/exact/sample_projects.h"

// Two projectors on a leaning, folded screen, a rod in the light of both: rays go out from every pixel of either with
// the light of its codes, read from the show file, and what falls on patches of 5 mm is added up. Room, lens and light
// are written out here once more; of the compiler nothing is asked.

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr double patch_m = 0.005;
constexpr int rays_across = 6;  ///< of a pixel
constexpr double lens_m = 0.015;

struct Box {
  glm::dvec3 low, high;

  /// Whether the way from `from` along `way` (0 to `end`) passes through.
  bool stops(const glm::dvec3& from, const glm::dvec3& way, double end) const {
    const glm::dvec3 a = (low - from) / way, b = (high - from) / way;
    const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
    const double in = std::max({near.x, near.y, near.z}), out = std::min({far.x, far.y, far.z});
    return in < out && out > 1e-9 && in < end;
  }
};

/// The screen: two wings about a fold, each by how far from it and how high.
struct Screen {
  Rigid world_from_screen;
  double wing_m, height_m, lift;

  explicit Screen(const Surface& surface) : world_from_screen(surface.placement.pose) {
    const auto& corner = std::get<CornerMesh>(surface.mesh.shape);
    wing_m = corner.size_m.x;
    height_m = corner.size_m.y;
    lift = (180.0 - corner.angle_deg) / 2.0 * 3.14159265358979323846 / 180.0;
  }
  glm::dvec3 along(int wing) const { return {(wing == 0 ? -1.0 : 1.0) * std::cos(lift), 0.0, std::sin(lift)}; }
  glm::dvec3 at(int wing, double u_m, double v_m) const {
    return world_from_screen.point(u_m * along(wing) + glm::dvec3(0.0, v_m, 0.0));
  }
  struct Hit {
    int wing = -1;
    double way = 1e300, u_m = 0.0, v_m = 0.0;
  };
  Hit hit(const glm::dvec3& from_m, const glm::dvec3& way) const {
    const Rigid screen_from_world = world_from_screen.inverse();
    const glm::dvec3 from = screen_from_world.point(from_m), to = screen_from_world.direction(way);
    Hit first;
    for (int wing = 0; wing < 2; ++wing) {
      const glm::dvec3 u = along(wing), normal = glm::cross(u, glm::dvec3(0.0, 1.0, 0.0));
      const double t = -glm::dot(normal, from) / glm::dot(normal, to);
      const glm::dvec3 point = from + t * to;
      const double u_m = glm::dot(point, u);
      if (t > 1e-9 && t < first.way && u_m >= 0.0 && u_m < wing_m && std::abs(point.y) < height_m / 2.0)
        first = {wing, t, u_m, point.y};
    }
    return first;
  }
};

Box rod_of(const Surface& surface, double wider_m = 0.0) {
  const glm::dvec3 half = std::get<BoxMesh>(surface.mesh.shape).size_m / 2.0 + wider_m;
  return {surface.placement.pose.position_m - half, surface.placement.pose.position_m + half};
}

struct Lamp {
  Projector it;
  std::vector<double> light;  ///< [row][column], of all exposures of the left eye

  double bend(double r2) const {
    return it.distortion.empty() ? 1.0 : 1.0 + it.distortion[0] * r2 + it.distortion[1] * r2 * r2;
  }
  glm::dvec3 way(double x_px, double y_px) const {
    const glm::dvec2 bent((x_px - it.cx_px) / it.fx_px, (y_px - it.cy_px) / it.fy_px);
    glm::dvec2 straight = bent;
    for (int k = 0; k < 30; ++k) straight = bent / bend(glm::dot(straight, straight));
    return it.pose.direction({straight.x, -straight.y, -1.0});
  }
  glm::dvec2 pixel(const glm::dvec3& world_m) const {
    const glm::dvec3 seen = it.pose.inverse().point(world_m);
    const glm::dvec2 straight(seen.x / -seen.z, -seen.y / -seen.z);
    const glm::dvec2 bent = straight * bend(glm::dot(straight, straight));
    return {it.cx_px + it.fx_px * bent.x, it.cy_px + it.fy_px * bent.y};
  }
  bool lights(const glm::dvec3& world_m, const Screen& screen, const Box& rod) const {
    const glm::dvec2 at = pixel(world_m);
    if (at.x < 0.0 || at.y < 0.0 || at.x > it.width_px || at.y > it.height_px) return false;
    const glm::dvec3 way = world_m - it.pose.position_m;
    return !rod.stops(it.pose.position_m, way, 1.0) && screen.hit(it.pose.position_m, way).way > 1.0 - 1e-6;
  }
};

using Change = std::function<void(CompileSettings&)>;

/// The sample without its ball, through a show file; `change` spoils what the compiler is told.
std::vector<Lamp> lamps_of(const Project& project, const Opened& sample, const Change& change) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("focalstage-blend-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto path = folder / "show.h5";
  std::vector<CompileSettings> settings{compile_settings(project, 0), compile_settings(project, 1)};
  std::vector<Schedule> schedules;
  for (std::size_t i = 0; i < 2; ++i) schedules.push_back(make_schedule(project, settings[i].images, i).schedule);
  ShowHeader header =
      make_show_header(project, project_text(project), sample.loaded, schedules[0], settings[0], {0, 1});
  header.others = {show_projector(project, 1, settings[1], schedules[1])};
  Result<ShowWriter> writer = ShowWriter::start(path, header, false, 0);
  REQUIRE(writer);
  const Stage stage = staged(project, sample.loaded.assets, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    change(settings[i]);
    const auto compiled = Compiler(settings[i]).frame(stage);
    REQUIRE(compiled);
    CHECK(compiled->measure.clipped_pixels == 0);
    REQUIRE(writer->add_frame(0, compiled->images, compiled->measure, i));
  }
  REQUIRE(writer->finish());
  const Result<ShowReader> show = ShowReader::open(path);
  REQUIRE(show);
  std::vector<Lamp> lamps;
  for (std::size_t i = 0; i < 2; ++i) {
    const Result<FrameImages> images = show->frame(0, i);
    REQUIRE(images);
    Lamp lamp{project.projectors[i], std::vector<double>(images->bytes_per_image(), 0.0)};
    const double per_pixel = *lamp.it.lumens / (static_cast<double>(lamp.it.width_px) * lamp.it.height_px);
    for (std::size_t n = 0; n < project.slices.powers_d.size(); ++n) {  // the left eye's stand first
      for (std::size_t k = 0; k < lamp.light.size(); ++k) {
        const double share = std::pow(images->image(n)[k] / 255.0, lamp.it.gamma);
        lamp.light[k] += per_pixel * (lamp.it.black_level + (1.0 - lamp.it.black_level) * share);
      }
    }
    lamps.push_back(std::move(lamp));
  }
  std::filesystem::remove_all(folder);
  return lamps;
}

struct Patches {
  int across, high;
  std::vector<double> light;  ///< [wing][u][v], lumens
  explicit Patches(const Screen& screen)
      : across(static_cast<int>(std::lround(screen.wing_m / patch_m))),
        high(static_cast<int>(std::lround(screen.height_m / patch_m))),
        light(static_cast<std::size_t>(2 * across * high), 0.0) {}
  std::size_t at(int wing, int u, int v) const { return static_cast<std::size_t>((wing * across + u) * high + v); }
};

/// Forward: every ray of every pixel to where it ends.
Patches cast(const std::vector<Lamp>& lamps, const Screen& screen, const Box& rod) {
  Patches sum(screen);
  for (const Lamp& lamp : lamps) {
    constexpr int bands = 16;
    std::vector<Patches> parts(bands, Patches(screen));
    tbb::parallel_for(0, bands, [&](int band) {
      Patches& part = parts[static_cast<std::size_t>(band)];
      for (int y = band; y < lamp.it.height_px; y += bands) {
        for (int x = 0; x < lamp.it.width_px; ++x) {
          const double each =
              lamp.light[static_cast<std::size_t>(y * lamp.it.width_px + x)] / rays_across / rays_across;
          for (int k = 0; k < rays_across * rays_across; ++k) {
            const glm::dvec3 way =
                lamp.way(x + (k % rays_across + 0.5) / rays_across, y + (k / rays_across + 0.5) / rays_across);
            const Screen::Hit hit = screen.hit(lamp.it.pose.position_m, way);
            if (hit.wing < 0 || rod.stops(lamp.it.pose.position_m, way, hit.way)) continue;
            const int u = static_cast<int>(hit.u_m / patch_m);
            const int v = static_cast<int>((hit.v_m + screen.height_m / 2.0) / patch_m);
            part.light[part.at(hit.wing, std::min(u, part.across - 1), std::min(v, part.high - 1))] += each;
          }
        }
      }
    });
    for (const Patches& part : parts) {
      for (std::size_t i = 0; i < sum.light.size(); ++i) sum.light[i] += part.light[i];
    }
  }
  return sum;
}

/// Where a patch lies.
enum class Place { outside, alone, both, rim };

/// What of the sheet the left eye sees there: looked at from the pupil, through slices that bend by up to `most_d`.
bool shows_sheet(const glm::dvec3& point_m, const Box& wide_rod, const Object& sheet) {
  const glm::dvec3 pupil(-0.0315, 0.0, 0.0);
  const glm::dvec3 look = (point_m - pupil) / -point_m.z;
  if (wide_rod.stops(pupil, point_m - pupil, 1.0)) return false;
  const glm::dvec3 on_sheet = pupil + look * -sheet.placement.pose.position_m.z;
  const glm::dvec2 half = std::get<PlaneMesh>(sheet.mesh.shape).size_m / 2.0 - 0.02;  // slices' looks differ a little
  return std::abs(on_sheet.x) < half.x && std::abs(on_sheet.y) < half.y;
}

Place place_of(const std::vector<Lamp>& lamps, const Screen& screen, const Project& project, int wing, int u, int v) {
  const Box rod = rod_of(project.surfaces[1]), wide_rod = rod_of(project.surfaces[1], 0.002);
  constexpr int points = 6;
  std::array<int, 2> lit{};
  for (int k = 0; k < points * points; ++k) {
    const glm::dvec3 point = screen.at(wing, (u + (k % points) / (points - 1.0)) * patch_m,
                                       (v + (k / points) / (points - 1.0)) * patch_m - screen.height_m / 2.0);
    if (!shows_sheet(point, wide_rod, project.objects[0])) return Place::outside;
    for (std::size_t i = 0; i < 2; ++i) lit[i] += lamps[i].lights(point, screen, rod) ? 1 : 0;
  }
  constexpr int all = points * points;
  if (lit[0] < all && lit[1] < all) return Place::outside;  // no projector lights all of it
  if (lit[0] == all && lit[1] == all) return Place::both;
  return lit[0] == 0 || lit[1] == 0 ? Place::alone : Place::rim;
}

struct Evenness {
  double worst = 0.0;  ///< off the mean, as a share of it
  double mean = 0.0;   ///< lumens per square metre
  std::array<int, 4> patches{};
  std::array<double, 4> worst_in{};
};

Evenness evenness(const Project& project, const Opened& sample, const Change& change) {
  const std::vector<Lamp> lamps = lamps_of(project, sample, change);
  const Screen screen(project.surfaces[0]);
  const Patches patches = cast(lamps, screen, rod_of(project.surfaces[1]));
  std::vector<std::pair<double, Place>> looked_at;
  Evenness even;
  for (int wing = 0; wing < 2; ++wing) {
    for (int u = 0; u < patches.across; ++u) {
      for (int v = 0; v < patches.high; ++v) {
        const Place place = place_of(lamps, screen, project, wing, u, v);
        if (place == Place::outside) continue;
        looked_at.emplace_back(patches.light[patches.at(wing, u, v)] / (patch_m * patch_m), place);
        even.mean += looked_at.back().first;
      }
    }
  }
  REQUIRE(!looked_at.empty());
  even.mean /= static_cast<double>(looked_at.size());
  for (const auto& [light, place] : looked_at) {
    const double off = std::abs(light / even.mean - 1.0);
    const auto in = static_cast<std::size_t>(place);
    ++even.patches[in];
    even.worst_in[in] = std::max(even.worst_in[in], off);
    even.worst = std::max(even.worst, off);
  }
  return even;
}

}  // namespace

TEST_CASE("two projectors on a leaning fold, a rod before it: even within 2 % over the overlap and across all rims") {
  Opened sample = opened(FOCALSTAGE_SOURCE_DIR "/projects/two-projectors");
  Project project = sample.project;
  REQUIRE(project.projectors.size() == 2);
  REQUIRE(project.objects[0].name == "sheet");
  project.objects.resize(1);  // the ball is a picture of its own
  const Evenness blended = evenness(project, sample, [](CompileSettings&) {});
  MESSAGE(blended.patches[1] << " patches lit by one, " << blended.patches[2] << " by both, " << blended.patches[3]
                             << " across a rim; worst " << 100.0 * blended.worst_in[1] << ", "
                             << 100.0 * blended.worst_in[2] << ", " << 100.0 * blended.worst_in[3] << " %");
  CHECK(blended.patches[1] > 300);
  CHECK(blended.patches[2] > 1000);
  CHECK(blended.patches[3] > 50);
  CHECK(blended.worst < 0.02);
  // As bright as was asked: 0.55 of the sheet's 0.8, of full white of the dimmer projector at 0.9 m.
  const double white = 400.0 / (1024.0 * 768.0) * 1900.0 * 1900.0 / (0.9 * 0.9);
  CHECK(blended.mean == doctest::Approx(0.55 * 0.8 * white).epsilon(0.01));

  const Evenness off = evenness(project, sample, [](CompileSettings& settings) { settings.blend.clear(); });
  CHECK(off.worst > 0.2);
  const Evenness wrong =
      evenness(project, sample, [](CompileSettings& settings) { settings.blend_own = 1 - settings.blend_own; });
  CHECK(wrong.worst > 0.2);
  const Evenness steep = evenness(project, sample, [](CompileSettings& settings) { settings.blend[1].level = 1.0; });
  CHECK(steep.worst > 0.05);  // projectors of unlike brightness taken for alike
}
