#include <algorithm>
#include <set>

#include "core/scene/history.h"
#include "core/scene/pointer.h"
#include "core/scene/project_value.h"
#include "core/scene/reading.h"
#include "io/project/project_file.h"
#include "io/project/schemas.h"
#include "io/project/validate.h"
#include "tests/io/project/sample.h"

using namespace focalstage;

// One table of every key a project file may have, each with another valid value. Round trip, edit, undo, wrong types
// and the schema's completeness are all driven by it.
namespace {

struct Row {
  const char* list;
  const char* name;  ///< of the item; empty for the single things
  const char* key;   ///< "name": changed by a rename
  const char* other;
};

constexpr const char* two_keys =
    R"([{"time_s":2,"position_m":[1,2,3],"rotation_xyzw":[0,1,0,0]},{"time_s":3,"position_m":[0,0,0],"rotation_xyzw":[1,0,0,0]}])";
constexpr const char* other_harmonics =
    R"([{"harmonic":0,"gain_d_per_a":40,"phase_deg":0},{"harmonic":2,"gain_d_per_a":3,"phase_deg":90}])";
constexpr const char* other_period = R"({"power_d":[-3,0,1,2,3,2,1,0],"drive_a":[7,6,5,4,3,2,1,0]})";

const std::vector<Row> rows{
    {"", "", "name", R"("Less")"},
    {"", "", "viewer", R"({"position_m":[1,2,3],"rotation_xyzw":[0,1,0,0],"interpupillary_mm":60})"},
    {"", "", "glasses",
     R"({"lens_to_pupil_mm":14,"lens_range_d":[-9,9],"lens_aperture_mm":10,"shutter_close_ms":0.2,"shutter_open_ms":1})"},
    {"", "", "sweep", R"({"frequency_hz":50,"min_power_d":-2,"max_power_d":2,"waveform":"sine"})"},
    {"", "", "slices", R"({"powers_d":[2,0.5],"assignment":"nearest","breathing":"off","samples_per_pixel":9})"},
    {"", "", "frames", R"({"count":5,"rate_hz":20})"},
    {"", "", "cues", R"([{"name":"only","time_s":4}])"},
    {"", "", "lights", R"([{"name":"sky","kind":"sky","color":[0,0,1],"intensity":2}])"},
    {"", "", "ambient_lux", "0.5"},
    {"", "", "surfaces", "[]"},
    {"", "", "objects", "[]"},
    {"", "", "projectors/0/name", R"("second")"},  // the pattern of a rename, and of the whole list below
    {"viewer", "", "position_m", "[0.5,-1,2]"},
    {"viewer", "", "rotation_xyzw", "[0,0.6,0,0.8]"},
    {"viewer", "", "interpupillary_mm", "58.5"},
    {"viewer", "", "keys", two_keys},
    {"viewer", "", "keys/0/time_s", "-1"},
    {"viewer", "", "keys/0/position_m", "[3,2,1]"},
    {"viewer", "", "keys/0/rotation_xyzw", "[0.6,0,0,0.8]"},
    {"viewer", "", "track", R"("hat")"},
    {"glasses", "", "lens_to_pupil_mm", "12"},
    {"glasses", "", "lens_range_d", "[-5,6]"},
    {"glasses", "", "lens_aperture_mm", "30"},
    {"glasses", "", "shutter_close_ms", "0"},
    {"glasses", "", "shutter_open_ms", "0.5"},
    {"glasses", "", "lens_response", other_harmonics},
    {"glasses", "", "lens_response/left", other_harmonics},
    {"glasses", "", "lens_response/right", other_harmonics},
    {"glasses", "", "lens_response/left/0/harmonic", "3"},
    {"glasses", "", "lens_response/left/0/gain_d_per_a", "12.5"},
    {"glasses", "", "lens_response/left/0/phase_deg", "4"},
    {"glasses", "", "lens_response/right/0/harmonic", "3"},
    {"glasses", "", "lens_response/right/0/gain_d_per_a", "12.5"},
    {"glasses", "", "lens_response/right/0/phase_deg", "4"},
    {"glasses", "", "lens_limits", R"({"max_current_a":0.1,"max_rms_current_a":0.05})"},
    {"glasses", "", "lens_limits/max_current_a", "0.3"},
    {"glasses", "", "lens_limits/max_rms_current_a", "0.1"},
    {"glasses", "", "lens_limits/max_frequency_hz", "480"},
    {"sweep", "", "frequency_hz", "90"},
    {"sweep", "", "min_power_d", "-3"},
    {"sweep", "", "max_power_d", "2.5"},
    {"sweep", "", "waveform", other_period},
    {"sweep", "", "waveform/left", other_period},
    {"sweep", "", "waveform/right", R"("sine")"},
    {"sweep", "", "waveform/left/power_d", "[-3,0,1,2,3,2,1,0]"},
    {"sweep", "", "waveform/left/drive_a", "[7,6,5,4,3,2,1,0]"},
    {"sweep", "", "waveform/right/power_d", "[-3,0,1,2,3,2,1,0]"},
    {"sweep", "", "waveform/right/drive_a", "[7,6,5,4,3,2,1,0]"},
    {"projectors", "main", "name", R"("left one")"},
    {"projectors", "main", "model", R"("other")"},
    {"projectors", "main", "width_px", "640"},
    {"projectors", "main", "height_px", "480"},
    {"projectors", "main", "pixel_layout", R"("square")"},
    {"projectors", "main", "frames_per_second", "2840"},
    {"projectors", "main", "bits", "1"},
    {"projectors", "main", "color", R"("rgb")"},
    {"projectors", "main", "latency_ms", "0"},
    {"projectors", "main", "gamma", "2.2"},
    {"projectors", "main", "transfer", "[0,0.1,0.1,1]"},
    {"projectors", "main", "black_level", "0.002"},
    {"projectors", "main", "fx_px", "1000.5"},
    {"projectors", "main", "fy_px", "1000.5"},
    {"projectors", "main", "cx_px", "-3"},
    {"projectors", "main", "cy_px", "-3"},
    {"projectors", "main", "distortion", "[1,2,3,4,5,6,7,8]"},
    {"projectors", "main", "position_m", "[1,1,1]"},
    {"projectors", "main", "rotation_xyzw", "[0,1,0,0]"},
    {"projectors", "main", "exposure_ms", "0.3"},
    {"projectors", "main", "focus_m", "0.6"},
    {"projectors", "main", "depth_of_field_d", "1"},
    {"projectors", "main", "lumens", "1000"},
    {"projectors", "main", "blend_margin_px", "32"},
    {"slices", "", "powers_d", "[1,-1,0.25,0]"},
    {"slices", "", "assignment", R"("optimal")"},
    {"slices", "", "breathing", R"("planar")"},
    {"slices", "", "samples_per_pixel", "16"},
    {"slices", "", "compensation", R"({"mode":"even","white":0.2})"},
    {"slices", "", "compensation/mode", R"("off")"},
    {"slices", "", "compensation/white", "0.7"},
    {"slices", "", "compensation/reference_m", "0.8"},
    {"frames", "", "count", "1000000"},
    {"frames", "", "rate_hz", "60"},
    {"surfaces", "plane", "name", R"("wall")"},
    {"surfaces", "plane", "mesh", R"({"primitive":"corner","size_m":[1,2],"angle_deg":80})"},
    {"surfaces", "plane", "mesh/size_m", "[0.5,0.25]"},
    {"surfaces", "sphere", "mesh/radius_m", "1"},
    {"surfaces", "corner", "mesh/angle_deg", "120"},
    {"surfaces", "step", "mesh/depth_m", "0.2"},
    {"surfaces", "teapot", "mesh/primitive", R"("rabbit")"},
    {"surfaces", "scan", "mesh/file", R"("assets/other.obj")"},
    {"surfaces", "scan", "mesh/process", R"([{"step":"clean"},{"step":"smooth","rounds":3,"feature_deg":10}])"},
    {"surfaces", "scan", "mesh/process/0/step", R"("fix-winding")"},
    {"surfaces", "scan", "mesh/process/1/tolerance_mm", "0.5"},
    {"surfaces", "scan", "mesh/process/2/least_share", "0.5"},
    {"surfaces", "scan", "mesh/process/3/longest_mm", "9"},
    {"surfaces", "scan", "mesh/process/4/part", "2"},
    {"surfaces", "scan", "mesh/process/4/fold_deg", "60"},
    {"surfaces", "scan", "mesh/process/5/triangles", "20"},
    {"surfaces", "scan", "mesh/process/8/error_mm", "2"},
    {"surfaces", "scan", "mesh/process/6/rounds", "9"},
    {"surfaces", "scan", "mesh/process/6/feature_deg", "90"},
    {"surfaces", "scan", "mesh/process/7/scheme", R"("loop")"},
    {"surfaces", "scan", "mesh/process/9/position_m", "[1,2,3]"},
    {"surfaces", "scan", "mesh/process/9/rotation_xyzw", "[0,0,1,0]"},
    {"surfaces", "scan", "mesh/process/9/size_m", "[3,4]"},
    {"surfaces", "scan", "mesh/process/10/width_px", "100"},
    {"surfaces", "scan", "mesh/process/10/height_px", "99"},
    {"surfaces", "scan", "mesh/process/10/fx_px", "98"},
    {"surfaces", "scan", "mesh/process/10/fy_px", "97"},
    {"surfaces", "scan", "mesh/process/10/cx_px", "-9"},
    {"surfaces", "scan", "mesh/process/10/cy_px", "8"},
    {"surfaces", "plane", "position_m", "[0,1,-2]"},
    {"surfaces", "plane", "rotation_xyzw", "[0,0,1,0]"},
    {"surfaces", "plane", "scale", "0.5"},
    {"surfaces", "plane", "illumination", "1"},
    {"surfaces", "plane", "albedo", R"({"file":"wall.png"})"},
    {"surfaces", "sphere", "albedo/file", R"("assets/brick.png")"},
    {"surfaces", "plane", "keys", two_keys},
    {"surfaces", "plane", "keys/0/time_s", "9"},
    {"surfaces", "plane", "keys/0/position_m", "[3,2,1]"},
    {"surfaces", "plane", "keys/0/rotation_xyzw", "[0.6,0,0,0.8]"},
    {"surfaces", "plane", "track", R"("rod")"},
    {"surfaces", "plane", "group", R"("floors")"},
    {"surfaces", "plane", "hidden", "false"},
    {"surfaces", "plane", "locked", "false"},
    {"objects", "near", "name", R"("far")"},
    {"objects", "near", "mesh", R"({"primitive":"sphere","radius_m":2})"},
    {"objects", "near", "mesh/file", R"("b.stl")"},
    {"objects", "near", "mesh/process", R"([{"step":"clean"},{"step":"smooth","rounds":3,"feature_deg":10}])"},
    {"objects", "near", "mesh/process/0/step", R"("fix-winding")"},
    {"objects", "near", "mesh/process/1/tolerance_mm", "0.5"},
    {"objects", "near", "mesh/process/2/least_share", "0.5"},
    {"objects", "near", "mesh/process/3/longest_mm", "9"},
    {"objects", "near", "mesh/process/4/part", "2"},
    {"objects", "near", "mesh/process/4/fold_deg", "60"},
    {"objects", "near", "mesh/process/5/triangles", "20"},
    {"objects", "near", "mesh/process/8/error_mm", "2"},
    {"objects", "near", "mesh/process/6/rounds", "9"},
    {"objects", "near", "mesh/process/6/feature_deg", "90"},
    {"objects", "near", "mesh/process/7/scheme", R"("loop")"},
    {"objects", "near", "mesh/process/9/position_m", "[1,2,3]"},
    {"objects", "near", "mesh/process/9/rotation_xyzw", "[0,0,1,0]"},
    {"objects", "near", "mesh/process/9/size_m", "[3,4]"},
    {"objects", "near", "mesh/process/10/width_px", "100"},
    {"objects", "near", "mesh/process/10/height_px", "99"},
    {"objects", "near", "mesh/process/10/fx_px", "98"},
    {"objects", "near", "mesh/process/10/fy_px", "97"},
    {"objects", "near", "mesh/process/10/cx_px", "-9"},
    {"objects", "near", "mesh/process/10/cy_px", "8"},
    {"objects", "box", "mesh/size_m", "[3,2,1]"},
    {"objects", "sphere", "mesh/radius_m", "1"},
    {"objects", "corner", "mesh/angle_deg", "120"},
    {"objects", "step", "mesh/depth_m", "0.2"},
    {"objects", "teapot", "mesh/primitive", R"("rabbit")"},
    {"objects", "near", "position_m", "[0,1,-2]"},
    {"objects", "near", "rotation_xyzw", "[0,0,1,0]"},
    {"objects", "near", "scale", "0.5"},
    {"objects", "near", "appearance", R"({"unlit":[0,0,1]})"},
    {"objects", "box", "appearance/unlit", "[0,0,1]"},
    {"objects", "near", "appearance/checker", R"({"squares":[1,1],"a":[0,1,0],"b":[0,0,1]})"},
    {"objects", "near", "appearance/checker/squares", "[2,3]"},
    {"objects", "near", "appearance/checker/a", "[0,0.5,1]"},
    {"objects", "near", "appearance/checker/b", "[0,0.5,1]"},
    {"objects", "plane", "appearance/image", R"({"file":"poster.png"})"},
    {"objects", "plane", "appearance/image/file", R"("smoke_##.jpg")"},
    {"objects", "plane", "appearance/image/count", "3"},
    {"objects", "plane", "appearance/image/first", "1001"},
    {"objects", "plane", "appearance/image/rate_hz", "23.976"},
    {"objects", "plane", "appearance/image/start_s", "-2"},
    {"objects", "plane", "appearance/image/loop", R"("once")"},
    {"objects", "plane", "appearance/image/wrap", R"("repeat")"},
    {"objects", "plane", "appearance/image/filter", R"("linear")"},
    {"objects", "plane", "appearance/image/color_space", R"("srgb")"},
    {"objects", "plane", "appearance/image/lit", "false"},
    {"objects", "plane", "appearance/image/alpha_cutoff", "0.25"},
    {"objects", "near", "depth", R"({"mode":"offset","vergence_d":-0.5})"},
    {"objects", "near", "depth/mode", R"("offset")"},
    {"objects", "near", "depth/vergence_d", "2.5"},
    {"objects", "box", "depth/index", "2"},
    {"objects", "near", "keys", two_keys},
    {"objects", "near", "keys/0/time_s", "9"},
    {"objects", "near", "keys/0/position_m", "[3,2,1]"},
    {"objects", "near", "keys/0/rotation_xyzw", "[0.6,0,0,0.8]"},
    {"objects", "near", "track", R"("rod")"},
    {"objects", "near", "group", R"("birds")"},
    {"objects", "near", "hidden", "false"},
    {"objects", "near", "locked", "false"},
    {"lights", "lamp", "name", R"("bulb")"},
    {"lights", "lamp", "kind", R"("sun")"},
    {"lights", "lamp", "position_m", "[1,1,1]"},
    {"lights", "lamp", "direction", "[1,0,0]"},
    {"lights", "lamp", "color", "[0,1,1]"},
    {"lights", "lamp", "intensity", "2"},
    {"cues", "turn", "name", R"("spin")"},
    {"cues", "turn", "time_s", "0.75"},
};

// The same keys where one value stands for both eyes.
const std::vector<Row> rows_of_both_eyes{
    {"glasses", "", "lens_response/0/harmonic", "3"},       {"glasses", "", "lens_response/0/gain_d_per_a", "12.5"},
    {"glasses", "", "lens_response/0/phase_deg", "4"},      {"sweep", "", "waveform/power_d", "[-3,0,1,2,3,2,1,0]"},
    {"sweep", "", "waveform/drive_a", "[7,6,5,4,3,2,1,0]"},
};

const std::vector<Row> rows_of_the_list{
    {"", "", "projectors", R"([{"name":"p","model":"m","width_px":2,"height_px":2,"frames_per_second":100,"bits":8,
      "color":"rgb","latency_ms":1,"gamma":2,"fx_px":1,"fy_px":1,"cx_px":1,"cy_px":1,"distortion":[],
      "position_m":[0,0,0],"rotation_xyzw":[0,0,0,1]}])"},
};

