#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/scene/finding.h"
#include "core/scene/pointer.h"

namespace focalstage {

/// Where a reader of values stands and what it met. Reading stops at the first fault.
class Reading {
 public:
  explicit Reading(std::vector<Finding>* notes) : notes_(notes) {}

  /// Records the fault at `where`; false, so that readers can return it.
  bool fail(std::string code, std::string message, std::string remedy);
  /// The same about the member `key` of what is being read.
  bool fail_at(std::string_view key, std::string code, std::string message, std::string remedy);
  /// "must be `expected`, but is text".
  bool wrong_type(const Value& value, std::string_view expected);

  void note_unknown(std::string_view key);

  const std::string& where() const { return where_; }
  const std::optional<Fault>& fault() const { return fault_; }

  /// Stands one step deeper while it lives.
  class Step {
   public:
    Step(Reading& reading, std::string_view key) : reading_(reading), length_(reading.where_.size()) {
      reading.where_ = pointer_into(reading.where_, key);
    }
    Step(Reading& reading, std::size_t index) : Step(reading, std::to_string(index)) {}
    ~Step() { reading_.where_.resize(length_); }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

   private:
    Reading& reading_;
    std::size_t length_;
  };

 private:
  std::string where_;
  std::optional<Fault> fault_;
  std::vector<Finding>* notes_;
};

/// "text", "a number", "a list"...
std::string_view type_word(const Value& value);

}  // namespace focalstage
