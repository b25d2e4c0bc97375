#include "core/calibrate/projector_scan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/number_words.h"
#include "core/calibrate/board_view.h"
#include "core/calibrate/scan_mesh.h"

namespace focalstage {

namespace {

constexpr std::size_t looked_at = 20000;  // places of a capture
constexpr double mark_radius_px = 5.0;

Fault no_world(const std::string& where, const std::string& message, const std::string& remedy) {
  return {"scan.world", where, message, remedy};
}

/// The captures of boards; that which fixes the world first, so that the rig's frame is its board.
Result<std::vector<BoardView>> views_of(const std::vector<ScannedCapture>& captures, const ScanWorld& world) {
  std::vector<BoardView> views;
  for (std::size_t i = 0; i < captures.size(); ++i) {
    if (captures[i].corners.empty()) continue;
    auto view = board_view(captures[i].name, captures[i].corners, captures[i].decoded);
    if (!view) return view.fault();
    const bool first = world.world_from_board && i == world.capture;
    views.insert(first ? views.begin() : views.end(), std::move(*view));
  }
  return views;
}

double median_off_px(const ScanRig& rig, const DecodedCapture& decoded) {
  const std::size_t step = std::max<std::size_t>(1, decoded.u.size() / looked_at);
  std::vector<double> off_px;
  for (std::size_t i = 0; i < decoded.u.size(); i += step) {
    if (!std::isfinite(decoded.u[i])) continue;
    const auto width = static_cast<std::size_t>(decoded.width_px);
    const glm::dvec2 pixel(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
    const auto met = meeting_rays(rig.camera, rig.projector, pixel, {decoded.u[i], decoded.v[i]});
    off_px.push_back(met ? met->off_px : 1e3);
  }
  if (off_px.empty()) return 0.0;
  const auto middle = off_px.begin() + static_cast<std::ptrdiff_t>(off_px.size() / 2);
  std::ranges::nth_element(off_px, middle);
  return *middle;
}

Status check_agreement(const ScanRig& rig, const std::vector<ScannedCapture>& captures, double limit_px,
                       std::vector<CaptureAgreement>& agreements) {
  for (const ScannedCapture& capture : captures) {
    agreements.push_back({capture.name, median_off_px(rig, capture.decoded)});
    if (agreements.back().median_off_px <= limit_px) continue;
    return Fault{"scan.moved", capture.name,
                 "its places lie " + fixed_text(agreements.back().median_off_px, 2) +
                     " px (median) off the rays that the boards tell of",
                 "camera and projector must not move from the first capture to the last; capture all of them anew"};
  }
  return {};
}

Result<Alignment> align_marks(const ScanRig& rig, const ScannedCapture& capture, const std::vector<WorldMark>& marks) {
  std::vector<PointPair> pairs;
  for (const WorldMark& mark : marks) {
    const auto place = projector_place(capture.decoded, mark.camera_px, mark_radius_px);
    const auto met = place ? meeting_rays(rig.camera, rig.projector, mark.camera_px, *place) : std::nullopt;
    if (!met) {
      return no_world("mark " + mark.name, "the projector's place is not told there in " + capture.name,
                      "choose marks on faces that the projector lights and the camera sees");
    }
    pairs.push_back({mark.name, met->world_m, mark.world_m});
  }
  return align(pairs);
}

}  // namespace

Result<ProjectorScan> calibrate_by_scan(const ProjectorModel& known, const std::vector<ScannedCapture>& captures,
                                        const ScanWorld& world, double limit_px) {
  if (world.capture >= captures.size()) return no_world("world", "it names a capture that is not there", "");
  const ScannedCapture& fixing = captures[world.capture];
  if (world.world_from_board && fixing.corners.empty()) {
    return no_world(fixing.name, "no board was seen in it", "name the capture in which the board's place is known");
  }
  const auto views = views_of(captures, world);
  if (!views) return views.fault();
  auto rig = solve_scan_rig(known, captures[0].decoded.width_px, captures[0].decoded.height_px, *views);
  if (!rig) return rig.fault();
  ProjectorScan scan{rig->camera, rig->projector, std::move(rig->report), std::move(rig->camera_report), {}, {}};
  if (Status good = check_agreement(*rig, captures, limit_px, scan.agreements); !good) return good.fault();
  Rigid world_from_frame;
  if (world.world_from_board) {
    world_from_frame = *world.world_from_board;
  } else {
    auto aligned = align_marks(*rig, fixing, world.marks);
    if (!aligned) return aligned.fault();
    world_from_frame = aligned->world_from_tracker;
    scan.marks = std::move(*aligned);
  }
  for (ProjectorModel* lens : {&scan.camera, &scan.projector}) {
    lens->world_from_projector = world_from_frame * lens->world_from_projector;
  }
  return scan;
}

}  // namespace focalstage
