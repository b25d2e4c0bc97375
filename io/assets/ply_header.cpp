#include "io/assets/ply_header.h"

#include <string_view>
#include <utility>

#include "io/assets/mesh_file.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64},
};

constexpr std::size_t most_header_bytes = std::size_t{1} << 20;
constexpr std::size_t most_properties = 1000;  ///< of an element

std::optional<PlyType> type_from(std::string_view name) {
  for (const auto& [known, type] : type_names) {
    if (known == name) return type;
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

  Result<PlyHeader> read() {
    if (!next_line() || word() != "ply") return invalid("a PLY file begins with the line `ply`");
    if (!next_line() || word() != "format") return invalid("`format` is expected");
    const std::string_view format = word();
    if (format == "binary_little_endian") {
      header_.format = PlyHeader::Format::binary_little;
    } else if (format == "binary_big_endian") {
      header_.format = PlyHeader::Format::binary_big;
    } else if (format != "ascii") {
      return invalid("the format is none of ascii, binary_little_endian and binary_big_endian");
    }
    if (word() != "1.0") return invalid("the version is not 1.0");
    while (next_line()) {
      if (header_.size_bytes > most_header_bytes) return invalid("the header is over 1 MiB long");
      const std::string_view key = word();
      if (key == "end_header") return header_;
      if (key.empty() || key == "comment" || key == "obj_info") continue;
      const bool good = key == "element" ? read_element() : key == "property" && read_property();
      if (!good) return invalid("this is no line of a PLY header");
    }
    return invalid("the header does not end with `end_header`");
  }

 private:
  bool next_line() {
    const std::string_view left = text_.substr(header_.size_bytes);
    const std::size_t end = left.find('\n');
    ++header_.lines;
    if (end == std::string_view::npos) return false;  // data must follow, so a header's line always ends
    line_ = left.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    header_.size_bytes += end + 1;
    return true;
  }

  std::string_view word() {
    const std::size_t start = line_.find_first_not_of(" \t");
    line_.remove_prefix(start == std::string_view::npos ? line_.size() : start);
    const std::string_view result = line_.substr(0, line_.find_first_of(" \t"));
    line_.remove_prefix(result.size());
    return result;
  }

  bool read_element() {
    PlyElement element;
    element.name = word();
    const std::optional<std::int64_t> count = integer_from(word());
    if (element.name.empty() || !count || *count < 0 || !word().empty()) return false;
    element.count = static_cast<std::uint64_t>(*count);
    header_.elements.push_back(std::move(element));
    return true;
  }

  bool read_property() {
    if (header_.elements.empty()) return false;
    PlyProperty property;
    std::string_view type = word();
    if (type == "list") {
      property.count_type = type_from(word());
      if (!property.count_type || !is_integer(*property.count_type)) return false;
      type = word();
    }
    const std::optional<PlyType> known = type_from(type);
    property.name = word();
    if (!known || property.name.empty() || !word().empty()) return false;
    property.type = *known;
    if (header_.elements.back().properties.size() == most_properties) return false;
    for (const PlyProperty& other : header_.elements.back().properties) {
      if (other.name == property.name) return false;
    }
    header_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  Fault invalid(const std::string& what) const {
    return invalid_asset(path_ + ": line " + std::to_string(header_.lines), what);
  }

  std::string_view text_;
  std::string_view line_;
  std::string path_;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 0;
}

Result<PlyHeader> read_ply_header(std::span<const std::byte> bytes, const std::string& path) {
  return HeaderReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path).read();
}

}  // namespace focalstage
