#include "io/study/report.h"
#include "io/study/report_words.h"

namespace focalstage {
namespace {

Value value_of(const std::optional<FTest>& test) {
  if (!test) return Value();
  Value value;
  value.set("f", test->f);
  value.set("df1", test->df1);
  value.set("df2", test->df2);
  value.set("p", test->p);
  value.set("sum_of_squares_m2", test->ss);
  return value;
}

Value value_of(const Study& study, const ErrorSummary& summary) {
  Value value;
  value.set("condition", condition_name(study, summary.condition));
  if (summary.target >= 0) value.set("target", target_name(study, summary.target));
  value.set("means", summary.error.count);
  value.set("estimated_m", summary.estimated.mean_m);
  value.set("estimated_sd_m", summary.estimated.deviation_m);
  value.set("error_m", summary.error.mean_m);
  value.set("error_sd_m", summary.error.deviation_m);
  return value;
}

Value value_of(const Tally& tally) {
  Value value;
  value.set("participant", tally.participant);
  value.set("kind", tally.kind);
  value.set("answered", tally.answered);
  value.set("given_up", tally.given_up);
  value.set("spoiled", tally.spoiled);
  value.set("finished", tally.finished());
  return value;
}

Value regression_value(const Study& study, const std::optional<Regression>& regression) {
  if (!regression) return Value();
  Value::Array lines;
  for (const FittedLine& line : regression->lines) {
    Value value;
    value.set("condition", condition_name(study, line.condition));
    value.set("slope", line.slope);
    value.set("intercept_m", line.intercept_m);
    value.set("r_squared", line.r_squared);
    value.set("parallel_intercept_m", regression->parallel_m[static_cast<std::size_t>(line.condition)]);
    lines.push_back(std::move(value));
  }
  Value value;
  value.set("lines", std::move(lines));
  value.set("common_slope", regression->common_slope);
  value.set("slopes_differ", value_of(regression->slopes));
  value.set("intercepts_differ", value_of(regression->intercepts));
  return value;
}

Value anova_value(const Study& study, const std::optional<Anova>& anova) {
  if (!anova) return Value();
  Value value;
  value.set("condition", value_of(anova->condition));
  value.set("distance", value_of(anova->target));
  value.set("interaction", value_of(anova->interaction));
  value.set("residual_df", anova->residual_df);
  value.set("residual_ss_m2", anova->residual_ss);
  Value::Array pairs;
  for (const PairTest& pair : anova->pairs) {
    Value item;
    item.set("first", condition_name(study, pair.first));
    item.set("second", condition_name(study, pair.second));
    item.set("difference_m", pair.difference_m);
    item.set("t", pair.t);
    item.set("df", pair.df);
    item.set("p", pair.p);
    item.set("method", anova->pairs.size() == 1 ? "tukey" : "holm");
    pairs.push_back(std::move(item));
  }
  value.set("pairs", std::move(pairs));
  return value;
}

Value within_value(const Study& study, const std::vector<Within>& within) {
  Value::Array list;
  for (const Within& each : within) {
    Value value;
    value.set("first", condition_name(study, each.first));
    value.set("second", condition_name(study, each.second));
    value.set("participants", each.participants);
    value.set("difference_m", each.difference_m);
    value.set("low_m", each.low_m);
    value.set("high_m", each.high_m);
    value.set("t", each.t);
    value.set("df", each.df);
    value.set("p", each.p);
    list.push_back(std::move(value));
  }
  return Value(std::move(list));
}

Value questions_value(const StudyReport& report) {
  Value::Array list;
  for (const QuestionAnswer& answer : report.answers.questions) {
    Value value;
    value.set("participant", answer.participant);
    value.set("question", report.answers.study.questions[static_cast<std::size_t>(answer.question)].name);
    value.set("yes", answer.yes);
    list.push_back(std::move(value));
  }
  return Value(std::move(list));
}

Value names_value(const Study& study, const std::vector<int>& participants) {
  Value::Array list;
  for (const int p : participants) list.push_back(participant_name(study, p));
  return Value(std::move(list));
}

Value left_out_value(const Study& study, const CellMeans& cells) {
  Value value;
  value.set("rule", name_of(study.missing));
  value.set("unfinished", names_value(study, cells.unfinished));
  value.set("by_rule", names_value(study, cells.left_out));
  Value::Array empty;
  for (const EmptyCell& cell : cells.empty) {
    Value item;
    item.set("participant", participant_name(study, cell.participant));
    item.set("condition", condition_name(study, cell.condition));
    item.set("target", target_name(study, cell.target));
    empty.push_back(std::move(item));
  }
  value.set("empty_means", std::move(empty));
  return value;
}

}  // namespace

Value report_value(const StudyReport& report) {
  const Study& study = report.answers.study;
  Value value;
  value.set("study", study.name);
  value.set("human", !report.tallies.empty() && !report.scripted());
  if (report.scripted()) value.set("warning", scripted_warning);
  Value::Array tallies;
  for (const Tally& tally : report.tallies) tallies.push_back(value_of(tally));
  value.set("participants", std::move(tallies));
  value.set("left_out", left_out_value(study, report.analysis.cells));
  Value::Array conditions;
  for (const ErrorSummary& summary : report.analysis.by_condition) conditions.push_back(value_of(study, summary));
  value.set("by_condition", std::move(conditions));
  Value::Array targets;
  for (const ErrorSummary& summary : report.analysis.by_target) targets.push_back(value_of(study, summary));
  value.set("by_target", std::move(targets));
  value.set("regression", regression_value(study, report.analysis.regression));
  value.set("anova", anova_value(study, report.analysis.anova));
  value.set("within", within_value(study, report.analysis.within));
  value.set("questions", questions_value(report));
  Value::Array notes(report.answers.notes.begin(), report.answers.notes.end());
  value.set("notes", std::move(notes));
  return value;
}

}  // namespace focalstage
