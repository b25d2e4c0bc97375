#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/number_words.h"
#include "io/study/report.h"
#include "io/study/report_words.h"

namespace focalstage {
namespace {

using Words = std::vector<std::string>;

std::string row(const Words& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string table(const Words& titles, const std::vector<Words>& rows) {
  std::string text = "\n" + row(titles) + "|";
  for (std::size_t k = 0; k < titles.size(); ++k) text += k == 0 ? "---|" : "--:|";
  text += "\n";
  for (const Words& cells : rows) text += row(cells);
  return text;
}

std::string heading(const StudyReport& report) {
  const Study& study = report.answers.study;
  std::string text = "# " + escaped(study.name) + "\n\n";
  if (report.scripted()) text += std::string("> **") + scripted_warning + "**\n\n";
  std::set<std::string> rigs;
  for (const Response& response : report.answers.responses) rigs.insert(response.rig);
  text += std::to_string(report.tallies.size()) + " of " + std::to_string(study.participants.size()) +
          " participants, " + std::to_string(study.conditions.size()) + " conditions, " +
          std::to_string(study.targets.size()) + " targets, " + std::to_string(study.repetitions) +
          " repetitions; seed " + std::to_string(study.seed) + ".";
  for (const std::string& rig : rigs) {
    text += rig == "sim" ? " The rig was a simulated one: no light reached an eye." : " Rig: " + escaped(rig) + ".";
  }
  return text + " Distances are in mm from the lens centre; an error is the estimated less the actual distance.\n";
}

std::string participants(const StudyReport& report) {
  std::vector<Words> rows;
  for (const Tally& tally : report.tallies) {
    rows.push_back({tally.participant, tally.kind, std::to_string(tally.answered), std::to_string(tally.given_up),
                    std::to_string(tally.spoiled), std::to_string(tally.sittings), tally.finished() ? "yes" : "no"});
  }
  return "\n## Participants\n" +
         table({"participant", "kind", "answered", "given up", "spoiled, repeated", "sittings", "finished"}, rows);
}

std::string names(const Study& study, const std::vector<int>& participants) {
  std::string text;
  for (const int p : participants) text += (text.empty() ? "" : ", ") + participant_name(study, p);
  return text;
}

std::string left_out(const StudyReport& report) {
  const Study& study = report.answers.study;
  const CellMeans& cells = report.analysis.cells;
  std::string text =
      "\nA mean is of the repetitions that one participant answered for one target under one condition; training is in "
      "no "
      "statistic. There are " +
      std::to_string(cells.means.size()) + " means of " + std::to_string(cells.used.size()) + " participants.";
  if (!cells.unfinished.empty()) text += " Left out, not finished: " + names(study, cells.unfinished) + ".";
  if (!cells.empty.empty()) {
    text += " All repetitions were given up by";
    for (const EmptyCell& cell : cells.empty) {
      text += (&cell == &cells.empty.front() ? " " : "; ") + participant_name(study, cell.participant) + " (" +
              condition_name(study, cell.condition) + ", " + target_name(study, cell.target) + ")";
    }
    text += std::string(". Rule `") + name_of(study.missing) + "`: " +
            (cells.left_out.empty() ? "these means are left out, and sums of squares are of type II."
                                    : "left out are " + names(study, cells.left_out) + ".");
  }
  for (const std::string& note : report.answers.notes) text += " Note: " + escaped(note) + ".";
  return text + "\n";
}

Words summary_cells(const ErrorSummary& summary) {
  if (summary.error.count == 0) return {"0", "", "", "", ""};
  return {std::to_string(summary.error.count), mm_text(summary.estimated.mean_m),
          mm_text(summary.estimated.deviation_m), mm_text(summary.error.mean_m), mm_text(summary.error.deviation_m)};
}

std::string means(const StudyReport& report) {
  const Study& study = report.answers.study;
  std::vector<Words> rows;
  const auto add = [&](const ErrorSummary& summary, const std::string& target, const std::string& actual) {
    Words cells{condition_name(study, summary.condition), target, actual};
    const Words numbers = summary_cells(summary);
    cells.insert(cells.end(), numbers.begin(), numbers.end());
    rows.push_back(std::move(cells));
  };
  for (const ErrorSummary& all : report.analysis.by_condition) {
    for (const ErrorSummary& summary : report.analysis.by_target) {
      if (summary.condition != all.condition) continue;
      const StudyTarget& target = study.targets[static_cast<std::size_t>(summary.target)];
      add(summary, target.name, mm_text(target.actual_m, 1));
    }
    add(all, "all", "");
  }
  return "\n## Means and errors\n" + left_out(report) +
         table({"condition", "target", "actual", "means", "estimated", "SD", "error", "SD of error"}, rows);
}

std::string line_text(double slope, double intercept_m) {
  return "y = " + fixed_text(slope, 5) + " x " + (intercept_m < 0.0 ? "- " : "+ ") + mm_text(std::abs(intercept_m), 3);
}

std::string regression(const StudyReport& report) {
  std::string text = "\n## Regression of estimated on actual distance\n";
  const Study& study = report.answers.study;
  const auto& found = report.analysis.regression;
  if (!found) return text + "\nNot possible: a condition has means at fewer than two distances.\n";
  std::vector<Words> rows;
  for (const FittedLine& line : found->lines) {
    const double parallel_m = found->parallel_m[static_cast<std::size_t>(line.condition)];
    rows.push_back({condition_name(study, line.condition), std::to_string(line.points),
                    line_text(line.slope, line.intercept_m), fixed_text(line.r_squared, 4),
                    line_text(found->common_slope, parallel_m)});
  }
  text += table({"condition", "means", "line (mm)", "R²", "line under one slope (mm)"}, rows);
  text += "\n- Do the slopes differ? " + test_text(found->slopes) + ".\n";
  text += "- Do the intercepts differ, slopes made equal? " + test_text(found->intercepts) + ".\n";
  for (std::size_t k = 1; k < found->parallel_m.size(); ++k) {
    text += "- Under one slope, `" + study.conditions[k].name + "` lies " +
            mm_text(found->parallel_m[k] - found->parallel_m[0]) + " mm from `" + study.conditions[0].name + "`.\n";
  }
  return text;
}

std::string mm2_text(double area_m2) { return fixed_text(area_m2 * 1e6, 2); }

Words anova_row(const std::string& name, const std::optional<FTest>& test) {
  if (!test) return {name, "", "", "", "", "no test"};
  return {name,
          mm2_text(test->ss),
          fixed_text(test->df1, 0),
          mm2_text(test->ss / test->df1),
          fixed_text(test->f, 3),
          p_text(test->p)};
}

std::string anova(const StudyReport& report) {
  std::string text = "\n## Analysis of variance of the errors\n";
  const auto& found = report.analysis.anova;
  if (!found) {
    return text + "\nNot possible: a condition has no mean for some target, or there is but one mean for each.\n";
  }
  text += table({"source", "SS (mm²)", "df", "MS (mm²)", "F", "p"},
                {anova_row("condition", found->condition),
                 anova_row("distance", found->target),
                 anova_row("condition x distance", found->interaction),
                 {"residual", mm2_text(found->residual_ss), fixed_text(found->residual_df, 0),
                  mm2_text(found->residual_ss / found->residual_df), "", ""}});
  if (!found->condition)
    return text + "\nThe answers do not vary within condition and distance: nothing can be tested.\n";
  return text + "\nTwo-way, between subjects, as in the paper: means of one participant count as independent.\n";
}

std::string post_hoc(const StudyReport& report) {
  const Study& study = report.answers.study;
  const auto& found = report.analysis.anova;
  if (!found || found->pairs.empty()) return {};
  const bool tukey = found->pairs.size() == 1;
  std::vector<Words> rows;
  for (const PairTest& pair : found->pairs) {
    Words cells{condition_name(study, pair.first) + " - " + condition_name(study, pair.second),
                mm_text(pair.difference_m), fixed_text(pair.t, 3), fixed_text(pair.df, 0)};
    if (tukey) cells.push_back(fixed_text(std::abs(pair.t) * std::numbers::sqrt2, 3));
    cells.push_back(p_text(pair.p));
    rows.push_back(std::move(cells));
  }
  Words titles{"conditions", "difference of errors (mm)", "t", "df"};
  if (tukey) titles.push_back("q");
  titles.push_back("p");
  return "\n## Pairs of conditions\n" + table(titles, rows) +
         (tukey ? "\nTukey's HSD. Of two conditions its q is |t| times the square root of 2 and its p that of the t "
                  "test.\n"
                : "\nt tests with the residual of the analysis of variance, p after Holm's correction.\n");
}

std::string within(const StudyReport& report) {
  const Study& study = report.answers.study;
  std::vector<Words> rows;
  for (const Within& each : report.analysis.within) {
    rows.push_back({condition_name(study, each.first) + " - " + condition_name(study, each.second),
                    std::to_string(each.participants), mm_text(each.difference_m),
                    mm_text(each.low_m) + " to " + mm_text(each.high_m), fixed_text(each.t, 3), fixed_text(each.df, 0),
                    p_text(each.p)});
  }
  if (rows.empty()) return {};
  return "\n## Within participants\n\nBeside the paper's tests: the difference of each participant's mean errors, "
         "which does not take means of "
         "one person as independent (paired t test; those with a mean for every target).\n" +
         table({"conditions", "participants", "difference (mm)", "95 % confidence (mm)", "t", "df", "p"}, rows);
}

std::string questions(const StudyReport& report) {
  const Study& study = report.answers.study;
  if (study.questions.empty()) return {};
  std::vector<Words> rows;
  for (std::size_t q = 0; q < study.questions.size(); ++q) {
    std::string yes;
    int said_yes = 0;
    int said_no = 0;
    for (const QuestionAnswer& answer : report.answers.questions) {
      if (answer.question != static_cast<int>(q)) continue;
      ++(answer.yes ? said_yes : said_no);
      if (answer.yes) yes += (yes.empty() ? "" : ", ") + answer.participant;
    }
    const int silent = static_cast<int>(report.tallies.size()) - said_yes - said_no;
    rows.push_back({study.questions[q].name, escaped(study.questions[q].text), std::to_string(said_yes),
                    std::to_string(said_no), std::to_string(silent), yes});
  }
  return "\n## Questions\n" + table({"question", "", "yes", "no", "not asked yet", "who said yes"}, rows);
}

std::string shows(const StudyReport& report) {
  const Study& study = report.answers.study;
  std::set<std::pair<int, std::string>> met;
  for (const Response& response : report.answers.responses) met.insert({response.condition, response.show_sha256});
  if (met.empty()) return {};
  std::string text = "\n## Shows\n\n";
  for (const auto& [condition, sha256] : met) text += "- " + condition_name(study, condition) + ": `" + sha256 + "`\n";
  return text;
}

}  // namespace

std::string report_markdown(const StudyReport& report, const std::string& plot) {
  std::string text = heading(report) + participants(report) + means(report);
  if (!plot.empty()) text += "\n![Estimated over actual distance, with the line of each condition](" + plot + ")\n";
  return text + regression(report) + anova(report) + post_hoc(report) + within(report) + questions(report) +
         shows(report);
}

}  // namespace focalstage
