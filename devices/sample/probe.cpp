#include "devices/sample/probe.h"

#include <algorithm>
#include <system_error>

namespace focalstage {

std::vector<DeviceId> probe_sample(const std::filesystem::path& folder) {
  std::vector<DeviceId> found;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() != ".motion") continue;
    found.push_back({"sample", "motion from a file", entry.path().stem().string(), entry.path().string()});
  }
  std::ranges::sort(found, {}, &DeviceId::address);
  return found;
}

}  // namespace focalstage
