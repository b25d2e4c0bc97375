#include "io/show/part.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "io/show/part_record.h"

namespace focalstage {
namespace {

// A kill loses nothing that was written; only a power cut needs fdatasync, which takes as long as several frames.
constexpr std::chrono::milliseconds sync_every{500};

}  // namespace

Result<PartLog> PartLog::open(const std::filesystem::path& folder, const PartKey& key, bool resume,
                              std::size_t projector) {
  PartLog log;
  log.folder_ = folder;
  log.path_ = folder / (projector == 0 ? "frames.log" : "frames-" + std::to_string(projector) + ".log");
  log.key_ = key;
  log.records_.resize(key.frames);
  log.measures_.assign(key.frames, spread({}, key.objects, key.surfaces));

  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error) return write_fault(folder, error.value());
  log.file_ = open_file(log.path_, O_RDWR | O_CREAT);
  if (!log.file_.is_open()) return write_fault(log.path_, errno);

  struct stat status {};
  const bool held = ::flock(log.file_.descriptor(), LOCK_EX | LOCK_NB) == 0 &&
                    ::fstat(log.file_.descriptor(), &status) == 0 && status.st_nlink > 0;
  if (!held) {
    return Fault{"show.busy", folder.string(), "another compile is writing this show",
                 "wait until it is done, or write to another file with -o"};
  }
  if (resume && log.preamble_fits()) {
    log.take_over();
    if (::ftruncate(log.file_.descriptor(), static_cast<off_t>(log.end_)) != 0) return write_fault(log.path_, errno);
    return log;
  }
  if (Status fresh = log.start_over(); !fresh) return fresh.fault();
  return log;
}

bool PartLog::preamble_fits() const {
  const std::vector<std::byte> expected = preamble_bytes(key_);
  std::vector<std::byte> found(expected.size());
  return file_.read_at(0, found) && found == expected;
}

Status PartLog::start_over() {
  if (::ftruncate(file_.descriptor(), 0) != 0) return write_fault(path_, errno);
  const std::vector<std::byte> preamble = preamble_bytes(key_);
  if (!file_.write_at(0, preamble)) return failed(errno);
  end_ = preamble.size();
  if (Status synced = sync(); !synced) return synced;
  if (!sync_directory(folder_) || !sync_directory(folder_of(folder_))) return write_fault(folder_, errno);
  return {};
}

/// Every whole record from the preamble on.
void PartLog::take_over() {
  end_ = preamble_bytes(key_).size();
  while (take_record()) {
  }
}

bool PartLog::take_record() {
  std::vector<std::byte> bytes(sizeof(RecordHead));
  if (!file_.read_at(end_, bytes)) return false;
  const std::optional<RecordHead> head = head_from(bytes, key_);
  if (!head || has(head->frame) || head->body_bytes > file_.size() - end_ - sizeof(RecordHead)) return false;
  bytes.resize(head->body_bytes);
  if (!file_.read_at(end_ + sizeof(RecordHead), bytes)) return false;
  std::optional<RecordBody> body = body_from(bytes, *head, key_);
  if (!body) return false;
  measures_[head->frame] = std::move(body->measure);
  records_[head->frame] = {end_, sizeof(RecordHead) + head->body_bytes};
  end_ += records_[head->frame].bytes;
  return true;
}

Status PartLog::append(std::size_t frame, const FrameMeasure& measure, const PackedFrame& packed) {
  const std::vector<std::byte> bytes = record_bytes(frame, measure, packed, key_);
  if (!file_.write_at(end_, bytes)) return failed(errno);
  records_[frame] = {end_, bytes.size()};
  measures_[frame] = spread(measure, key_.objects, key_.surfaces);
  end_ += bytes.size();
  if (std::chrono::steady_clock::now() - synced_ < sync_every) return {};
  return sync();
}

/// Takes back what a refused write left behind, so that the log ends with a whole record.
Fault PartLog::failed(int error) {
  if (::ftruncate(file_.descriptor(), static_cast<off_t>(end_)) != 0) return write_fault(path_, errno);
  return write_fault(path_, error);
}

Result<PackedFrame> PartLog::read(std::size_t frame) const {
  const Record& record = records_[frame];
  std::vector<std::byte> bytes(record.bytes);
  if (file_.read_at(record.at, bytes)) {
    if (const std::optional<RecordHead> head = head_from(bytes, key_)) {
      std::optional<RecordBody> body = body_from(std::span(bytes).subspan(sizeof(RecordHead)), *head, key_);
      if (body && head->frame == frame) return std::move(body->packed);
    }
  }
  return Fault{"show.part-damaged", path_.string(),
               "frame " + std::to_string(frame) + " was changed after it was written",
               "compile again with --resume: frames that are whole are kept"};
}

Status PartLog::sync() {
  if (::fdatasync(file_.descriptor()) != 0) return write_fault(path_, errno);
  synced_ = std::chrono::steady_clock::now();
  return {};
}

void PartLog::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(folder_, ignored);
}

}  // namespace focalstage
