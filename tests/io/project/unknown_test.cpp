#include <algorithm>

#include "core/scene/edit.h"
#include "core/scene/pointer.h"
#include "core/scene/project_value.h"
#include "io/project/project_file.h"
#include "tests/io/project/sample.h"

using namespace focalstage;

namespace {

/// Gives every object of the file a member that no version knows, and collects their pointers.
void plant(Value& value, const std::string& where, std::vector<std::string>& planted) {
  if (Value::Array* items = value.array()) {
    for (std::size_t i = 0; i < items->size(); ++i) plant((*items)[i], pointer_into(where, i), planted);
  } else if (Value::Object* members = value.object()) {
    for (auto& [key, member] : *members) plant(member, pointer_into(where, key), planted);
    value.set("x-note/1", value_of(R"({"deep":[1,{"k":null}],"t":"\u00fc"})"));
    planted.push_back(pointer_into(where, "x-note/1"));
  }
}

}  // namespace

TEST_CASE("unknown keys are kept in every object of the file, and each is noted once") {
  Value value = value_of(full_sample);
  std::vector<std::string> planted;
  plant(value, "", planted);
  CHECK(planted.size() > 40);

  const auto loaded = parse_project(write_json(value), "x");
  REQUIRE_MESSAGE(loaded.ok(), describe(loaded.ok() ? Fault{} : loaded.fault()));
  std::vector<std::string> noted;
  for (const Finding& note : loaded->notes) {
    CHECK(note.severity == Severity::info);
    CHECK(note.code == "project.unknown-key");
    noted.push_back(note.where);
  }
  std::sort(planted.begin(), planted.end());
  std::sort(noted.begin(), noted.end());
  CHECK(noted == planted);

  const auto again = parse_json(project_text(loaded->project), "x");
  REQUIRE(again.ok());
  for (const std::string& where : planted) {
    INFO(where);
    const Value* kept = value_at(*again, pointer_steps(where));
    REQUIRE(kept);
    CHECK(*kept == value_of(R"({"deep":[1,{"k":null}],"t":"\u00fc"})"));
  }
  CHECK(parse_project(project_text(loaded->project), "x")->project == loaded->project);
}

TEST_CASE("an edit can change and remove an unknown key that is there, but not invent one") {
  Value value = value_of(full_sample);
  value.find("viewer")->set("x-note", Value(1));
  const Project project = *project_from(value);
  const auto changed = apply(project, {Edit::Kind::set, "viewer", "", "x-note", Value(2)});
  REQUIRE(changed.ok());
  CHECK(*value_from(*changed).find("viewer")->find("x-note") == Value(2));
  const auto removed = apply(project, {Edit::Kind::set, "viewer", "", "x-note", Value()});
  REQUIRE(removed.ok());
  CHECK_FALSE(value_from(*removed).find("viewer")->find("x-note"));
  for (const char* key : {"x-other", "x-other/deep", "interpupilary_mm"}) {
    const auto invented = apply(project, {Edit::Kind::set, "viewer", "", key, Value(2)});
    REQUIRE_FALSE(invented.ok());
    CHECK(invented.fault().code == "edit.key");
  }
}
