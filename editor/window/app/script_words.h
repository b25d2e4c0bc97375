#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace focalstage {

/// The words of one line of a script, from the left: bare, or in double quotes with \" and \\ inside.
class ScriptWords {
 public:
  explicit ScriptWords(std::string_view line) : rest_(line) { skip_blanks(); }

  bool at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }
  bool next_is_quoted() const { return !rest_.empty() && rest_.front() == '"'; }

  /// The next word; empty at the end.
  std::string take();
  /// What the next word would be.
  std::string peek() const;
  /// Takes the next word if it is this one.
  bool take_if(std::string_view word);
  /// The next word as a number; none (and nothing taken) where it isn't one.
  std::optional<double> take_number();
  /// All that is left.
  std::string take_rest();

 private:
  void skip_blanks();
  std::string_view rest_;
};

}  // namespace focalstage
