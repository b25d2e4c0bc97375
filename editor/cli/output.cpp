#include "editor/cli/output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/base/number_words.h"
#include "editor/cli/one_line.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

const char* word(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::info:
      return "info";
  }
  return "";
}

std::string amount_text(const Amount& amount) {
  const std::string unit = amount.unit.empty() ? "" : " " + amount.unit;
  return short_text(amount.value) + unit + ", limit " + short_text(amount.limit) + unit;
}

}  // namespace

ExitStatus status_of(const Fault& fault) {
  static constexpr std::array<std::string_view, 13> environment{
      "rig.",     "file.unwritable", "show.disk-full", "show.unwritable",    "show.busy", "export.folder", "program.",
      "display.", "trials.busy",     "trials.stopped", "trials.input-ended", "measure.",  "light."};
  const bool outside = std::any_of(environment.begin(), environment.end(),
                                   [&](std::string_view code) { return fault.code.starts_with(code); });
  return outside ? ExitStatus::environment : ExitStatus::invalid;
}

ExitStatus report(const Fault& fault) {
  std::fprintf(stderr, "focalstage: %s\n", one_line(describe(fault)).c_str());
  return status_of(fault);
}

void print_json(const Value& object) { std::printf("%s\n", write_json(object, -1).c_str()); }

Value findings_value(const std::vector<Finding>& findings) {
  Value::Array array;
  for (const Finding& finding : findings) array.push_back(value_from(finding));
  Value object;
  object.set("findings", std::move(array));
  return object;
}

std::string findings_text(const std::vector<Finding>& findings) {
  if (findings.empty()) return "no findings\n";
  std::string text;
  for (const Finding& finding : findings) {
    text += std::string(word(finding.severity)) + ": " + finding.message + "\n";
    text += "  " + finding.code + " at " + (finding.where.empty() ? "/" : finding.where);
    if (finding.amount) text += " (" + amount_text(*finding.amount) + ")";
    text += "\n";
    for (const Edit& edit : finding.remedy) text += "  remedy: " + write_json(value_from(edit), -1) + "\n";
  }
  return text;
}

ExitStatus status_of(const std::vector<Finding>& findings) {
  return has_error(findings) ? ExitStatus::findings : ExitStatus::done;
}

namespace {

/// Characters, not bytes, of UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string table_text(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::size_t width = width_of(columns[c].title);
    for (const auto& row : rows) width = std::max(width, width_of(row[c]));
    widths.push_back(width);
  }
  const auto line = [&](const auto& cell) {
    std::string text;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string& content = cell(c);
      const std::string pad(widths[c] - width_of(content), ' ');
      text += (c == 0 ? "" : "  ") + (columns[c].right ? pad + content : content + pad);
    }
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text + "\n";
  };
  std::string text = line([&](std::size_t c) -> const std::string& { return columns[c].title; });
  for (const auto& row : rows) text += line([&](std::size_t c) -> const std::string& { return row[c]; });
  return text;
}

}  // namespace focalstage
