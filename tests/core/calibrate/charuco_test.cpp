#include "core/calibrate/charuco.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/calibrate/board_view.h"

using namespace focalstage;

namespace {

const CharucoBoard board{9, 7, 0.05, 0.03, "4x4_50"};

std::string code_of(const CharucoBoard& wrong) {
  const Status good = check_board(wrong);
  return good ? "" : good.fault().code;
}

}  // namespace

TEST_CASE("a drawn board's corners are found where they were drawn, counted from the pixels' corners") {
  const int square_px = 64;
  const auto picture = picture_of_board(board, square_px);
  REQUIRE(picture);
  CHECK(picture->width_px == 640);
  CHECK(picture->height_px == 512);
  const auto corners = find_board(board, *picture);
  REQUIRE(corners);
  CHECK(corners->size() == 48);
  for (const BoardCorner& corner : *corners) {
    // A rim of half a square; rows run down, the board's Y up.
    CHECK(corner.pixel.x == doctest::Approx(32.0 + corner.board_m.x / 0.05 * square_px).epsilon(2e-4));
    CHECK(corner.pixel.y == doctest::Approx(512.0 - 32.0 - corner.board_m.y / 0.05 * square_px).epsilon(2e-4));
  }
  CHECK(corners->front().board_m.z == 0.0);
}

TEST_CASE("a picture without the board is refused by its name") {
  const CameraPicture blank{"00-white.png", 320, 240, std::vector<std::uint8_t>(320 * 240, 128)};
  const auto found = find_board(board, blank);
  REQUIRE_FALSE(found);
  CHECK(found.fault().code == "board.unseen");
  CHECK(found.fault().where == "00-white.png");
}

TEST_CASE("boards that cannot be are refused") {
  CHECK(code_of(board).empty());
  CHECK(code_of({9, 6, 0.05, 0.03, "4x4_50"}) == "board.settings");
  CHECK(code_of({2, 7, 0.05, 0.03, "4x4_50"}) == "board.settings");
  CHECK(code_of({9, 7, 0.05, 0.05, "4x4_50"}) == "board.settings");
  CHECK(code_of({9, 7, 0.05, std::nan(""), "4x4_50"}) == "board.settings");
  CHECK(code_of({9, 7, 0.05, 0.03, "7x7"}) == "board.settings");
  CHECK(code_of({15, 9, 0.05, 0.03, "4x4_50"}) == "board.settings");  // 67 markers
  CHECK_FALSE(picture_of_board(board, 4).ok());
}

TEST_CASE("a place between decoded pixels is told through their noise; at the rim of what is lit it is not") {
  DecodedCapture decoded{40, 40, {}, {}, {}, 1.0};
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const double stray = (x * 7 + y * 13) % 50 == 0 ? 30.0 : 0.0;  // a few are far off
      const double ripple = 0.05 * ((x * 5 + y * 11) % 7 - 3);
      const bool lit = x < 25;
      decoded.u.push_back(lit ? static_cast<float>(100.0 + 0.8 * (x + 0.5) + 0.002 * x * y + ripple + stray) : NAN);
      decoded.v.push_back(lit ? static_cast<float>(50.0 - 0.3 * (x + 0.5) + 1.1 * (y + 0.5) + ripple) : NAN);
      decoded.confidence.push_back(lit ? 1.0F : 0.0F);
    }
  }
  const auto place = projector_place(decoded, {12.0, 20.0}, 8.0);
  REQUIRE(place);
  CHECK(place->x == doctest::Approx(100.0 + 0.8 * 12.0 + 0.002 * 11.5 * 19.5).epsilon(5e-4));
  CHECK(place->y == doctest::Approx(50.0 - 0.3 * 12.0 + 1.1 * 20.0).epsilon(5e-4));
  CHECK_FALSE(projector_place(decoded, {25.5, 20.0}, 6.0));
  CHECK_FALSE(projector_place(decoded, {38.0, 20.0}, 6.0));
}
