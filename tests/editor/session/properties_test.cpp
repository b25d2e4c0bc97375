#include "editor/session/properties.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/scene/pointer.h"
#include "core/scene/project_value.h"
#include "editor/session/angles.h"
#include "editor/session/colour_text.h"
#include "editor/session/edits.h"

using namespace focalstage;

namespace {

using Kind = Property::Kind;

Edit set(const std::string& list, const std::string& name, const std::string& key, Value value) {
  return {Edit::Kind::set, list, name, key, std::move(value)};
}

Value object(const char* primitive, Value::Object more = {}) {
  Value item;
  item.set("mesh", Value(Value::Object{{"primitive", primitive}}));
  item.set("position_m", Value(Value::Array{0.0, 0.0, -0.5}));
  item.set("scale", std::string(primitive) == "rabbit" ? 0.1 : 0.2);
  item.set("depth", Value(Value::Object{{"mode", "placed"}}));
  for (auto& [key, value] : more) item.set(key, std::move(value));
  return item;
}

Value key(double time_s, double x) {
  Value value;
  value.set("time_s", time_s);
  value.set("position_m", Value(Value::Array{x, 0.0, -0.5}));
  value.set("rotation_xyzw", Value(Value::Array{0.0, 0.0, 0.0, 1.0}));
  return value;
}

Value picture(const char* file, double count = 0.0) {
  Value image(Value::Object{{"file", file}});
  if (count > 0.0) {
    image.set("count", count);
    image.set("rate_hz", 24.0);
  }
  return Value(Value::Object{{"image", image}});
}

/// One of everything that has rows.
Project rich_project() {
  Project start;
  start.name = "rich";
  start.projectors.resize(1);
  start.projectors[0].name = "main";
  start.slices.powers_d = {-1.0, 0.0, 1.0};
  start.frames.count = 30;
  Value fixed, slice, checker;
  fixed.set("mode", "fixed");
  fixed.set("vergence_d", 2.0);
  slice.set("mode", "slice");
  slice.set("index", 1.0);
  checker.set("checker", Value(Value::Object{{"squares", Value(Value::Array{4, 6})}}));
  const Value unlit(Value::Object{{"unlit", Value(Value::Array{1.0, 0.5, 0.25})}});
  const Value offset(Value::Object{{"mode", "offset"}, {"vergence_d", 0.25}});
  const Value keys(Value::Array{key(0.0, 0.0), key(1.0, 0.1)});
  const auto step_of = [](const char* name, const char* key = nullptr, double number = 0.0) {
    Value made(Value::Object{{"step", name}});
    if (key) made.set(key, number);
    return made;
  };
  Value with_size = step_of("uv-plane");
  with_size.set("size_m", Value(Value::Array{1.0, 2.0}));
  const Value process(Value::Array{step_of("weld"), step_of("clean"), step_of("drop-bits"),
                                   step_of("fill-holes", "longest_mm", 50.0), step_of("keep-part"),
                                   step_of("decimate", "triangles", 1000.0), step_of("decimate", "error_mm", 0.5),
                                   step_of("smooth"), step_of("subdivide"), with_size, step_of("uv-projector")});
  Value with_file = object("plane");
  with_file.set("mesh", Value(Value::Object{{"file", "assets/a.glb"}, {"process", process}}));
  const auto add = [](const char* list, const char* name, Value item) { return add_edit(list, name, std::move(item)); };
  Value corner = object("corner"), step = object("step");
  corner.erase("depth");
  step.erase("depth");
  const auto made = apply_all(
      start, {add("objects", "rabbit", object("rabbit")), add("objects", "box", object("box", {{"depth", fixed}})),
              add("objects", "ball", object("sphere", {{"depth", offset}, {"appearance", unlit}})),
              add("objects", "sheet", object("plane", {{"depth", slice}, {"appearance", checker}, {"keys", keys}})),
              add("objects", "poster", object("plane", {{"appearance", picture("poster.png")}})),
              add("objects", "fire", object("plane", {{"appearance", picture("fire_##.png", 12.0)}})),
              add("objects", "filed", with_file), add("surfaces", "corner", corner), add("surfaces", "step", step),
              add("lights", "sun", Value(Value::Object{{"kind", "sun"}})),
              add("lights", "lamp", Value(Value::Object{{"kind", "point"}})),
              set("projectors", "main", "distortion", Value(Value::Array{0.1, 0.0, 0.0, 0.0})),
              set("projectors", "main", "focus_m", Value(0.8)),
              set("", "", "cues", Value(Value::Array{Value(Value::Object{{"name", "go"}, {"time_s", 0.5}})}))});
  REQUIRE_MESSAGE(made.ok(), describe(made.ok() ? Fault{} : made.fault()));
  return *made;
}

/// Without what needs a file.
std::shared_ptr<const Stage> staged(Project project, double time_s = 0.0) {
  const auto is_filed = [](const auto& thing) { return std::holds_alternative<FileMesh>(thing.mesh.shape); };
  std::erase_if(project.objects, is_filed);
  std::erase_if(project.objects,
                [](const Object& each) { return std::holds_alternative<ImageAppearance>(each.appearance); });
  std::erase_if(project.surfaces, is_filed);
  for (Surface& surface : project.surfaces) {
    if (std::holds_alternative<FileAlbedo>(surface.albedo)) surface.albedo = PlainAlbedo{};
  }
  auto made = stage(project, {}, time_s);
  REQUIRE(made.ok());
  return std::make_shared<const Stage>(std::move(*made));
}

std::vector<PropertyGroup> rows_of(const Project& project, const std::vector<Thing>& things, double time_s = 0.0,
                                   glm::dvec3 near_deg = glm::dvec3(0.0)) {
  const auto stage = staged(project, time_s);
  Picker picker;
  return properties_of({project, time_s, stage.get(), &picker, near_deg}, things);
}

/// What a hand could put there instead.
std::vector<Value> others(const Property& row) {
  switch (row.kind) {
    case Kind::number:
    case Kind::integer: {
      const double* now = row.value.number();
      if (!now) return {row.fresh};
      const double by = row.kind == Kind::integer ? 1.0 : std::pow(10.0, -row.digits) * 7.0;
      return {Value(*now + by <= row.most ? *now + by : *now - by)};
    }
    case Kind::text:
      return {Value("another Ω")};
    case Kind::flag:
      return {Value(!*row.value.boolean())};
    case Kind::colour:
      return {Value(Value::Array{0.125, 0.5, 0.75})};
    case Kind::choice: {
      std::vector<Value> values;
      for (const PropertyChoice& choice : row.choices) {
        if (choice.value != row.value) values.push_back(choice.value);
      }
      return values;
    }
    case Kind::shown:
    case Kind::action:
      break;
  }
  return {};
}

bool near(const Value& a, const Value& b) {
  if (!a.number() || !b.number()) return a == b;
  return std::abs(*a.number() - *b.number()) < 1e-6;
}

Project after(const Project& project, const std::vector<Thing>& things, const std::string& id, const Value& value,
              double time_s = 0.0) {
  const auto stage = staged(project, time_s);
  Picker picker;
  const PropertyScope scope{project, time_s, stage.get(), &picker};
  const auto groups = properties_of(scope, things);
  const Property* row = row_named(groups, id);
  REQUIRE_MESSAGE(row, id);
  const auto edits = edits_for(scope, things, *row, value);
  REQUIRE_FALSE(edits.empty());
  const auto changed = apply_all(project, edits);
  REQUIRE_MESSAGE(changed.ok(), describe(changed.ok() ? Fault{} : changed.fault()));
  return *changed;
}

/// "mesh/size_m/0" -> "mesh/size_m": keys of lists have no index in the schema's names here.
std::string without_indices(const std::string& path) {
  std::string plain;
  for (const std::string& step : pointer_steps(path)) {
    if (!index_in(step)) plain += (plain.empty() ? "" : "/") + step;
  }
  return plain;
}

}  // namespace

