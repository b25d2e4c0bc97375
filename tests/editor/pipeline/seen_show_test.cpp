#include "editor/pipeline/seen_show.h"

#include <doctest/doctest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/compile/compile.h"
#include "core/reference/seen.h"
#include "core/retina/retinas.h"
#include "core/schedule/schedule.h"
#include "editor/pipeline/compile_show.h"
#include "editor/pipeline/source.h"
#include "io/project/project_file.h"
#include "io/show/writer.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

/// A lit screen that moves away, 1 m in a second: frame 30 of 60 stands half a metre farther.
Project moving_screen() {
  Project project;
  project.name = "Seen";
  project.projectors.push_back({});
  Projector& projector = project.projectors.front();
  projector.name = "main";
  projector.width_px = 64;
  projector.height_px = 48;
  projector.fx_px = projector.fy_px = 60;
  projector.cx_px = 32;
  projector.cy_px = 24;
  project.slices.powers_d = {-0.5, 0.5};
  project.frames.count = 60;
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{1.0, 1.0}};
  screen.placement.keys = {{0.0, {{0.0, 0.0, -0.5}, {1, 0, 0, 0}}}, {1.0, {{0.0, 0.0, -1.5}, {1, 0, 0, 0}}}};
  screen.placement.pose = screen.placement.keys.front().pose;
  screen.illumination = 1.0;
  project.surfaces.push_back(screen);
  return project;
}

/// Frames 30 and 31 as a show, the images all at full code; `spoil` may change what the header says.
template <class Spoil>
Result<ShowReader> show_of(const TemporaryFolder& folder, Spoil&& spoil) {
  const Project project = moving_screen();
  const CompileSettings settings = compile_settings(project);
  const ScheduleResult schedule = make_schedule(project, settings.images);
  ShowHeader header =
      make_show_header(project, project_text(project), LoadedAssets{}, schedule.schedule, settings, {30, 32});
  spoil(header);
  auto writer = ShowWriter::start(folder.path() / "show.h5", header, false, 1);
  if (!writer) return writer.fault();
  FrameImages images;
  images.count = settings.images.size();
  images.width_px = 64;
  images.height_px = 48;
  images.codes.assign(images.count * images.bytes_per_image(), 255);
  for (int frame = 0; frame < 2; ++frame) {
    if (Status added = writer->add_frame(frame, images); !added) return added.fault();
  }
  if (Status done = writer->finish(); !done) return done.fault();
  return ShowReader::open(folder.path() / "show.h5");
}

}  // namespace

TEST_CASE("an eye gets its own exposures, at the lens' power, and the light that both get") {
  const TemporaryFolder folder;
  const auto show = show_of(folder, [](ShowHeader&) {});
  REQUIRE(show);
  for (const Side side : both_sides) {
    const auto seen = SeenShow::of(*show, "show.h5", 0, side);
    REQUIRE(seen);
    const RetinaInput input = seen->inputs().at(0);
    std::vector<double> powers_d;
    for (const RetinaExposure& exposure : input.exposures) {
      double share = 0.0, power_d = 0.0;
      for (const PowerShare& part : exposure.powers) {
        share += part.share;
        power_d += part.share * part.power_d;
      }
      CHECK(share == doctest::Approx(1.0));  // open throughout
      powers_d.push_back(power_d);
    }
    std::sort(powers_d.begin(), powers_d.end());
    REQUIRE(powers_d.size() == 3);
    CHECK(powers_d[0] == doctest::Approx(-0.5).epsilon(0.005));  // the mean of a bent curve
    CHECK(std::abs(powers_d[1]) < 1e-9);                         // the light image
    CHECK(powers_d[2] == doctest::Approx(0.5).epsilon(0.005));
    CHECK(input.projector.width_px == 64);
    CHECK(input.lens_aperture_m == doctest::Approx(0.016));
    const auto image = Retina(1).view(input, {});
    REQUIRE(image);
    CHECK(image->rgb[3 * (150 * 400 + 200)] == doctest::Approx(3.0));
  }
}

