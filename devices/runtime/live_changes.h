#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace focalstage {

/// A file of the project by its hash.
struct LiveFile {
  std::string path;
  std::string sha256;
};

/// What an editor asks of a live link, with the moment at which it was received (monotonic_s).
struct ProjectChange {
  std::uint64_t revision = 0;
  double received_s = 0.0;
  std::string text_sha256;
  int frame = 0;
  std::vector<LiveFile> files;
};

struct EditsChange {
  std::uint64_t revision = 0;
  double received_s = 0.0;
  std::uint64_t base_revision = 0;
  std::vector<std::string> edits;  ///< JSON lines
  std::vector<LiveFile> files;
};

struct FrameChange {
  double received_s = 0.0;
  int frame = 0;
};

using LiveChange = std::variant<ProjectChange, EditsChange, FrameChange>;

}  // namespace focalstage
