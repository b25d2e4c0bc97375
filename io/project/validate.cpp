#include "io/project/validate.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "core/scene/pointer.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

using nlohmann::json;

json number_from(double number) {
  constexpr double exactly_whole = 9007199254740992.0;  // 2^53
  if (number == std::floor(number) && std::abs(number) <= exactly_whole) return static_cast<std::int64_t>(number);
  return number;
}

/// Values come from parse_json, which bounds how deep they nest.
json json_from(const Value& value) {
  if (const bool* flag = value.boolean()) return *flag;
  if (const double* number = value.number()) return number_from(*number);
  if (const std::string* text = value.text()) return *text;
  if (const Value::Array* items = value.array()) {
    json list = json::array();
    for (const Value& item : *items) list.push_back(json_from(item));
    return list;
  }
  if (const Value::Object* members = value.object()) {
    json object = json::object();
    for (const auto& [key, member] : *members) object[key] = json_from(member);
    return object;
  }
  return nullptr;
}

/// The validator's steps: "<root>", "[key]", "[3]".
std::string pointer_from(const std::vector<std::string>& steps) {
  std::string pointer;
  for (const std::string& step : steps) {
    if (step.size() < 2 || step.front() != '[') continue;
    pointer = pointer_into(pointer, std::string_view(step).substr(1, step.size() - 2));
  }
  return pointer;
}

/// Of what the validator says, the deepest: outer complaints only repeat that something within is wrong.
Fault deepest(valijson::ValidationResults& results, const std::string& kind) {
  const std::string refused = "does not agree with the " + kind + "'s schema";
  Fault fault{kind + ".schema", "", refused, "see io/schema/" + kind + ".schema.json"};
  std::size_t depth = 0;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    if (error.context.size() < depth) continue;
    depth = error.context.size() + 1;
    fault.where = pointer_from(error.context);
    fault.message = refused + ": " + error.description;
  }
  return fault;
}

}  // namespace

std::optional<Fault> schema_fault(const Value& value, std::string_view schema_text, const std::string& kind) {
  try {
    const json schema_json = json::parse(schema_text);
    const json target_json = json_from(value);
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
    valijson::Validator validator;
    valijson::ValidationResults results;
    const valijson::adapters::NlohmannJsonAdapter target(target_json);
    if (validator.validate(schema, target, &results)) return std::nullopt;
    return deepest(results, kind);
  } catch (const std::exception& error) {
    return Fault{kind + ".schema", "", std::string("cannot be held against the schema: ") + error.what(), ""};
  }
}

Fault in_file(Fault fault, const std::string& source) {
  fault.where = fault.where.empty() ? source : source + ": " + fault.where;
  return fault;
}

Result<Value> parse_checked(std::string_view text, const std::string& source, std::size_t most_bytes,
                            std::string_view schema, const std::string& kind) {
  auto value = parse_json(text, source, {most_bytes, 16});
  if (!value) return value;
  if (const auto refused = schema_fault(*value, schema, kind)) return in_file(*refused, source);
  return value;
}

}  // namespace focalstage
