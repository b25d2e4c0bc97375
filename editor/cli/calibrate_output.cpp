#include "editor/cli/calibrate_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/number_words.h"
#include "core/calibrate/calibrated_edits.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/output.h"
#include "io/image/png.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

constexpr std::size_t most_rows = 60;
constexpr double picture_scale = 50.0;

Value optional_value(const std::optional<double>& number) { return number ? Value(*number) : Value(); }

std::string coverage_text(const Coverage& coverage) {
  std::string text;
  for (int row = 0; row < Coverage::rows; ++row) {
    text += "  ";
    for (int column = 0; column < Coverage::columns; ++column) {
      const int count = coverage.counts[static_cast<std::size_t>(row * Coverage::columns + column)];
      text += count == 0 ? " ." : count < 10 ? " " + std::to_string(count) : " +";
    }
    text += "\n";
  }
  return text;
}

std::string rows_text(const CalibrationReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const PointResidual& residual : report.residuals) {
    rows.push_back({residual.name, fixed_text(residual.pixel.x, 1), fixed_text(residual.pixel.y, 1),
                    signed_text(residual.off_px.x, 2), signed_text(residual.off_px.y, 2),
                    fixed_text(residual.distance_px, 2),
                    residual.left_out_px ? fixed_text(*residual.left_out_px, 2) : "-"});
  }
  return table_text(
      {{"point"}, {"u", true}, {"v", true}, {"off u", true}, {"off v", true}, {"px", true}, {"left out px", true}},
      rows);
}

Value edits_value(const std::vector<Edit>& edits) {
  Value::Array list;
  for (const Edit& edit : edits) list.push_back(value_from(edit));
  return Value(std::move(list));
}

Status write_picture(const CalibrateOptions& options, const Projector& projector, const CalibrationReport& report) {
  if (options.picture.empty()) return {};
  return write_png(options.picture, projector.width_px, projector.height_px, 3,
                   residual_picture(report, projector.width_px, projector.height_px));
}

}  // namespace

Result<Projector> projector_meant(const LoadedProject& loaded, const std::string& name) {
  const auto& all = loaded.project.projectors;
  std::string names;
  for (const Projector& projector : all) {
    if (projector.name == name || (name.empty() && all.size() == 1)) return projector;
    names += (names.empty() ? "" : ", ") + projector.name;
  }
  if (all.empty()) {
    return Fault{"calibrate.projector", loaded.file.string() + ": /projectors", "the project has no projector",
                 "add one"};
  }
  return Fault{"calibrate.projector", loaded.file.string() + ": /projectors",
               name.empty() ? "there are several projectors" : "there is no projector named " + name,
               "name one with --projector: " + names};
}

std::string report_text(const CalibrationReport& report, bool each) {
  std::string text;
  if (each && report.residuals.size() <= most_rows) text += rows_text(report);
  text += "residual: median " + fixed_text(report.median_px, 3) + " px, 95 % within " + fixed_text(report.p95_px, 3) +
          " px, worst " + fixed_text(report.worst_px, 3) + " px";
  if (!report.residuals.empty()) text += " (point " + report.residuals[report.worst].name + ")";
  text += "\n";
  if (report.left_out_median_px) {
    text += "left out: half of new points land within " + fixed_text(*report.left_out_median_px, 3) + " px\n";
  }
  text += "coverage: " + fixed_text(100.0 * report.coverage.hull_share, 0) + " % of the picture lies between points\n" +
          coverage_text(report.coverage);
  text += "uncertainty: position " + fixed_text(report.uncertainty.position_mm, 2) + " mm, rotation " +
          fixed_text(report.uncertainty.rotation_deg, 4) + " degrees";
  if (report.uncertainty.focal_px) text += ", focal length " + fixed_text(*report.uncertainty.focal_px, 2) + " px";
  if (report.uncertainty.centre_px) text += ", centre " + fixed_text(*report.uncertainty.centre_px, 2) + " px";
  return text + " (one standard deviation)\n";
}