TEST_CASE("every row of everything sets what it says and reads it back") {
  const Project project = rich_project();
  std::vector<Thing> all = things_of(project);
  all.push_back({});
  int set_rows = 0;
  for (const Thing& thing : all) {
    const std::vector<Thing> things = thing.list.empty() ? std::vector<Thing>{} : std::vector<Thing>{thing};
    for (const PropertyGroup& group : rows_of(project, things)) {
      for (const Property& row : group.rows) {
        for (const Value& value : others(row)) {
          CAPTURE(thing.list);
          CAPTURE(thing.name);
          CAPTURE(row.id);
          const Project changed = after(project, things, row.id, value);
          const bool renamed = row.key == "name" && !thing.list.empty();
          const auto groups = rows_of(changed, renamed ? std::vector<Thing>{{thing.list, *value.text()}} : things);
          const Property* again = row_named(groups, row.id);
          REQUIRE(again);
          CHECK(near(again->value, value));
          CHECK_FALSE(words_for(row, things, value).empty());
          ++set_rows;
        }
      }
    }
  }
  CHECK(set_rows > 200);
}

TEST_CASE("what can be taken away goes, and comes back with what it begins with") {
  const Project project = rich_project();
  for (const Thing& thing : things_of(project)) {
    for (const PropertyGroup& group : rows_of(project, {thing})) {
      for (const Property& row : group.rows) {
        if (!row.removable || row.value.is_null()) continue;
        CAPTURE(thing.list);
        CAPTURE(row.id);
        const Project changed = after(project, {thing}, row.id, Value());
        CHECK(changed != project);
      }
    }
  }
  const Project lit = after(project, {{"projectors", "main"}}, "lumens", Value(800.0));
  CHECK(lit.projectors[0].lumens == 800.0);
  CHECK_FALSE(after(lit, {{"projectors", "main"}}, "lumens", Value()).projectors[0].lumens.has_value());
}