Project full_project() {
  auto project = project_from(value_of(full_sample));
  REQUIRE_MESSAGE(project.ok(), describe(project.ok() ? Fault{} : project.fault()));
  return *project;
}

Project both_eyes_project() {
  Project project = full_project();
  project.glasses.lens_response.right = project.glasses.lens_response.left;
  project.sweep.waveform.right = project.sweep.waveform.left;
  return project;
}

/// Where the row's value stands in the written project.
std::string pointer_of(const Value& project, const Row& row) {
  std::string pointer;
  if (*row.list) pointer = pointer_into(pointer, row.list);
  if (*row.name) {
    const Value::Array& items = *project.find(row.list)->array();
    const auto item =
        std::find_if(items.begin(), items.end(), [&](const Value& v) { return *v.find("name") == Value(row.name); });
    REQUIRE(item != items.end());
    pointer = pointer_into(pointer, static_cast<std::size_t>(item - items.begin()));
  }
  return pointer + "/" + row.key;
}

std::string pattern_of(const std::string& pointer) {
  std::string pattern;
  for (const std::string& step : pointer_steps(pointer)) pattern += index_in(step) ? "/*" : "/" + step;
  return pattern;
}

Edit edit_of(const Row& row) {
  const bool rename = *row.name && std::string_view(row.key) == "name";
  return {rename ? Edit::Kind::rename : Edit::Kind::set, row.list, row.name, rename ? "" : row.key,
          value_of(row.other)};
}

