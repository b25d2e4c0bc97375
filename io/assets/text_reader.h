#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace focalstage {

/// Words and numbers of a text file, line by line. Numbers are read exactly (correctly rounded), whatever the locale.
class TextReader {
 public:
  /// `comment` begins a comment that ends with its line; 0 for none.
  TextReader(std::span<const std::byte> bytes, std::string path, char comment = '#');

  /// Moves to the next line that holds a word; false at the end of the file.
  bool next_line();

  /// The next word of the line; empty at its end.
  std::string_view word();

  /// The next word of the file, on this line or a later one; empty at the end.
  std::string_view word_across_lines();

  /// What is left of the line, without spaces around it.
  std::string_view rest_of_line();

  bool at_end_of_line() const { return line_.empty(); }
  std::size_t line() const { return line_number_; }

  /// "path: line 12"
  std::string where() const;
  Fault invalid(const std::string& what) const;

 private:
  void take_line();
  void skip_empty_lines();
  void skip_spaces();

  std::string_view text_;
  std::string_view line_;
  std::string path_;
  char comment_;
  std::size_t line_number_ = 0;
};

/// No text of ours has longer lines; who reads words may hold that against a file of one line.
inline constexpr std::size_t longest_line_bytes = std::size_t{1} << 26;

/// Refuses a text with a line over `longest_line_bytes`, or one nearly as long, without reading all of it.
Status check_line_lengths(std::span<const std::byte> bytes, const std::string& path);

/// The whole word as a finite number, or nothing.
std::optional<double> number_from(std::string_view word);

/// The same, but `nan` and `inf` count as numbers.
std::optional<double> any_number_from(std::string_view word);

/// The whole word as an integer, or nothing.
std::optional<std::int64_t> integer_from(std::string_view word);

}  // namespace focalstage
