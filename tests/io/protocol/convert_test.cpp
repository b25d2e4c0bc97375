#include "io/protocol/convert.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

RigDescription description() {
  RigDescription rig;
  rig.name = "bench 2";
  rig.kind = "sim";
  Projector projector;
  projector.name = "main";
  projector.model = "lightcrafter4500";
  projector.width_px = 912;
  projector.height_px = 1140;
  projector.pixel_layout = PixelLayout::diamond;
  projector.frames_per_second = 1440.5;
  projector.bits = 1;
  projector.color = ColorMode::rgb;
  projector.latency_ms = 0.21;
  rig.projectors = {projector, Projector{}};
  rig.glasses.lens_to_pupil_mm = 17.0;
  rig.glasses.lens_range_d = {-2.5, 3.5};
  rig.glasses.lens_aperture_mm = 10.0;
  rig.glasses.shutter_close_ms = 0.2;
  rig.glasses.shutter_open_ms = 2.7;
  rig.glasses.lens_response.left = {{0, 41.0, 0.0, {}}, {1, 39.5, -12.25, {}}};
  rig.glasses.lens_response.right = {{0, 40.0, 0.0, {}}};
  rig.frequency_hz = 59.94;
  rig.lens_current_max_a = 0.27;
  rig.shutter_changes_per_s_max = 140.0;
  RigMeasurement measured{50.0, 1'700'000'000, {0.21, 0.004}, {0.012, 0.001}, {}};
  measured.eye.left = {
      {0.21, 0.01}, {2.7, 0.05}, {-0.01, 0.02}, {{0, {41.0, 0.2}, {0.0, 0.0}}, {1, {39.5, 0.1}, {-12.25, 0.2}}}};
  measured.eye.right = {{0.22, 0.02}, {2.6, 0.04}, {0.03, 0.01}, {{0, {40.0, 0.3}, {0.0, 0.0}}}};
  rig.measurement = measured;
  return rig;
}

RigState state() {
  RigState state;
  state.state = "playing";
  state.show_sha256 = std::string(64, 'c');
  state.sweeps = std::numeric_limits<std::uint64_t>::max();
  state.missed_exposures = 3;
  state.lens_phase = 0.75;
  state.temperature_c = 31.5;
  state.fault = "somewhere: something (rig.late)";
  state.slots = {{1, 2, 1, -0.5, -0.51, 0.003, 0.0031, true, false, true, false, 99, 1, 0.28, 0.29},
                 {2, 3, 0, 0.5, 0.5, 0.004, 0.004, false, true, false, true, 7, 0, 0.02, 0.03, true}};
  state.holder = "anna:1";
  state.frame = 12;
  state.late_sweeps = 4;
  state.revision = 1ull << 53;
  state.pose_to_light_ms = 118.5;
  state.temperatures = {{"left lens", 31.5}, {"projector", 44.0}};
  state.parts = {{{"uno", "Arduino Uno", "A1", "/dev/ttyACM0"}, "lost", "unplugged"},
                 {{"sim", "", "", ""}, "running", ""}};
  state.lateness = {{50.0, 10}, {std::numeric_limits<double>::infinity(), 2}};
  return state;
}

TEST_CASE("descriptions and states come back as they went") {
  const v1::RigDescription description_message = message_from(description());
  v1::RigDescription read_description;
  REQUIRE(read_description.ParseFromString(description_message.SerializeAsString()));
  CHECK(description_from(read_description) == description());
  const v1::RigState state_message = message_from(state());
  v1::RigState read_state;
  REQUIRE(read_state.ParseFromString(state_message.SerializeAsString()));
  CHECK(state_from(read_state) == state());
}

TEST_CASE("no field of a message stays at its default when all values differ from theirs: none is forgotten") {
  const auto unset_fields = [](const google::protobuf::Message& message) {
    std::vector<std::string> unset;
    const auto* descriptor = message.GetDescriptor();
    const auto* reflection = message.GetReflection();
    for (int i = 0; i < descriptor->field_count(); ++i) {
      const auto* field = descriptor->field(i);
      const bool set =
          field->is_repeated() ? reflection->FieldSize(message, field) > 0 : reflection->HasField(message, field);
      if (!set) unset.push_back(field->name());
    }
    return unset;
  };
  const v1::RigDescription rig = message_from(description());
  CHECK(unset_fields(rig).empty());
  CHECK(unset_fields(rig.glasses()).empty());
  CHECK(unset_fields(rig.projectors(0)).empty());
  CHECK(unset_fields(rig.glasses().left().harmonics(1)).empty());
  CHECK(unset_fields(message_from(state())).empty());
}

TEST_CASE("a fault crosses the wire whole; a broken connection becomes rig.unreachable") {
  for (const char* code : {"rig.held", "rig.differs", "rig.damaged", "rig.disk-full", "rig.lease", "other.code"}) {
    const Fault fault{code, "chunk 3 of 9", "it is damaged", "push again"};
    const grpc::Status status = status_from(fault);
    CHECK_FALSE(status.ok());
    CHECK(fault_from(status, "127.0.0.1:1") == fault);
  }
  CHECK(status_from({"rig.disk-full", "", "", ""}).error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED);
  const Fault gone = fault_from({grpc::StatusCode::UNAVAILABLE, "connect failed"}, "127.0.0.1:1");
  CHECK(gone.code == "rig.unreachable");
  CHECK(gone.where == "127.0.0.1:1");
  CHECK(fault_from({grpc::StatusCode::DEADLINE_EXCEEDED, ""}, "").code == "rig.unreachable");
  CHECK(fault_from({grpc::StatusCode::UNIMPLEMENTED, "no such call"}, "").message == "no such call");
  CHECK(fault_from({grpc::StatusCode::INTERNAL, "odd", "\xff\xff not a fault"}, "").message == "odd");
}

TEST_CASE("a fault that quotes bytes which are no text still arrives") {
  const Fault quoted{"asset.invalid", "mesh.obj", "\"\xff\xfe\" is no number", "mend it"};
  const Fault readable{"asset.invalid", "mesh.obj", "\"\xef\xbf\xbd\xef\xbf\xbd\" is no number", "mend it"};
  CHECK(fault_from(status_from(quoted), "") == readable);
  RigState state;
  state.fault = quoted.message;
  v1::RigState read;
  REQUIRE(read.ParseFromString(message_from(state).SerializeAsString()));
  CHECK(read.fault() == readable.message);
}

}  // namespace
}  // namespace focalstage
