#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "core/base/number_words.h"
#include "core/calibrate/align.h"
#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/pair_file.h"

namespace focalstage {
namespace {

struct Options {
  std::string pairs;
  double limit_mm = 2.0;
  bool force = false;
  bool json = false;
};

Fault too_far_off(const Options& options, const std::vector<PointPair>& pairs, const Alignment& alignment) {
  return {"align.limit", options.pairs,
          "the pairs agree to " + fixed_text(alignment.rms_mm, 2) + " mm (root mean square), more than " +
              fixed_text(options.limit_mm, 2) + " mm; pair " + pair_label(pairs, alignment.worst) + " is off by " +
              fixed_text(alignment.worst_mm, 2) + " mm",
          "measure anew, or take it all the same with --force"};
}

Value optional_value(const std::optional<double>& number) { return number ? Value(*number) : Value(); }

void print_values(const std::vector<PointPair>& pairs, const Alignment& alignment) {
  Value::Array rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairResidual& residual = alignment.residuals[i];
    rows.push_back(Value::Object{{"name", pairs[i].name},
                                 {"residual_mm", residual.distance_mm},
                                 {"left_out_mm", optional_value(residual.left_out_mm)}});
  }
  const glm::dvec3& at = alignment.world_from_tracker.position_m;
  const glm::dquat& turn = alignment.world_from_tracker.rotation;
  print_json(Value::Object{
      {"world_from_tracker", Value::Object{{"position_m", Value::Array{at.x, at.y, at.z}},
                                           {"rotation_xyzw", Value::Array{turn.x, turn.y, turn.z, turn.w}}}},
      {"rms_mm", alignment.rms_mm},
      {"worst_mm", alignment.worst_mm},
      {"worst_pair", static_cast<double>(alignment.worst + 1)},
      {"left_out_rms_mm", optional_value(alignment.left_out_rms_mm)},
      {"pairs", std::move(rows)},
  });
}

void print_words(const std::vector<PointPair>& pairs, const Alignment& alignment) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairResidual& residual = alignment.residuals[i];
    rows.push_back({std::to_string(i + 1), pairs[i].name, fixed_text(residual.distance_mm, 2),
                    residual.left_out_mm ? fixed_text(*residual.left_out_mm, 2) : "-"});
  }
  std::fputs(table_text({{"pair", true}, {"name"}, {"off by mm", true}, {"left out mm", true}}, rows).c_str(), stdout);
  std::printf("root mean square %s mm, worst %s mm (pair %s)", fixed_text(alignment.rms_mm, 2).c_str(),
              fixed_text(alignment.worst_mm, 2).c_str(), pair_label(pairs, alignment.worst).c_str());
  if (alignment.left_out_rms_mm) {
    std::printf("; a new point may be off by %s mm", fixed_text(*alignment.left_out_rms_mm, 2).c_str());
  }
  const glm::dvec3& at = alignment.world_from_tracker.position_m;
  const glm::dquat& turn = alignment.world_from_tracker.rotation;
  std::printf("\nfocalstage-runtime --tracker-pose %.6f %.6f %.6f %.8f %.8f %.8f %.8f\n", at.x, at.y, at.z, turn.x,
              turn.y, turn.z, turn.w);
}

ExitStatus run(const Options& options) {
  const auto pairs = read_pairs(options.pairs);
  if (!pairs) return report(pairs.fault());
  const auto alignment = align(*pairs);
  if (!alignment) {
    Fault fault = alignment.fault();
    fault.where = options.pairs + ": " + fault.where;
    return report(fault);
  }
  if (alignment->rms_mm > options.limit_mm && !options.force) return report(too_far_off(options, *pairs, *alignment));
  if (options.json) {
    print_values(*pairs, *alignment);
  } else {
    print_words(*pairs, *alignment);
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_track_align(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("pairs", options->pairs, "CSV: name, tracker's x y z, world's x y z in metres")
      ->required()
      ->type_name("PAIRS.csv");
  app.add_option("--limit-mm", options->limit_mm, "refuse where the pairs agree worse than so")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--force", options->force, "take it all the same");
  app.add_flag("--json", options->json, "one JSON object instead of words");
  app.footer("docs/trackers.md says how pairs are measured and what is refused.");
  return [options] { return run(*options); };
}

}  // namespace focalstage
