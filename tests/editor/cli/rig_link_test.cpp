#include "editor/cli/rig_link.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("the line of a rig's state tells the delay of poses, where something is tracked") {
  RigState state;
  state.state = "playing";
  state.sweeps = 12;
  state.holder = "anna";
  CHECK(state_line(state) == "playing: 12 sweeps, 0 exposures missed, 0 sweeps late, frame 0, held by anna\n");
  state.pose_to_light_ms = 121.6;
  CHECK(state_line(state).find(", 122 ms from pose to light, held by anna") != std::string::npos);
  CHECK(*value_of(state).find("pose_to_light_ms") == Value(121.6));
}
