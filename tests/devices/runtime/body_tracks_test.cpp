#include "devices/runtime/body_tracks.h"

#include <doctest/doctest.h>

#include "devices/runtime/pose_delay.h"

namespace focalstage {
namespace {

TrackedFrame frame_at(double time_s, std::vector<TrackedBody> bodies) {
  return {static_cast<std::int64_t>(1e3 * time_s), 70.0 + time_s, 0.004, time_s + 0.004, std::move(bodies)};
}

TrackedBody body(std::int32_t id, const std::string& name, double x_m, bool tracked = true) {
  return {id, name, tracked, {{x_m, 0, 0}, {}}, 0.0};
}

TEST_CASE("bodies go by name, or by number, and are predicted from when their light fell") {
  BodyTracks tracks;
  CHECK_FALSE(tracks.newest());
  CHECK(tracks.at(1.0).empty());
  for (int k = 0; k <= 10; ++k) tracks.take(frame_at(0.01 * k, {body(7, "Head", 0.01 * k), body(3, "", 1.0)}));
  CHECK(tracks.newest()->count == 11);
  CHECK(tracks.newest()->seen_s == doctest::Approx(0.1));
  const BodyPoses poses = tracks.at(0.16);
  CHECK(poses.size() == 2);
  CHECK(poses.at("Head")->position_m.x == doctest::Approx(0.16));
  CHECK(poses.at("3")->position_m.x == 1.0);
}

TEST_CASE("not tracked, or not there any more: no pose, then doubt") {
  BodyTracks tracks;
  tracks.take(frame_at(0.0, {body(7, "Head", 0.0), body(8, "Box", 0.0)}));
  tracks.take(frame_at(0.05, {body(7, "Head", 0.0, false)}));
  CHECK_FALSE(tracks.at(0.05).at("Head"));
  CHECK_FALSE(tracks.at(0.05).at("Box"));
  const TrackerState fine{TrackerPhase::tracking, std::nullopt, 2, 0, 0};
  CHECK_FALSE(tracks.doubt({"Head", "Box"}, fine, 0.09, 0.09));
  CHECK_FALSE(tracks.doubt({}, fine, 9.0, 0.09));
  const auto doubt = tracks.doubt({"Head"}, fine, 0.095, 0.09);
  REQUIRE(doubt);
  CHECK(doubt->code == "rig.tracker");
  CHECK(doubt->where == "body Head");
  CHECK(doubt->message == "it is not seen any more");
  CHECK(tracks.doubt({"Cat"}, fine, 0.0, 0.09)->message == "the tracker knows no such body");
  const TrackerState lost{TrackerPhase::lost, Fault{"tracker.lost", "1.2.3.4", "no frame came", ""}, 2, 0, 0};
  CHECK(tracks.doubt({"Box"}, lost, 0.2, 0.09)->message.find("no frame came") != std::string::npos);
}

TEST_CASE("the delay of poses: a guess until light came, then measured") {
  PoseDelay delay(0.12);
  CHECK(delay.lead_s() == 0.12);
  CHECK(delay.pose_to_light_s() == 0.0);
  delay.follow(true);
  delay.lit(10.0, 10.01, 10.15);
  CHECK(delay.pose_to_light_s() == doctest::Approx(0.15));
  for (int k = 0; k < 100; ++k) delay.lit(10.0, 10.01, 10.11);
  CHECK(delay.lead_s() == doctest::Approx(0.1).epsilon(1e-4));
  CHECK(delay.pose_to_light_s() == doctest::Approx(0.11).epsilon(1e-4));
  delay.follow(false);
  CHECK(delay.pose_to_light_s() == 0.0);
  delay.lit(10.0, 10.01, 10.11);  // of a show that was on its way
  CHECK(delay.pose_to_light_s() == 0.0);
}

}  // namespace
}  // namespace focalstage
