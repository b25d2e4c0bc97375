#include "editor/session/palette.h"

#include <algorithm>
#include <utility>

#include "editor/session/fuzzy.h"
#include "editor/session/session.h"

namespace focalstage {
namespace {

/// A word of the help counts less than the same in the title.
constexpr int help_penalty = 60;

struct Ranked {
  PaletteEntry entry;
  int score = 0;
};

class Ranking {
 public:
  explicit Ranking(std::string_view query) : query_(query) {}

  void add(PaletteEntry entry) {
    if (auto match = fuzzy_match(query_, entry.title)) {
      entry.matched = std::move(match->bytes);
      found_.push_back({std::move(entry), match->score});
    } else if (entry.help.find(query_) != std::string::npos) {  // whole words only: letters alone stand in any sentence
      found_.push_back({std::move(entry), -help_penalty});
    }
  }

  std::vector<PaletteEntry> take() {
    std::ranges::stable_sort(found_, [&](const Ranked& a, const Ranked& b) {
      if (query_.empty()) return false;
      if (a.entry.unavailable.empty() != b.entry.unavailable.empty()) return a.entry.unavailable.empty();
      return a.score > b.score;
    });
    std::vector<PaletteEntry> entries;
    for (Ranked& ranked : found_) entries.push_back(std::move(ranked.entry));
    return entries;
  }

 private:
  std::string query_;
  std::vector<Ranked> found_;
};

const char* icon_of(const Thing& thing) {
  if (thing.list == "surfaces") return "surface";
  if (thing.list == "objects") return "object";
  if (thing.list == "lights") return "light";
  if (thing.list == "projectors") return "projector";
  return "settings";
}

PaletteEntry entry_of(const Session& session, const Command& command) {
  return {std::string(command.title),
          std::string(command.help),
          std::string(command.shortcut),
          std::string(command.icon),
          command.unavailable(session),
          std::string(command.id),
          {},
          {}};
}

PaletteEntry entry_of(const Thing& thing) {
  Value args;
  args.set("list", thing.list);
  args.set("name", thing.name);
  return {"Select " + title_of(thing), "", "", icon_of(thing), "", "select", args, {}};
}

}  // namespace

std::vector<PaletteEntry> palette_entries(const Session& session, std::string_view query) {
  Ranking ranking(query);
  for (const Command& command : commands()) {
    if (command.shown != nullptr && !command.shown(session)) continue;
    if (command.in_palette && command.id != "app.palette") ranking.add(entry_of(session, command));
  }
  if (query.empty()) return ranking.take();
  if (session.has_document()) {
    for (const Thing& thing : things_of(session.project())) ranking.add(entry_of(thing));
  }
  for (const SampleCard& card : session.sample_cards()) {
    Value args;
    args.set("from", card.name);
    ranking.add({"New from " + card.title, card.says, "", "sample", "", "file.new", args, {}});
  }
  for (const auto& path : session.recent()) {
    Value args;
    args.set("path", path.string());
    ranking.add({"Open " + path.stem().string(), path.parent_path().string(), "", "folder", "", "file.open", args, {}});
  }
  return ranking.take();
}

}  // namespace focalstage
