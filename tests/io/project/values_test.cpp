#include <cmath>

#include "core/scene/pointer.h"
#include "core/scene/project_value.h"
#include "io/project/project_file.h"
#include "io/project/schemas.h"
#include "io/project/validate.h"
#include "tests/io/project/sample.h"

using namespace focalstage;

namespace {

/// The full sample with the value at `pointer` replaced, or added as a member.
Value sample_with(const std::string& pointer, const Value& value) {
  Value sample = value_of(full_sample);
  auto steps = pointer_steps(pointer);
  const std::string last = steps.back();
  steps.pop_back();
  auto* parent = const_cast<Value*>(value_at(sample, steps));
  REQUIRE(parent);
  if (Value::Array* items = parent->array()) {
    (*items)[*index_in(last)] = value;
  } else {
    parent->set(last, value);
  }
  return sample;
}

struct Bad {
  const char* pointer;
  const char* value;
  const char* code;
  const char* where;  ///< of the fault; empty: the pointer
};

// Everything that has the right type and is wrong all the same.
const std::vector<Bad> bad_values{
    {"/viewer/interpupillary_mm", "0", "project.range", ""},
    {"/viewer/interpupillary_mm", "-63", "project.range", ""},
    {"/viewer/position_m", "[0,1e300,0]", "project.range", "/viewer/position_m/1"},
    {"/viewer/position_m", "[0,0]", "project.type", ""},
    {"/viewer/rotation_xyzw", "[0,0,0,0]", "project.rotation", ""},
    {"/viewer/rotation_xyzw", "[0,0,0,1.01]", "project.rotation", ""},
    {"/viewer/rotation_xyzw", "[1,1,1,1]", "project.rotation", ""},
    {"/viewer/keys/1/time_s", "0", "project.order", ""},
    {"/viewer/keys/1/time_s", "-1", "project.order", ""},
    {"/glasses/lens_to_pupil_mm", "0", "project.range", ""},
    {"/glasses/lens_aperture_mm", "-1", "project.range", ""},
    {"/glasses/lens_range_d", "[10,-10]", "project.range", ""},
    {"/glasses/lens_range_d", "[3,3]", "project.range", ""},
    {"/glasses/shutter_open_ms", "-0.1", "project.range", ""},
    {"/glasses/lens_limits/max_current_a", "0", "project.range", ""},
    {"/glasses/lens_limits/max_rms_current_a", "-1", "project.range", ""},
    {"/glasses/lens_limits/max_frequency_hz", "\"fast\"", "project.type", ""},
    {"/glasses/lens_limits", "0.25", "project.type", ""},
    {"/glasses/lens_response/left/0/gain_d_per_a", "0", "project.range", ""},
    {"/glasses/lens_response/left/0/harmonic", "-1", "project.range", ""},
    {"/glasses/lens_response/left/0/harmonic", "1.5", "project.type", ""},
    {"/glasses/lens_response", R"([{"harmonic":1,"gain_d_per_a":1},{"harmonic":1,"gain_d_per_a":2}])",
     "project.duplicate", "/glasses/lens_response/1/harmonic"},
    {"/glasses/lens_response", R"({"left":[]})", "project.missing", "/glasses/lens_response/right"},
    {"/sweep/frequency_hz", "0", "project.range", ""},
    {"/sweep/frequency_hz", "-60", "project.range", ""},
    {"/sweep/max_power_d", "-1.5", "project.range", ""},
    {"/sweep/min_power_d", "2", "project.range", "/sweep/max_power_d"},
    {"/sweep/waveform", R"("square")", "project.word", ""},
    {"/sweep/waveform/left/drive_a", "[0,1,2,3,4,5,6]", "project.count", ""},
    {"/sweep/waveform/left/drive_a", "[0,1,2,3,4,5,6,7,8]", "project.count", ""},
    {"/sweep/waveform/left/power_d", "[0,0,1,2,3,2,1,0.5]", "project.order", ""},  // flat after the minimum
    {"/sweep/waveform/left/power_d", "[0,1,2,1,3,2,1,0.5]", "project.order", ""},  // two hills
    {"/sweep/waveform/left/power_d", "[1,0,1,2,3,2,1,0.5]", "project.order", ""},  // starts beside its minimum
    {"/sweep/waveform/left/power_d", "[0,1,2,3,4,3,2,0]", "project.order", ""},    // ends at the minimum
    {"/sweep/waveform/left/power_d", "[8,7,6,5,4,3,2,1]", "project.order", ""},    // never rises
    {"/projectors", "[]", "project.count", ""},
    {"/projectors/0/width_px", "0", "project.range", ""},
    {"/projectors/0/width_px", "8193", "project.range", ""},
    {"/projectors/0/height_px", "-768", "project.range", ""},
    {"/projectors/0/height_px", "768.5", "project.type", ""},
    {"/projectors/0/bits", "0", "project.range", ""},
    {"/projectors/0/bits", "9", "project.range", ""},
    {"/projectors/0/frames_per_second", "0", "project.range", ""},
    {"/projectors/0/gamma", "0", "project.range", ""},
    {"/projectors/0/transfer", "[0.1,1]", "project.range", ""},
    {"/projectors/0/transfer", "[0]", "project.range", ""},
    {"/projectors/0/transfer", "[0,0.9]", "project.range", ""},
    {"/projectors/0/transfer", "[0,0.5,0.4,1]", "project.order", ""},
    {"/projectors/0/transfer/1", "1.5", "project.range", ""},
    {"/projectors/0/black_level", "0.6", "project.range", ""},
    {"/projectors/0/black_level", "-0.1", "project.range", ""},
    {"/projectors/0/blend_margin_px", "0", "project.range", ""},
    {"/projectors/0/blend_margin_px", "5000", "project.range", ""},
    {"/slices/compensation/mode", R"("bright")", "project.word", ""},
    {"/slices/compensation/white", "0", "project.range", ""},
    {"/slices/compensation/reference_m", "0", "project.range", ""},
    {"/slices/compensation", R"("even")", "project.type", ""},
    {"/surfaces/0/albedo", "[1,1,1.5]", "project.range", "/surfaces/0/albedo/2"},
    {"/surfaces/0/albedo", "[1,1]", "project.type", ""},
    {"/surfaces/0/albedo", R"("stone")", "project.word", ""},
    {"/surfaces/0/albedo", "0.5", "project.type", ""},
    {"/surfaces/1/albedo", "{}", "project.missing", "/surfaces/1/albedo/file"},
    {"/surfaces/1/albedo/file", R"("")", "project.name", ""},
    {"/ambient_lux", "-1", "project.range", ""},
    {"/projectors/0/fx_px", "0", "project.range", ""},
    {"/projectors/0/exposure_ms", "0", "project.range", ""},
    {"/projectors/0/latency_ms", "-1", "project.range", ""},
    {"/projectors/0/color", R"("grey")", "project.word", ""},
    {"/projectors/0/distortion", "[1]", "project.count", ""},
    {"/projectors/0/distortion", "[1,2,3,4,5,6]", "project.count", ""},
    {"/projectors/0/distortion", "[1,2,3,4,5,6,7]", "project.count", ""},
    {"/projectors/0/distortion", "[1,2,3,4,5,6,7,8,9]", "project.count", ""},
    {"/projectors/0/name", R"("")", "project.name", ""},
    {"/projectors/0/name", R"("a\nb")", "project.name", ""},
    {"/slices/powers_d", "[]", "project.count", ""},
    {"/slices/powers_d", "[1,0,1]", "project.duplicate", "/slices/powers_d/2"},
    {"/slices/powers_d", "[0,-0]", "project.duplicate", "/slices/powers_d/1"},
    {"/slices/powers_d", "[0,1,66.7]", "project.range", "/slices/powers_d/2"},  // 1000 / 15 mm = 66.67 D
    {"/slices/powers_d", "[0,1,-66.7]", "project.range", "/slices/powers_d/2"},
    {"/slices/powers_d", "[0]", "project.range", "/objects/1/depth/index"},  // the box is in slice 1
    {"/slices/samples_per_pixel", "2", "project.range", ""},
    {"/slices/samples_per_pixel", "25", "project.range", ""},
    {"/frames/count", "0", "project.range", ""},
    {"/frames/count", "1000001", "project.range", ""},
    {"/frames/rate_hz", "0", "project.range", ""},
    {"/surfaces/0/mesh/size_m", "[1,0]", "project.range", "/surfaces/0/mesh/size_m/1"},
    {"/surfaces/0/mesh/size_m", "[-1,1]", "project.range", "/surfaces/0/mesh/size_m/0"},
    {"/surfaces/0/mesh/size_m", "[1,1,1]", "project.type", ""},
    {"/surfaces/0/mesh/primitive", R"("cone")", "project.word", ""},
    {"/surfaces/0/mesh", "{}", "project.missing", ""},
    {"/surfaces/0/mesh", R"({"file":"a","primitive":"box"})", "project.conflict", ""},
    {"/surfaces/1/mesh/radius_m", "0", "project.range", ""},
    {"/surfaces/2/mesh/angle_deg", "0", "project.range", ""},
    {"/surfaces/2/mesh/angle_deg", "361", "project.range", ""},
    {"/surfaces/3/mesh/depth_m", "-0.1", "project.range", ""},
    {"/surfaces/5/mesh/file", R"("")", "project.name", ""},
    {"/surfaces/5/mesh/process", R"([{"to":1}])", "project.missing", "/surfaces/5/mesh/process/0/step"},
    {"/surfaces/5/mesh/process", R"([{"step":"polish"}])", "project.word", "/surfaces/5/mesh/process/0/step"},
    {"/surfaces/5/mesh/process/1/tolerance_mm", "-1", "project.range", ""},
    {"/surfaces/5/mesh/process/2/least_share", "1.1", "project.range", ""},
    {"/surfaces/5/mesh/process/4/part", "-1", "project.range", ""},
    {"/surfaces/5/mesh/process/5", R"({"step":"decimate"})", "project.missing", ""},
    {"/surfaces/5/mesh/process/5", R"({"step":"decimate","triangles":9,"error_mm":1})", "project.conflict", ""},
    {"/surfaces/5/mesh/process/7/rounds", "9", "project.range", ""},
    {"/surfaces/0/scale", "0", "project.range", ""},
    {"/surfaces/0/illumination", "1.5", "project.range", ""},
    {"/surfaces/1/name", R"("plane")", "project.duplicate", ""},
    {"/objects/1/mesh/size_m", "[1,1]", "project.type", ""},
    {"/objects/0/scale", "-1", "project.range", ""},
    {"/objects/0/appearance", R"({"unlit":[0,0,0],"checker":{}})", "project.conflict", ""},
    {"/objects/1/appearance/unlit", "[2,0,0]", "project.range", "/objects/1/appearance/unlit/0"},
    {"/objects/0/appearance/checker/squares", "[0,1]", "project.range", "/objects/0/appearance/checker/squares/0"},
    {"/objects/0/appearance", R"({"image":{"file":"a.png"},"checker":{}})", "project.conflict", ""},
    {"/objects/0/appearance", R"({"image":{"file":"a.png"},"unlit":[0,0,0]})", "project.conflict", ""},
    {"/objects/2/appearance/image", "{}", "project.missing", "/objects/2/appearance/image/file"},
    {"/objects/2/appearance/image/file", R"("")", "project.name", ""},
    {"/objects/2/appearance/image/file", R"("fire.png")", "project.range", ""},
    {"/objects/2/appearance/image/file", R"("fire_##_##.png")", "project.range", ""},
    {"/objects/2/appearance/image/file", R"("fire_##/a.png")", "project.range", ""},
    {"/objects/2/appearance/image/count", "0", "project.range", ""},
    {"/objects/2/appearance/image/count", "10001", "project.range", ""},
    {"/objects/2/appearance/image/count", "2.5", "project.type", ""},
    {"/objects/2/appearance/image/first", "-1", "project.range", ""},
    {"/objects/2/appearance/image/rate_hz", "0", "project.range", ""},
    {"/objects/2/appearance/image", R"({"file":"a_#.png","count":2})", "project.missing",
     "/objects/2/appearance/image/rate_hz"},
    {"/objects/2/appearance/image/loop", R"("twice")", "project.word", ""},
    {"/objects/2/appearance/image/wrap", R"("tile")", "project.word", ""},
    {"/objects/2/appearance/image/alpha_cutoff", "1.5", "project.range", ""},
    {"/objects/0/depth", R"({"mode":"fixed"})", "project.missing", "/objects/0/depth/vergence_d"},
    {"/objects/0/depth", R"({"mode":"offset"})", "project.missing", "/objects/0/depth/vergence_d"},
    {"/objects/0/depth", R"({"mode":"slice"})", "project.missing", "/objects/0/depth/index"},
    {"/objects/0/depth", R"({})", "project.missing", "/objects/0/depth/mode"},
    {"/objects/1/depth/index", "3", "project.range", ""},
    {"/objects/1/depth/index", "-1", "project.range", ""},
    {"/objects/1/name", R"("near")", "project.duplicate", ""},
    {"/lights/0/kind", R"("moon")", "project.word", ""},
    {"/lights/0/intensity", "-1", "project.range", ""},
    {"/lights/0", R"({"kind":"sun","direction":[0,0,0]})", "project.range", "/lights/0/direction"},
    {"/cues/1/name", R"("start")", "project.duplicate", ""},
    {"/cues/1/time_s", "-1", "project.range", ""},
    {"/focalstage", "2", "project.version", ""},
    {"/focalstage", "0", "project.version", ""},
    {"/focalstage", "1.5", "project.version", ""},
};

}  // namespace

TEST_CASE("what has the right type and is wrong all the same is refused at its place, with a remedy") {
  for (const Bad& bad : bad_values) {
    INFO(bad.pointer, " = ", bad.value);
    const auto loaded = parse_project(write_json(sample_with(bad.pointer, value_of(bad.value))), "a.focal");
    REQUIRE_FALSE(loaded.ok());
    CHECK(loaded.fault().code == bad.code);
    CHECK(loaded.fault().where == std::string("a.focal: ") + (*bad.where ? bad.where : bad.pointer));
    CHECK_FALSE(loaded.fault().remedy.empty());
  }
}

TEST_CASE("the schema itself refuses what a schema can express") {
  // These need arithmetic between values, uniqueness by name, or a tolerance: beyond draft 7. Where numbers go in a
  // picture's name would be a pattern, and std::regex follows long texts into the depth of the stack.
  const auto beyond = [](const Bad& bad) {
    const std::string_view code = bad.code;
    const std::string_view pointer = bad.pointer;
    return code == "project.order" || code == "project.rotation" || code == "project.duplicate" ||
           pointer == "/glasses/lens_range_d" || pointer.starts_with("/sweep/m") || pointer == "/slices/powers_d" ||
           pointer == "/projectors/0/transfer" || pointer.ends_with("/drive_a") || pointer == "/lights/0" ||
           (pointer == "/objects/2/appearance/image/file" && bad.value != std::string_view(R"("")")) ||
           bad.value == std::string_view(R"("a\nb")") ||
           (pointer == "/objects/1/depth/index" && bad.value == std::string_view("3"));
  };
  for (const Bad& bad : bad_values) {
    if (beyond(bad)) continue;
    INFO(bad.pointer, " = ", bad.value);
    CHECK(schema_fault(sample_with(bad.pointer, value_of(bad.value)), project_schema()));
  }
}

TEST_CASE("a newer version is refused by name, a missing one too") {
  const auto newer = parse_project(R"({"focalstage": 2, "brand_new": true})", "x");
  REQUIRE_FALSE(newer.ok());
  CHECK(newer.fault().message.find("made by a newer version") != std::string::npos);
  const auto none = parse_project(R"({"name": "x"})", "x");
  REQUIRE_FALSE(none.ok());
  CHECK(none.fault().where == "x: /focalstage");
  CHECK(none.fault().message.find("missing") != std::string::npos);
}

TEST_CASE("rotations a little off are made unit, and stay put from then on") {
  const auto loaded =
      parse_project(write_json(sample_with("/viewer/rotation_xyzw", value_of("[0,0.7071,0,0.7071]"))), "x");
  REQUIRE(loaded.ok());
  const glm::dquat q = loaded->project.viewer.placement.pose.rotation;
  CHECK(std::abs(q.y - std::sqrt(0.5)) < 1e-15);
  const auto again = parse_project(project_text(loaded->project), "x");
  REQUIRE(again.ok());
  CHECK(again->project == loaded->project);
}

TEST_CASE("a key that leaves out its position or rotation has that of the thing itself") {
  const auto loaded =
      parse_project(write_json(sample_with("/viewer", value_of(R"({"position_m":[1,2,3],"rotation_xyzw":[0,1,0,0],
        "keys":[{"time_s":0},{"time_s":1,"position_m":[4,5,6]}]})"))),
                    "x");
  REQUIRE(loaded.ok());
  const Placement& placement = loaded->project.viewer.placement;
  CHECK(placement.keys[0].pose == placement.pose);
  CHECK(placement.keys[1].pose.position_m == glm::dvec3(4, 5, 6));
  CHECK(placement.keys[1].pose.rotation == placement.pose.rotation);
}

TEST_CASE("lights without a name get one that no other light has") {
  const auto loaded =
      parse_project(write_json(sample_with(
                        "/lights", value_of(R"([{"kind":"sky"},{"name":"light 1","kind":"sun"},{"kind":"sky"}])"))),
                    "x");
  REQUIRE(loaded.ok());
  const auto& lights = loaded->project.lights;
  CHECK(lights[0].name == "light 2");
  CHECK(lights[1].name == "light 1");
  CHECK(lights[2].name == "light 3");
}

TEST_CASE("the smallest project opens with the documented defaults") {
  const auto loaded = parse_project(R"({"focalstage":1,"projectors":[{"name":"p"}],"slices":{"powers_d":[0]}})", "x");
  REQUIRE_MESSAGE(loaded.ok(), describe(loaded.ok() ? Fault{} : loaded.fault()));
  CHECK(loaded->notes.empty());
  CHECK(loaded->project.viewer == Viewer{});
  CHECK(loaded->project.glasses == Glasses{});
  CHECK(loaded->project.sweep == Sweep{});
  CHECK(loaded->project.frames == Frames{});
  CHECK_FALSE(fault_of(loaded->project));
}

TEST_CASE("what stands once for both eyes is written once; what differs, or carries more, for each") {
  const auto open = [](const char* waveform) {
    const auto loaded = parse_project(write_json(sample_with("/sweep/waveform", value_of(waveform))), "x");
    REQUIRE(loaded.ok());
    return *value_from(loaded->project).find("sweep")->find("waveform");
  };
  CHECK(open(R"("sine")") == Value("sine"));
  CHECK(open(R"({"left":"sine","right":"sine"})") == Value("sine"));
  const char* noted = R"({"left":"sine","right":"sine","measured_on":"Monday"})";
  CHECK(open(noted) == value_of(noted));
}