/// Where two values differ, as pointers to the outermost things that are not both objects or lists of one length.
void differences(const Value& a, const Value& b, const std::string& where, std::vector<std::string>& found) {
  if (a == b) return;
  if (a.object() && b.object()) {
    std::set<std::string> keys;
    for (const auto& [key, member] : *a.object()) keys.insert(key);
    for (const auto& [key, member] : *b.object()) keys.insert(key);
    for (const std::string& key : keys) {
      const Value* in_a = a.find(key);
      const Value* in_b = b.find(key);
      differences(in_a ? *in_a : Value(), in_b ? *in_b : Value(), pointer_into(where, key), found);
    }
  } else if (a.array() && b.array() && a.array()->size() == b.array()->size()) {
    for (std::size_t i = 0; i < a.array()->size(); ++i) {
      differences((*a.array())[i], (*b.array())[i], pointer_into(where, i), found);
    }
  } else {
    found.push_back(where);
  }
}

template <class Check>
void each_row(Check&& check) {
  for (const Row& row : rows) check(row, full_project());
  for (const Row& row : rows_of_both_eyes) check(row, both_eyes_project());
  for (const Row& row : rows_of_the_list) check(row, full_project());
}

std::set<std::string> rows_patterns() {
  std::set<std::string> patterns;
  each_row([&](const Row& row, const Project& project) {
    patterns.insert(pattern_of(pointer_of(value_from(project), row)));
  });
  return patterns;
}

