#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace focalstage {

/// A plain tree of values with the shape of JSON. Objects keep the order of their keys, so that a saved file reads as
/// its author wrote it. This is what edits carry; the bytes are the business of io/json.
class Value {
 public:
  using Array = std::vector<Value>;
  using Member = std::pair<std::string, Value>;
  using Object = std::vector<Member>;

  Value() = default;
  Value(bool b) : data_(b) {}
  Value(double number) : data_(number) {}
  Value(int number) : data_(static_cast<double>(number)) {}
  Value(const char* text) : data_(std::string(text)) {}
  Value(std::string text) : data_(std::move(text)) {}
  Value(std::string_view text) : data_(std::string(text)) {}
  Value(Array array) : data_(std::move(array)) {}
  Value(Object object) : data_(std::move(object)) {}

  bool operator==(const Value&) const = default;

  bool is_null() const { return data_.index() == 0; }
  const bool* boolean() const { return std::get_if<bool>(&data_); }
  const double* number() const { return std::get_if<double>(&data_); }
  const std::string* text() const { return std::get_if<std::string>(&data_); }
  const Array* array() const { return std::get_if<Array>(&data_); }
  const Object* object() const { return std::get_if<Object>(&data_); }
  Array* array() { return std::get_if<Array>(&data_); }
  Object* object() { return std::get_if<Object>(&data_); }

  /// The member named `key` of an object; null where this is no object or has none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);

  /// Sets or appends the member `key`; turns a null value into an object first.
  void set(std::string_view key, Value value);

  /// Removes the member `key` if there.
  void erase(std::string_view key);

 private:
  std::variant<std::monostate, bool, double, std::string, Array, Object> data_;
};

}  // namespace focalstage
