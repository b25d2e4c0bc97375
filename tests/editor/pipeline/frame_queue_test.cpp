#include "editor/pipeline/frame_queue.h"

#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>

#include "core/stage/stage.h"
#include "editor/pipeline/compile_show.h"
#include "io/project/project_file.h"
#include "io/show/reader.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

Source small_source(int frames) {
  Source source;
  Project& project = source.project;
  project.name = "Queue";
  project.projectors.push_back({});
  Projector& projector = project.projectors.front();
  projector.name = "main";
  projector.width_px = 32;
  projector.height_px = 24;
  projector.fx_px = projector.fy_px = 30;
  projector.cx_px = 16;
  projector.cy_px = 12;
  project.slices.powers_d = {-0.5, 0.0, 0.5};
  project.frames.count = frames;
  Surface screen;
  screen.name = "screen";
  screen.mesh.shape = PlaneMesh{{1.0, 1.0}};
  screen.placement.pose.position_m = {0.0, 0.0, -0.515};
  screen.illumination = 0.5;
  project.surfaces.push_back(screen);
  source.text = project_text(project);
  return source;
}

CompileJob job_for(const TemporaryFolder& folder, int threads) {
  CompileJob job;
  job.show = folder.path() / "show.h5";
  job.engine.threads = threads;
  return job;
}

}  // namespace

TEST_CASE("every frame arrives, whichever thread writes it") {
  for (const int threads : {1, 2}) {
    CAPTURE(threads);
    const TemporaryFolder folder;
    int told = 0;
    const auto report =
        compile_show(small_source(9), job_for(folder, threads), [&](int done, int) { told = done; }, {});
    REQUIRE(report.ok());
    CHECK(told == 9);
    CHECK(report->frames == 9);
    CHECK(report->resumed == 0);
    const auto show = ShowReader::open(folder.path() / "show.h5");
    REQUIRE(show.ok());
    CHECK(show->header().frames == 9);
  }
}

TEST_CASE("a stop leaves what is finished, and a resume takes it over") {
  const TemporaryFolder folder;
  CompileJob job = job_for(folder, 1);
  std::stop_source stop;
  const auto stopped = compile_show(
      small_source(9), job,
      [&](int done, int) {
        if (done == 4) stop.request_stop();
      },
      stop.get_token());
  REQUIRE(!stopped.ok());
  CHECK(stopped.fault().code == "compile.cancelled");
  CHECK(!std::filesystem::exists(job.show));
  job.resume = true;
  const auto resumed = compile_show(small_source(9), job, [](int, int) {}, {});
  REQUIRE(resumed.ok());
  CHECK(resumed->resumed == 4);
}

TEST_CASE("frames outside the project are refused") {
  const TemporaryFolder folder;
  CompileJob job = job_for(folder, 1);
  for (const FrameRange range : {FrameRange{0, 10}, FrameRange{-1, 2}, FrameRange{3, 3}, FrameRange{5, 4}}) {
    job.frames = range;
    const auto report = compile_show(small_source(9), job, [](int, int) {}, {});
    REQUIRE(!report.ok());
    CHECK(report.fault().code == "frames.range");
  }
  Source empty = small_source(1);
  empty.project.projectors.clear();
  const auto report = compile_show(empty, job_for(folder, 1), [](int, int) {}, {});
  REQUIRE(!report.ok());
  CHECK(report.fault().code == "project.no-projector");
}

TEST_CASE("a writer that fails ends the queue, and is not waited for") {
  const TemporaryFolder folder;
  const Source source = small_source(9);
  FrameMaker maker(source.project, source.loaded.assets, {1, false, VectorPath::best});
  const ScheduleResult schedule = make_schedule(source.project, maker.settings().images);
  const ShowHeader header =
      make_show_header(source.project, source.text, source.loaded, schedule.schedule, maker.settings(), {0, 9});
  auto writer = ShowWriter::start(folder.path() / "show.h5", header, false, 1);
  REQUIRE(writer.ok());
  FrameQueue queue(*writer);
  FrameImages wrong;  // no image at all: the writer refuses it
  const auto images = std::make_shared<const FrameImages>(wrong);
  Status status;
  for (int k = 0; k < 9 && status; ++k) status = queue.add(k, images, {});
  if (status) status = queue.drain();
  CHECK(!status);
  CHECK(!queue.add(0, images, {}));
}
