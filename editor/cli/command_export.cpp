#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/pipeline/clip_maps.h"
#include "editor/pipeline/source.h"
#include "io/export/export.h"
#include "io/export/image_name.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

struct Options {
  std::string show;
  std::string folder;
  bool clipped = false;
};

/// "frame-0007-clipped.png" beside the images: where surfaces cannot send back what is wanted.
Status export_clipped(const ShowReader& show, const Options& options, const FrameProgress& progress,
                      const std::stop_token& stop) {
  const auto source = project_in(show, options.show);
  if (!source) return source.fault();
  const ShowHeader& header = show.header();
  const double darkest = whole_leak(compile_settings(source->project));
  const auto write = [&](int frame, const ClipMap& map) {
    const auto file =
        std::filesystem::path(options.folder) / image_file_name(frame - header.first_frame, header.frames, "clipped");
    return write_png(file, map.width_px, map.height_px, 3, clip_picture(map, darkest));
  };
  return each_clip_map(*source, {header.first_frame, header.first_frame + header.frames}, write, progress, stop);
}

ExitStatus run(const Options& options) {
  const auto show = ShowReader::open(options.show);
  if (!show) return report(show.fault());
  Interrupt interrupt;
  Status exported;
  {
    Progress bar("Exporting to " + options.folder, Progress::Style::automatic);
    const auto progress = [&](int done, int of) { bar.update(done, of, "frame"); };
    exported = export_show(*show, options.folder, progress, interrupt.token());
    if (exported && options.clipped) exported = export_clipped(*show, options, progress, interrupt.token());
  }
  if (!exported) {
    const ExitStatus status = report(exported.fault());
    interrupt.end_if_asked();
    return status;
  }
  const ShowHeader& header = show->header();
  std::printf("%s: %d %s of %zu images as PNG, schedule.csv, waveform.csv, timing.vcd\n", options.folder.c_str(),
              header.frames, header.frames == 1 ? "frame" : "frames", header.images.size());
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_export(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("SHOW", options->show, "the show (.h5)")->required()->type_name("");
  app.add_option("-o,--output", options->folder, "the folder to write into; made if missing")
      ->required()
      ->type_name("DIR");
  app.add_flag(
      "--clipped", options->clipped,
      "write a PNG per frame of where light is wanted that surfaces cannot send back: red for too bright, blue "
      "for darker than black");
  return [options] { return run(*options); };
}

}  // namespace focalstage
