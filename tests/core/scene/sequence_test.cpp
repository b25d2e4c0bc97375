#include "core/scene/sequence.h"

#include <doctest/doctest.h>

#include <vector>

using namespace focalstage;

namespace {

ImageAppearance sequence_of(int count, double rate_hz, SequenceEnd end, double start_s = 0.0) {
  ImageAppearance image;
  image.file = "frames/fire_####.png";
  image.count = count;
  image.rate_hz = rate_hz;
  image.start_s = start_s;
  image.end = end;
  return image;
}

/// A rate as people mean it: 24000/1001.
struct Rate {
  long long pictures;
  long long seconds;
  double hz() const { return static_cast<double>(pictures) / static_cast<double>(seconds); }
};

/// The whole pictures in k frames of the clock, by whole numbers alone.
long long whole_pictures(long long k, const Rate& picture, const Rate& clock) {
  return k * picture.pictures * clock.seconds / (picture.seconds * clock.pictures);
}

std::vector<int> shown(const ImageAppearance& image, int frames) {
  std::vector<int> pictures;
  for (int k = -2; k < frames; ++k) pictures.push_back(picture_at(image, k / image.rate_hz).value_or(-1));
  return pictures;
}

}  // namespace

TEST_CASE("the picture of every frame of a long show is the one that whole numbers say") {
  const std::vector<Rate> pictures{{24, 1},       {25, 1},     {30, 1}, {60, 1}, {1, 1},   {24000, 1001},
                                   {30000, 1001}, {2997, 125}, {12, 1}, {1, 3},  {1000, 1}};
  const std::vector<Rate> clocks{{60, 1}, {30, 1}, {20, 1}, {15, 1}, {90, 1}, {60000, 1001}, {3, 2}};
  for (const Rate& picture : pictures) {
    for (const Rate& clock : clocks) {
      const ImageAppearance image = sequence_of(10'000, picture.hz(), SequenceEnd::loop);
      long long wrong = 0;
      for (long long k = 0; k < 1'000'000; k += k < 2000 ? 1 : 97) {
        const auto at = picture_at(image, static_cast<double>(k) / clock.hz());
        wrong += !at || *at != static_cast<int>(whole_pictures(k, picture, clock) % 10'000) ? 1 : 0;
      }
      CAPTURE(picture.hz());
      CAPTURE(clock.hz());
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a sequence that starts between two frames of the clock counts from its start") {
  // 0.35 s at 60 Hz is frame 21; 12 pictures a second are one in five frames.
  const ImageAppearance image = sequence_of(4, 12.0, SequenceEnd::hold, 0.35);
  for (int k = 0; k < 60; ++k) {
    const int expected = k < 21 ? 0 : std::min(3, (k - 21) / 5);
    CAPTURE(k);
    CHECK(picture_at(image, k / 60.0) == expected);
  }
}

TEST_CASE("after its last picture a sequence does what it says, before its first one it waits") {
  CHECK(shown(sequence_of(3, 24.0, SequenceEnd::loop), 8) == std::vector<int>{0, 0, 0, 1, 2, 0, 1, 2, 0, 1});
  CHECK(shown(sequence_of(3, 24.0, SequenceEnd::hold), 6) == std::vector<int>{0, 0, 0, 1, 2, 2, 2, 2});
  CHECK(shown(sequence_of(3, 24.0, SequenceEnd::once), 6) == std::vector<int>{-1, -1, 0, 1, 2, -1, -1, -1});
  CHECK(shown(sequence_of(3, 24.0, SequenceEnd::ping_pong), 9) == std::vector<int>{0, 0, 0, 1, 2, 1, 0, 1, 2, 1, 0});
  CHECK(shown(sequence_of(1, 24.0, SequenceEnd::ping_pong), 3) == std::vector<int>{0, 0, 0, 0, 0});
  CHECK(shown(sequence_of(2, 24.0, SequenceEnd::ping_pong), 4) == std::vector<int>{0, 0, 0, 1, 0, 1});
}

TEST_CASE("a single picture is always there") {
  ImageAppearance image;
  image.file = "poster_##.png";
  CHECK(picture_at(image, -3.0) == 0);
  CHECK(picture_at(image, 1e6) == 0);
  CHECK(picture_file(image, 0) == "poster_##.png");
}

TEST_CASE("numbers are filled up to as many digits as the name has places") {
  ImageAppearance image = sequence_of(12, 24.0, SequenceEnd::loop);
  image.first = 8;
  CHECK(picture_file(image, 0) == "frames/fire_0008.png");
  CHECK(picture_file(image, 2) == "frames/fire_0010.png");
  image.first = 99'999;
  CHECK(picture_file(image, 1) == "frames/fire_100000.png");
  image.file = "#.jpg";
  image.first = 0;
  CHECK(picture_file(image, 11) == "11.jpg");
  image.file = "take#1/shot##.png";
  CHECK(picture_file(image, 3) == "take#1/shot03.png");
  CHECK(has_number_place("take#1/shot##.png"));
  CHECK_FALSE(has_number_place("take#1/shot.png"));
  CHECK_FALSE(has_number_place("a#b#.png"));
}
