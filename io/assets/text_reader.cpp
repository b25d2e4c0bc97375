#include "io/assets/text_reader.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

constexpr std::string_view spaces = " \t\r\v\f";

template <class T>
std::optional<T> value_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

TextReader::TextReader(std::span<const std::byte> bytes, std::string path, char comment)
    : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), path_(std::move(path)), comment_(comment) {}

void TextReader::take_line() {
  const std::size_t end = text_.find('\n');
  line_ = text_.substr(0, end);
  text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
  ++line_number_;
  if (comment_ != 0) line_ = line_.substr(0, line_.find(comment_));
  skip_spaces();
}

void TextReader::skip_spaces() {
  const std::size_t start = line_.find_first_not_of(spaces);
  line_.remove_prefix(start == std::string_view::npos ? line_.size() : start);
}

/// Files may be nothing but ends of lines: eight at once.
void TextReader::skip_empty_lines() {
  constexpr std::string_view ends = "\n\n\n\n\n\n\n\n";
  while (text_.starts_with(ends)) {
    text_.remove_prefix(ends.size());
    line_number_ += ends.size();
  }
}

bool TextReader::next_line() {
  do {
    skip_empty_lines();
    if (text_.empty()) {
      line_ = {};
      return false;
    }
    take_line();
  } while (line_.empty());
  return true;
}

std::string_view TextReader::word() {
  const std::string_view result = line_.substr(0, line_.find_first_of(spaces));
  line_.remove_prefix(result.size());
  skip_spaces();
  return result;
}

std::string_view TextReader::word_across_lines() {
  if (line_.empty() && !next_line()) return {};
  return word();
}

std::string_view TextReader::rest_of_line() {
  const std::string_view result = line_.substr(0, line_.find_last_not_of(spaces) + 1);
  line_ = {};
  return result;
}

std::string TextReader::where() const { return path_ + ": line " + std::to_string(line_number_); }

Fault TextReader::invalid(const std::string& what) const { return invalid_asset(where(), what); }

Status check_line_lengths(std::span<const std::byte> bytes, const std::string& path) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t begin = 0; text.size() - begin > longest_line_bytes;) {
    const std::size_t end = text.substr(begin, longest_line_bytes).rfind('\n');
    if (end == std::string_view::npos) {
      return invalid_asset(path + ": byte " + std::to_string(begin), "a line is over 64 MiB long");
    }
    begin += end + 1;
  }
  return {};
}

std::optional<double> number_from(std::string_view word) {
  const std::optional<double> value = value_from<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> any_number_from(std::string_view word) { return value_from<double>(word); }

std::optional<std::int64_t> integer_from(std::string_view word) { return value_from<std::int64_t>(word); }

}  // namespace focalstage
