#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/history.h"
#include "editor/document/asset_shelf.h"
#include "editor/document/folders.h"
#include "io/journal/journal.h"

namespace focalstage {

/// What a crash left behind, as the start screen offers it.
struct Recovery {
  std::filesystem::path journal;
  std::string project_file;
  bool untitled = false;
  std::vector<std::string> words;  ///< what recovering would add, in order
  std::filesystem::file_time_type when{};
};

/// An open project: its history, its file, its assets and its journal. Always has a folder: a project that was never
/// saved lives in the user's state folder until Save As gives it a place.
class Document {
 public:
  /// A `NAME.focal` or the folder that holds it.
  static Result<Document> open(const std::filesystem::path& project, const UserFolders& folders);
  /// A sample, or with an empty name a bare room, as a project without a place of its own yet.
  static Result<Document> from_sample(const std::string& sample, const UserFolders& folders);
  /// What `recoveries` offered: the state at the crash, and Undo reaches behind it.
  static Result<Document> recover(const Recovery& recovery, const UserFolders& folders);

  Document(Document&&) noexcept = default;
  Document& operator=(Document&&) noexcept = default;

  const History& history() const { return history_; }
  const Project& project() const { return *history_.now(); }

  Status apply(Step step, Joining joining = Joining::own_step);
  Status undo();
  Status redo();
  Status jump(std::size_t place);

  const std::filesystem::path& file() const { return file_; }
  std::filesystem::path folder() const { return file_.parent_path(); }
  bool untitled() const { return untitled_; }
  /// Whether closing now would lose something.
  bool unsaved() const;

  /// Faults of io/project's save_project, and "document.untitled": there is no place yet, Save As asks for one.
  Status save();
  /// Writes project and assets into `folder` (made if missing; must hold no other project) and goes on there.
  Status save_as(const std::filesystem::path& folder);

  /// Whether somebody else changed the project's file since it was read or saved.
  bool changed_outside() const;
  /// Takes what is on disk instead, as one step of undo; or leaves it and stops asking.
  Status reload();
  void keep_ours();

  AssetShelf& shelf() { return shelf_; }
  const AssetShelf& shelf() const { return shelf_; }
  const std::vector<Finding>& notes() const { return notes_; }

  /// Brings the journal to the disk. A fault is told once per cause.
  Status sync();
  /// What the journal could not do, if anything: edits since are only in memory.
  const std::optional<Fault>& journal_fault() const { return journal_fault_; }
  /// The end: the journal goes, and the folder of a project that has never been saved.
  void close();

 private:
  Document(Project project, std::filesystem::path file, bool untitled);
  Status start_journal(const UserFolders& folders);
  void record(const JournalRecord& record);
  void remember_disk();

  History history_;
  std::filesystem::path file_;
  bool untitled_ = false;
  History::Snapshot saved_;  ///< what is on disk; null: nothing the author chose
  struct Written {
    std::filesystem::file_time_type when{};
    std::uintmax_t bytes = 0;
    bool operator==(const Written&) const = default;
  };
  static Written written(const std::filesystem::path& file);
  mutable Written written_;  ///< when the disk was looked at last and was as `disk_sha256_` says
  std::string disk_sha256_;
  AssetShelf shelf_;
  std::vector<Finding> notes_;
  std::optional<Journal> journal_;
  std::optional<Fault> journal_fault_;
  UserFolders folders_;
};

/// Copies a mesh file and all that it refers to into the assets/ of a project's folder, once it has been read whole.
/// Returns the reference to write into the project. Any thread. Faults "asset.*", "file.*".
Result<std::string> bring_in(const std::filesystem::path& file, const std::filesystem::path& project_folder);

/// The same for a picture as the look of an object. Where its name ends in a number and the next ones lie beside it,
/// they come along as a sequence, `rate_hz` of them a second.
Result<ImageAppearance> bring_in_look(const std::filesystem::path& file, const std::filesystem::path& project_folder,
                                      double rate_hz);

/// Journals that nobody holds, of projects that were open when something went wrong; the newest first.
std::vector<Recovery> recoveries(const UserFolders& folders, const std::vector<std::filesystem::path>& recent);

/// Removes what a recovery offers, for good.
void forget(const Recovery& recovery);

/// Where the journal of a project's file lies: beside it, or in the state folder where that cannot be written.
std::filesystem::path journal_beside(const std::filesystem::path& project_file);
std::filesystem::path journal_in_state(const std::filesystem::path& project_file, const UserFolders& folders);

}  // namespace focalstage
