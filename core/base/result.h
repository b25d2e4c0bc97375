#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace focalstage {

/// What went wrong, where, and what to do about it. A value, never thrown across rooms.
struct Fault {
  std::string code;     ///< stable and searchable, e.g. "project.syntax"
  std::string where;    ///< the place: a file, "file: /json/pointer", "file: byte 812"
  std::string message;  ///< what is wrong, in one sentence without a full stop
  std::string remedy;   ///< what to do; may be empty

  bool operator==(const Fault&) const = default;
};

/// The fault on one line: "where: message (code); remedy".
std::string describe(const Fault& fault);

/// Either a value or the Fault that prevented it.
template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Fault fault) : state_(std::in_place_index<1>, std::move(fault)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    assert(ok());
    return std::get<0>(state_);
  }
  T& value() & {
    assert(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    assert(ok());
    return std::get<0>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  const Fault& fault() const {
    assert(!ok());
    return std::get<1>(state_);
  }

  /// Passes the value on to `next`, which returns a Result of its own.
  template <class Next>
  auto and_then(Next&& next) && -> decltype(next(std::declval<T&&>())) {
    if (!ok()) return fault();
    return next(std::move(*this).value());
  }

 private:
  std::variant<T, Fault> state_;
};

/// Success without a value, or a Fault.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Fault fault) : fault_(std::move(fault)), ok_(false) {}

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Fault& fault() const {
    assert(!ok_);
    return fault_;
  }

 private:
  Fault fault_;
  bool ok_ = true;
};

using Status = Result<void>;

}  // namespace focalstage
