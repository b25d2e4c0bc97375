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

TEST_CASE("slots of a rig that can't see its light are not measured, which is no miss") {
  RigState state;
  state.state = "playing";
  SlotReport slot;
  slot.slot = 3;
  slot.asked_power_d = slot.delivered_power_d = -0.5;
  slot.exposures = 0;
  slot.unmeasured = true;
  state.slots = {slot};
  const std::string text = state_text(state);
  CHECK(text.find("not measured") != std::string::npos);
  CHECK(text.find("no slot was measured") != std::string::npos);
  CHECK(text.find("NO") == std::string::npos);
  CHECK(text.find("delivered\n") == text.rfind("delivered\n"));  // the column's name, and no count
  const Value blind = (*value_of(state).find("slots")->array())[0];
  CHECK(*blind.find("measured") == Value(false));
  CHECK(blind.find("delivered")->is_null());
  CHECK(blind.find("delivered_power_d")->is_null());
  CHECK(*blind.find("asked_power_d") == Value(-0.5));

  state.slots[0].unmeasured = false;
  CHECK(state_text(state).find("0 of 1 slots delivered") != std::string::npos);
  const Value seen = (*value_of(state).find("slots")->array())[0];
  CHECK(*seen.find("measured") == Value(true));
  CHECK(*seen.find("delivered") == Value(false));
}