/// Every key a schema describes, in the patterns of project_keys.
void schema_keys(const Value& root, const Value& schema, const std::string& prefix, std::set<std::string>& keys) {
  if (const Value* ref = schema.find("$ref")) {
    const Value* definition = value_at(root, pointer_steps(ref->text()->substr(1)));
    REQUIRE(definition);
    schema_keys(root, *definition, prefix, keys);
  }
  if (const Value* properties = schema.find("properties")) {
    for (const auto& [key, below] : *properties->object()) {
      keys.insert(pointer_into(prefix, key));
      schema_keys(root, below, pointer_into(prefix, key), keys);
    }
  }
  if (const Value* items = schema.find("items")) schema_keys(root, *items, prefix + "/*", keys);
  for (const char* branch : {"then", "else"}) {
    if (const Value* below = schema.find(branch)) schema_keys(root, *below, prefix, keys);
  }
  if (const Value* all = schema.find("allOf")) {
    for (const Value& below : *all->array()) schema_keys(root, below, prefix, keys);
  }
}

}  // namespace

TEST_CASE("the table of this test has every key of the field tables, and no other") {
  const auto keys = project_keys();
  std::set<std::string> wanted(keys.begin(), keys.end());
  wanted.erase("/focalstage");  // the version is no key to edit; version_test has its cases
  const std::set<std::string> listed = rows_patterns();
  for (const std::string& key : wanted) CHECK_MESSAGE(listed.contains(key), key << " has no row");
  for (const std::string& key : listed) CHECK_MESSAGE(wanted.contains(key), key << " is no key");
}