Value report_value(const CalibrationReport& report) {
  Value::Array points;
  for (const PointResidual& residual : report.residuals) {
    points.push_back(Value::Object{{"name", residual.name},
                                   {"pixel", Value::Array{residual.pixel.x, residual.pixel.y}},
                                   {"off_px", Value::Array{residual.off_px.x, residual.off_px.y}},
                                   {"residual_px", residual.distance_px},
                                   {"left_out_px", optional_value(residual.left_out_px)}});
  }
  const Coverage& coverage = report.coverage;
  const PoseUncertainty& uncertainty = report.uncertainty;
  return Value::Object{
      {"median_px", report.median_px},
      {"p95_px", report.p95_px},
      {"worst_px", report.worst_px},
      {"worst_point", report.residuals.empty() ? Value() : Value(report.residuals[report.worst].name)},
      {"left_out_median_px", optional_value(report.left_out_median_px)},
      {"coverage", Value::Object{{"columns", Coverage::columns},
                                 {"rows", Coverage::rows},
                                 {"counts", Value::Array(coverage.counts.begin(), coverage.counts.end())},
                                 {"hull_share", coverage.hull_share},
                                 {"touched_share", coverage.touched_share}}},
      {"uncertainty", Value::Object{{"position_mm", uncertainty.position_mm},
                                    {"rotation_deg", uncertainty.rotation_deg},
                                    {"focal_px", optional_value(uncertainty.focal_px)},
                                    {"centre_px", optional_value(uncertainty.centre_px)}}},
      {"points", std::move(points)},
  };
}

std::vector<std::uint8_t> residual_picture(const CalibrationReport& report, int width_px, int height_px) {
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 24);
  const auto paint = [&](const glm::dvec2& at, const std::array<std::uint8_t, 3>& color) {
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < width_px && at.y < height_px)) return;
    const auto pixel =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(at.x);
    std::copy(color.begin(), color.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
  };
  for (const PointResidual& residual : report.residuals) {
    const std::array<std::uint8_t, 3> color = residual.distance_px < 0.5   ? std::array<std::uint8_t, 3>{80, 220, 90}
                                              : residual.distance_px < 1.0 ? std::array<std::uint8_t, 3>{235, 205, 60}
                                                                           : std::array<std::uint8_t, 3>{240, 70, 60};
    for (double along = 0.0; along <= 1.0; along += 0.002) {
      paint(residual.pixel + picture_scale * along * residual.off_px, color);
    }
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) paint(residual.pixel + glm::dvec2(x, y), color);
    }
  }
  return rgb;
}

ExitStatus finish_calibration(const CalibrateOptions& options, const LoadedProject& loaded, const Projector& projector,
                              const ProjectorCalibration& calibration, Value extra) {
  if (Status written = write_picture(options, projector, calibration.report); !written) return report(written.fault());
  if (Status good = check_limit(calibration.report, options.limit_px); !good && !options.despite_residual) {
    Fault fault = good.fault();
    fault.where = options.input + ": " + fault.where;
    return report(fault);
  }
  const std::vector<Edit> edits = calibrated_edits(projector, calibration.model);
  if (!options.dry_run) {
    if (const auto saved = apply_and_save(loaded, edits, options.output); !saved) return report(saved.fault());
  }
  if (options.json) {
    Value object = std::move(extra);
    object.set("projector", projector.name);
    object.set("edits", edits_value(edits));
    object.set("applied", !options.dry_run);
    const Value values = report_value(calibration.report);
    for (const auto& [key, value] : *values.object()) object.set(key, value);
    print_json(object);
    return ExitStatus::done;
  }
  std::fputs(report_text(calibration.report, true).c_str(), stdout);
  for (const Edit& edit : edits) std::printf("%s\n", write_json(value_from(edit), -1).c_str());
  return ExitStatus::done;
}

}  // namespace focalstage
