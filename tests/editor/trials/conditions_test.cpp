#include "editor/trials/conditions.h"

#include <doctest/doctest.h>

#include "core/compile/frame.h"
#include "editor/trials/example_study.h"
#include "io/project/project_file.h"
#include "io/show/reader.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

const std::filesystem::path projects = FOCALSTAGE_SOURCE_DIR "/projects";

std::vector<double> content_powers(const ShowHeader& header) {
  std::vector<double> powers;
  for (const ImageSpec& image : header.images) {
    if (image.eye == ImageEye::left) powers.push_back(image.power_d);
  }
  return powers;
}

}  // namespace

TEST_CASE("the example is a study, and both its conditions are shows that a rig takes") {
  const Study study = example_study();
  CHECK(check(study));
  const TemporaryFolder folder;
  const auto conditions = make_conditions(study, projects, folder.path(), std::nullopt, [](int, int) {}, {});
  REQUIRE(conditions);
  REQUIRE(conditions->size() == 2);
  const auto multifocal = ShowReader::open((*conditions)[0].show);
  const auto conventional = ShowReader::open((*conditions)[1].show);
  REQUIRE(multifocal);
  REQUIRE(conventional);
  // The sample as it is; and one slice at 0 D, which the light for the pointer shares.
  const auto source = load_project(projects / "depth-matching");
  CHECK(multifocal->header().project_text == source->text);
  for (const double power_d : content_powers(conventional->header())) CHECK(power_d == 0.0);
  CHECK(content_powers(multifocal->header()).size() > content_powers(conventional->header()).size());
  CHECK(conventional->header().schedule.lens_power_d == multifocal->header().schedule.lens_power_d);
  for (const ReadyCondition& condition : *conditions) {
    CHECK(condition.interpupillary_mm == 63.0);
    for (int t = 0; t < 5; ++t) CHECK(condition.targets[static_cast<std::size_t>(t)].frame == t);
  }
}

TEST_CASE("the conventional variant changes focus and nothing that two eyes see") {
  const auto source = load_project(projects / "depth-matching");
  REQUIRE(source);
  CHECK(variant_edits(source->project, ConditionVariant::multifocal).empty());
  const auto changed = apply_all(source->project, variant_edits(source->project, ConditionVariant::conventional));
  REQUIRE(changed);
  CHECK(changed->slices.powers_d == std::vector<double>{0.0});
  Project back = *changed;
  back.slices = source->project.slices;
  for (std::size_t k = 0; k < back.objects.size(); ++k) {
    CHECK(back.objects[k].depth.mode == DepthMode::slice);
    back.objects[k].depth = source->project.objects[k].depth;
  }
  CHECK(back == source->project);
}

TEST_CASE("frames in place of cues, another distance between the eyes, and what cannot be") {
  Study study = example_study();
  for (int t = 0; t < 5; ++t) {
    study.targets[static_cast<std::size_t>(t)].cue.clear();
    study.targets[static_cast<std::size_t>(t)].frame = t;
  }
  const TemporaryFolder folder;
  const auto narrow = make_conditions(study, projects, folder.path(), 58.0, [](int, int) {}, {});
  REQUIRE(narrow);
  CHECK((*narrow)[0].interpupillary_mm == 58.0);
  CHECK((*narrow)[0].targets[1] == ShownTarget{"364 mm", 1});
  const std::string sha256 = (*narrow)[0].sha256;
  const auto wide = make_conditions(study, projects, folder.path(), 70.0, [](int, int) {}, {});
  REQUIRE(wide);
  CHECK((*wide)[0].sha256 != sha256);

  // As a show, it is what it is.
  study.conditions[0] = {"ready", "", (*wide)[0].show.string(), ConditionVariant::multifocal};
  CHECK(make_conditions(study, projects, folder / "more", std::nullopt, [](int, int) {}, {}));
  CHECK(make_conditions(study, projects, folder / "more", 58.0, [](int, int) {}, {}).fault().code == "study.condition");
  study.targets[0].frame = 5;
  CHECK(make_conditions(study, projects, folder / "more", std::nullopt, [](int, int) {}, {}).fault().code ==
        "study.target");
  study = example_study();
  study.conditions[0].project = "nowhere";
  CHECK(make_conditions(study, projects, folder / "more", std::nullopt, [](int, int) {}, {}).fault().code ==
        "file.missing");
}

TEST_CASE("a frame without a cue gets one in a project") {
  auto source = load_project(projects / "depth-matching");
  REQUIRE(source);
  source->project.cues.resize(2);
  Study study = example_study();
  study.targets[1].cue.clear();
  study.targets[1].frame = 1;
  study.targets[4].cue.clear();
  study.targets[4].frame = 4;
  const auto edits = cue_edits(source->project, study);
  REQUIRE(edits.size() == 1);
  const auto changed = apply_all(source->project, edits);
  REQUIRE(changed);
  CHECK(changed->cues.back().name == "frame 4");
  CHECK(changed->cues.back().time_s == 4.0);
}
