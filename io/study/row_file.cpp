#include "io/study/row_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/files/files.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 64u << 20;

Fault unwritable(const fs::path& path, int error) {
  return {"file.unwritable", path.string(), std::string("cannot be written: ") + std::strerror(error),
          error == ENOSPC ? "free some space and go on with --resume; no row is lost"
                          : "check the folder and its permissions"};
}

Fault other_header(const fs::path& path) {
  return {"study.rows", path.string() + ": line 1", "is not the header of such a file",
          "put the file back as it was written, or move it away"};
}

/// Rows of the whole text; `end` becomes where the last whole line ends.
Result<RowList> split(const fs::path& path, std::string_view text, std::string_view header, std::size_t& end) {
  RowList rows;
  end = 0;
  bool first = true;
  while (end < text.size()) {
    const std::size_t stop = text.find('\n', end);
    rows.torn = stop == std::string_view::npos;
    if (rows.torn) break;
    const std::string_view line = text.substr(end, stop - end);
    if (first && line != header) return other_header(path);
    if (!first) rows.lines.emplace_back(line);
    first = false;
    end = stop + 1;
  }
  // A file that was being made: its header is all it could have held.
  if (first && rows.torn && !header.starts_with(text)) return other_header(path);
  return rows;
}

Result<std::string> text_of(const fs::path& path) {
  const auto bytes = read_file(path, size_limit);
  if (!bytes) return bytes.fault();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

}  // namespace

Result<RowList> read_rows(const fs::path& path, std::string_view header) {
  const auto text = text_of(path);
  if (!text) return text.fault();
  std::size_t end = 0;
  return split(path, *text, header, end);
}

Result<RowFile> RowFile::open(const fs::path& path, std::string_view header) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!file.open()) return unwritable(path, errno);
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
    return Fault{"trials.busy", path.string(), "another focalstage is running this participant",
                 "wait for it to end, or stop it"};
  }
  RowFile rows(path, std::move(file));
  if (Status begun = rows.begin(header); !begun) return begun.fault();
  return rows;
}

Status RowFile::begin(std::string_view header) {
  const auto text = text_of(path_);
  if (!text) return text.fault();
  std::size_t end = 0;
  auto found = split(path_, *text, header, end);
  if (!found) return found.fault();
  rows_ = std::move(*found);
  size_ = end;
  if (rows_.torn && ::ftruncate(file_.number(), static_cast<off_t>(end)) != 0) return unwritable(path_, errno);
  if (size_ > 0) return {};
  if (Status written = append(std::string(header)); !written) return written;
  return sync_folder(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
}

Status RowFile::append(const std::string& row) {
  const std::string line = row + "\n";
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t count =
        ::pwrite(file_.number(), line.data() + done, line.size() - done, static_cast<off_t>(size_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    done += static_cast<std::size_t>(count);
  }
  if (done == line.size() && ::fsync(file_.number()) == 0) {
    size_ += line.size();
    return {};
  }
  const int error = errno;
  (void)!::ftruncate(file_.number(), static_cast<off_t>(size_));
  return unwritable(path_, error);
}

}  // namespace focalstage