TEST_CASE("things stand where they stood in that frame") {
  const TemporaryFolder folder;
  const auto show = show_of(folder, [](ShowHeader&) {});
  REQUIRE(show);
  const auto seen = SeenShow::of(*show, "show.h5", 0, Side::left);
  REQUIRE(seen);
  const Stage& stage = *seen->inputs().at(0).stage;
  CHECK(stage.surfaces[0].drawables[0].world_from_mesh[3].z == doctest::Approx(-1.0));
  const auto later = SeenShow::of(*show, "show.h5", 1, Side::left);
  CHECK(later->inputs().at(0).stage->surfaces[0].drawables[0].world_from_mesh[3].z ==
        doctest::Approx(-1.0 - 1.0 / 60.0));
}

TEST_CASE("poses that a tracker gave the show count, not the project's") {
  const TemporaryFolder folder;
  const auto show = show_of(folder, [](ShowHeader& header) {
    // A quarter turn about Y: what faced +Z faces +X.
    header.poses[0].surfaces[0] = {0.25, 0.0, -2.0, 0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
    header.poses[0].viewer = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  });
  REQUIRE(show);
  const auto seen = SeenShow::of(*show, "show.h5", 0, Side::left);
  REQUIRE(seen);
  const Stage& stage = *seen->inputs().at(0).stage;
  const glm::dmat4& placed = stage.surfaces[0].drawables[0].world_from_mesh;
  CHECK(placed[3].x == doctest::Approx(0.25));
  CHECK(placed[3].z == doctest::Approx(-2.0));
  CHECK(placed[2].x == doctest::Approx(1.0));
  CHECK(stage.world_from_viewer.position_m.y == 1.0);
}

TEST_CASE("an eye sees the light of both projectors: even, as bright as asked, fast and by rays") {
  const TemporaryFolder folder;
  auto source = open_project(FOCALSTAGE_SOURCE_DIR "/projects/two-projectors");
  REQUIRE(source);
  source->project.objects.resize(1);  // the sheet, without the ball
  source->text = project_text(source->project);
  CompileJob job;
  job.show = folder / "two.h5";
  const auto compiled = compile_show(*source, job, [](int, int) {}, {});
  REQUIRE(compiled);
  CHECK(compiled->findings.empty());
  CHECK(compiled->projectors == 2);
  CHECK(compiled->images == 16);
  const auto show = ShowReader::open(job.show);
  REQUIRE(show);
  const auto seen = SeenShow::of(*show, "two.h5", 0, Side::left);
  REQUIRE(seen);
  const std::vector<RetinaInput> inputs = seen->inputs();
  REQUIRE(inputs.size() == 2);
  CHECK(inputs[0].level == 1.0);
  CHECK(inputs[1].level == doctest::Approx(1.25));
  RetinaView view;
  view.width_px = 120;
  view.height_px = 30;
  view.fov_deg = 28.0;  // inside the sheet
  view.gaze = {0.025, 0.0};
  view.focus_d = 0.81;
  Retinas retinas;
  const auto both = retinas.view(inputs, view);
  REQUIRE(both);
  RetinaImage rays{view.width_px, view.height_px, std::vector<float>(both->rgb.size(), 0.0f)};
  for (const RetinaInput& input : inputs) {
    const auto more = see_by_rays(input, view, {32});
    REQUIRE(more);
    add_light(*more, rays);
  }
  for (const RetinaImage* picture : std::array<const RetinaImage*, 2>{&*both, &rays}) {
    const auto [least, most] = std::minmax_element(picture->rgb.begin(), picture->rgb.end());
    CHECK(*least == doctest::Approx(0.44).epsilon(0.03));
    CHECK(*most == doctest::Approx(0.44).epsilon(0.03));
  }
  // One of them alone leaves the other's share dark.
  const auto one = retinas.view({inputs.data(), 1}, view);
  REQUIRE(one);
  CHECK(*std::min_element(one->rgb.begin(), one->rgb.end()) < 0.1f);
}
