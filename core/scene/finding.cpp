#include "core/scene/finding.h"

#include <algorithm>

namespace focalstage {
namespace {

std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::info:
      break;
  }
  return "info";
}

}  // namespace

bool has_error(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::error; });
}

Value value_from(const Finding& finding) {
  Value::Object object{{"severity", Value(word(finding.severity))},
                       {"code", Value(finding.code)},
                       {"where", Value(finding.where)},
                       {"message", Value(finding.message)}};
  if (finding.amount) {
    object.emplace_back("amount", Value(Value::Object{{"value", Value(finding.amount->value)},
                                                      {"limit", Value(finding.amount->limit)},
                                                      {"unit", Value(finding.amount->unit)}}));
  }
  Value::Array remedy;
  for (const Edit& edit : finding.remedy) remedy.push_back(value_from(edit));
  object.emplace_back("remedy", Value(std::move(remedy)));
  return Value(std::move(object));
}

}  // namespace focalstage
