#include "devices/roles/lens_drive.h"

namespace focalstage {

Status LensDrive::steer(double, double) {
  return Fault{"drive.unable", id().address, "its periods cannot be steered", "use a lens drive that can follow"};
}

}  // namespace focalstage
