#include <cstdio>
#include <filesystem>

#include "editor/cli/output.h"
#include "editor/cli/trials_actions.h"
#include "io/files/files.h"
#include "io/study/report.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

/// The folder of answers: the one named, or the one that `run` made beside its study.
fs::path answers_in(const fs::path& folder) {
  std::error_code problem;
  return fs::is_directory(folder / trials_answers_folder, problem) ? folder / trials_answers_folder : folder;
}

Status write_report(const StudyReport& made, const fs::path& file) {
  const fs::path plot = fs::path(file).replace_extension(".svg");
  if (plot == file) return Fault{"usage", file.string(), "is the picture's own name", "name a .md file"};
  if (Status written = write_file_atomically(plot, report_svg(made)); !written) return written;
  return write_file_atomically(file, report_markdown(made, plot.filename().string()));
}

}  // namespace

ExitStatus run_trials_report(const TrialsOptions& options) {
  auto answers = load_answers(answers_in(options.folder));
  if (!answers) return report(answers.fault());
  const StudyReport made = report_of(std::move(*answers));
  if (!options.out.empty()) {
    if (const Status written = write_report(made, options.out); !written) {
      const ExitStatus status = report(written.fault());
      return written.fault().code == "usage" ? ExitStatus::usage : status;
    }
  }
  if (options.json) {
    print_json(report_value(made));
  } else if (options.out.empty()) {
    std::fputs(report_markdown(made, "").c_str(), stdout);
  } else {
    std::printf("%s: %zu participants%s\n", options.out.c_str(), made.tallies.size(),
                made.scripted() ? ", scripted: no human result" : "");
  }
  return ExitStatus::done;
}

}  // namespace focalstage
