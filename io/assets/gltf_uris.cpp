#include "io/assets/gltf_uris.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

bool has_scheme(const std::string& uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  return end != std::string::npos && uri[end] == ':';
}

/// %XX as the byte it stands for; none where XX are not two hexadecimal digits.
std::optional<std::string> percent_decoded(const std::string& uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      decoded += uri[i];
      continue;
    }
    unsigned code = 0;
    if (i + 2 >= uri.size()) return std::nullopt;
    const char* digits = uri.data() + i + 1;
    if (std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2) return std::nullopt;
    decoded += static_cast<char>(code);
    i += 2;
  }
  return decoded;
}

}  // namespace

Result<CompanionNames> companion_names(const std::vector<std::string>& uris, const std::string& path) {
  CompanionNames names;
  for (const std::string& uri : uris) {
    if (uri.starts_with("data:")) continue;
    if (has_scheme(uri)) {
      return unsupported_asset(path, "files are not fetched from elsewhere: " + uri.substr(0, 60),
                               "put the file beside this one and refer to it by a relative path");
    }
    const std::optional<std::string> name = percent_decoded(uri);
    if (!name || name->empty()) return invalid_asset(path, "this is no uri: " + uri.substr(0, 60));
    std::string with_spaces = uri;
    std::replace(with_spaces.begin(), with_spaces.end(), '+', ' ');
    const std::string& kept = names.try_emplace(*percent_decoded(with_spaces), *name).first->second;
    if (kept != *name) {
      return unsupported_asset(path, "two files differ only by a plus sign and a space: " + *name, "rename one");
    }
  }
  return names;
}

}  // namespace focalstage
