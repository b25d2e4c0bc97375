#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/scene/history.h"
#include "io/files/descriptor.h"

namespace focalstage {

/// What happened to a history: a step was made, or somebody went to another place in it (undo, redo, a jump).
struct JournalStep {
  Step step;
  Joining joining = Joining::own_step;
  bool operator==(const JournalStep&) const = default;
};
struct JournalJump {
  std::size_t place = 0;
  bool operator==(const JournalJump&) const = default;
};
using JournalRecord = std::variant<JournalStep, JournalJump>;

/// Where a journal's history begins.
struct JournalStart {
  std::string project_file;  ///< absolute; whose edits these are
  bool untitled = false;     ///< the project has never been saved by its author
  std::string base_text;     ///< the project file as it was when the history began

  bool operator==(const JournalStart&) const = default;
};

/// The edits since the last save, on disk before anybody misses them: one checksummed line each, written at once (a
/// kill of the program loses none) and brought to the disk by `sync` (a power cut loses what came after the last one).
///
/// While open it holds a lock: who finds a journal that is locked has found an editor at work, not a crash.
class Journal {
 public:
  /// Starts anew, replacing what is there. Faults "journal.held" (another editor's), "file.unwritable".
  static Result<Journal> start(const std::filesystem::path& path, const JournalStart& start);

  Journal(Journal&&) noexcept = default;
  Journal& operator=(Journal&&) noexcept = default;
  ~Journal();  ///< one without a record goes: there is nothing in it to bring back

  Status add(const JournalRecord& record);
  /// Does nothing where nothing is new.
  Status sync();
  /// Removes the file: everything in it is saved, or is not wanted.
  void discard();

  const std::filesystem::path& path() const { return path_; }

 private:
  Journal(std::filesystem::path path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
  Status append(const std::string& line);

  std::filesystem::path path_;
  Descriptor file_;
  bool new_ = false;
  bool any_ = false;  ///< whether there is a record
};

/// What a journal holds: all whole records before the first that is torn or damaged.
struct JournalContent {
  JournalStart start;
  std::vector<JournalRecord> records;
  bool torn = false;  ///< something followed that could not be read
};

/// Faults "journal.held" (an editor is at work on it), "journal.invalid", "file.*".
Result<JournalContent> read_journal(const std::filesystem::path& path);

}  // namespace focalstage
