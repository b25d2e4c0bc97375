#include "io/assets/gltf_container.h"

#include "io/assets/byte_reader.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

constexpr std::size_t most_json_bytes = std::size_t{128} << 20;

/// Judged without a parser: those recurse, and make up to a kilobyte of every bracket.
const char* monstrous(std::span<const std::byte> json) {
  constexpr int deepest = 64;
  constexpr std::size_t most_values = 2'000'000;
  int depth = 0;
  std::size_t values = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = static_cast<char>(json[i]);
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text) {
      const bool opens = c == '{' || c == '[';
      depth += opens ? 1 : (c == '}' || c == ']') ? -1 : 0;
      values += opens || c == ',';
      if (depth > deepest) return "the JSON is nested deeper than 64 levels";
      if (values > most_values) return "the JSON holds more than two million values";
    }
  }
  return in_text || depth > 0 ? "the JSON ends too early" : nullptr;
}

/// All of a .gltf, the first chunk of a .glb.
Result<GltfText> found_text(std::span<const std::byte> bytes, const std::string& path) {
  constexpr std::uint32_t magic = 0x46546C67;  // "glTF"
  constexpr std::uint32_t json_chunk = 0x4E4F534A;
  constexpr std::uint32_t binary_chunk = 0x004E4942;
  const auto word = [&](std::size_t at) { return number_at<std::uint32_t>(bytes.data() + at); };
  if (bytes.size() < 4 || word(0) != magic) return GltfText{bytes, {}};
  if (bytes.size() < 20) return invalid_asset(path, "the GLB ends within its header");
  if (word(4) != 2) return unsupported_asset(path, "this GLB is not of version 2", "export it as glTF 2.0");
  if (word(8) != bytes.size()) return invalid_asset(path + ": byte 8", "the GLB gives another length than it has");
  const std::uint64_t json_bytes = word(12);
  if (word(16) != json_chunk || json_bytes > bytes.size() - 20) {
    return invalid_asset(path + ": byte 12", "the GLB's first chunk is no JSON or longer than the file");
  }
  GltfText text{bytes.subspan(20, json_bytes), {}};
  for (std::uint64_t at = 20 + json_bytes, number = 1; at < bytes.size(); ++number) {
    if (at % 4 != 0 || bytes.size() - at < 8 || word(at) > bytes.size() - at - 8) {
      return invalid_asset(path + ": byte " + std::to_string(at), "a chunk of the GLB is longer than the file");
    }
    if (number == 1 && word(at + 4) != binary_chunk) {
      return invalid_asset(path + ": byte " + std::to_string(at), "the GLB's second chunk is not binary");
    }
    if (number == 1) text.binary = bytes.subspan(at + 8, word(at));
    at += 8 + std::uint64_t{word(at)};
  }
  return text;
}

}  // namespace

Result<GltfText> gltf_text(std::span<const std::byte> bytes, const std::string& path) {
  Result<GltfText> text = found_text(bytes, path);
  if (!text) return text;
  if (text->json.size() > most_json_bytes) {
    return Fault{"asset.too-large", path, "its JSON is over 128 MiB long",
                 "save it as .glb, or keep its buffers and images in files"};
  }
  if (const char* reason = monstrous(text->json)) return invalid_asset(path, reason);
  return text;
}

}  // namespace focalstage
