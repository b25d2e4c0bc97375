#include "devices/mcc1208/mcc1208.h"

#include "devices/mcc1208/drive.h"

namespace focalstage {

std::unique_ptr<LensDrive> make_mcc1208(const Mcc1208Settings& settings) {
  return std::make_unique<Mcc1208Drive>(settings);
}

}  // namespace focalstage
