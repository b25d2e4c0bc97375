#include "devices/recording/recording_text.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <thread>

#include <doctest/doctest.h>

#include "devices/recording/recorded_tracker.h"
#include "devices/recording/recorder.h"

namespace focalstage {
namespace {

TrackedFrame frame_of(std::int64_t number, double arrival_s) {
  TrackedFrame frame{number, 0.1 * static_cast<double>(number), 1.0 / 3.0, arrival_s, {}};
  frame.bodies.push_back(
      {7, "Head", true, {{std::numbers::pi, -1e-17, 1e300}, glm::angleAxis(0.3, glm::dvec3(0, 1, 0))}, 5e-4});
  frame.bodies.push_back({8, "a \"box\", red", false, {}, 0.0});
  return frame;
}

/// Frames 10 ms apart, with a silence of half a second after the third.
TrackerRecording sample() {
  TrackerRecording recording;
  for (const double s : {500.0, 500.01, 500.02, 500.52, 500.53}) {
    recording.push_back(frame_of(40 + static_cast<std::int64_t>(recording.size()), s));
  }
  recording[1].latency_s.reset();
  recording[2].bodies.clear();
  return recording;
}

std::string text_of(const TrackerRecording& recording) {
  std::string text = recording_head();
  for (const TrackedFrame& frame : recording) text += recording_lines(frame);
  return text;
}

Result<TrackerRecording> read(const std::string& text) {
  std::istringstream stream(text);
  return read_recording(stream, "walk.csv");
}

void check_refused(const std::string& text, const std::string& line, const std::string& reason) {
  const auto result = read(text);
  REQUIRE_FALSE(result);
  CHECK(result.fault().code == "recording.format");
  CHECK(result.fault().where == "walk.csv: line " + line);
  CHECK(result.fault().message.find(reason) != std::string::npos);
}

TEST_CASE("what is written is read again to the last bit, also with another's line ends") {
  const TrackerRecording recording = sample();
  const auto again = read(text_of(recording));
  REQUIRE(again);
  CHECK(*again == recording);
  std::string dos;
  for (const char c : text_of(recording)) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(*read(dos) == recording);
}

TEST_CASE("the example of the format's document is read") {
  std::ifstream document(std::string(FOCALSTAGE_SOURCE_DIR) + "/docs/formats/tracking.md");
  std::string all((std::istreambuf_iterator<char>(document)), {});
  const std::size_t begin = all.find("```\n# focalstage") + 4;
  const auto recording = read(all.substr(begin, all.find("```", begin) - begin));
  REQUIRE(recording);
  REQUIRE(recording->size() == 2);
  CHECK(recording->front().bodies.size() == 2);
  CHECK_FALSE(recording->front().bodies[1].tracked);
  CHECK(recording->back().bodies[0].tracker_from_body.position_m.x == 0.251);
}

TEST_CASE("bad files are refused with line and reason") {
  const std::string head = recording_head();
  check_refused("", "1", "begins with");
  check_refused("frame,time_s\n", "1", "begins with");
  check_refused("# focalstage tracking 1\nframe,time_s\n", "2", "columns");
  check_refused(head, "3", "no frame");
  check_refused(head + "1,2,3\n", "3", "3 columns");
  const std::string good = "1,0.5,0.1,2,7,Head,1,0,0,0,0,0,0,1,0\n";
  REQUIRE(read(head + good).ok());
  check_refused(head + good + "\n", "4", "1 columns");
  check_refused(head + "x,0.5,0.1,2,7,Head,1,0,0,0,0,0,0,1,0\n", "3", "frame is no");
  check_refused(head + "1,nan,0.1,2,7,Head,1,0,0,0,0,0,0,1,0\n", "3", "time_s");
  check_refused(head + "1,0.5,-1,2,7,Head,1,0,0,0,0,0,0,1,0\n", "3", "latency_s");
  check_refused(head + "1,0.5,0.1,,7,Head,1,0,0,0,0,0,0,1,0\n", "3", "arrival_s");
  check_refused(head + "1,0.5,0.1,2,7.5,Head,1,0,0,0,0,0,0,1,0\n", "3", "id");
  check_refused(head + "1,0.5,0.1,2,7,Head,yes,0,0,0,0,0,0,1,0\n", "3", "tracked");
  check_refused(head + "1,0.5,0.1,2,7,Head,1,0,inf,0,0,0,0,1,0\n", "3", "column 9");
  check_refused(head + "1,0.5,0.1,2,7,Head,1,0,0,0,0,0,0,0.9,0\n", "3", "rotation");
  check_refused(head + "1,0.5,0.1,2,7,\"Head,1,0,0,0,0,0,0,1,0\n", "3", "quote");
  check_refused(head + good + "2,0.6,0.1,1,7,Head,1,0,0,0,0,0,0,1,0\n", "4", "goes back");
  CHECK(read_recording_file("/nowhere/walk.csv").fault().code == "recording.unreadable");
}

TEST_CASE("a rotation written by hand becomes one exactly") {
  const auto recording = read(recording_head() + "1,0.5,,2,7,Head,1,0,0,0,0,0.7071,0,0.7071,0\n");
  REQUIRE(recording);
  CHECK(glm::length((*recording)[0].bodies[0].tracker_from_body.rotation) == doctest::Approx(1.0).epsilon(1e-14));
  CHECK_FALSE((*recording)[0].latency_s.has_value());
}

TEST_CASE("told the time, it says what it said then, and is lost in the silence and at the end") {
  double now = 100.0;
  RecordedTracker tracker(sample(), {false, 0.1, [&] { return now; }});
  CHECK(tracker.state().phase == TrackerPhase::off);
  CHECK(tracker.newest() == nullptr);
  REQUIRE(tracker.start().ok());
  CHECK(tracker.newest()->number == 40);
  CHECK(tracker.newest()->arrival_s == doctest::Approx(100.0));
  now = 100.0101;
  CHECK(tracker.newest()->number == 41);
  CHECK(tracker.newest() == tracker.newest());
  now = 100.1;
  CHECK(tracker.newest()->number == 42);
  CHECK(tracker.newest()->arrival_s == doctest::Approx(100.02));
  CHECK(tracker.state().phase == TrackerPhase::tracking);
  now = 100.13;
  CHECK(tracker.state().phase == TrackerPhase::lost);
  CHECK(tracker.state().fault->code == "recording.silent");
  now = 100.5205;
  CHECK(tracker.newest()->number == 43);
  CHECK(tracker.state().phase == TrackerPhase::tracking);
  CHECK(tracker.state().frames == 4);
  now = 101.0;
  CHECK(tracker.state().phase == TrackerPhase::lost);
  CHECK(tracker.state().fault->code == "recording.ended");
  CHECK(tracker.newest()->number == 44);
  tracker.stop();
  CHECK(tracker.newest() == nullptr);
}

TEST_CASE("in a loop, numbers and times go on") {
  double now = 0.0;
  TrackerRecording recording = {frame_of(40, 5.0), frame_of(41, 5.01), frame_of(42, 5.02)};
  RecordedTracker tracker(recording, {true, 0.1, [&] { return now; }});
  REQUIRE(tracker.start().ok());
  double before_s = -1.0;
  for (int k = 0; k < 100; ++k) {
    now = 0.01 * k + 0.005;
    const auto frame = tracker.newest();
    CHECK(frame->number == 40 + k);
    CHECK(frame->arrival_s == doctest::Approx(0.01 * k));
    CHECK(frame->time_s > before_s);
    before_s = frame->time_s;
    CHECK(tracker.state().phase == TrackerPhase::tracking);
  }
  CHECK(tracker.state().frames == 100);
}

TEST_CASE("a recording of a recording is the recording") {
  const std::string path = (std::filesystem::temp_directory_path() / "focalstage-recorder-test.csv").string();
  TrackerRecording walk;
  for (int k = 0; k < 30; ++k) walk.push_back(frame_of(k, 0.01 * k));
  {
    TrackerRecorder recorder(std::make_shared<RecordedTracker>(walk), path);
    REQUIRE(recorder.start().ok());
    for (int k = 0; k < 2000 && recorder.state().frames < 30; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(recorder.written().ok());
  }
  const auto again = read_recording_file(path);
  std::filesystem::remove(path);
  REQUIRE(again);
  // A crowded machine may sleep through a frame; what is there is as it was.
  CHECK(again->size() > 20);
  for (const TrackedFrame& frame : *again) {
    CHECK(frame.bodies == walk[static_cast<std::size_t>(frame.number)].bodies);
    CHECK(frame.time_s == walk[static_cast<std::size_t>(frame.number)].time_s);
  }
}

TEST_CASE("a place that can't be written is a fault at once, and so is an empty recording") {
  TrackerRecorder recorder(std::make_shared<RecordedTracker>(sample()), "/nowhere/walk.csv");
  CHECK(recorder.start().fault().code == "recording.unwritable");
  CHECK(RecordedTracker({}).start().fault().code == "recording.empty");
}

}  // namespace
}  // namespace focalstage
