#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"

namespace focalstage {

/// How a step joins the history.
enum class Joining {
  own_step,        ///< undone by itself
  continues_last,  ///< a drag goes on: replaces the last step if that set the same keys of the same things
};

/// What one act of the designer changed: undone and redone as one.
struct Step {
  std::string words;  ///< "Move rabbit"
  std::vector<Edit> edits;

  bool operator==(const Step&) const = default;
};

/// A project and the steps that led to it, undone and redone. Every state of the project is a snapshot that others may
/// hold while it goes on; between kept snapshots, states come back by applying the steps again.
class History {
 public:
  using Snapshot = std::shared_ptr<const Project>;

  explicit History(Project start);

  const Snapshot& now() const { return now_; }
  /// Grows with every change of `now`, also by undo; never twice the same.
  std::uint64_t revision() const { return revision_; }

  /// Applies the step after the present place; what had been undone is forgotten. On a fault nothing changes.
  Status apply(Step step, Joining joining = Joining::own_step);

  bool can_undo() const { return place_ > 0; }
  bool can_redo() const { return place_ < steps_.size(); }
  void undo();
  void redo();
  /// To the state after the first `place` steps; beyond the last: to the last.
  void jump(std::size_t place);

  /// All steps, those undone included, and how many of them are in effect.
  const std::vector<Step>& steps() const { return steps_; }
  std::size_t place() const { return place_; }

 private:
  Snapshot state_at(std::size_t place) const;
  void stand_at(std::size_t place, Snapshot state);

  std::vector<Step> steps_;
  std::size_t place_ = 0;
  std::map<std::size_t, Snapshot> kept_;  ///< by place; 0 always there
  Snapshot now_;
  std::uint64_t revision_ = 0;
};

}  // namespace focalstage