TEST_CASE("the extremes a row allows are allowed by the project") {
  const Project project = rich_project();
  for (const Thing& thing : things_of(project)) {
    for (const PropertyGroup& group : rows_of(project, {thing})) {
      for (const Property& row : group.rows) {
        if (row.kind != Kind::number && row.kind != Kind::integer) continue;
        // Which of two ends is lower is between the rows; a lens too near the pupil or far powers too.
        static const std::set<std::string> between{"lowest power", "highest power", "lens to pupil"};
        if (between.contains(row.id)) continue;
        for (const double extreme : {row.least, row.most}) {
          CAPTURE(thing.list);
          CAPTURE(row.id);
          CAPTURE(extreme);
          const auto edits = edits_for({project}, {thing}, row, Value(extreme));
          if (!edits.empty()) CHECK(apply_all(project, edits).ok());
        }
      }
    }
  }
}

TEST_CASE("every key a project file may have stands in some row") {
  Project project = rich_project();
  const MeshSource filed = object_named(project, "filed")->mesh;
  for (const MeshShape& shape : {MeshShape(SphereMesh{}), MeshShape(CornerMesh{}), MeshShape(StepMesh{})}) {
    const std::string name = "shape " + std::to_string(shape.index());
    project.objects.push_back(project.objects[0]);
    project.objects.back().name = name;
    project.objects.back().mesh.shape = shape;
    project.surfaces.push_back(project.surfaces[0]);
    project.surfaces.back().name = name;
    project.surfaces.back().mesh.shape = shape;
  }
  project.surfaces[0].mesh = filed;
  project.surfaces.back().albedo = FileAlbedo{"assets/wall.png", {}};
  std::set<std::string> shown;
  for (const Thing& thing : things_of(project)) {
    for (const PropertyGroup& group : rows_of(project, {thing})) {
      for (const Property& row : group.rows) {
        std::string plain = without_indices(row.key);
        if (plain == "rotation") plain = "rotation_xyzw";
        const bool single = thing.name.empty();
        shown.insert("/" + thing.list + (single ? "/" : "/*/") + plain);
        if (row.id.starts_with("cue ")) shown.insert({"/cues/*/time_s", "/cues/*/name"});
      }
    }
  }
  // Read as a whole, or made by other rows: the mode of a depth by its choice, keys on the timeline, what the rig
  // measured by adopting it.
  static const std::set<std::string> wholes{"/glasses/lens_response", "/sweep/waveform"};
  for (const std::string& known : project_keys()) {
    std::string name;
    for (const std::string& step : pointer_steps(known)) name += "/" + step;
    const bool is_part = name.find("/keys/") != std::string::npos;
    if (name.ends_with("/process/*/step")) continue;  // the row of the step itself
    if (const auto at = name.find("/process/*/"); at != std::string::npos) name.erase(at + 8, 2);
    const bool is_root = std::count(name.begin(), name.end(), '/') == 1;
    const bool has_parts =
        std::any_of(shown.begin(), shown.end(), [&](const std::string& row) { return row.starts_with(name + "/"); });
    const bool in_whole =
        std::any_of(wholes.begin(), wholes.end(), [&](const std::string& whole) { return name.starts_with(whole); });
    CAPTURE(name);
    CHECK((is_part || is_root || has_parts || in_whole || shown.contains(name)));
  }
}

