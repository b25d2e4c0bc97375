#pragma once

#include <vector>

#include "core/scene/history.h"
#include "io/journal/journal.h"

namespace focalstage {

/// The history that a journal's records describe. A record that does not apply (another version's) ends it.
History replayed(const Project& base, const std::vector<JournalRecord>& records);

/// What the records would add, in words, those undone at the end left out.
std::vector<std::string> words_of(const std::vector<JournalRecord>& records);

}  // namespace focalstage
