#pragma once

#include <string>
#include <vector>

namespace focalstage {

/// Numbers typed while a hand drags: digits, a point or a comma, a minus in front; a space begins the next number.
class TypedNumbers {
 public:
  /// Takes a character if it may stand there; false: not one of ours.
  bool type(char character);
  void backspace();
  void clear() { text_.clear(); }

  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

  /// What is there so far; an unfinished number ("-", ".") counts as zero.
  std::vector<double> numbers() const;

 private:
  std::string text_;
};

}  // namespace focalstage
