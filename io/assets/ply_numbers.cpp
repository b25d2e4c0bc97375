#include "io/assets/ply_numbers.h"

#include <bit>
#include <utility>

#include "io/assets/byte_reader.h"
#include "io/assets/text_reader.h"

namespace focalstage {
namespace {

class BinaryNumbers : public PlyNumbers {
 public:
  BinaryNumbers(std::span<const std::byte> bytes, std::size_t start, std::endian order, std::string path)
      : bytes_(bytes), at_(start), order_(order), path_(std::move(path)) {}

  std::optional<double> next(PlyType type) override {
    if (bytes_left() < size_of(type)) return std::nullopt;
    const std::byte* from = bytes_.data() + at_;
    at_ += size_of(type);
    switch (type) {
      case PlyType::int8:
        return number_at<std::int8_t>(from, order_);
      case PlyType::uint8:
        return number_at<std::uint8_t>(from, order_);
      case PlyType::int16:
        return number_at<std::int16_t>(from, order_);
      case PlyType::uint16:
        return number_at<std::uint16_t>(from, order_);
      case PlyType::int32:
        return number_at<std::int32_t>(from, order_);
      case PlyType::uint32:
        return number_at<std::uint32_t>(from, order_);
      case PlyType::float32:
        return number_at<float>(from, order_);
      case PlyType::float64:
        return number_at<double>(from, order_);
    }
    return std::nullopt;
  }

  std::size_t bytes_left() const override { return bytes_.size() - at_; }
  bool at_end() override { return at_ == bytes_.size(); }
  std::string where() const override { return path_ + ": byte " + std::to_string(at_); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_;
  std::endian order_;
  std::string path_;
};

class AsciiNumbers : public PlyNumbers {
 public:
  AsciiNumbers(std::span<const std::byte> bytes, const PlyHeader& header, std::string path)
      : size_(bytes.size() - header.size_bytes),
        header_lines_(header.lines),
        path_(std::move(path)),
        text_(bytes.subspan(header.size_bytes), path_, 0) {}

  std::optional<double> next(PlyType type) override {
    const std::string_view word = text_.word_across_lines();
    if (!is_integer(type)) return any_number_from(word);
    const std::optional<std::int64_t> integer = integer_from(word);
    return integer ? std::optional<double>(static_cast<double>(*integer)) : std::nullopt;
  }

  std::size_t bytes_left() const override { return size_; }
  bool at_end() override { return text_.word_across_lines().empty(); }
  std::string where() const override { return path_ + ": line " + std::to_string(header_lines_ + text_.line()); }

 private:
  std::size_t size_;
  std::size_t header_lines_;
  std::string path_;
  TextReader text_;
};

}  // namespace

std::unique_ptr<PlyNumbers> ply_numbers(const FileToRead& file, const PlyHeader& header) {
  if (header.format == PlyHeader::Format::ascii) {
    return std::make_unique<AsciiNumbers>(file.bytes, header, file.path);
  }
  const bool big = header.format == PlyHeader::Format::binary_big;
  return std::make_unique<BinaryNumbers>(file.bytes, header.size_bytes, big ? std::endian::big : std::endian::little,
                                         file.path);
}

}  // namespace focalstage