TEST_CASE("the schema describes every key of the field tables, and no other") {
  const Value schema = value_of(project_schema());
  std::set<std::string> described;
  schema_keys(schema, schema, "", described);
  const auto keys = project_keys();
  const std::set<std::string> wanted(keys.begin(), keys.end());
  for (const std::string& key : wanted) CHECK_MESSAGE(described.contains(key), key << " is not in the schema");
  for (const std::string& key : described) CHECK_MESSAGE(wanted.contains(key), key << " is only in the schema");
}

TEST_CASE("every key: an edit changes it and nothing else, undo brings it back, and it survives the file") {
  each_row([](const Row& row, const Project& before) {
    INFO(row.list, " ", row.name, " ", row.key);
    const Value before_value = value_from(before);
    const std::string pointer = pointer_of(before_value, row);
    History history(before);
    const Status done = history.apply({"edit", {edit_of(row)}});
    REQUIRE_MESSAGE(done.ok(), describe(done.ok() ? Fault{} : done.fault()));

    const Value after_value = value_from(*history.now());
    std::vector<std::string> changed;
    differences(before_value, after_value, "", changed);
    CHECK_FALSE(changed.empty());
    for (const std::string& where : changed) CHECK_MESSAGE((where + "/").starts_with(pointer + "/"), where);
    const Value* written = value_at(after_value, pointer_steps(pointer));
    const Value other = value_of(row.other);
    if (written) CHECK(*written == other);
    // What goes back to its default is not written at all.
    if (!written)
      CHECK((other == Value(false) || other == Value(Value::Array{}) || other == Value("square") ||
             other == Value("linear") || other == Value("srgb")));

    const std::string text = project_text(*history.now());
    const auto loaded = parse_project(text, "test");
    REQUIRE_MESSAGE(loaded.ok(), describe(loaded.ok() ? Fault{} : loaded.fault()));
    CHECK(loaded->project == *history.now());
    CHECK(project_text(loaded->project) == text);

    history.undo();
    CHECK(*history.now() == before);
    history.redo();
    CHECK(value_from(*history.now()) == after_value);
  });
}

