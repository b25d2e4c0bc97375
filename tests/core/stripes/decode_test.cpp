#include "core/stripes/decode.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/core/stripes/simulated_room.h"

using namespace focalstage;

namespace {

const PatternSet set{512, 384, 2.2, 4, 16, 8};

own::Lens projector() {
  own::Lens lens{512, 384, 640.0, 640.0, 250.0, 200.0};
  lens.k1 = -0.05;
  lens.world_from_own = own::turned(-14.0, -4.0, 2.0);
  lens.at = {-0.3, 0.12, 0.2};
  return lens;
}

own::Lens camera() {
  own::Lens lens{320, 240, 344.0, 342.0, 162.0, 118.0};
  lens.k1 = -0.12;
  lens.k2 = 0.05;
  lens.world_from_own = own::turned(9.0, -2.0, -1.0);
  lens.at = {0.22, 0.05, 0.15};
  return lens;
}

/// A textured wall that swells, and a sheet before it that stands askew.
std::vector<own::Thing> room() {
  const auto wall = [](double x, double y) -> std::optional<double> { return own::texture(x, y); };
  return {own::wavy_wall(-1.1, 0.05, wall),
          own::sheet({-0.25, -0.2, -0.75}, own::turned(25.0, 5.0, 8.0), own::textured(0.25, 0.3))};
}

own::Photographer photographer(const own::Shot& shot = {}, const own::Lens& from = camera()) {
  return own::Photographer(room(), projector(), from, shot);
}

/// Photographed once: the tests spoil copies of it.
const Capture& good() {
  static const Capture capture = photographer().capture(set);
  return capture;
}

Fault refused(const Capture& capture) {
  const auto decoded = decode_capture(set, capture);
  return decoded ? Fault{} : decoded.fault();
}

std::size_t index_of(const std::string& name) {
  const auto patterns = patterns_of(set);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (name_of(patterns[i]) == name) return i;
  }
  FAIL(name);
  return 0;
}

/// Their pixels; the names stay, as a camera's would.
void exchange(Capture& capture, const std::string& a, const std::string& b) {
  std::swap(capture[index_of(a)].gray, capture[index_of(b)].gray);
}

struct Errors {
  std::vector<double> px;
  double share = 0.0;

  double at(double part) const { return px[static_cast<std::size_t>(part * static_cast<double>(px.size() - 1))]; }
};

/// Against the ray through each pixel's middle; the pixels at depth edges have no one place, and are in the tail.
Errors errors_of(const DecodedCapture& decoded, const own::Lens& from) {
  Errors errors;
  double lit = 0.0;
  const auto things = room();
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      const own::Vector along = from.look(x + 0.5, y + 0.5);
      const auto hit = own::first_hit(things, from.at, along);
      if (!hit) continue;
      const own::Vector at = own::plus(from.at, own::scaled(along, hit->way));
      const auto truth = projector().pixel(at);
      if (!truth || truth->x < 1 || truth->y < 1 || truth->x > 511 || truth->y > 383) continue;
      const own::Vector to_light = own::minus(projector().at, at);
      const auto shadow = own::first_hit(things, own::plus(at, own::scaled(to_light, 1e-4)), to_light);
      if (shadow && shadow->way < 1.0) continue;
      lit += 1.0;
      const auto i = static_cast<std::size_t>(y * from.width + x);
      if (!std::isfinite(decoded.u[i])) continue;
      errors.px.push_back(std::hypot(decoded.u[i] - truth->x, decoded.v[i] - truth->y));
    }
  }
  std::ranges::sort(errors.px);
  errors.share = static_cast<double>(errors.px.size()) / lit;
  return errors;
}

}  // namespace

TEST_CASE("a textured, swelling wall: each pixel's place to a fraction of a projector pixel") {
  const auto decoded = decode_capture(set, good());
  REQUIRE(decoded);
  const Errors errors = errors_of(*decoded, camera());
  MESSAGE("median ", errors.at(0.5), " px, 95 % ", errors.at(0.95), " px, told ", errors.share);
  CHECK(errors.share > 0.97);
  CHECK(errors.at(0.5) < 0.08);
  CHECK(errors.at(0.95) < 0.25);
  CHECK(*std::ranges::max_element(decoded->confidence) <= 1.0F);
}

TEST_CASE("noise, a room lit as bright as a tenth of the projector, another gamma") {
  own::Shot shot;
  shot.noise = 3.0;
  shot.ambient = 0.1;
  shot.gamma = 1.0;
  const auto decoded = decode_capture(set, photographer(shot).capture(set));
  REQUIRE(decoded);
  const Errors errors = errors_of(*decoded, camera());
  MESSAGE("median ", errors.at(0.5), " px, 95 % ", errors.at(0.95), " px, told ", errors.share);
  CHECK(errors.share > 0.9);
  CHECK(errors.at(0.5) < 0.2);
}

TEST_CASE("over-exposed, too dark, and not lit at all: refused by the white picture") {
  own::Shot shot;
  shot.exposure = 4.0;
  Fault fault = refused(photographer(shot).capture(set));
  CHECK(fault.code == "capture.over-exposed");
  CHECK(fault.where == "white");
  shot.exposure = 0.0003;
  fault = refused(photographer(shot).capture(set));
  CHECK(fault.code == "capture.dark");
  CHECK(fault.where == "white");
}

