#include "editor/document/document.h"

#include <system_error>

#include "core/scene/edits_between.h"
#include "editor/document/recent.h"
#include "editor/document/replay.h"
#include "editor/samples/samples.h"
#include "io/files/files.h"
#include "io/project/project_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for a project that has no place yet; the project file takes its name.
Result<fs::path> fresh_folder(const UserFolders& folders) {
  const fs::path unsaved = folders.state / "unsaved";
  std::error_code problem;
  fs::create_directories(unsaved, problem);
  for (int k = 1; !problem && k < 10000; ++k) {
    const fs::path folder = unsaved / ("untitled-" + std::to_string(k));
    if (fs::create_directory(folder, problem)) return folder;
  }
  return Fault{"file.unwritable", unsaved.string(), "no folder can be made here: " + problem.message(),
               "free some space, or set XDG_STATE_HOME to a folder that can be written"};
}

/// A room with what no project can do without.
Project bare_room() {
  Project project;
  project.name = "Untitled";
  project.projectors.push_back({});
  project.projectors[0].name = "main";
  project.projectors[0].pose.position_m = {0.0, 0.0, 0.3};
  project.slices.powers_d = {-1.0, -0.5, 0.0, 0.5, 1.0};
  Light sun;
  sun.name = "sun";
  sun.direction = {-0.4, -0.6, -0.7};
  sun.intensity = 0.6;
  Light sky;
  sky.name = "sky";
  sky.kind = LightKind::sky;
  sky.intensity = 0.2;
  project.lights = {sun, sky};
  return project;
}

/// Opening a project without recovering it first must not cost what the crash left: it is offered again.
void keep_what_a_crash_left(const fs::path& file, const UserFolders& folders) {
  const fs::path left = journal_beside(file);
  const auto content = read_journal(left);
  if (!content || words_of(content->records).empty()) return;
  std::error_code problem;
  fs::create_directories(folders.state / "journals", problem);
  const std::string name = sha256_hex(left.string() + content->start.base_text).substr(0, 16) + "-left.journal";
  fs::copy_file(left, folders.state / "journals" / name, fs::copy_options::overwrite_existing, problem);
}

std::string disk_hash(const fs::path& file) {
  const auto bytes = read_file(file, 1u << 30);
  return bytes ? sha256_hex(*bytes) : std::string();
}

}  // namespace

Document::Document(Project project, fs::path file, bool untitled)
    : history_(std::move(project)), file_(std::move(file)), untitled_(untitled), shelf_(file_.parent_path()) {
  if (!untitled_) saved_ = history_.now();
  remember_disk();
}

void Document::remember_disk() {
  written_ = written(file_);
  disk_sha256_ = disk_hash(file_);
}

Document::Written Document::written(const fs::path& file) {
  std::error_code none;
  return {fs::last_write_time(file, none), fs::file_size(file, none)};
}

Result<Document> Document::open(const fs::path& project, const UserFolders& folders) {
  auto loaded = load_project(fs::absolute(project).lexically_normal());
  if (!loaded) return loaded.fault();
  Document document(std::move(loaded->project), loaded->file, false);
  document.notes_ = std::move(loaded->notes);
  keep_what_a_crash_left(document.file_, folders);
  if (Status begun = document.start_journal(folders); !begun) return begun.fault();
  document.shelf_.fetch(document.project());
  remember_recent(document.file_, folders);
  return document;
}

Result<Document> Document::from_sample(const std::string& sample, const UserFolders& folders) {
  auto folder = fresh_folder(folders);
  if (!folder) return folder.fault();
  fs::path file = *folder / (folder->filename().string() + ".focal");
  if (sample.empty()) {
    if (Status saved = save_project(bare_room(), file); !saved) return saved.fault();
  } else {
    const auto found = sample_named(sample);
    if (!found) return found.fault();
    const auto written = write_sample(*found, *folder);
    if (!written) return written.fault();
  }
  auto loaded = load_project(file);
  if (!loaded) return loaded.fault();
  Document document(std::move(loaded->project), std::move(file), true);
  if (Status begun = document.start_journal(folders); !begun) return begun.fault();
  document.shelf_.fetch(document.project());
  return document;
}

