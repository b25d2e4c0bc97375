#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

// The simulator knows what hardware knows: it reads no show and no schedule (design section 8).

namespace focalstage {
namespace {

/// What in `text` a simulated rig must not include or call.
std::vector<std::string> forbidden_in(const std::string& text) {
  static const std::regex include(R"(#include\s*[<"]([^>"]+)[>"])");
  static const std::regex name(
      R"(\b(Show\w*|Schedule|make_schedule|Slot|slots?|lens_power_d|header|image_plan|ImageSpec|Project|H5\w*|hid_t|ifstream|fopen)\b)");
  std::vector<std::string> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), include); it != std::sregex_iterator(); ++it) {
    const std::string path = (*it)[1];
    const bool allowed = path.starts_with("devices/sim/") || path.starts_with("devices/roles/") ||
                         path.starts_with("core/base/") || path.starts_with("glm/") || path == "pthread.h" ||
                         path == "sched.h" ||
                         (path.find('/') == std::string::npos && path.find('.') == std::string::npos);
    if (!allowed) found.push_back(path);
  }
  for (auto it = std::sregex_iterator(text.begin(), text.end(), name); it != std::sregex_iterator(); ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

TEST_CASE("the simulator includes and names nothing of shows and schedules") {
  int files = 0;
  for (const char* room : {"sim", "roles"}) {
    const std::filesystem::path folder = std::filesystem::path(FOCALSTAGE_SOURCE_DIR) / "devices" / room;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      ++files;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      for (const std::string& word : forbidden_in(text)) FAIL_CHECK(entry.path().filename().string(), ": ", word);
    }
  }
  CHECK(files >= 18);
}

TEST_CASE("a planted break is found") {
  CHECK(forbidden_in("#include \"io/show/reader.h\"") == std::vector<std::string>{"io/show/reader.h"});
  CHECK(forbidden_in("#include \"core/schedule/schedule.h\"").size() == 1);
  CHECK(forbidden_in("const auto& asked = show.slots;").size() == 1);
  CHECK(forbidden_in("ShowReader::open(path)").size() == 1);
  CHECK(forbidden_in("#include <vector>\n#include \"devices/roles/rig_port.h\"").empty());
}

}  // namespace
}  // namespace focalstage
