#include "io/journal/record.h"

#include <cmath>

#include "io/files/files.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr std::size_t checksum_digits = 16;

std::string checksum(std::string_view text) { return sha256_hex(text).substr(0, checksum_digits); }

std::optional<std::string> text_in(const Value& value, std::string_view key) {
  const Value* member = value.find(key);
  if (!member || !member->text()) return std::nullopt;
  return *member->text();
}

bool flag_in(const Value& value, std::string_view key) {
  const Value* member = value.find(key);
  return member && member->boolean() && *member->boolean();
}

std::optional<JournalRecord> step_from(const Value& value) {
  JournalStep record;
  const auto words = text_in(value, "step");
  const Value* edits = value.find("edits");
  if (!words || !edits || !edits->array()) return std::nullopt;
  record.step.words = *words;
  for (const Value& item : *edits->array()) {
    auto edit = edit_from(item);
    if (!edit) return std::nullopt;
    record.step.edits.push_back(std::move(*edit));
  }
  if (flag_in(value, "continues")) record.joining = Joining::continues_last;
  return record;
}

}  // namespace

std::string journal_line(const Value& value) {
  const std::string json = write_json(value, -1);
  return checksum(json) + " " + json + "\n";
}

std::optional<Value> journal_value(std::string_view line) {
  if (line.size() < checksum_digits + 2 || line[checksum_digits] != ' ' || line.back() != '\n') return std::nullopt;
  const std::string_view json = line.substr(checksum_digits + 1, line.size() - checksum_digits - 2);
  if (line.substr(0, checksum_digits) != checksum(json)) return std::nullopt;
  auto value = parse_json(json, "journal");
  if (!value) return std::nullopt;
  return std::move(*value);
}

Value value_from(const JournalStart& start) {
  Value value;
  value.set("focalstage_journal", 1);
  value.set("project_file", start.project_file);
  value.set("untitled", start.untitled);
  value.set("base", start.base_text);
  return value;
}

std::optional<JournalStart> journal_start_from(const Value& value) {
  const Value* version = value.find("focalstage_journal");
  const auto file = text_in(value, "project_file");
  const auto base = text_in(value, "base");
  if (!version || *version != Value(1) || !file || !base) return std::nullopt;
  return JournalStart{*file, flag_in(value, "untitled"), *base};
}

Value value_from(const JournalRecord& record) {
  Value value;
  if (const auto* jump = std::get_if<JournalJump>(&record)) {
    value.set("jump", static_cast<double>(jump->place));
    return value;
  }
  const auto& made = std::get<JournalStep>(record);
  value.set("step", made.step.words);
  Value::Array edits;
  for (const Edit& edit : made.step.edits) edits.push_back(value_from(edit));
  value.set("edits", std::move(edits));
  if (made.joining == Joining::continues_last) value.set("continues", true);
  return value;
}

std::optional<JournalRecord> journal_record_from(const Value& value) {
  const Value* jump = value.find("jump");
  if (!jump) return step_from(value);
  const double* place = jump->number();
  if (!place || *place < 0 || *place > 1e9 || *place != std::floor(*place)) return std::nullopt;
  return JournalJump{static_cast<std::size_t>(*place)};
}

}  // namespace focalstage
