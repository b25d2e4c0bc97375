#pragma once

#include <optional>

#include "core/scene/project.h"

namespace focalstage {

/// Powers from the lowest to the highest.
struct PowerSpan {
  double low_d = 0.0;
  double high_d = 0.0;
};

/// Whether the sweep is a sine for both eyes, which can be made wider or smaller.
bool sweep_is_free(const Sweep& sweep);

/// The part of a sine's amplitude that exposures can use: the cosine of the phase from an extremum to the centre of the
/// first exposure that clears the dead window (decision 9). Zero or less: none.
double usable_share(const Project& project);

/// The smallest sine whose exposures can be centred on all of `span`, its ends whole hundredths of a dioptre; nothing
/// where the shutters leave no time or the lens does not reach it. Where the smallest would be next to nothing: 0.1 D.
///
/// With m the middle, A the amplitude and c the usable share: m - c A <= low, m + c A >= high. Every sweep that serves
/// contains the smallest one, and where it contains it it is faster at every power, as (v - min)(max - v) grows with
/// both ends: so the smallest is also the one of least smear and of most time between two slices.
std::optional<PowerSpan> smallest_sweep(const Project& project, const PowerSpan& span);

/// The powers that exposures of the project's sweep can be centred on in both eyes, to a hundredth of a dioptre.
std::optional<PowerSpan> reach_of(const Project& project);

}  // namespace focalstage
