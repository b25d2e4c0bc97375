#include <fstream>
#include <functional>
#include <thread>

#include <doctest/doctest.h>

#include "devices/roles/clock.h"
#include "devices/sample/packets.h"
#include "devices/sample/probe.h"
#include "devices/sample/sample_input.h"
#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = monotonic_s() + seconds; monotonic_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

void write(const std::filesystem::path& file, const std::string& line) {
  std::ofstream(file.string() + ".new") << line << '\n';
  std::filesystem::rename(file.string() + ".new", file);  // never seen half written
}

TEST_CASE("lines are motions, or nothing") {
  const auto read = sample_deflection("push 0.5 0 -1 turn 0 -0.25 0 buttons 3");
  REQUIRE(read);
  CHECK(*read == Deflection{{0.5, 0.0, -1.0}, {0.0, -0.25, 0.0}, 3});
  CHECK_FALSE(sample_deflection(""));
  CHECK_FALSE(sample_deflection("push 0.5 0 0"));
  CHECK_FALSE(sample_deflection("push 1.5 0 0 turn 0 0 0 buttons 0"));
  CHECK_FALSE(sample_deflection("push nan 0 0 turn 0 0 0 buttons 0"));
  CHECK_FALSE(sample_deflection("push 0 0 0 turn 0 0 0 buttons 0 more"));
}

TEST_CASE("it is found, opened, moved, unplugged and found again") {
  const TemporaryFolder folder;
  CHECK(probe_sample(folder.path()).empty());
  const auto input = make_sample_input({folder / "left.motion"});
  CHECK(input->open().fault().code == "input.absent");
  CHECK(input->state().phase == DevicePhase::lost);

  write(folder / "left.motion", "push 0.5 0 0 turn 0 0 0 buttons 0");
  REQUIRE(probe_sample(folder.path()).size() == 1);
  CHECK(probe_sample(folder.path())[0] == input->id());
  REQUIRE(input->open().ok());
  CHECK(input->state().phase == DevicePhase::ready);
  CHECK(input->deflection().push.x == 0.5);
  CHECK_FALSE(input->identify().ok());
  write(folder / "left.motion", "push 0 0 0 turn 0 1 0 buttons 1");
  CHECK(within(3.0, [&] { return input->deflection() == Deflection{{}, {0.0, 1.0, 0.0}, 1}; }));

  std::filesystem::remove(folder / "left.motion");
  CHECK(within(3.0, [&] { return input->state().phase == DevicePhase::lost; }));
  CHECK(input->deflection() == Deflection{});
  CHECK(input->state().fault->code == "input.lost");
  write(folder / "left.motion", "push 0 0 1 turn 0 0 0 buttons 0");
  CHECK(input->open().ok());
  CHECK(input->deflection().push.z == 1.0);
  write(folder / "left.motion", "what is this");
  CHECK(within(3.0, [&] { return input->state().fault.has_value(); }));
  CHECK(input->state().fault->code == "input.damaged");
  input->close();
  CHECK(input->state().phase == DevicePhase::off);
}

}  // namespace
}  // namespace focalstage
