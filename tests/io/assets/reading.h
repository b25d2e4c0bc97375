#pragma once

#include <doctest/doctest.h>

#include <bit>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "io/assets/mesh_file.h"

namespace focalstage::test {

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(const std::string& text) {
  const auto* from = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(from, from + text.size());
}

/// Appends a number as a little or big-endian file has it.
template <class T>
void put(Bytes& bytes, T value, std::endian order = std::endian::little) {
  std::byte raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(raw[order == std::endian::native ? i : sizeof(T) - 1 - i]);
  }
}

inline Result<MeshFile> read(const std::string& path, const Bytes& bytes,
                             const std::map<std::string, Bytes>& companions = {}) {
  const Companions serve = [&](const std::string& uri) -> Result<std::span<const std::byte>> {
    const auto found = companions.find(uri);
    if (found == companions.end()) return Fault{"asset.missing", uri, "not there", ""};
    return std::span<const std::byte>(found->second);
  };
  return read_mesh_file({path, bytes, serve});
}

inline Result<MeshFile> read(const std::string& path, const std::string& text,
                             const std::map<std::string, Bytes>& companions = {}) {
  return read(path, bytes_of(text), companions);
}

inline MeshFile must_read(const Result<MeshFile>& file) {
  if (!file) FAIL(describe(file.fault()));
  return *file;
}

inline const Mesh& only_mesh(const MeshFile& file) {
  REQUIRE(file.model.nodes.size() == 1);
  REQUIRE(file.model.nodes[0].parts.size() == 1);
  return *file.model.nodes[0].parts[0].mesh;
}

/// The fault's code, "" for success.
inline std::string refusal(const Result<MeshFile>& file) { return file ? "" : file.fault().code; }

}  // namespace focalstage::test
