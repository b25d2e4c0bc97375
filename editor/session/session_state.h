#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/document/recent.h"
#include "editor/preview/pixel_reader.h"
#include "editor/preview/preview.h"
#include "editor/rig/rig_link.h"
#include "editor/session/jobs.h"
#include "editor/session/sample_cards.h"
#include "editor/session/session.h"

namespace focalstage {

/// A question and what each answer does.
struct Asked {
  Question question;
  std::vector<std::function<void()>> answers;  ///< the last choice, Cancel, needs none
};

/// What the person was told of the rig last.
struct RigTold {
  RigStatus::Phase phase = RigStatus::Phase::none;
  std::string fault;
  std::string latched;
  std::string pushed;
};

/// What is behind a Session, for the files of this room that carry out commands.
struct Session::State {
  explicit State(std::function<void()> wake_up, UserFolders user_folders);

  std::atomic<bool> news{false};  ///< something arrived from behind since the last update
  std::function<void()> wake;     ///< from any thread
  UserFolders folders;

  std::optional<Document> document;
  std::uint64_t revision_base = 0;  ///< grows with every document, so that revisions are never twice the same
  Project nothing;

  Selection selection;
  ViewState view;
  Value clipboard;                         ///< things as add edits carry them
  std::filesystem::path clipboard_folder;  ///< of the project they come from
  std::vector<std::filesystem::path> recent;
  std::vector<Recovery> left_behind;
  std::vector<std::string> recent_rigs;
  std::vector<SampleCard> sample_cards;
  std::size_t samples_drawn = 0;
  bool drawing_samples = false;

  bool dragging = false;
  bool drag_has_step = false;

  std::shared_ptr<const Stage> stage;
  std::uint64_t staged_revision = 0;
  int staged_frame = -1;
  std::shared_ptr<const SeenRig> off_rig;  ///< made of these two
  std::shared_ptr<const Stage> off_rig_stage;
  ErrorAmounts off_rig_errors;
  std::shared_ptr<const ProjectorModels> models;  ///< known to the open project
  std::vector<Finding> asset_findings;
  bool reading = false;               ///< files of the project, behind the window
  std::vector<Finding> rig_findings;  ///< where the project is not made for the rig that is there
  std::uint64_t rig_checked_revision = 0;
  RigDescription rig_checked;
  std::string rig_fault_said;

  std::shared_ptr<const SolveOffer> solve_offer;  ///< of any revision

  glm::ivec2 eye_size_px{400, 300};
  std::optional<FocusQuestion> focus_question;
  int focus_answered = 0;

  std::optional<Asked> asked;
  Log log;
  std::optional<LogLine> notice;
  bool quitting = false;
  bool palette_open = false;
  FileWish file_wish = FileWish::none;
  std::string import_look_of;        ///< the object on which the picture to be asked for is laid
  Thing import_replaces;             ///< whose mesh the file to be asked for becomes; no name: a new object
  std::function<void()> after_save;  ///< what waits for an untitled project to get its place

  RigTold rig_told;

  double now_s = 0.0;
  double synced_at_s = 0.0;
  double looked_outside_at_s = 0.0;
  double frame_since_s = 0.0;  ///< of the timeline's play

  Preview preview;
  PixelReader reader;
  RigLink rig;
  Jobs jobs;  ///< last: its threads end first

  const Project& project() const { return document ? document->project() : nothing; }
  std::uint64_t revision() const { return revision_base + (document ? document->history().revision() : 0); }
  double frame_time_s() const { return view.frame / project().frames.rate_hz; }

  void say(LogLine::Kind kind, std::string text);
  Status apply(std::string words, std::vector<Edit> edits, Joining joining = Joining::own_step);

  /// Makes `opened` the document in view.
  void take(Document opened);
  /// Runs `next` at once, or after asking what to do with unsaved edits.
  void leave_then(std::function<void()> next);
  void close_document();

  /// Drops what is selected but is no more.
  void tidy();
  /// Of the folder in view. What cannot be read is told, and the program's own models serve.
  void read_models();
  void read_files(const std::vector<AssetReference>& wanted);
  void restage();
  void fit_views();
  void wish_preview();
  /// The rig of the view's errors; null without any, and where it cannot stand.
  std::shared_ptr<const SeenRig> seen_rig();
  /// The picture of the next sample that has none yet.
  void draw_next_sample();
};

struct SessionAccess {
  static Session::State& of(Session& session) { return *session.state_; }
  static const Session::State& of(const Session& session) { return *session.state_; }
};

}  // namespace focalstage
