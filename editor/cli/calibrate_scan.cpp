#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/number_words.h"
#include "core/calibrate/scan_mesh.h"
#include "editor/cli/calibrate_actions.h"
#include "editor/cli/calibrate_output.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/cli/scan_file.h"
#include "io/export/mesh_ply.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

Fault inside(Fault fault, const fs::path& folder) {
  if (!fault.where.starts_with(folder.string())) fault.where = folder.string() + ": " + fault.where;
  return fault;
}

Result<ScannedCapture> scan_capture(const fs::path& folder, const CaptureEntry& entry, const PatternSet& set,
                                    const CharucoBoard& board) {
  const fs::path at = folder / entry.folder;
  const auto capture = read_capture(at, set);
  if (!capture) return capture.fault();
  auto decoded = decode_capture(set, *capture);
  if (!decoded) return inside(decoded.fault(), at);
  ScannedCapture scanned{entry.folder, std::move(*decoded), {}};
  if (!entry.board) return scanned;
  auto corners = find_board(board, capture->front());
  if (!corners) return inside(corners.fault(), at);
  scanned.corners = std::move(*corners);
  return scanned;
}

Fault stopped() { return {"calibrate.stopped", "calibrate scan", "was stopped; nothing was written", ""}; }

Result<std::vector<ScannedCapture>> scan_all(const CalibrateOptions& options, const PatternSet& set,
                                             const ScanFile& file, const std::stop_token& stop) {
  Progress bar("Decoding", options.json ? Progress::Style::quiet : Progress::Style::automatic);
  std::vector<ScannedCapture> captures;
  for (const CaptureEntry& entry : file.captures) {
    if (stop.stop_requested()) return stopped();
    auto scanned = scan_capture(options.input, entry, set, file.board);
    if (!scanned) return scanned.fault();
    captures.push_back(std::move(*scanned));
    const DecodedCapture& first = captures.front().decoded;
    const DecodedCapture& last = captures.back().decoded;
    if (last.width_px != first.width_px || last.height_px != first.height_px) {
      return Fault{"capture.size", (fs::path(options.input) / entry.folder).string(),
                   "its pictures are of another size than those of " + captures.front().name,
                   "keep the camera's settings over all captures"};
    }
    bar.update(static_cast<double>(captures.size()), static_cast<double>(file.captures.size()), "capture");
  }
  return captures;
}

Value scan_value(const ProjectorScan& scan) {
  Value::Array agreements;
  for (const CaptureAgreement& agreement : scan.agreements) {
    agreements.push_back(Value::Object{{"capture", agreement.name}, {"median_off_px", agreement.median_off_px}});
  }
  const Rigid& at = scan.camera.world_from_projector;
  Value object = Value::Object{
      {"captures", std::move(agreements)},
      {"camera",
       Value::Object{{"fx_px", scan.camera.focal_px.x},
                     {"fy_px", scan.camera.focal_px.y},
                     {"cx_px", scan.camera.centre_px.x},
                     {"cy_px", scan.camera.centre_px.y},
                     {"distortion", Value::Array(scan.camera.distortion.begin(), scan.camera.distortion.end())},
                     {"position_m", Value::Array{at.position_m.x, at.position_m.y, at.position_m.z}},
                     {"rotation_xyzw", Value::Array{at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w}},
                     {"median_px", scan.camera_report.median_px},
                     {"p95_px", scan.camera_report.p95_px}}},
  };
  if (scan.marks) object.set("marks_rms_mm", scan.marks->rms_mm);
  return object;
}

void print_scan(const ProjectorScan& scan) {
  std::vector<std::vector<std::string>> rows;
  for (const CaptureAgreement& agreement : scan.agreements) {
    rows.push_back({agreement.name, fixed_text(agreement.median_off_px, 3)});
  }
  std::fputs(table_text({{"capture"}, {"off the rays px", true}}, rows).c_str(), stdout);
  std::printf("camera: median %s px, 95 %% within %s px\n", fixed_text(scan.camera_report.median_px, 3).c_str(),
              fixed_text(scan.camera_report.p95_px, 3).c_str());
  if (scan.marks) std::printf("marks: agree to %s mm\n", fixed_text(scan.marks->rms_mm, 2).c_str());
}

/// What the patterns were made for is what they are read as.
Status check_same(const Projector& projector, const PatternsFile& patterns, const std::string& file) {
  if (projector.width_px == patterns.set.width_px && projector.height_px == patterns.set.height_px) return {};
  return Fault{"calibrate.projector", file,
               "the patterns are of " + std::to_string(patterns.set.width_px) + " x " +
                   std::to_string(patterns.set.height_px) + " pixels, " + projector.name + " has " +
                   std::to_string(projector.width_px) + " x " + std::to_string(projector.height_px),
               "make the patterns for this projector"};
}

Status write_mesh(const CalibrateOptions& options, const ProjectorScan& scan, const ScannedCapture& capture) {
  if (options.mesh.empty()) return {};
  const Mesh mesh = scan_mesh(scan.camera, scan.projector, capture.decoded, {});
  if (mesh.triangles.empty()) {
    return Fault{"scan.empty", capture.name, "nothing of it becomes a face", "name another capture in mesh_of"};
  }
  return write_ply(options.mesh, mesh);
}

}  // namespace

ExitStatus run_calibrate_scan(const CalibrateOptions& options) {
  Interrupt interrupt;
  const fs::path folder = options.input;
  const auto loaded = load_project(options.project);
  if (!loaded) return report(loaded.fault());
  const auto patterns = read_patterns(folder / patterns_file_name);
  if (!patterns) return report(patterns.fault());
  const auto file = read_scan(folder / scan_file_name);
  if (!file) return report(file.fault());
  const auto projector = projector_meant(*loaded, options.projector.empty() ? patterns->projector : options.projector);
  if (!projector) return report(projector.fault());
  const std::string where = (folder / patterns_file_name).string();
  if (Status same = check_same(*projector, *patterns, where); !same) return report(same.fault());
  const auto captures = scan_all(options, patterns->set, *file, interrupt.token());
  if (!captures) {
    const ExitStatus status = report(captures.fault());
    interrupt.end_if_asked();
    return status;
  }
  const double limit_px = options.despite_residual ? std::numeric_limits<double>::infinity() : options.limit_px;
  const auto scan = calibrate_by_scan(projector_model(*projector), *captures, file->world, limit_px);
  if (!scan) return report(inside(scan.fault(), folder));
  if (Status written = write_mesh(options, *scan, (*captures)[file->mesh_of]); !written) return report(written.fault());
  if (!options.json) print_scan(*scan);
  return finish_calibration(options, *loaded, *projector, {scan->projector, scan->report}, scan_value(*scan));
}

}  // namespace focalstage
