#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "io/export/export.h"

namespace focalstage {
namespace {

struct Options {
  std::string show;
  std::string folder;
};

ExitStatus run(const Options& options) {
  const auto show = ShowReader::open(options.show);
  if (!show) return report(show.fault());
  Interrupt interrupt;
  Status exported;
  {
    Progress bar("Exporting to " + options.folder, Progress::Style::automatic);
    exported = export_show(
        *show, options.folder, [&](int done, int of) { bar.update(done, of, "frame"); }, interrupt.token());
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
  return [options] { return run(*options); };
}

}  // namespace focalstage
