#include "editor/pipeline/frame_maker.h"

#include <utility>

#include "core/reference/reference.h"
#include "editor/pipeline/measure_needs.h"

namespace focalstage {

FrameMaker::FrameMaker(const Project& project, const Assets& assets, EngineChoice choice)
    : project_(project),
      assets_(assets),
      choice_(choice),
      settings_(compile_settings(project)),
      compiler_(settings_, choice.threads, choice.vectors),
      meter_(settings_.projector, settings_.lens_to_pupil_m, project.glasses.lens_aperture_mm / 1000.0) {}

Status FrameMaker::stand_up(int frame) {
  auto staged = stage(project_, assets_, frame / project_.frames.rate_hz);
  if (!staged) return staged.fault();
  if (stage_ && same_room(*stage_, *staged)) return {};
  coverage_ = {};  // waits for one that still looks at the stage
  made_.reset();
  stage_ = std::move(*staged);
  const auto how = choice_.threads == 1 ? std::launch::deferred : std::launch::async;
  coverage_ = std::async(how, [this] { return meter_.measure(*stage_); }).share();
  return {};
}

const std::vector<ObjectCoverage>& FrameMaker::coverage() { return coverage_.get(); }

Result<FrameMaker::Made> FrameMaker::compile(std::stop_token stop) {
  if (made_) return *made_;
  auto compiled = choice_.reference ? compile_reference(*stage_, settings_, choice_.threads)
                                    : compiler_.frame(*stage_, std::move(stop), pool_.take());
  if (!compiled) return compiled.fault();
  made_ = Made{pool_.share(std::move(compiled->images)), std::move(compiled->measure)};
  return *made_;
}

}  // namespace focalstage
