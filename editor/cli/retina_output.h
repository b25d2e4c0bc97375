#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/retina/retina.h"
#include "core/scene/value.h"
#include "editor/pipeline/retina_report.h"

namespace focalstage {

/// What a run of `focalstage retina` was asked for, as far as its words repeat it.
struct RetinaRun {
  std::string show;
  std::string picture;
  int frame = 0;
  double focus_m = 0.5;
  double pupil_mm = 4.0;
};

/// The object that `--json` prints; docs/retina.md names its members.
Value retina_value(const RetinaRun& run, const RetinaView& view, std::span<const RetinaInput> inputs,
                   const RetinaReport& report);

/// The same for people: a line, and a table of the things that are seen.
std::string retina_text(const RetinaRun& run, const RetinaView& view, std::span<const RetinaInput> inputs,
                        const RetinaReport& report);

/// 3 where red, green and blue may differ: in a show of three channels, an eye with colours of its own, or a picture in
/// which they do differ (painted surfaces).
int channels_of(std::span<const RetinaInput> inputs, const RetinaView& view, const RetinaImage& image);

/// Linear light for a 16-bit picture, 65535 = full code; one channel of a gray picture.
std::vector<std::uint16_t> levels_of(const RetinaImage& image, int channels);

/// 8-bit RGB by `conflict_colour`; black where nothing is lit.
std::vector<std::uint8_t> conflict_colours(const std::vector<float>& conflict_d);

}  // namespace focalstage
