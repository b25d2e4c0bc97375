#include "io/show/writer.h"

#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "io/show/assemble.h"
#include "io/show/check_counts.h"
#include "io/show/chunks.h"
#include "io/show/disk.h"
#include "io/show/fingerprint.h"
#include "io/show/part.h"

namespace focalstage {

struct ShowWriter::State {
  std::filesystem::path path;
  ShowHeader header;
  std::vector<ChunkGrid> grids;  ///< of each projector
  std::vector<PartLog> logs;
  tbb::task_arena arena;
  mutable std::mutex mutex;  ///< of the logs

  std::filesystem::path temporary() const { return path.string() + ".tmp"; }
};

namespace {

PartKey part_key(const ShowHeader& header, std::size_t images, const ChunkGrid& grid) {
  return {sha256_of(header.project_text), fingerprint_of(header), static_cast<std::size_t>(header.frames),
          images * grid.per_image(),      grid.bytes(),           header.poses[0].objects.size(),
          header.poses[0].surfaces.size()};
}

Status check_asset_hashes(const ShowHeader& header, const std::string& where) {
  for (const AssetFile& asset : header.assets) {
    if (hex(sha256_of(asset.bytes)) != asset.sha256)
      return Fault{"show.invalid", where + ": /asset/" + asset.sha256, "its bytes have another hash: " + asset.path,
                   ""};
  }
  return {};
}

bool fits(const FrameImages& images, const ShowProjector& projector) {
  return images.count == projector.images.size() && images.width_px == projector.width_px &&
         images.height_px == projector.height_px && images.channels == projector.channels &&
         images.codes.size() == images.count * images.bytes_per_image();
}

}  // namespace

ShowWriter::ShowWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShowWriter::ShowWriter(ShowWriter&&) noexcept = default;
ShowWriter& ShowWriter::operator=(ShowWriter&&) noexcept = default;
ShowWriter::~ShowWriter() = default;

Result<ShowWriter> ShowWriter::start(const std::filesystem::path& path, const ShowHeader& header, bool resume,
                                     int threads) {
  const std::string where = path.string();
  if (Status valid = check_header(header, where); !valid) return valid.fault();
  if (Status valid = check_counts(header, where); !valid) return valid.fault();
  if (Status right = check_asset_hashes(header, where); !right) return right.fault();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return write_fault(path, EISDIR);

  const int all = tbb::info::default_concurrency();
  const int concurrency = threads > 0 ? std::min(threads, all) : all;
  auto state = std::unique_ptr<State>(new State{path, header, {}, {}, tbb::task_arena(concurrency), {}});
  for (std::size_t i = 0; i < header.projectors(); ++i) {
    const ShowProjector one = header.projector(i);
    const ChunkGrid grid = chunk_grid(one.width_px, one.height_px, one.channels);
    Result<PartLog> log = PartLog::open(where + ".part", part_key(header, one.images.size(), grid), resume, i);
    if (!log) return log.fault();
    state->grids.push_back(grid);
    state->logs.push_back(std::move(*log));
  }
  std::filesystem::remove(state->temporary(), error);
  return ShowWriter(std::move(state));
}

bool ShowWriter::has_frame(int frame) const {
  const std::scoped_lock lock(state_->mutex);
  return frame >= 0 && frame < state_->header.frames &&
         std::all_of(state_->logs.begin(), state_->logs.end(),
                     [&](const PartLog& log) { return log.has(static_cast<std::size_t>(frame)); });
}

bool ShowWriter::has_frame(int frame, std::size_t projector) const {
  const std::scoped_lock lock(state_->mutex);
  return frame >= 0 && frame < state_->header.frames && state_->logs.at(projector).has(static_cast<std::size_t>(frame));
}

const std::vector<FrameMeasure>& ShowWriter::measures(std::size_t projector) const {
  return state_->logs.at(projector).measures();
}

Status ShowWriter::add_frame(int frame, const FrameImages& images, const FrameMeasure& measure, std::size_t projector) {
  const auto refused = [&](const std::string& why) {
    return Fault{"show.frame", state_->path.string(), "frame " + std::to_string(frame) + " " + why, ""};
  };
  if (frame < 0 || frame >= state_->header.frames) return refused("is beyond the show's end");
  if (projector >= state_->logs.size()) return refused("is of a projector that the show has not");
  if (!fits(images, state_->header.projector(projector)))
    return refused("has not the images that the header announces");
  if (has_frame(frame, projector)) return refused("is already there");
  try {
    PackedFrame packed;
    state_->arena.execute([&] { packed = pack(images, state_->grids[projector]); });
    const std::scoped_lock lock(state_->mutex);
    PartLog& log = state_->logs[projector];
    if (log.has(static_cast<std::size_t>(frame))) return refused("is already there");
    return log.append(static_cast<std::size_t>(frame), measure, packed);
  } catch (const std::bad_alloc&) {
    return refused("does not fit into memory");
  }
}

Status ShowWriter::finish(std::stop_token stop) {
  const std::scoped_lock lock(state_->mutex);
  for (int frame = 0; frame < state_->header.frames; ++frame) {
    const auto there = [&](const PartLog& log) { return log.has(static_cast<std::size_t>(frame)); };
    if (!std::all_of(state_->logs.begin(), state_->logs.end(), there)) {
      return Fault{"show.missing-frame", state_->path.string(),
                   "frame " + std::to_string(frame) + " was never compiled", "compile again with --resume"};
    }
  }
  for (PartLog& log : state_->logs) {
    if (Status synced = log.sync(); !synced) return synced;
  }
  const std::filesystem::path temporary = state_->temporary();
  std::error_code ignored;
  Status written = assemble(temporary, state_->header, state_->logs, stop);
  if (written && ::rename(temporary.c_str(), state_->path.c_str()) != 0) written = write_fault(state_->path, errno);
  if (!written) {
    std::filesystem::remove(temporary, ignored);
    return written;
  }
  if (!sync_directory(folder_of(state_->path))) return write_fault(state_->path, errno);
  for (PartLog& log : state_->logs) log.remove();
  return {};
}

}  // namespace focalstage
