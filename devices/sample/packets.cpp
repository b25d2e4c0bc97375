#include "devices/sample/packets.h"

#include <cmath>
#include <sstream>
#include <string>

namespace focalstage {

namespace {

bool within(const glm::dvec3& v) { return std::abs(v.x) <= 1.0 && std::abs(v.y) <= 1.0 && std::abs(v.z) <= 1.0; }

}  // namespace

std::optional<Deflection> sample_deflection(std::string_view line) {
  std::istringstream words{std::string(line)};
  Deflection out;
  std::string push;
  std::string turn;
  std::string buttons;
  words >> push >> out.push.x >> out.push.y >> out.push.z >> turn >> out.turn.x >> out.turn.y >> out.turn.z;
  words >> buttons >> out.buttons;
  const bool whole = !words.fail() && (words >> std::ws).eof();
  if (!whole || push != "push" || turn != "turn" || buttons != "buttons") return std::nullopt;
  if (!within(out.push) || !within(out.turn)) return std::nullopt;
  return out;
}

}  // namespace focalstage
