#include <utility>

#include "editor/session/command_list.h"
#include "editor/session/edit_words.h"

namespace focalstage {
namespace {

Result<Finding> finding_at(const Session& session, const Value& args) {
  const auto index = number_arg(args, "index");
  if (!index) return index.fault();
  const std::vector<Finding> findings = session.findings();
  if (*index < 0 || *index >= static_cast<double>(findings.size())) {
    return Fault{"command.argument", "index", "there is no such finding", ""};
  }
  return findings[static_cast<std::size_t>(*index)];
}

/// args: index
Status show(Session& session, const Value& args) {
  const auto finding = finding_at(session, args);
  if (!finding) return finding.fault();
  const Thing culprit = thing_at(session.project(), finding->where);
  if (!culprit.list.empty()) session.select({culprit});
  return {};
}

/// args: index
Status remedy(Session& session, const Value& args) {
  const auto finding = finding_at(session, args);
  if (!finding) return finding.fault();
  if (finding->remedy.empty()) return Fault{"session.no-remedy", finding->code, "has no remedy that is known", ""};
  return session.edit(edit_words(finding->remedy, session.project()), finding->remedy);
}

/// The first finding that has one.
Status remedy_first(Session& session, const Value&) {
  for (const Finding& finding : session.findings()) {
    if (!finding.remedy.empty()) return session.edit(edit_words(finding.remedy, session.project()), finding.remedy);
  }
  return {};
}

std::string needs_remedy(const Session& session) {
  for (const Finding& finding : session.findings()) {
    if (!finding.remedy.empty()) return {};
  }
  return "no finding has a remedy";
}

}  // namespace

void add_finding_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"finding.show", "Show a finding", "", "Selects what it is about", "", false, needs_project, show});
  add({"finding.remedy", "Apply a remedy", "", "", "", false, needs_project, remedy});
  add({"finding.remedy-first", "Apply the first remedy", "Ctrl+Return", "Of the first finding that has one", "remedy",
       true, needs_remedy, remedy_first});
}

}  // namespace focalstage
