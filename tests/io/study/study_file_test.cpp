#include "io/study/study_file.h"

#include <doctest/doctest.h>

#include "io/files/files.h"
#include "tests/core/study/a_study.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

TEST_CASE("a study reads back as it was written, with its optional keys or without") {
  Study study = paper_study();
  study.missing = MissingRule::complete_participants;
  study.targets[1].cue.clear();
  study.targets[1].frame = 3;
  study.conditions[1] = {"ready", "", "ready.h5", ConditionVariant::multifocal};
  const auto read = parse_study(study_text(study), "s.json");
  REQUIRE(read);
  CHECK(*read == study);

  const auto least = parse_study(R"({"focalstage_study":1,"name":"n","seed":0,"participants":["a"],
    "conditions":[{"name":"x","project":"p"},{"name":"y","project":"p","variant":"conventional"}],
    "targets":[{"name":"t","cue":"c","actual_m":0.3},{"name":"u","frame":1,"actual_m":0.4}],
    "repetitions":1,"pointer":{"from_m":0,"to_m":1}})",
                                 "s.json");
  REQUIRE(least);
  CHECK(least->training_trials == 1);
  CHECK(least->pointer.step_m == 0.001);
  CHECK(least->missing == MissingRule::answered_repetitions);
  CHECK(least->conditions[0].variant == ConditionVariant::multifocal);
}

TEST_CASE("faults name file, place and code") {
  const std::string good = study_text(paper_study());
  const auto fault_with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    const auto read = parse_study(text.replace(at, from.size(), to), "s.json");
    REQUIRE_FALSE(read);
    return read.fault();
  };
  CHECK(fault_with("\"repetitions\": 4", "\"repetitions\": 0").where == "s.json: /repetitions");
  CHECK(fault_with("\"repetitions\": 4", "\"repetitions\": \"4\"").code == "study.schema");
  CHECK(fault_with("\"seed\"", "\"sed\": 1, \"seed\"").message.find("sed") != std::string::npos);
  CHECK(fault_with("0.364", "NaN").code == "json.syntax");
  CHECK(fault_with("0.364", "1e999").code == "json.number");
  CHECK(fault_with("0.364", "0.9").where == "s.json: /targets/1/actual_m");
  CHECK(fault_with("\"focalstage_study\": 1", "\"focalstage_study\": 2").remedy.find("study.schema.json") !=
        std::string::npos);
}

TEST_CASE("the fingerprint is that of all but the participants") {
  Study study = paper_study();
  const std::string before = study_fingerprint(study);
  CHECK(before.size() == 16);
  study.participants.push_back("late");
  CHECK(study_fingerprint(study) == before);
  study.seed = 8;
  CHECK(study_fingerprint(study) != before);
}

TEST_CASE("a study is found in its folder") {
  const TemporaryFolder folder;
  CHECK(load_study(folder.path()).fault().code == "file.missing");
  REQUIRE(write_file_atomically(folder / "study.json", study_text(paper_study())));
  const auto loaded = load_study(folder.path());
  REQUIRE(loaded);
  CHECK(loaded->file == folder / "study.json");
  CHECK(load_study(folder / "study.json"));
}
