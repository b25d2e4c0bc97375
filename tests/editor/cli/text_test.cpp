#include <doctest/doctest.h>

#include "editor/cli/one_line.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"

using namespace focalstage;

TEST_CASE("an error line can't steer the terminal") {
  CHECK(one_line("two\nlines\tand a tab") == "two lines and a tab");
  CHECK(one_line("\x1b[2J") == "\\x1b[2J");
  CHECK(one_line("\x07\x7f") == "\\x07\\x7f");
  CHECK(one_line("caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x90\x87") == "caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x90\x87");
}

TEST_CASE("what is no UTF-8 is shown byte by byte") {
  CHECK(one_line("\xff") == "\\xff");
  CHECK(one_line("\xc3") == "\\xc3");                             // cut short
  CHECK(one_line("\xc0\xaf") == "\\xc0\\xaf");                    // overlong '/'
  CHECK(one_line("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");           // overlong
  CHECK(one_line("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(one_line("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond the last sign
  CHECK(one_line("\xc2\x9b") == "\\xc2\\x9b");                    // a control sequence introducer in one sign
}

TEST_CASE("faults of rigs and disks are the environment's, all others the input's") {
  for (const char* code : {"rig.unreachable", "rig.differs", "file.unwritable", "show.disk-full", "show.busy",
                           "export.folder", "program.missing"}) {
    CAPTURE(code);
    CHECK(status_of(Fault{code, "", "", ""}) == ExitStatus::environment);
  }
  for (const char* code : {"file.missing", "json.syntax", "show.damaged", "asset.invalid", "compile.assignment"}) {
    CAPTURE(code);
    CHECK(status_of(Fault{code, "", "", ""}) == ExitStatus::invalid);
  }
}

TEST_CASE("findings set the status by their worst") {
  const Finding warning{Severity::warning, "slices.spacing", "/slices", "wide", std::nullopt, {}};
  const Finding error{Severity::error, "slices.spacing", "/slices", "wider", Amount{1.2, 1.0, "D"}, {}};
  CHECK(status_of(std::vector<Finding>{}) == ExitStatus::done);
  CHECK(status_of(std::vector<Finding>{warning}) == ExitStatus::done);
  CHECK(status_of(std::vector<Finding>{warning, error}) == ExitStatus::findings);
  CHECK(findings_text({}) == "no findings\n");
  CHECK(findings_text({error}) == "error: wider\n  slices.spacing at /slices (1.2 D, limit 1 D)\n");
}

TEST_CASE("a table is as wide as its widest cells, numbers flush right") {
  const std::vector<Column> columns{{"eye"}, {"power D", true}};
  CHECK(table_text(columns, {{"left", "-1.000"}, {"right", "+0.500"}}) ==
        "eye    power D\n"
        "left    -1.000\n"
        "right   +0.500\n");
  CHECK(table_text(columns, {}) == "eye  power D\n");
  // Characters count, not their bytes.
  CHECK(table_text(columns, {{"左", "1 °"}, {"ab", "1 mm"}}) == "eye  power D\n左        1 °\nab      1 mm\n");
}

TEST_CASE("durations read as a clock does") {
  CHECK(duration_text(0.4) == "0 s");
  CHECK(duration_text(59.4) == "59 s");
  CHECK(duration_text(60.0) == "1 min 00 s");
  CHECK(duration_text(3599.0) == "59 min 59 s");
  CHECK(duration_text(3720.0) == "1 h 02 min");
  CHECK(duration_text(-1.0) == "0 s");
}

TEST_CASE("a bar is full only at the end") {
  CHECK(bar_text(0.0, 4) == "[----]");
  CHECK(bar_text(0.5, 4) == "[##--]");
  CHECK(bar_text(0.999, 4) == "[###-]");
  CHECK(bar_text(1.0, 4) == "[####]");
  CHECK(bar_text(7.0, 4) == "[####]");
}
