#include "core/scene/fields_project.h"

#include <cmath>
#include <set>

#include "core/scene/number_text.h"

namespace focalstage {
namespace {

template <class Item>
bool names_differ(Reading& reading, std::string_view list, const std::vector<Item>& items) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (names.insert(items[i].name).second) continue;
    const Reading::Step in_list(reading, list);
    const Reading::Step at_item(reading, i);
    return reading.fail_at("name", "project.duplicate", "\"" + items[i].name + "\" is the name of an earlier item too",
                           "give each item of " + std::string(list) + " a name of its own");
  }
  return true;
}

/// At 1/d_e the virtual image of the lens meets the pupil and the stretched look (design section 5) has no direction.
bool powers_fit(Reading& reading, const Project& project) {
  const double limit_d = 1000.0 / project.glasses.lens_to_pupil_mm;
  const std::vector<double>& powers = project.slices.powers_d;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (std::abs(powers[i]) < limit_d) continue;
    const Reading::Step slices(reading, "slices");
    const Reading::Step list(reading, "powers_d");
    const Reading::Step item(reading, i);
    return reading.fail("project.range", number_text(powers[i]) + " D is beyond 1/lens_to_pupil",
                        "choose a power within " + number_text(limit_d) + " D of zero");
  }
  return true;
}

bool depths_exist(Reading& reading, const Project& project) {
  const auto count = static_cast<int>(project.slices.powers_d.size());
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Depth& depth = project.objects[i].depth;
    if (depth.mode != DepthMode::slice || depth.index < count) continue;
    const Reading::Step list(reading, "objects");
    const Reading::Step item(reading, i);
    const Reading::Step member(reading, "depth");
    return reading.fail_at(
        "index", "project.range",
        "slice " + std::to_string(depth.index) + " does not exist; there are " + std::to_string(count),
        "choose 0 to " + std::to_string(count - 1) + ", or add a slice");
  }
  return true;
}

}  // namespace

bool Table<Slices>::check(Reading& reading, const Slices& slices) {
  std::set<double> powers;
  for (std::size_t i = 0; i < slices.powers_d.size(); ++i) {
    if (powers.insert(slices.powers_d[i]).second) continue;
    const Reading::Step list(reading, "powers_d");
    const Reading::Step item(reading, i);
    return reading.fail("project.duplicate", number_text(slices.powers_d[i]) + " D is listed twice",
                        "list each power once");
  }
  const int samples = slices.samples_per_pixel;
  if (samples == 1 || samples == 4 || samples == 9 || samples == 16) return true;
  return reading.fail_at("samples_per_pixel", "project.range", std::to_string(samples) + " is not a square number",
                         "choose 1, 4, 9 or 16");
}

bool check_project(Reading& reading, const Project& project) {
  if (project.projectors.empty()) {
    return reading.fail_at("projectors", "project.count", "is empty", "add a projector");
  }
  return names_differ(reading, "projectors", project.projectors) &&
         names_differ(reading, "surfaces", project.surfaces) && names_differ(reading, "objects", project.objects) &&
         names_differ(reading, "lights", project.lights) && names_differ(reading, "cues", project.cues) &&
         powers_fit(reading, project) && depths_exist(reading, project);
}

}  // namespace focalstage
