#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/history.h"
#include "core/scene/value.h"
#include "core/schedule/projector_models.h"
#include "editor/document/document.h"
#include "editor/preview/pixel_reader.h"
#include "editor/preview/preview.h"
#include "editor/rig/rig_link.h"
#include "editor/session/command.h"
#include "editor/session/log.h"
#include "editor/session/sample_cards.h"
#include "editor/session/selection.h"
#include "editor/session/solve_offer.h"
#include "editor/session/task.h"
#include "editor/session/view_state.h"

namespace focalstage {

/// Everything the editor knows, without a window: the open document, what is selected, what the views show, what was
/// compiled of it, the link to a rig. One thread's; what runs behind it reports through `update`.
///
/// Whatever a person does becomes a command (`run`) or an edit (`edit`, `drag`); panels and views read the rest.
class Session {
 public:
  struct State;  ///< editor/session/session_state.h; for the commands of this room

  /// `wake`: called from any thread when something arrived and `update` should be called.
  explicit Session(std::function<void()> wake);
  ~Session();

  // What a person does ------------------------------------------------------------------------------------------------

  /// Runs a command of the table. Faults are also put in the log and in `notice()`.
  Status run(std::string_view command, const Value& args = {});

  /// One act on the project, undone as one.
  Status edit(std::string words, std::vector<Edit> edits);

  /// A hand that is still moving: all `drag`s until `end_drag` are one step of undo, and the preview stays small.
  Status drag(std::string words, std::vector<Edit> edits);
  void end_drag();
  bool dragging() const;

  // What there is -----------------------------------------------------------------------------------------------------

  bool has_document() const;
  const Document& document() const;
  const Project& project() const;  ///< the open one; an empty one where none is
  std::uint64_t revision() const;
  /// The projector models that the open project can name; null before anything was open.
  const std::shared_ptr<const ProjectorModels>& models() const;
  /// The room at the frame in view, always of the present revision (what can't be stood up is left out).
  const std::shared_ptr<const Stage>& stage() const;

  const Selection& selection() const;
  void select(std::vector<Thing> things);

  const ViewState& view() const;
  ViewState& view();  ///< views change it freely; nothing of it is the project's

  std::shared_ptr<const CompiledSlices> slices() const;   ///< null: none yet
  std::shared_ptr<const CheckedProject> checked() const;  ///< null: none yet
  std::shared_ptr<const EyePicture> eye_picture() const;  ///< null: none yet
  void want_eye_size(int width_px, int height_px);
  /// "Focus here": at a place of the eye's picture, 0..1 from its top left corner. `view().focus_d` follows.
  void focus_at(glm::dvec2 at);
  /// A pixel of the images in `slices()` explained; the answer comes with a later update, null until then.
  void read_pixel(Side side, glm::ivec2 pixel);
  std::shared_ptr<const PixelReading> pixel_reading() const;
  bool compiling() const;
  /// Why the newest revision could not be compiled, if it could not.
  std::optional<Fault> compile_fault() const;
  /// Everything wrong with the project, what cannot be read of its files included.
  std::vector<Finding> findings() const;

  /// What the solver proposes for the present revision, until it is applied or discarded; null: nothing.
  std::shared_ptr<const SolveOffer> solve_offer() const;

  const RigLink& rig() const;
  const Log& log() const;
  const std::vector<Task>& tasks() const;
  void cancel_task(int id);

  /// The last thing to tell the person in passing, with when it was said; empty: nothing.
  const std::optional<LogLine>& notice() const;
  void dismiss_notice();

  /// What must be asked before going on ("unsaved edits"), if anything.
  const Question* question() const;
  void answer(std::size_t choice);

  // The start screen's.
  const std::vector<std::filesystem::path>& recent() const;
  const std::vector<Recovery>& left_behind() const;
  const std::vector<SampleCard>& sample_cards() const;
  /// Draws the pictures of the samples behind the window, one after the other, while nothing is open.
  void want_sample_pictures();

  const std::vector<std::string>& recent_rigs() const;

  bool palette_open() const;
  void close_palette();
  bool wants_to_quit() const;

  /// A path to be asked for; `run` its command ("file.open", "file.save-as", "file.import") with it, or forget it.
  FileWish file_wish() const;
  void forget_file_wish();

  // The loop ----------------------------------------------------------------------------------------------------------

  /// Takes what arrived from behind and starts what is needed next. True if anything a view shows has changed.
  bool update(double now_s);

  /// When `update` wants to be called again even if nothing happens; infinite: never.
  double next_update_s() const;

  /// The whole state as a value: what scripts and tests assert on.
  Value described() const;

 private:
  std::unique_ptr<State> state_;
  friend struct SessionAccess;  ///< commands reach the state through editor/session/session_access.h
};

}  // namespace focalstage
