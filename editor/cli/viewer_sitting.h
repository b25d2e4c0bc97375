#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "core/study/equality.h"
#include "editor/cli/viewer_actions.h"
#include "editor/pipeline/source.h"
#include "editor/trials/trial_rig.h"
#include "editor/viewer/two_choice.h"
#include "io/project/project_file.h"

namespace focalstage {

/// Somebody at the rig for a test of the viewer: the project, the rig, and a folder for shows that nobody needs
/// afterwards.
class ViewerSitting {
 public:
  static Result<std::unique_ptr<ViewerSitting>> begin(const ViewerOptions& options, std::stop_token stop);
  ~ViewerSitting();
  ViewerSitting(const ViewerSitting&) = delete;
  ViewerSitting& operator=(const ViewerSitting&) = delete;

  const LoadedProject& loaded() const { return loaded_; }
  const Source& source() const { return source_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::stop_token& stop() const { return stop_; }
  Side eye() const { return options_.eye == "right" ? Side::right : Side::left; }

  /// Makes something slow while a bar is drawn.
  template <class Make>
  auto make(const std::string& title, const Make& make_it) const {
    const auto bar = bar_of(title);
    return make_it([&](int done, int of) { bar(done, of); });
  }

  /// What a person is told, and with which keys they answer.
  struct Guide {
    std::string text;
    ChoiceKeys keys{};
  };

  /// Asks a person, or the simulated eye if there is one; answers to the test are kept under the name of `--answers`
  /// with `suffix`. Fault "viewer.given-up".
  Result<EqualityEstimate> ask(const TwoChoiceTest& test, const Guide& guide, const SeenDifference& simulated,
                               const std::string& suffix = {});

  /// Saves `edit` unless told not to.
  Status save(const Edit& edit) const;

 private:
  ViewerSitting(const ViewerOptions& options, LoadedProject loaded, Source source, std::filesystem::path folder,
                std::stop_token stop);
  FrameProgress bar_of(const std::string& title) const;
  Status connect();

  const ViewerOptions& options_;
  LoadedProject loaded_;
  Source source_;
  std::filesystem::path folder_;
  std::stop_token stop_;
  std::optional<ProtocolTrialRig> rig_;
};

/// "left" or "right".
const char* eye_word(Side eye);
inline Side other_eye(Side eye) { return eye == Side::left ? Side::right : Side::left; }

/// "scripted" or "human".
const char* observer_kind(const ViewerOptions& options);

/// Fault "viewer.outside" where answers close in on no value from `range`, "viewer.uncertain" where the value is less
/// certain than `--limit-mm`, unless that is to be taken.
Status check_found(const ViewerOptions& options, const std::string& what, bool inside, double value_mm,
                   double uncertainty_mm, const std::string& range);

/// Runs an action of `focalstage calibrate viewer` and says why it failed.
ExitStatus run_sitting(const ViewerOptions& options,
                       const std::function<Result<ExitStatus>(ViewerSitting& sitting)>& action);

}  // namespace focalstage
