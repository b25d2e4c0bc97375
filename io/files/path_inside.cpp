#include <algorithm>

#include "io/files/files.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

Fault outside(const std::string& relative) {
  return {"path.outside", relative, "leads out of the project's folder", "copy the file into the project's folder"};
}

bool lies_below(const fs::path& root, const fs::path& path) {
  const auto [at_root, at_path] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return at_root == root.end() && at_path != path.end();
}

}  // namespace

Result<fs::path> path_inside(const fs::path& root, const std::string& relative) {
  if (relative.empty() || relative.find('\0') != std::string::npos) {
    return Fault{"path.outside", relative, "names no file", "name a file in the project's folder"};
  }
  if (fs::path(relative).is_absolute()) {
    return Fault{"path.absolute", relative, "is an absolute path, which means nothing on another machine",
                 "copy the file into the project's folder and name it from there"};
  }
  // Also for what is not there yet or any more: whatever exists of the path is followed through its links.
  std::error_code error;
  const fs::path real_root = fs::canonical(root, error);
  if (error) return Fault{"file.missing", root.string(), "there is no such folder", "check the path"};
  const fs::path real = fs::weakly_canonical(real_root / relative, error);
  if (error) return Fault{"path.outside", relative, "cannot be followed: " + error.message(), "check its links"};
  if (!lies_below(real_root, real)) return outside(relative);
  return real;
}

}  // namespace focalstage
