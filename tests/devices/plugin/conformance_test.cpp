#include "tests/devices/plugin/conformance.h"

#include <doctest/doctest.h>

#include "tests/devices/plugin/emulator/optics.h"
#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

using test::Conformance;
using wire_emulator::Optics;

PluginProjectorSettings settings_for(const std::string& name) {
  PluginProjectorSettings settings;
  settings.plugin.library = std::string(FOCALSTAGE_BINARY_DIR) + "/plugins/" + name + ".so";
  settings.eye_safe = true;
  return settings;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

/// What the null plugin with one defect breaks.
std::string broken_by(const std::string& defect) {
  return joined(Conformance(settings_for("plugin_mutant_" + defect)).run());
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("the null plugin conforms") {
  PluginProjectorSettings settings = settings_for("focalstage-null");
  CHECK(joined(Conformance(settings).run()) == "");
  settings.plugin.options = {{"width", "16"}, {"height", "9"}};
  const auto projector = make_plugin_projector(settings);
  REQUIRE(projector->open().ok());
  CHECK(projector->abilities().width_px == 16);
  CHECK(projector->abilities().pacing == Pacing::master);
}

TEST_CASE("the wire plugin conforms, and what it was given is what comes to light") {
  const TemporaryFolder folder;
  const auto optics = Optics::start({.socket = (folder / "optics").string()});
  REQUIRE(optics);
  PluginProjectorSettings settings = settings_for("focalstage-wire");
  settings.plugin.options = {{"socket", (folder / "optics").string()}};
  CHECK(joined(Conformance(settings).run()) == "");
  const auto record = optics->record();
  CHECK(record.broken == "");
  CHECK_FALSE(record.triggers);
  REQUIRE(record.light.size() >= 48);
  for (std::size_t i = 0; i < 48; ++i) {
    CHECK(record.light[i].period == i / 4);
    CHECK(record.light[i].exposure == i % 4);
    CHECK(record.light[i].code == i + 1);
  }
}

TEST_CASE("mutants do not pass") {
  CHECK(broken_by("abi") == "opens: plugin.abi");
  CHECK(broken_by("size") == "opens: plugin.size");
  CHECK(broken_by("call") == "opens: plugin.calls");
  CHECK(has(broken_by("lie"), "answers while it misses"));
  CHECK(has(broken_by("back"), "answers while it shows"));
  CHECK(broken_by("room") == "holds what it said");
  CHECK(has(broken_by("lit"), "gives no buffer while blank"));
}

TEST_CASE("mutants that hang or fall silent do not pass, and keep nobody waiting") {
  CHECK(has(broken_by("silent"), "answers while it shows"));
  CHECK(has(broken_by("stuck"), "answers while it shows"));
  CHECK(has(broken_by("blank_hangs"), "dark"));
  CHECK(has(broken_by("hang"), "counts what it shows"));
}

}  // namespace
}  // namespace focalstage
