#include "io/journal/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "io/files/files.h"
#include "io/journal/record.h"

namespace focalstage {
namespace {

/// A day's work is some megabytes; beyond this it is no journal of ours.
constexpr std::uint64_t largest_journal = 1u << 30;

Fault unwritable(const std::filesystem::path& path) {
  return {"file.unwritable", path.string(), std::string("cannot be written: ") + std::strerror(errno),
          "free some space or choose another folder; save the project soon"};
}

Fault held(const std::filesystem::path& path) {
  return {"journal.held", path.string(), "another editor has this project open", "close it there, or work on a copy"};
}

}  // namespace

Result<Journal> Journal::start(const std::filesystem::path& path, const JournalStart& start) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (!file.open()) return unwritable(path);
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return held(path);
  if (::ftruncate(file.number(), 0) != 0) return unwritable(path);
  Journal journal(path, std::move(file));
  if (Status begun = journal.append(journal_line(value_from(start))); !begun) return begun.fault();
  if (Status synced = journal.sync(); !synced) return synced.fault();
  const std::filesystem::path folder = path.parent_path();
  if (Status synced = sync_folder(folder.empty() ? "." : folder); !synced) return synced.fault();
  return journal;
}

Status Journal::append(const std::string& line) {
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t count = ::write(file_.number(), line.data() + done, line.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unwritable(path_);
    done += static_cast<std::size_t>(count);
  }
  new_ = true;
  return {};
}

Journal::~Journal() {
  if (file_.open() && !any_) discard();
}

Status Journal::add(const JournalRecord& record) {
  any_ = true;
  return append(journal_line(value_from(record)));
}

Status Journal::sync() {
  if (!new_) return {};
  if (::fdatasync(file_.number()) != 0) return unwritable(path_);
  new_ = false;
  return {};
}

void Journal::discard() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  new_ = false;
}

Result<JournalContent> read_journal(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.open() && ::flock(file.number(), LOCK_SH | LOCK_NB) != 0) return held(path);
  auto bytes = read_file(path, largest_journal);
  if (!bytes) return bytes.fault();
  std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  JournalContent content;
  bool started = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end == std::string_view::npos ? text.size() : end + 1);
    const auto value = journal_value(line);
    const auto start = value && !started ? journal_start_from(*value) : std::nullopt;
    const auto record = value && started ? journal_record_from(*value) : std::nullopt;
    if (!start && !record) break;
    if (start) content.start = *start;
    if (record) content.records.push_back(*record);
    started = true;
    text.remove_prefix(line.size());
  }
  if (!started) {
    return Fault{"journal.invalid", path.string(), "is not a journal of edits", "remove it"};
  }
  content.torn = !text.empty();
  return content;
}

}  // namespace focalstage