TEST_CASE("a step is added by the last row of processing, changed by its own, and taken away") {
  const Project project = rich_project();
  const std::vector<Thing> box{{"objects", "box"}};
  const auto steps_of = [](const Project& of) { return object_named(of, "box")->mesh.process; };
  Project with = after(project, box, "step 1", Value("smooth"));
  REQUIRE(steps_of(with).size() == 1);
  CHECK(steps_of(with)[0].kind == ProcessKind(SmoothStep{}));
  with = after(with, box, "step 1 rounds", Value(3.0));
  with = after(with, box, "step 2", Value("decimate"));
  REQUIRE(steps_of(with).size() == 2);
  CHECK(steps_of(with)[0].kind == ProcessKind(SmoothStep{3, 30.0}));
  CHECK(steps_of(with)[1].kind == ProcessKind(DecimateStep{6, std::nullopt}));  // half of a box
  with = after(with, box, "step 2", Value("decimate by error"));
  CHECK(steps_of(with)[1].kind == ProcessKind(DecimateStep{std::nullopt, 0.1}));
  CHECK_FALSE(row_named(rows_of(with, box), "step 2 triangles"));
  with = after(with, box, "step 1", Value());
  REQUIRE(steps_of(with).size() == 1);
  CHECK(std::holds_alternative<DecimateStep>(steps_of(with)[0].kind));
  CHECK(row_named(rows_of(with, box), "step 2")->value.is_null());
}

TEST_CASE("of several things stand the rows that all have, and differences are told") {
  const Project project = rich_project();
  const std::vector<Thing> two{{"objects", "box"}, {"objects", "ball"}};
  const auto groups = rows_of(project, two);
  REQUIRE(row_named(groups, "position z"));
  CHECK_FALSE(row_named(groups, "position z")->mixed);
  CHECK(row_named(groups, "shape")->mixed);
  CHECK_FALSE(row_named(groups, "radius"));
  CHECK_FALSE(row_named(groups, "name"));
  const Project moved = after(project, two, "position x", Value(0.25));
  CHECK(object_named(moved, "box")->placement.pose.position_m == glm::dvec3(0.25, 0.0, -0.5));
  CHECK(object_named(moved, "ball")->placement.pose.position_m == glm::dvec3(0.25, 0.0, -0.5));
  // A value that only the last one has already still goes to the others.
  const Project balls = after(project, two, "shape", Value("sphere"));
  CHECK(std::holds_alternative<SphereMesh>(object_named(balls, "box")->mesh.shape));
  CHECK(balls.objects[2] == project.objects[2]);
  // A surface and an object have places and meshes in common, but depth is the object's alone.
  const auto unlike = rows_of(project, {{"objects", "box"}, {"surfaces", "step"}});
  CHECK(row_named(unlike, "position x"));
  CHECK(row_named(unlike, "hidden"));
  CHECK_FALSE(row_named(unlike, "focus"));
  CHECK_FALSE(row_named(unlike, "illumination"));
}

TEST_CASE("models to choose from are those that somebody described, and the one that is named already") {
  Project project = rich_project();
  const auto choices = [&](std::shared_ptr<const ProjectorModels> models) {
    PropertyScope scope{project};
    scope.models = std::move(models);
    const auto groups = properties_of(scope, {{"projectors", "main"}});
    std::vector<std::string> words;
    for (const PropertyChoice& choice : row_named(groups, "model")->choices) words.push_back(choice.label);
    return words;
  };
  ProjectorModels two(2);
  two[0].name = "one";
  two[1].name = "dynaflash";
  const auto known = std::make_shared<const ProjectorModels>(two);
  CHECK(choices(nullptr) == std::vector<std::string>{"dynaflash"});
  CHECK(choices(known) == std::vector<std::string>{"one", "dynaflash"});
  project.projectors[0].model = "abacus";
  CHECK(choices(known) == std::vector<std::string>{"one", "dynaflash", "abacus"});
}