TEST_CASE("every key: a value of a wrong type is refused at its pointer, by file and by edit") {
  const std::vector<Value> kinds{Value(true),
                                 Value(0.3),
                                 Value("x \x01"),
                                 Value(Value::Array{Value(Value::Array{})}),
                                 Value(Value::Object{{"q", Value(1)}}),
                                 Value()};
  each_row([&](const Row& row, const Project& before) {
    const Value written = value_from(before);
    const std::string pointer = pointer_of(written, row);
    const Value right = *value_at(written, pointer_steps(pointer));
    for (const Value& wrong : kinds) {
      if (type_word(wrong) == type_word(right) || type_word(wrong) == type_word(value_of(row.other))) {
        continue;
      }
      Value broken = written;
      *const_cast<Value*>(value_at(broken, pointer_steps(pointer))) = wrong;
      INFO(pointer, " = ", write_json(wrong, -1));
      const auto loaded = parse_project(write_json(broken), "file");
      REQUIRE_FALSE(loaded.ok());
      CHECK((loaded.fault().where + "/").starts_with("file: " + pointer + "/"));
      CHECK_FALSE(loaded.fault().remedy.empty());
      const auto refused = schema_fault(broken, project_schema());
      CHECK_MESSAGE(refused, "the schema lets it pass");
      if (refused) CHECK(refused->code == "project.schema");
      if (wrong.is_null()) continue;  // an edit's null takes the key away
      Edit edit = edit_of(row);
      edit.value = wrong;
      const auto applied = apply(before, edit);
      REQUIRE_FALSE(applied.ok());
      CHECK(applied.fault().code.starts_with("edit."));
      CHECK_FALSE(applied.fault().where.empty());
    }
  });
}

TEST_CASE("every key: null takes it away, and the file still opens; or it is refused as missing") {
  each_row([](const Row& row, const Project& before) {
    Edit edit = edit_of(row);
    if (edit.kind != Edit::Kind::set) return;
    INFO(row.list, " ", row.name, " ", row.key);
    edit.value = Value();
    const auto taken = apply(before, edit);
    if (taken) {
      const auto loaded = parse_project(project_text(*taken), "test");
      REQUIRE(loaded.ok());
      CHECK(loaded->project == *taken);
    } else {
      CHECK(taken.fault().code == "edit.value");
      CHECK(taken.fault().message.find("missing") != std::string::npos);
    }
  });
}
