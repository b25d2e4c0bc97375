#include "io/export/export.h"

#include <tbb/parallel_for.h>

#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include "io/export/image_name.h"
#include "io/export/tables.h"
#include "io/export/vcd.h"
#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder, error)) return {};
  return Fault{"export.folder", folder.string(), "the folder cannot be made (" + error.message() + ")",
               "choose another with -o"};
}

/// The images that a projector shows in one frame, each by a thread of its own; of several faults the first image's
/// counts.
Status export_frame(const ShowReader& show, int frame, std::size_t projector, const std::vector<std::string>& names,
                    const std::filesystem::path& folder) {
  const Result<FrameImages> images = show.frame(frame, projector);
  if (!images) return images.fault();
  std::vector<Status> written(names.size());
  tbb::parallel_for(std::size_t{0}, names.size(), [&](std::size_t i) {
    const std::filesystem::path file = folder / image_file_name(frame, show.header().frames, names[i]);
    written[i] = write_png(file, images->width_px, images->height_px, images->channels, images->image(i));
  });
  for (const Status& status : written)
    if (!status) return status;
  return {};
}

/// A show's header as if projector number `i` were its only one.
ShowHeader only(const ShowHeader& header, std::size_t i) {
  ShowHeader one = header;
  const ShowProjector projector = header.projector(i);
  one.images = projector.images;
  one.schedule.slots = projector.slots;
  return one;
}

Status export_projector(const ShowReader& show, std::size_t projector, const std::filesystem::path& folder,
                        const std::function<void()>& done_one, const std::stop_token& stop) {
  if (Status made = make_folder(folder); !made) return made;
  const ShowHeader header = only(show.header(), projector);
  if (Status done = write_file_atomically(folder / "schedule.csv", schedule_csv(header)); !done) return done;
  if (Status done = write_file_atomically(folder / "waveform.csv", waveform_csv(header)); !done) return done;
  if (Status done = write_file_atomically(folder / "timing.vcd", timing_vcd(header)); !done) return done;
  const std::vector<std::string> names = image_names(header.images);
  for (int frame = 0; frame < header.frames; ++frame) {
    if (stop.stop_requested())
      return Fault{"export.cancelled", folder.string(), "the export was stopped", "export again for the rest"};
    if (Status done = export_frame(show, frame, projector, names, folder); !done) return done;
    done_one();
  }
  return {};
}

}  // namespace

Status export_show(const ShowReader& show, const std::filesystem::path& folder, const ExportProgress& progress,
                   std::stop_token stop) {
  const std::size_t projectors = show.header().projectors();
  const int total = show.header().frames * static_cast<int>(projectors);
  int done = 0;
  const auto done_one = [&] {
    ++done;
    if (progress) progress(done, total);
  };
  for (std::size_t i = 0; i < projectors; ++i) {
    const auto own = i == 0 ? folder : folder / ("projector-" + std::to_string(i));
    if (Status exported = export_projector(show, i, own, done_one, stop); !exported) return exported;
  }
  return {};
}

}  // namespace focalstage