TEST_CASE("nothing selected shows the project") {
  const Project project = rich_project();
  const auto groups = rows_of(project, {});
  CHECK(row_named(groups, "name")->value == Value("rich"));
  CHECK(row_named(groups, "objects")->value == Value("7"));
  CHECK(row_named(groups, "slices")->value == Value("3"));
  CHECK(after(project, {}, "name", Value("Другой")).name == "Другой");
  CHECK(title_for({project}, {}).title == "rich");
}

TEST_CASE("what moves is edited at the frame in view") {
  const Project project = rich_project();
  const std::vector<Thing> sheet{{"objects", "sheet"}};
  // Between the keys at 0 s (x = 0) and 1 s (x = 0.1).
  CHECK(row_named(rows_of(project, sheet, 0.5), "position x")->value.number()[0] == doctest::Approx(0.05));
  const Project moved = after(project, sheet, "position x", Value(0.3), 0.5);
  const auto& keys = object_named(moved, "sheet")->placement.keys;
  REQUIRE(keys.size() == 3);
  CHECK(keys[1].time_s == 0.5);
  CHECK(keys[1].pose.position_m.x == 0.3);
  CHECK(object_named(moved, "sheet")->placement.pose == object_named(project, "sheet")->placement.pose);
}

TEST_CASE("depth tells vergence, accommodation and their conflict, red beyond half a dioptre") {
  Project project = rich_project();
  // A centre 0.44 m before the lens, which stands 15 mm before the pupils: 1/0.44 = 2.27 D.
  project = *apply(project, set("objects", "box", "position_m", Value(Value::Array{0.0, 0.0, -0.455})));
  auto groups = rows_of(project, {{"objects", "box"}});
  CHECK(row_named(groups, "vergence")->value == Value("2.27 D"));
  CHECK(row_named(groups, "vergence")->other == "0.44 m");
  CHECK(row_named(groups, "conflict")->value == Value("-0.27 D"));
  CHECK(row_named(groups, "conflict")->tone == Property::Tone::plain);
  CHECK(row_named(groups, "accommodation")->other == "0.50 m");
  const Project far = after(project, {{"objects", "box"}}, "focus distance", Value(2.0));
  CHECK(object_named(far, "box")->depth.vergence_d == doctest::Approx(0.5));
  groups = rows_of(far, {{"objects", "box"}});
  CHECK(row_named(groups, "conflict")->value == Value("-1.77 D"));
  CHECK(row_named(groups, "conflict")->tone == Property::Tone::red);
}

TEST_CASE("another rule for the depth leaves it where it is") {
  const Project project = rich_project();
  const std::vector<Thing> box{{"objects", "box"}};
  // Fixed at 2 D while it stands at 2.06 D: shifted by -0.06 D.
  const Project shifted = after(project, box, "focus", Value("offset"));
  CHECK(object_named(shifted, "box")->depth.vergence_d == doctest::Approx(-0.06));
  const Project placed = after(project, box, "focus", Value("placed"));
  const Project fixed = after(placed, box, "focus", Value("fixed"));
  CHECK(object_named(fixed, "box")->depth.vergence_d == doctest::Approx(2.06));
}

TEST_CASE("another shape is about as large") {
  const Project project = rich_project();
  const Project teapot = after(project, {{"objects", "ball"}}, "shape", Value("teapot"));
  CHECK(object_named(teapot, "ball")->scale == doctest::Approx(0.1));
  const Project plane = after(project, {{"objects", "rabbit"}}, "shape", Value("plane"));
  CHECK(object_named(plane, "rabbit")->scale == 1.0);
  // Among sized shapes the scale is the designer's.
  CHECK(object_named(after(project, {{"objects", "ball"}}, "shape", Value("box")), "ball")->scale == 0.2);
}

TEST_CASE("what is locked can be read and unlocked, not moved") {
  const Project project = *apply(rich_project(), set("objects", "box", "locked", Value(true)));
  const auto groups = rows_of(project, {{"objects", "box"}});
  const Property* x = row_named(groups, "position x");
  CHECK_FALSE(x->unavailable.empty());
  CHECK(edits_for({project}, {{"objects", "box"}}, *x, Value(1.0)).empty());
  CHECK_FALSE(object_named(after(project, {{"objects", "box"}}, "locked", Value(false)), "box")->locked);
  // One locked among several keeps all of them.
  CHECK_FALSE(
      row_named(rows_of(project, {{"objects", "box"}, {"objects", "ball"}}), "position x")->unavailable.empty());
}

