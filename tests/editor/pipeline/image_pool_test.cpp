#include "editor/pipeline/image_pool.h"

#include <doctest/doctest.h>

#include <utility>

using namespace focalstage;

TEST_CASE("memory comes back when the last holder lets go, and not before") {
  ImagePool pool;
  CHECK(pool.take().codes.empty());
  FrameImages images;
  images.codes.assign(1000, 7);
  const std::uint8_t* const memory = images.codes.data();
  auto held = pool.share(std::move(images));
  auto also_held = held;
  held.reset();
  CHECK(pool.take().codes.empty());
  CHECK(also_held->codes[999] == 7);
  also_held.reset();
  CHECK(pool.take().codes.data() == memory);
  CHECK(pool.take().codes.empty());
}

TEST_CASE("images may outlive their pool") {
  std::shared_ptr<const FrameImages> held;
  {
    ImagePool pool;
    FrameImages images;
    images.codes.assign(10, 3);
    held = pool.share(std::move(images));
  }
  CHECK(held->codes[9] == 3);
}
