#include <doctest/doctest.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "core/reference/reference.h"
#include "core/schedule/schedule.h"
#include "core/stage/stage.h"
#include "io/assets/assets.h"
#include "io/project/project_file.h"
#include "io/show/reader.h"
#include "io/show/writer.h"
#include "tests/exact/compare.h"
#include "tests/exact/forward_trace.h"
#include "tests/exact/room_of.h"
#include "tests/exact/sample_projects.h"

// The ready projects, each held against the reference, and its edges, read from a show file, against the light.

using namespace focalstage;
using namespace focalstage::exact;

namespace {

constexpr double tolerance_px = 0.05;

/// What `optimal` changes near depth edges is no longer one look a pixel: its linear images are held against light.
Opened linear(Opened sample) {
  Slices& slices = sample.project.slices;
  if (slices.assignment == Assignment::optimal) slices.assignment = Assignment::linear;
  return sample;
}

/// With its first projector alone: the reference and the light's edges know one. How several share their light is held
/// against rays in blend_test.
Opened alone(Opened sample) {
  sample.project.projectors.resize(1);
  return sample;
}

/// The variant whose edges are looked for: all objects carry a fine checker, nothing else is lit, every pixel is one
/// sample, codes make up for nothing.
Project checkered(Project project) {
  for (Object& object : project.objects)
    object.appearance = CheckerAppearance{{64, 64}, glm::dvec3(1.0), glm::dvec3(0.3)};
  for (Surface& surface : project.surfaces) surface.illumination = 0.0;
  for (Projector& projector : project.projectors) projector.color = ColorMode::gray;
  project.slices.compensation = {};
  for (Projector& projector : project.projectors) projector.transfer.clear();
  project.slices.samples_per_pixel = 1;
  return project;
}

/// Compiles one frame into a show file and opens that.
ShowReader show_of(const Opened& opened, int frame, const std::filesystem::path& file) {
  const CompileSettings settings = compile_settings(opened.project);
  const ScheduleResult schedule = make_schedule(opened.project, settings.images);
  const ShowHeader header = make_show_header(opened.project, project_text(opened.project), opened.loaded,
                                             schedule.schedule, settings, {frame, frame + 1});
  Result<CompiledFrame> compiled = Compiler(settings).frame(staged(opened.project, opened.loaded.assets, frame));
  REQUIRE(compiled);
  Result<ShowWriter> writer = ShowWriter::start(file, header, false, 0);
  REQUIRE(writer);
  REQUIRE(writer->add_frame(0, compiled->images, compiled->measure));
  REQUIRE(writer->finish());
  Result<ShowReader> show = ShowReader::open(file);
  REQUIRE(show);
  return *std::move(show);
}

/// A folder that goes when the test does.
struct Scratch {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("focalstage-edges-" + std::to_string(getpid()));
  Scratch() { std::filesystem::create_directories(folder); }
  ~Scratch() { std::filesystem::remove_all(folder); }
};

/// All pictures of a frame against the light; pictures side by side, `enough` for each.
forward::EdgeReport checked(const forward::Room& room, const FrameImages& images, const std::vector<ImageSpec>& specs,
                            std::uint64_t enough = ~std::uint64_t{0}) {
  std::vector<forward::EdgeReport> reports(specs.size());
  tbb::parallel_for(std::size_t{0}, specs.size(), [&](std::size_t i) {
    const int eye = specs[i].eye == ImageEye::left ? 0 : 1;
    reports[i] = forward::check_edges(room, {eye, static_cast<std::size_t>(specs[i].slice), images.image(i)},
                                      tolerance_px, enough);
  });
  forward::EdgeReport all;
  for (const forward::EdgeReport& report : reports) all += report;
  return all;
}

/// The first frame and, where things move, one in the middle.
std::vector<int> frames_to_look_at(const Project& project) {
  if (project.frames.count < 2) return {0};
  return {0, project.frames.count / 2};
}

struct Mutant {
  std::string name;
  std::function<void(Stage&, CompileSettings&)> change;
};

const Mutant mutants[] = {
    {"breathing off", [](Stage&, CompileSettings& settings) { settings.slices.breathing = Breathing::off; }},
    {"lens 1 mm farther", [](Stage&, CompileSettings& settings) { settings.lens_to_pupil_m += 0.001; }},
    {"eyes swapped", [](Stage& stage, CompileSettings&) { stage.interpupillary_m *= -1.0; }},
    {"half a pixel aside", [](Stage&, CompileSettings& settings) { settings.projector.centre_px.x += 0.5; }}};

}  // namespace

TEST_CASE("every sample: the engine shows what the reference shows") {
  Difference all;
  for (const std::filesystem::path& folder : projects()) {
    INFO(folder.filename().string());
    const Opened sample = alone(linear(opened(folder)));
    const CompileSettings settings = compile_settings(sample.project);
    Compiler compiler(settings);
    for (const int frame : frames_to_look_at(sample.project)) {
      const Stage stage = staged(sample.project, sample.loaded.assets, frame);
      const auto fast = compiler.frame(stage);
      const auto reference = compile_reference(stage, settings);
      REQUIRE(fast);
      REQUIRE(reference);
      const Difference here = difference(fast->images.codes, reference->images.codes);
      MESSAGE(folder.filename().string() << ", frame " << frame << ": " << here.off << " of " << here.bytes
                                         << " bytes off by more than one code");
      CHECK(here.off <= 10);
      all += here;
    }
  }
  CHECK(all.off * 1'000'000 <= all.bytes);
}

TEST_CASE("every sample: the edges in its show lie where the light falls, and mistakes are noticed") {
  const Scratch scratch;
  for (const std::filesystem::path& folder : projects()) {
    INFO(folder.filename().string());
    Opened variant = alone(linear(opened(folder)));
    variant.project = checkered(variant.project);
    std::map<std::string, std::uint64_t> noticed;
    for (const int frame : frames_to_look_at(variant.project)) {
      const ShowReader show = show_of(variant, frame, scratch.folder / (folder.filename().string() + ".h5"));
      // From here on the show is all there is.
      const Result<LoadedProject> within = parse_project(show.header().project_text, "show");
      REQUIRE(within);
      const Result<Assets> assets = assets_from(within->project, show.header().assets);
      REQUIRE(assets);
      const Stage stage = staged(within->project, *assets, show.header().first_frame);
      const CompileSettings settings = compile_settings(within->project);
      const forward::Room room = room_of(stage, settings);
      const Result<FrameImages> images = show.frame(0);
      REQUIRE(images);
      const forward::EdgeReport report = checked(room, *images, show.header().images);
      MESSAGE(folder.filename().string() << ", frame " << frame << ": " << report.edges << " edges, worst "
                                         << report.worst_px << " px, mean " << report.mean_px() << " px off");
      CHECK(report.edges > 1000);
      CHECK(report.contradicted == 0);

      for (const Mutant& mutant : mutants) {
        Stage changed_stage = stage;
        CompileSettings changed = settings;
        mutant.change(changed_stage, changed);
        const auto mistaken = Compiler(changed).frame(changed_stage);
        REQUIRE(mistaken);
        noticed[mutant.name] += checked(room, mistaken->images, settings.images, 20).contradicted;
      }
    }
    // Over all frames: where only the slice of no power is lit, a lens elsewhere changes nothing.
    for (const auto& [name, contradictions] : noticed) {
      INFO(name << ": " << contradictions << " contradictions");
      CHECK(contradictions >= 20);
    }
  }
}
