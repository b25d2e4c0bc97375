#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "io/json/json.h"

namespace focalstage {
namespace {

/// Characters that tell how far the parser has come: its callbacks do not.
struct Cursor {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  Cursor& operator++() {
    *reached = ++at;
    return *this;
  }
  Cursor operator++(int) {
    const Cursor before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Cursor& other) const { return at == other.at; }
  bool operator!=(const Cursor& other) const { return at != other.at; }
};

/// Builds a Value from the parser's events. What is open lies on a stack of its own: no call nests with the text.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(std::string_view text, const std::string& source, const JsonLimits& limits)
      : text_(text), source_(source), limits_(limits), reached_(text.data()) {}

  Cursor begin() { return {text_.data(), &reached_}; }
  Cursor end() { return {text_.data() + text_.size(), &reached_}; }

  Result<Value> result() {
    if (fault_) return *fault_;
    return std::move(root_);
  }

  bool null() override { return put(Value()); }
  bool boolean(bool flag) override { return put(Value(flag)); }
  bool number_integer(number_integer_t number) override { return put(Value(static_cast<double>(number))); }
  bool number_unsigned(number_unsigned_t number) override { return put(Value(static_cast<double>(number))); }
  bool number_float(number_float_t number, const string_t&) override { return put(Value(number)); }
  bool string(string_t& text) override { return put(Value(std::move(text))); }
  bool binary(binary_t&) override { return false; }  // never in JSON text

  bool start_object(std::size_t) override { return open(Value(Value::Object{})); }
  bool start_array(std::size_t) override { return open(Value(Value::Array{})); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Open& object = open_.back();
    if (!object.keys.insert(key).second) {
      return fail(offset(), "json.duplicate-key", "the key \"" + key + "\" stands twice in one object",
                  "remove one of the two");
    }
    object.key = key;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow) {
      return fail(offset(), "json.number", "the number " + token + " is beyond what a computer's number holds",
                  "write a smaller one");
    }
    return fail(position == 0 ? 0 : position - 1, "json.syntax", reason(error.what()), "mend the text there");
  }

 private:
  struct Open {
    Value value;
    std::string key;             ///< whose value comes next
    std::set<std::string> keys;  ///< those met
  };

  std::size_t offset() const { return static_cast<std::size_t>(reached_ - text_.data()); }

  /// Without the library's name and its count of lines, which ours replaces.
  static std::string reason(std::string_view what) {
    if (const auto colon = what.find(": "); colon != std::string_view::npos) what.remove_prefix(colon + 2);
    return "is no valid JSON: " + std::string(what);
  }

  /// "source: line 3, column 14" of the byte at `offset`.
  std::string place(std::size_t offset) const {
    const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto line_start = before.rfind('\n');
    const std::size_t column = before.size() - (line_start == std::string_view::npos ? 0 : line_start + 1) + 1;
    return source_ + ": line " + std::to_string(line) + ", column " + std::to_string(column);
  }

  bool fail(std::size_t offset, std::string code, std::string message, std::string remedy) {
    fault_ = Fault{std::move(code), place(offset), std::move(message), std::move(remedy)};
    return false;
  }

  bool open(Value container) {
    if (static_cast<int>(open_.size()) >= limits_.depth) {
      return fail(offset() - 1, "json.depth", "nests deeper than " + std::to_string(limits_.depth) + " levels",
                  "flatten it; no file of ours nests so deep");
    }
    open_.push_back({std::move(container), {}, {}});
    return true;
  }

  bool close() {
    Value done = std::move(open_.back().value);
    open_.pop_back();
    return put(std::move(done));
  }

  bool put(Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (Value::Array* items = open_.back().value.array()) {
      items->push_back(std::move(value));
    } else {
      open_.back().value.object()->emplace_back(std::move(open_.back().key), std::move(value));
    }
    return true;
  }

  std::string_view text_;
  const std::string& source_;
  const JsonLimits& limits_;
  const char* reached_;
  std::vector<Open> open_;
  Value root_;
  std::optional<Fault> fault_;
};

}  // namespace

Result<Value> parse_json(std::string_view text, const std::string& source, const JsonLimits& limits) {
  if (text.size() > limits.bytes) {
    return Fault{"json.size", source,
                 "is " + std::to_string(text.size()) + " bytes long; " + std::to_string(limits.bytes) + " are allowed",
                 "check that this is the right file"};
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return Fault{"json.syntax", source + ": line 1, column 1", "is empty", "check that this is the right file"};
  }
  Builder builder(text, source, limits);
  try {
    nlohmann::json::sax_parse(builder.begin(), builder.end(), &builder);
  } catch (const std::exception& error) {
    return Fault{"json.syntax", source, error.what(), "check that this is the right file"};
  }
  return builder.result();
}

}  // namespace focalstage
