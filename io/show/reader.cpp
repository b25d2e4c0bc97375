#include "io/show/reader.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/show/check_counts.h"
#include "io/show/chunks.h"
#include "io/show/hdf5_in.h"
#include "io/show/read_header.h"
#include "io/show/seal.h"

namespace focalstage {

struct ShowReader::State {
  std::filesystem::path path;
  DiskFile file;
  std::string sha256;
  ShowHeader header;
  std::vector<std::vector<FrameMeasure>> measures;  ///< of each projector
  std::vector<ChunkGrid> grids;
  std::optional<Hdf5In> hdf5;

  ~State() {
    const Hdf5Session session;
    hdf5.reset();
  }
};

namespace {

Fault too_large(const std::filesystem::path& path) {
  return {"show.too-large", path.string(), "it does not fit into memory", "compile fewer or smaller frames"};
}

Hdf5In::Shape chunk_shape(const ChunkGrid& grid) {
  Hdf5In::Shape shape{1, 1, grid.rows, grid.columns};
  if (grid.channels != 1) shape.push_back(grid.channels);
  return shape;
}

std::vector<hsize_t> chunk_offset(const ChunkGrid& grid, int frame, int image, std::size_t chunk) {
  std::vector<hsize_t> offset{static_cast<hsize_t>(frame), static_cast<hsize_t>(image), chunk / grid.across * grid.rows,
                              chunk % grid.across * grid.columns};
  if (grid.channels != 1) offset.push_back(0);
  return offset;
}

}  // namespace

ShowReader::ShowReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShowReader::ShowReader(ShowReader&&) noexcept = default;
ShowReader& ShowReader::operator=(ShowReader&&) noexcept = default;
ShowReader::~ShowReader() = default;

Result<ShowReader> ShowReader::open(const std::filesystem::path& path) {
  try {
    auto state = std::make_unique<State>();
    state->path = path;
    Result<DiskFile> file = open_show(path);
    if (!file) return file.fault();
    state->file = std::move(*file);
    Result<std::string> sealed = check_seal(state->file, path);
    if (!sealed) return sealed.fault();
    state->sha256 = *sealed;

    const Hdf5Session session;
    Hdf5In& in = state->hdf5.emplace(state->file, path);
    state->header = read_header(in);
    if (!in.ok()) return in.fault();
    if (Status valid = check_header(state->header, path.string()); !valid) return valid.fault();
    if (Status valid = check_counts(state->header, path.string()); !valid) return valid.fault();
    for (std::size_t i = 0; i < state->header.projectors(); ++i) {
      const ShowProjector projector = state->header.projector(i);
      state->measures.push_back(read_measures(in, state->header, i));
      state->grids.push_back(chunk_grid(projector.width_px, projector.height_px, projector.channels));
      if (!projector.images.empty() && !in.chunked_as(i, chunk_shape(state->grids[i])))
        in.refuse(projector_group(i) + "/images", "its chunks have not the shape and filter of a show's");
    }
    if (!in.ok()) return in.fault();
    return ShowReader(std::move(state));
  } catch (const std::bad_alloc&) {
    return too_large(path);
  } catch (const std::length_error&) {
    return too_large(path);
  }
}

const ShowHeader& ShowReader::header() const { return state_->header; }
const std::vector<FrameMeasure>& ShowReader::measures(std::size_t projector) const {
  return state_->measures.at(projector);
}
const std::string& ShowReader::sha256() const { return state_->sha256; }

namespace {

/// Fills `images` with the images of `frame` from `first_image` on; false where a chunk is damaged.
bool fill(Hdf5In& in, std::size_t projector, const ChunkGrid& grid, int frame, int first_image, FrameImages& images) {
  std::vector<std::vector<std::uint8_t>> streams(images.count * grid.per_image());
  {
    const Hdf5Session session;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const int image = first_image + static_cast<int>(i / grid.per_image());
      auto stream = in.chunk(projector, chunk_offset(grid, frame, image, i % grid.per_image()));
      if (!stream) return false;
      streams[i] = std::move(*stream);
    }
  }
  std::atomic<bool> whole = true;
  tbb::parallel_for(std::size_t{0}, streams.size(), [&](std::size_t i) {
    if (streams[i].empty()) return;
    const std::span image =
        std::span(images.codes).subspan(i / grid.per_image() * images.bytes_per_image(), images.bytes_per_image());
    if (!unpack(streams[i], grid, i % grid.per_image(), image)) whole = false;
  });
  return whole;
}

}  // namespace

Result<FrameImages> ShowReader::images(int frame, std::size_t projector, int first_image, int count) const {
  const ShowHeader& header = state_->header;
  const ShowProjector one = header.projector(projector);
  const std::string name = "frame " + std::to_string(frame);
  const int last_image = static_cast<int>(one.images.size()) - count;
  if (frame < 0 || frame >= header.frames || first_image < 0 || first_image > last_image)
    return Fault{"show.frame", state_->path.string(), name + " or its image is beyond the show's end", ""};
  try {
    FrameImages images{static_cast<std::size_t>(count), one.width_px, one.height_px, one.channels, {}};
    images.codes.resize(images.count * images.bytes_per_image());
    if (fill(*state_->hdf5, projector, state_->grids[projector], frame, first_image, images)) return images;
  } catch (const std::bad_alloc&) {
    return too_large(state_->path);
  }
  return Fault{"show.damaged", state_->path.string() + ": " + projector_group(projector) + "/images",
               name + " cannot be read", "copy it again, or compile the show again"};
}

Result<FrameImages> ShowReader::frame(int frame, std::size_t projector) const {
  return images(frame, projector, 0, static_cast<int>(state_->header.projector(projector).images.size()));
}

Result<FrameImages> ShowReader::image(int frame, int image, std::size_t projector) const {
  return images(frame, projector, image, 1);
}

}  // namespace focalstage
