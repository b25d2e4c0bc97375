#include "io/export/export.h"

#include <tbb/parallel_for.h>

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

/// The images of one frame, each by a thread of its own; of several faults the first image's counts.
Status export_frame(const ShowReader& show, int frame, const std::vector<std::string>& names,
                    const std::filesystem::path& folder) {
  const Result<FrameImages> images = show.frame(frame);
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

}  // namespace

Status export_show(const ShowReader& show, const std::filesystem::path& folder, const ExportProgress& progress,
                   std::stop_token stop) {
  if (Status made = make_folder(folder); !made) return made;
  const ShowHeader& header = show.header();
  if (Status done = write_file_atomically(folder / "schedule.csv", schedule_csv(header)); !done) return done;
  if (Status done = write_file_atomically(folder / "waveform.csv", waveform_csv(header)); !done) return done;
  if (Status done = write_file_atomically(folder / "timing.vcd", timing_vcd(header)); !done) return done;
  const std::vector<std::string> names = image_names(header.images);
  for (int frame = 0; frame < header.frames; ++frame) {
    if (stop.stop_requested())
      return Fault{"export.cancelled", folder.string(), "the export was stopped", "export again for the rest"};
    if (Status done = export_frame(show, frame, names, folder); !done) return done;
    if (progress) progress(frame + 1, header.frames);
  }
  return {};
}

}  // namespace focalstage
