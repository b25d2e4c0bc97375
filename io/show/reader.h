#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/show/show.h"

namespace focalstage {

/// Reads a show, checked whole: names, types, shapes, ranges, hashes. Never crashes, whatever the bytes.
class ShowReader {
 public:
  /// Faults "show.*" name the file and the dataset. The file stays open: frames are read from it.
  static Result<ShowReader> open(const std::filesystem::path& path);

  ShowReader(ShowReader&&) noexcept;
  ShowReader& operator=(ShowReader&&) noexcept;
  ~ShowReader();

  const ShowHeader& header() const;

  /// What compiling measured for a projector, per frame; objects in the project's order.
  const std::vector<FrameMeasure>& measures(std::size_t projector = 0) const;

  /// Lower-case hex SHA-256 of the show as its seal holds it (io/show/seal.h): names the show.
  const std::string& sha256() const;

  /// All images of one frame, or one of them, of a projector.
  Result<FrameImages> frame(int frame, std::size_t projector = 0) const;
  Result<FrameImages> image(int frame, int image, std::size_t projector = 0) const;

 private:
  struct State;
  explicit ShowReader(std::unique_ptr<State> state);
  Result<FrameImages> images(int frame, std::size_t projector, int first_image, int count) const;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