TEST_CASE("angles come back as they were set, also past straight up and all around") {
  glm::dvec3 shown(0.0);
  for (int step = 0; step < 800; ++step) {  // a hand that turns pitch on and on, twice around
    const glm::dvec3 wanted(shown.x + 0.9, 30.0, -20.0);
    const glm::dvec3 seen = angles_of(rotation_of(wanted), step == 0 ? wanted : shown);
    CHECK(glm::all(glm::lessThan(glm::abs(seen - wanted), glm::dvec3(1e-6))));
    shown = seen;
  }
  // Straight up: roll stays what it was, yaw takes the rest.
  const glm::dvec3 up = angles_of(rotation_of({90.0, 40.0, 10.0}), {89.0, 40.0, 10.0});
  CHECK(up.x == doctest::Approx(90.0));
  CHECK(up.y == doctest::Approx(40.0));
  CHECK(up.z == doctest::Approx(10.0));
  const glm::dvec3 down = angles_of(rotation_of({-90.0, 40.0, 10.0}), {-89.0, 40.0, 10.0});
  CHECK(down.y == doctest::Approx(40.0));
  // By hand: 90 degrees of yaw turn what looks along -Z to look along -X.
  const glm::dvec3 look = rotation_of({0.0, 90.0, 0.0}) * glm::dvec3(0.0, 0.0, -1.0);
  CHECK(look.x == doctest::Approx(-1.0));
  // Pitch 30 looks up by 30 degrees, whatever the yaw.
  CHECK((rotation_of({30.0, 77.0, 0.0}) * glm::dvec3(0.0, 0.0, -1.0)).y == doctest::Approx(0.5));
}

TEST_CASE("a sun's direction is told by where it comes from") {
  // From above and behind on the right: it travels down, forwards (-Z) and to the left.
  const glm::dvec3 direction = direction_from({45.0, 30.0});
  CHECK(direction.y == doctest::Approx(-0.5));
  CHECK(direction.x == doctest::Approx(-std::sqrt(0.375)));
  CHECK(direction.z == doctest::Approx(-std::sqrt(0.375)));
  CHECK(source_of(direction).x == doctest::Approx(45.0));
  CHECK(source_of(direction).y == doctest::Approx(30.0));
  CHECK(source_of({0.0, -1.0, 0.0}) == glm::dvec2(0.0, 90.0));
}

TEST_CASE("colours are written as people know them") {
  // sRGB: half the code is 0.2140 of the light (IEC 61966-2-1).
  CHECK(typed_colour("#808080")->r == doctest::Approx(0.2158605));
  CHECK(colour_text({1.0, 0.2158605, 0.0}) == "#ff8000");
  CHECK(colour_text(*typed_colour("f80")) == "#ff8800");
  CHECK(colour_text({7.0, -1.0, 0.0}) == "#ff0000");
  for (const char* wrong : {"", "#", "12345", "#12345g", "#1234567", "-12345"}) CHECK_FALSE(typed_colour(wrong));
}

TEST_CASE("what was done is said in words") {
  const auto groups = rows_of(rich_project(), {{"slices", ""}});
  CHECK(words_for(*row_named(groups, "slice 1"), {{"slices", ""}}, Value(0.2)) == "Set slice 1 of Slices");
  CHECK(words_for(*row_named(groups, "slice 1"), {{"slices", ""}}, Value()) == "Remove slice 1 of Slices");
  const std::vector<Thing> two{{"objects", "box"}, {"objects", "ball"}};
  CHECK(words_for(*row_named(rows_of(rich_project(), two), "position x"), two, Value(0.2)) == "Move 2 things");
}

TEST_CASE("titles say what it is") {
  const Project project = rich_project();
  const auto stage = staged(project);
  const PropertyScope scope{project, 0.0, stage.get()};
  CHECK(title_for(scope, {{"objects", "box"}}).subtitle == "box, 12 triangles");
  CHECK(title_for(scope, {{"objects", "filed"}}).subtitle == "a.glb");
  CHECK(title_for(scope, {{"projectors", "main"}}).subtitle == "dynaflash, 1024 × 768");
  const auto several = title_for(scope, {{"objects", "box"}, {"objects", "ball"}, {"surfaces", "step"}});
  CHECK(several.title == "3 things");
  CHECK(several.subtitle == "1 surface, 2 objects");
}
