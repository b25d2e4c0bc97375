#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/journal/journal.h"

namespace focalstage {

/// One line of a journal: a checksum, a space, JSON, a newline. The other way: nothing where the line is not whole.
std::string journal_line(const Value& value);
std::optional<Value> journal_value(std::string_view line);

Value value_from(const JournalStart& start);
std::optional<JournalStart> journal_start_from(const Value& value);

Value value_from(const JournalRecord& record);
std::optional<JournalRecord> journal_record_from(const Value& value);

}  // namespace focalstage
