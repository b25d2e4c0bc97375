#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// Compiles the frame in view behind the window: of all wishes the newest only, first at half or quarter size where a
/// whole one would take longer than a frame of the window, then exactly once the hand rests. A full-size compile that
/// is superseded ends within milliseconds; a small one is let finish, so that a long drag still shows something.
class Preview {
 public:
  /// `wake` is called from the worker's thread whenever something new can be taken.
  explicit Preview(std::function<void()> wake);
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  void want(PreviewWish wish);
  /// Nothing is open: what there is goes.
  void clear();

  /// Each the newest there is; null: none yet.
  std::shared_ptr<const CompiledSlices> slices() const;
  std::shared_ptr<const CheckedProject> checked() const;
  std::shared_ptr<const EyePicture> eye_picture() const;

  std::optional<FocusAnswer> focus_answer() const;

  /// Why the newest wish could not be compiled, if it could not.
  std::optional<Fault> fault() const;
  /// Whether the newest wish is not wholly fulfilled yet.
  bool busy() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