Result<Document> Document::recover(const Recovery& recovery, const UserFolders& folders) {
  auto content = read_journal(recovery.journal);
  if (!content) return content.fault();
  auto base = parse_project(content->start.base_text, recovery.journal.string());
  if (!base) return base.fault();
  Document document(std::move(base->project), content->start.project_file, content->start.untitled);
  document.history_ = replayed(document.project(), content->records);
  // The new journal begins where the old one did: a second crash loses nothing either.
  if (Status begun = document.start_journal(folders); !begun) return begun.fault();
  for (const JournalRecord& record : content->records) document.record(record);
  if (document.journal_ && document.journal_->path() != recovery.journal) forget(recovery);
  document.shelf_.fetch(document.project());
  return document;
}

Status Document::start_journal(const UserFolders& folders) {
  folders_ = folders;
  journal_.reset();
  const JournalStart start{file_.string(), untitled_, project_text(*(saved_ ? saved_ : history_.now()))};
  auto journal = Journal::start(journal_beside(file_), start);
  if (!journal && journal.fault().code == "file.unwritable") {
    std::error_code ignored;
    fs::create_directories(folders.state / "journals", ignored);
    journal = Journal::start(journal_in_state(file_, folders), start);
  }
  if (!journal && journal.fault().code == "journal.held") return journal.fault();
  if (!journal) {
    journal_fault_ = journal.fault();
    return {};
  }
  journal_ = std::move(*journal);
  return {};
}

void Document::record(const JournalRecord& record) {
  if (!journal_) return;
  if (Status added = journal_->add(record); !added) journal_fault_ = added.fault();
}

Status Document::apply(Step step, Joining joining) {
  const JournalStep made{step, joining};
  if (Status applied = history_.apply(std::move(step), joining); !applied) return applied;
  record(made);
  return {};
}

Status Document::undo() { return jump(history_.can_undo() ? history_.place() - 1 : 0); }
Status Document::redo() { return jump(history_.place() + 1); }

Status Document::jump(std::size_t place) {
  const std::size_t before = history_.place();
  history_.jump(place);
  if (history_.place() != before) record(JournalJump{history_.place()});
  return {};
}

bool Document::unsaved() const {
  if (!saved_) return !untitled_ || history_.place() > 0;
  return saved_ != history_.now() && !(*saved_ == *history_.now());
}

Status Document::save() {
  if (untitled_) {
    return Fault{"document.untitled", project().name, "has never been saved", "choose a folder with Save As"};
  }
  if (Status saved = save_project(project(), file_); !saved) return saved;
  saved_ = history_.now();
  remember_disk();
  return start_journal(folders_);
}

bool Document::changed_outside() const {
  const Written now = written(file_);
  if (now == written_) return false;
  if (disk_hash(file_) != disk_sha256_) return true;
  written_ = now;  // only touched
  return false;
}

void Document::keep_ours() {
  remember_disk();
  saved_ = nullptr;
}

Status Document::reload() {
  auto loaded = load_project(file_);
  if (!loaded) return loaded.fault();
  Step step{"Reload from disk", edits_between(project(), loaded->project)};
  if (!step.edits.empty()) {
    if (Status applied = apply(std::move(step)); !applied) history_ = History(std::move(loaded->project));
  }
  saved_ = history_.now();
  remember_disk();
  return {};
}

Status Document::sync() {
  if (!journal_) return {};
  Status synced = journal_->sync();
  if (!synced) journal_fault_ = synced.fault();
  return synced;
}

void Document::close() {
  if (journal_) journal_->discard();
  journal_.reset();
  std::error_code ignored;
  if (untitled_) fs::remove_all(folder(), ignored);
}

}  // namespace focalstage
