#include "core/base/result.h"

namespace focalstage {

std::string describe(const Fault& fault) {
  std::string line = fault.where.empty() ? std::string() : fault.where + ": ";
  line += fault.message;
  if (!fault.code.empty()) line += " (" + fault.code + ")";
  if (!fault.remedy.empty()) line += "; " + fault.remedy;
  return line;
}

}  // namespace focalstage
