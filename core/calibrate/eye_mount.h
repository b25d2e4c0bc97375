#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/rigid.h"
#include "core/base/sides.h"

namespace focalstage {

/// An eye that looks at a real mark and sees it right before a spot of light on the surface: the straight way through
/// both leads to its centre of rotation.
struct Sighting {
  std::string name;  ///< for whoever reads the residuals; may be empty
  Side eye = Side::left;
  Rigid world_from_body;   ///< the glasses' tracked body, meanwhile
  glm::dvec3 mark_m{0.0};  ///< in the world
  glm::dvec3 spot_m{0.0};
};

/// Where the eyes are in the axes of the body that is tracked.
struct EyeMount {
  PerEye<glm::dvec3> centre_m;       ///< centres of rotation
  PerEye<glm::dvec3> uncertainty_m;  ///< one standard deviation of each, along the body's axes
  double interpupillary_mm = 0.0;    ///< of eyes that look straight ahead
  double interpupillary_uncertainty_mm = 0.0;
  Rigid body_from_viewer;           ///< the viewer stands at the midpoint of the pupils
  std::vector<double> residual_mm;  ///< how far each way passes by its eye's centre, in the order of the sightings
  double rms_mm = 0.0;
  std::size_t worst = 0;  ///< which sighting
};

/// By least squares of the residuals, with the covariance that their spread gives. How the viewer is turned in the body
/// is `body_from_viewer` as it is known, turned by the least angle that takes its x axis through both eyes: about that
/// axis sightings say nothing. Refuses rather than guesses:
///
/// "sightings.finite"    a number that is none, or a rotation that is none
/// "sightings.few"       fewer than four for an eye
/// "sightings.near"      mark and spot less than 5 cm apart: they tell no direction
/// "sightings.parallel"  ways of an eye that all run alike in the body's axes (3 degrees, root mean square), so that
///                       how far away it is is anyone's: the head did not turn
/// "sightings.behind"    one that leads away from the eye: mark and spot are exchanged
/// "sightings.eyes"      eyes that are not 40 to 85 mm apart, or not side by side as the body is said to be turned
Result<EyeMount> eye_mount(const std::vector<Sighting>& sightings, const glm::dquat& body_from_viewer);

/// "3 (head left)", counted from 1.
std::string sighting_label(const std::vector<Sighting>& sightings, std::size_t index);

}  // namespace focalstage
