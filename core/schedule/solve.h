#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/optics/needs.h"
#include "core/scene/project.h"
#include "core/schedule/projector_models.h"

namespace focalstage {

// What a rig has to do for a scene: the smallest sweep and the slices that reach every power that the scene needs, in
// both eyes, with nothing hidden by a shutter, no exposures that overlap, and no more smear than is allowed. Whatever
// is proposed was timed by the scheduler itself (`time_slots`) and has no trouble.

/// Two slices lie no farther apart, unless one asks for it (design section 6: a warning beyond 0.6 D, an error beyond
/// 1).
inline constexpr double good_spacing_d = 0.6;
inline constexpr double most_spacing_d = 1.0;
/// What is needed may lie so far beyond the outermost slice: the rule's 0.3 D less what measuring on a grid may miss.
inline constexpr double most_beyond_slices_d = 0.28;
inline constexpr int most_solved_slices = 64;  ///< `most_powers` of core/schedule/place_powers.h

struct SolveWishes {
  std::optional<int> slices;          ///< so many, placed for the least mean error; none: as few as keep the rest
  std::optional<double> spacing_d;    ///< instead of 0.6 D; with `slices`: 1 D where even steps would be wider than 0.6
  std::optional<double> max_error_d;  ///< every need at most so far from its nearest slice: then up to 1 D apart
};

/// Slices and the sweep that shows them.
struct SolvedRig {
  std::vector<double> powers_d;  ///< rising
  double min_power_d = 0.0;      ///< of the sweep; what it was where the waveforms are measured
  double max_power_d = 0.0;
  double frames_per_second = 0.0;     ///< of the projector: what it was, but in a nearest setting
  std::optional<double> exposure_ms;  ///< likewise

  double widest_gap_d = 0.0;  ///< between two slices; 0 for one alone
  double worst_smear_d = 0.0;
  double tightest_s = 0.0;  ///< from the start of one exposure to the next of the same eye; 0 for one alone
  double beyond_d = 0.0;    ///< how far the outermost need lies beyond the outermost slice

  bool operator==(const SolvedRig&) const = default;
};

/// A limit that keeps a scene from being shown, with how much.
struct SolveTrouble {
  enum class Limit {
    bad_project,     ///< no projector, or a lens, a shutter, a wish that is no sensible number
    bad_waveform,    ///< a sweep that is no curve
    nothing_needed,  ///< no object, or none before the eyes
    unserved,        ///< objects, but no surface carries their picture or no projector lights it. Share; 0
    pinned_slice,    ///< an object is pinned to a slice that is not there. Its index; how many there are
    lens_range,      ///< the sweep would have to reach a power that the lens does not. Power; the lens's end
    fixed_sweep,     ///< a measured sweep does not show a power that is needed. Power; the last that it shows
    dead_time,       ///< shutters and an exposure fill the half period. Seconds; the half period
    smear,           ///< the power would change too much in one exposure. D; 0.3
    overlap,         ///< exposures would start too soon after one another. Seconds; the projector's
    spacing,         ///< slices would lie too far apart. D; what was asked for
    count,           ///< so many slices cannot be placed. The number (none asked for: 64); the fewest that can
    unknown,         ///< no limit alone or together was found to blame
    gave_up,         ///< the search's bound was reached before anything was found
    stopped,         ///< somebody asked to stop
  };

  Limit limit = Limit::unknown;
  double amount = 0.0;
  double allowed = 0.0;
  std::size_t object = 0;  ///< pinned_slice: in the project's list

  bool operator==(const SolveTrouble&) const = default;
};

/// A setting near the one wished for that can be had.
struct NearestSetting {
  enum class Change {
    exposure,  ///< an exposure every `to` seconds instead of `from`
    spacing,   ///< slices up to `to` D apart instead of `from`
    slices,    ///< `to` slices instead of `from`
    range,     ///< `to` of the picture (a share) within reach instead of all
  };

  Change change = Change::range;
  double from = 0.0;
  double to = 0.0;
  double low_d = 0.0;  ///< range: the needs that are reached
  double high_d = 0.0;
  SolvedRig rig;

  bool operator==(const NearestSetting&) const = default;
};

/// How far needs lie from the nearest slice.
struct PlacementError {
  double mean_d = 0.0;
  double worst_d = 0.0;

  bool operator==(const PlacementError&) const = default;
};

struct SolveResult {
  std::optional<SolvedRig> rig;
  std::vector<SolveTrouble> troubles;   ///< why there is none; the first weighs most
  std::vector<NearestSetting> nearest;  ///< only where there is none

  double lowest_need_d = 0.0;
  double highest_need_d = 0.0;
  PlacementError before;   ///< of the slices that the project has
  PlacementError after;    ///< of those proposed
  PlacementError uniform;  ///< of as many at even steps over the needs
  PlacementError medians;  ///< of as many by the needs alone (k medians), whether or not a rig can show them
};

/// How long the search may be: some seconds, wherever it runs.
struct SolveBounds {
  std::uint64_t steps = 300'000'000;
  std::stop_token stop;
};

/// Solves for projector number 0 of `project`, whose surfaces say whether light is wanted at zero power.
SolveResult solve(const Project& project, const Needs& needs, const SolveWishes& wishes,
                  std::span<const ProjectorModelData> models, const SolveBounds& bounds = {});

}  // namespace focalstage
