#include <map>

#include "core/check/rules.h"
#include "core/check/words.h"
#include "core/percept/conflict.h"

namespace focalstage {
namespace {

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// The worst of one thing over all frames.
struct Worst {
  double share = 0.0;
  std::size_t frame = 0;

  void see(double other, std::size_t in_frame) {
    if (other <= share) return;
    share = other;
    frame = in_frame;
  }
};

Finding share_warning(const std::string& code, const std::string& where, const std::string& message,
                      const Worst& worst) {
  return {Severity::warning,
          code,
          where,
          percent(worst.share) + " of " + message + " (frame " + std::to_string(worst.frame) + ")",
          Amount{worst.share, 0.0, "share"},
          {}};
}

std::string name_of(const Project& project, std::size_t object) {
  return "\"" + (object < project.objects.size() ? project.objects[object].name : std::to_string(object)) + "\"";
}

void check_depths(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  std::map<std::size_t, std::pair<ObjectMeasure, std::size_t>> worst;  // by object: its worst frame
  for (std::size_t frame = 0; frame < measured.frames.size(); ++frame) {
    for (const ObjectMeasure& object : measured.frames[frame].objects) {
      const auto [entry, fresh] = worst.try_emplace(object.index, object, frame);
      if (!fresh && object.worst_beyond_d > entry->second.first.worst_beyond_d) entry->second = {object, frame};
    }
  }
  for (const auto& [index, seen] : worst) {
    const auto& [object, frame] = seen;
    if (!(object.worst_beyond_d > most_beyond_d + rounding)) continue;
    findings.push_back({Severity::error,
                        "depth.out-of-range",
                        item_pointer("objects", index) + "/depth",
                        "object " + name_of(project, index) + " wants a power " + words(object.worst_beyond_d) +
                            " D beyond the outermost slice (frame " + std::to_string(frame) + ", " +
                            percent(share_of(object.beyond, object.samples)) + " of it)",
                        Amount{object.worst_beyond_d, most_beyond_d, "D"},
                        {}});
  }
}

/// An object told to focus in a slice that is not there.
void check_slice_indices(const Project& project, std::vector<Finding>& findings) {
  const int count = static_cast<int>(project.slices.powers_d.size());
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Depth& depth = project.objects[i].depth;
    if (depth.mode != DepthMode::slice || (depth.index >= 0 && depth.index < count)) continue;
    findings.push_back({Severity::error,
                        "depth.out-of-range",
                        item_pointer("objects", i) + "/depth/index",
                        "object " + name_of(project, i) + " is to focus in slice " + std::to_string(depth.index) +
                            "; the last one is " + std::to_string(count - 1),
                        Amount{static_cast<double>(depth.index), static_cast<double>(count - 1), "slice"},
                        {}});
  }
}

void check_coverage(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  struct Shares {
    Worst off_surface;
    Worst outside_projector;
    Worst outside_lens;
  };
  std::map<std::size_t, Shares> worst;  // by object
  for (std::size_t frame = 0; frame < measured.coverage.size(); ++frame) {
    for (const ObjectCoverage& object : measured.coverage[frame]) {
      Shares& shares = worst[object.index];
      shares.off_surface.see(share_of(object.off_surface, object.looks), frame);
      shares.outside_projector.see(share_of(object.outside_projector, object.looks), frame);
      shares.outside_lens.see(share_of(object.outside_lens, object.looks), frame);
    }
  }
  for (const auto& [index, shares] : worst) {
    const std::string where = item_pointer("objects", index);
    const std::string of = "object " + name_of(project, index);
    const auto warn = [&](const char* code, const Worst& share, const char* what) {
      if (share.share > 0.0) findings.push_back(share_warning(code, where, of + what, share));
    };
    warn("view.off-surface", shares.off_surface, " has no surface that could carry its picture");
    warn("view.outside-projector", shares.outside_projector, " falls on surfaces that the projector does not reach");
    warn("view.outside-lens", shares.outside_lens, " is seen past the edge of the lens");
  }
}

/// An object that no frame shows: behind the viewer, or wholly behind another. Only where all frames were measured.
void check_unseen(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  if (measured.coverage.size() != static_cast<std::size_t>(std::max(1, project.frames.count))) return;
  std::map<std::size_t, std::uint64_t> looks;  // by object
  for (const std::vector<ObjectCoverage>& frame : measured.coverage) {
    for (const ObjectCoverage& object : frame) looks[object.index] += object.looks;
  }
  for (const auto& [index, count] : looks) {
    if (count > 0) continue;
    findings.push_back({Severity::warning,
                        "view.unseen",
                        item_pointer("objects", index),
                        "object " + name_of(project, index) +
                            " is never seen: it stands behind the viewer or wholly behind another object",
                        Amount{0.0, 1.0, "looks"},
                        {}});
  }
}

/// What eyes that converge on a thing and focus elsewhere soon tire of.
void check_conflicts(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  for (const ObjectConflict& conflict : measured.conflicts) {
    if (std::abs(conflict.mean_d) <= comfort_d) continue;
    const char* const way = conflict.mean_d > 0.0 ? " D further away than" : " D nearer than";
    findings.push_back({Severity::warning,
                        "view.conflict",
                        item_pointer("objects", conflict.index) + "/depth",
                        "object " + name_of(project, conflict.index) + " comes into focus " +
                            words(std::abs(conflict.mean_d)) + way + " the eyes converge on it",
                        Amount{conflict.mean_d, comfort_d, "D"},
                        {}});
  }
}

void check_light(const Project& project, const Measured& measured, std::vector<Finding>& findings) {
  Worst clipped;
  Worst defocused;
  double worst_defocus_d = 0.0;
  for (std::size_t frame = 0; frame < measured.frames.size(); ++frame) {
    const FrameMeasure& measure = measured.frames[frame];
    clipped.see(share_of(measure.clipped_pixels, measure.lit_pixels), frame);
    defocused.see(share_of(measure.defocused_pixels, measure.surface_pixels), frame);
    worst_defocus_d = std::max(worst_defocus_d, measure.worst_defocus_d);
  }
  // With compensation it is said of each surface (light_rules.cpp).
  if (clipped.share > 0.0 && project.slices.compensation.mode == CompensationMode::off) {
    findings.push_back(share_warning("light.clipped", "/projectors/0",
                                     "the lit pixels want more light than the projector has", clipped));
  }
  if (defocused.share > 0.0 && !project.projectors.empty()) {
    const double allowed_d = project.projectors.front().depth_of_field_d.value_or(0.0);
    findings.push_back(share_warning("projector.defocus", "/projectors/0/focus_m",
                                     "the pixels on surfaces lie outside the projector's depth of field, by up to " +
                                         words(worst_defocus_d) + " D from its focus; it has " + words(allowed_d) +
                                         " D",
                                     defocused));
  }
}

}  // namespace

std::vector<Finding> view_findings(const Project& project, const Measured& measured) {
  std::vector<Finding> findings;
  check_depths(project, measured, findings);
  check_slice_indices(project, findings);
  check_coverage(project, measured, findings);
  check_light(project, measured, findings);
  check_unseen(project, measured, findings);
  check_conflicts(project, measured, findings);
  return findings;
}

}  // namespace focalstage
