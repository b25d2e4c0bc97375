#include "core/scene/project_value.h"

#include "core/scene/fields_project.h"
#include "core/scene/number_text.h"

namespace focalstage {
namespace {

constexpr std::string_view version_key = "focalstage";

bool read_version(Reading& reading, const Value& value) {
  const Value* version = value.find(version_key);
  if (!version) {
    return reading.fail_at(version_key, "project.version", "is missing, so this may be no project",
                           "start the file with \"focalstage\": " + std::to_string(project_version));
  }
  const Reading::Step step(reading, version_key);
  if (!version->number()) return reading.wrong_type(*version, "a whole number");
  const double number = *version->number();
  if (number > project_version) {
    return reading.fail("project.version",
                        "version " + number_text(number) + " was made by a newer version of Focalstage",
                        "open it with that version; this one reads up to " + std::to_string(project_version));
  }
  if (number == project_version) return true;
  return reading.fail("project.version", number_text(number) + " is no version of the project file",
                      "write " + std::to_string(project_version));
}

}  // namespace

Result<Project> project_from(const Value& value, std::vector<Finding>* notes) {
  std::vector<Finding> met;
  Reading reading(&met);
  Project project;
  std::vector<std::string_view> known{version_key};
  if (!value.object()) {
    reading.wrong_type(value, "an object");
  } else if (read_version(reading, value) && read_fields(reading, value, project, known)) {
    keep_unknown(reading, value, known, project.unknown);
    name_lights(project.lights);
    check_project(reading, project);
  }
  if (reading.fault()) return *reading.fault();
  if (notes) notes->insert(notes->end(), met.begin(), met.end());
  return project;
}

Value value_from(const Project& project) {
  Value::Object object{{std::string(version_key), Value(project_version)}};
  write_fields(object, project);
  write_unknown(object, project.unknown);
  return Value(std::move(object));
}

std::optional<Fault> fault_of(const Project& project) {
  const auto read_back = project_from(value_from(project));
  return read_back ? std::nullopt : std::optional(read_back.fault());
}

std::vector<std::string> project_keys() {
  KeyList list;
  list.add(version_key, [](KeyList&) {});
  list_fields<Project>(list);
  return {list.keys.begin(), list.keys.end()};
}

}  // namespace focalstage
