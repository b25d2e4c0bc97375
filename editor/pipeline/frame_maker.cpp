#include "editor/pipeline/frame_maker.h"

#include <utility>

#include "core/reference/reference.h"
#include "editor/pipeline/measure_needs.h"

namespace focalstage {

namespace {

std::vector<CompileSettings> settings_of_all(const Project& project) {
  std::vector<CompileSettings> all;
  for (std::size_t i = 0; i < project.projectors.size(); ++i) all.push_back(compile_settings(project, i));
  return all;
}

}  // namespace

FrameMaker::FrameMaker(const Project& project, const Assets& assets, EngineChoice choice)
    : project_(project),
      assets_(assets),
      choice_(choice),
      settings_(settings_of_all(project)),
      meter_(projectors_of(settings_.at(0)), settings_[0].lens_to_pupil_m, project.glasses.lens_aperture_mm / 1000.0),
      made_(settings_.size()) {
  for (const CompileSettings& settings : settings_) compilers_.emplace_back(settings, choice.threads, choice.vectors);
}

Status FrameMaker::stand_up(int frame) {
  auto staged = stage(project_, assets_, frame / project_.frames.rate_hz);
  if (!staged) return staged.fault();
  if (stage_ && same_room(*stage_, *staged)) return {};
  coverage_ = {};  // waits for one that still looks at the stage
  for (std::optional<Made>& made : made_) made.reset();
  stage_ = std::move(*staged);
  const auto how = choice_.threads == 1 ? std::launch::deferred : std::launch::async;
  coverage_ = std::async(how, [this] { return meter_.measure(*stage_); }).share();
  return {};
}

const std::vector<ObjectCoverage>& FrameMaker::coverage() { return coverage_.get(); }

Result<FrameMaker::Made> FrameMaker::compile(std::stop_token stop, std::size_t projector) {
  std::optional<Made>& made = made_.at(projector);
  if (made) return *made;
  auto compiled = choice_.reference ? compile_reference(*stage_, settings_[projector], choice_.threads)
                                    : compilers_[projector].frame(*stage_, std::move(stop), pool_.take());
  if (!compiled) return compiled.fault();
  made = Made{pool_.share(std::move(compiled->images)), std::move(compiled->measure)};
  return *made;
}

}  // namespace focalstage
