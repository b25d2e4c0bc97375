#include "io/show/assemble.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <vector>

#include "io/show/chunks.h"
#include "io/show/hdf5_out.h"
#include "io/show/seal.h"
#include "io/show/write_header.h"

namespace focalstage {
namespace {

void create_images(Hdf5Out& out, std::size_t projector, hsize_t frames, hsize_t images, const ChunkGrid& grid) {
  std::vector<hsize_t> shape{frames, images, grid.height, grid.width};
  std::vector<hsize_t> chunk{1, 1, grid.rows, grid.columns};
  if (grid.channels != 1) {
    shape.push_back(grid.channels);
    chunk.push_back(grid.channels);
  }
  out.chunked((projector_group(projector) + "/images").c_str(), shape, chunk, compression_level);
}

void write_frame(Hdf5Out& out, std::size_t frame, const PackedFrame& packed, const ChunkGrid& grid) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < packed.sizes.size(); ++i) {
    const std::size_t size = packed.sizes[i];
    if (size == 0) continue;
    const std::size_t chunk = i % grid.per_image();
    std::vector<hsize_t> offset{frame, i / grid.per_image(), chunk / grid.across * grid.rows,
                                chunk % grid.across * grid.columns};
    if (grid.channels != 1) offset.push_back(0);
    out.chunk(offset, std::span(packed.data).subspan(at, size));
    at += size;
  }
}

/// Room for the whole file before HDF5 writes to it: the library does not take a full disk well. Where a file system
/// cannot reserve, what it says to be free must do.
Status reserve(const std::filesystem::path& path, std::uint64_t bytes) {
  const DiskFile file = open_file(path, O_RDWR);
  if (!file.is_open()) return write_fault(path, errno);
  if (::fallocate(file.descriptor(), FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes)) == 0) return {};
  if (errno != EOPNOTSUPP && errno != ENOSYS && errno != EINVAL) return write_fault(path, errno);
  struct statvfs space {};
  if (::fstatvfs(file.descriptor(), &space) == 0 && space.f_bavail < bytes / std::max(space.f_frsize, 1ul))
    return write_fault(path, ENOSPC);
  return {};
}

ChunkGrid grid_of(const ShowProjector& projector) {
  return chunk_grid(projector.width_px, projector.height_px, projector.channels);
}

/// No less than what the assembled file takes: the logs' bytes, an index entry per chunk, and the header's tables.
std::uint64_t room_for(const ShowHeader& header, const std::vector<PartLog>& logs) {
  const std::uint64_t frames = static_cast<std::uint64_t>(header.frames);
  const std::uint64_t things = header.poses[0].surfaces.size() + header.poses[0].objects.size() + 2;
  std::uint64_t bytes = (1u << 20) + header.project_text.size();
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const ShowProjector projector = header.projector(i);
    bytes += logs[i].bytes() + frames * projector.images.size() * grid_of(projector).per_image() * 128;
    bytes += frames * things * 128 + projector.images.size() * 256 + projector.slots.size() * 256;
  }
  bytes += header.schedule.lens_power_d.left.size() * 32 + header.cues.size() * 256;
  for (const AssetFile& asset : header.assets) bytes += asset.bytes.size() + 4096;
  return bytes;
}

Fault fault_of(const Hdf5Error& error, const std::filesystem::path& path) {
  if (error.system_error != 0) return write_fault(path, error.system_error);
  return {"show.unwritable", path.string(), "the HDF5 library refuses to write it (" + error.message + ")", ""};
}

Status write_images(Hdf5Out& out, const std::filesystem::path& path, const ShowHeader& header, std::size_t projector,
                    const PartLog& log, const std::stop_token& stop) {
  const ShowProjector one = header.projector(projector);
  const ChunkGrid grid = grid_of(one);
  create_images(out, projector, static_cast<hsize_t>(header.frames), one.images.size(), grid);
  for (std::size_t frame = 0; frame < log.measures().size() && !out.error(); ++frame) {
    if (stop.stop_requested())
      return Fault{"show.cancelled", path.string(), "writing the show was stopped", "compile again with --resume"};
    const Result<PackedFrame> packed = log.read(frame);
    if (!packed) return packed.fault();
    write_frame(out, frame, *packed, grid);
  }
  return {};
}

Status write_hdf5(const std::filesystem::path& path, const ShowHeader& header, const std::vector<PartLog>& logs,
                  const std::stop_token& stop) {
  const Hdf5Session session;
  Hdf5Out out(path, seal_bytes);
  if (out.error()) return fault_of(*out.error(), path);
  if (Status room = reserve(path, room_for(header, logs)); !room) return room;

  std::vector<const std::vector<FrameMeasure>*> measures;
  for (const PartLog& log : logs) measures.push_back(&log.measures());
  write_header(out, header, measures);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (Status written = write_images(out, path, header, i, logs[i], stop); !written) return written;
  }
  out.close();
  if (out.error()) return fault_of(*out.error(), path);
  return {};
}

}  // namespace

Status assemble(const std::filesystem::path& path, const ShowHeader& header, const std::vector<PartLog>& logs,
                std::stop_token stop) {
  if (Status written = write_hdf5(path, header, logs, stop); !written) return written;
  const DiskFile file = open_file(path, O_RDWR);
  if (!file.is_open()) return write_fault(path, errno);
  // Gives back what was reserved beyond the end.
  if (::ftruncate(file.descriptor(), static_cast<off_t>(file.size())) != 0) return write_fault(path, errno);
  if (!write_seal(file) || ::fsync(file.descriptor()) != 0) return write_fault(path, errno);
  return {};
}

}  // namespace focalstage