TEST_CASE("a camera that is bumped half-way is told, with the picture from which on") {
  struct Bump {
    own::Vector by;
    double yaw_deg;
    double roll_deg;
  };
  for (const Bump& bump : {Bump{{0.003, 0, 0}, 0, 0}, Bump{{0, 0, 0}, 0.1, 0}, Bump{{0, 0, 0}, 0, 0.3},
                           Bump{{0, 0.03, 0}, 0, 0}, Bump{{0, 0, 0}, 4.0, 0}}) {
    own::Lens moved = camera();
    moved.at = own::plus(moved.at, bump.by);
    moved.world_from_own = own::times(moved.world_from_own, own::turned(bump.yaw_deg, 0.0, bump.roll_deg));
    own::Photographer after = photographer({}, moved);
    const auto patterns = patterns_of(set);
    for (const char* from : {"columns-code-4", "rows-code-1", "white-again"}) {
      Capture capture = good();
      for (std::size_t i = index_of(from); i < capture.size(); ++i) capture[i] = after.photo(set, patterns[i]);
      const Fault fault = refused(capture);
      CAPTURE(from);
      CAPTURE(bump.yaw_deg);
      CAPTURE(fault.where);
      CHECK(fault.code == "capture.moved");
    }
    Capture capture = good();
    for (std::size_t i = index_of("rows-code-1"); i < capture.size(); ++i) capture[i] = after.photo(set, patterns[i]);
    const Fault fault = refused(capture);
    CAPTURE(bump.yaw_deg);
    if (bump.yaw_deg < 1.0) CHECK(fault.where == "rows-code-1");
  }
}

TEST_CASE("two good captures of the same are not called moved") {
  own::Photographer camera_again(room(), projector(), camera(), {}, 99);
  CHECK(refused(camera_again.capture(set)).code.empty());
}

TEST_CASE("missing, of another size, turned by a quarter or upside down: by name") {
  Capture capture = good();
  capture.erase(capture.begin() + 7);
  CHECK(refused(capture).code == "capture.missing");
  CHECK(refused({}).code == "capture.missing");
  capture = good();
  std::swap(capture[9].width_px, capture[9].height_px);
  CHECK(refused(capture).code == "capture.size");
  CHECK(refused(capture).where == capture[9].name);
  capture = good();
  capture[9].gray.pop_back();
  CHECK(refused(capture).code == "capture.size");
  for (const char* name : {"columns-code-2", "rows-code-3-inverse", "white-again"}) {
    capture = good();
    auto& gray = capture[index_of(name)].gray;
    std::reverse(gray.begin(), gray.end());
    const Fault fault = refused(capture);
    CAPTURE(name);
    CHECK(fault.code == "capture.turned");
    CHECK(fault.where == name);
  }
}

TEST_CASE("pictures in the wrong order: by name") {
  const auto after = [](const char* a, const char* b) {
    Capture capture = good();
    exchange(capture, a, b);
    const Fault fault = refused(capture);
    CAPTURE(a);
    CAPTURE(b);
    CAPTURE(fault.code);
    CAPTURE(fault.where);
    CHECK(fault.code == "capture.order");
    CHECK(fault.where.find(a) != std::string::npos);
    CHECK(fault.where.find(b) != std::string::npos);
  };
  after("white", "black");
  after("columns-code-1", "columns-code-4");
  after("columns-code-3", "rows-code-2-inverse");
  after("columns-sine-1", "columns-sine-4");
  // Whole, with their inverses.
  for (const auto& [a, b] : {std::pair("columns-code-0", "columns-code-1"),
                             std::pair("columns-code-2", "columns-code-5"), std::pair("rows-code-1", "rows-code-4")}) {
    Capture capture = good();
    exchange(capture, a, b);
    exchange(capture, std::string(a) + "-inverse", std::string(b) + "-inverse");
    const Fault fault = refused(capture);
    CAPTURE(a);
    CAPTURE(fault.where);
    CHECK(fault.code == "capture.order");
    CHECK(fault.where.find(a) != std::string::npos);
  }
  // A pattern and its own inverse: each is the other's.
  Capture capture = good();
  exchange(capture, "columns-code-0", "columns-code-0-inverse");
  CHECK(refused(capture).code == "capture.order");
  // One picture twice, all later ones a place on, the last lost.
  capture = good();
  for (std::size_t i = capture.size() - 1; i > 12; --i) capture[i].gray = capture[i - 1].gray;
  CHECK_FALSE(refused(capture).code.empty());
  // Two steps of a sine that are neighbours, and all steps backwards.
  capture = good();
  exchange(capture, "rows-sine-2", "rows-sine-3");
  CHECK(refused(capture).code == "capture.order");
  capture = good();
  for (int i = 0; i < 4; ++i) {
    exchange(capture, "rows-sine-" + std::to_string(i), "rows-sine-" + std::to_string(7 - i));
  }
  CHECK(refused(capture).code == "capture.order");
}

TEST_CASE("a projector's lamp that drifts is told from a camera that moved") {
  Capture capture = good();
  for (std::uint8_t& code : capture[capture.size() - 2].gray) code = static_cast<std::uint8_t>(code * 0.8);
  CHECK(refused(capture).code == "capture.light");
  CHECK(refused(capture).where == "white-again");
}
