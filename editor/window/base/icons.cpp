#include "editor/window/base/icons.h"

#include <algorithm>
#include <array>

namespace focalstage {
namespace {

struct Icon {
  std::string_view name;
  std::string_view glyph;  ///< of Fork Awesome, in Unicode's private area
};

// Sorted by name.
constexpr std::array table = {
    Icon{"add", "\xef\x81\xa7"},          Icon{"align", "\xef\x80\xb6"},
    Icon{"align-left", "\xef\x80\xb6"},   Icon{"align-right", "\xef\x80\xb8"},
    Icon{"apply", "\xef\x80\x8c"},        Icon{"archive", "\xef\x86\x87"},
    Icon{"asset", "\xef\x85\x9b"},        Icon{"assignment", "\xef\x87\x9e"},
    Icon{"audio", "\xef\x80\xa8"},        Icon{"axes", "\xef\x81\x87"},
    Icon{"back", "\xef\x81\xa0"},         Icon{"backward", "\xef\x81\x8a"},
    Icon{"blackout", "\xef\x86\x86"},     Icon{"camera", "\xef\x80\xb0"},
    Icon{"cancel", "\xef\x80\x8d"},       Icon{"check", "\xef\x80\x8c"},
    Icon{"circle", "\xef\x84\x91"},       Icon{"clip", "\xef\x83\x86"},
    Icon{"clock", "\xef\x80\x97"},        Icon{"clone", "\xef\x89\x8d"},
    Icon{"close", "\xef\x80\x8d"},        Icon{"cog", "\xef\x80\x93"},
    Icon{"collapse", "\xef\x84\x87"},     Icon{"collect", "\xef\x86\x87"},
    Icon{"compare", "\xef\x81\x82"},      Icon{"compass", "\xef\x85\x8e"},
    Icon{"compile", "\xef\x82\x85"},      Icon{"connect", "\xef\x87\xa6"},
    Icon{"conventional", "\xef\x81\x82"}, Icon{"copy", "\xef\x83\x85"},
    Icon{"copy-of", "\xef\x83\x85"},      Icon{"crosshairs", "\xef\x81\x9b"},
    Icon{"cube", "\xef\x86\xb2"},         Icon{"cubes", "\xef\x86\xb3"},
    Icon{"cue", "\xef\x80\xa4"},          Icon{"cut", "\xef\x83\x84"},
    Icon{"delete", "\xef\x80\x94"},       Icon{"depth", "\xef\x81\xbe"},
    Icon{"desktop", "\xef\x84\x88"},      Icon{"difference", "\xef\x81\x82"},
    Icon{"dim", "\xef\x86\x86"},          Icon{"disconnect", "\xef\x84\xa7"},
    Icon{"disk", "\xef\x83\x87"},         Icon{"done", "\xef\x81\x98"},
    Icon{"dot", "\xef\x86\x92"},          Icon{"down", "\xef\x81\xb8"},
    Icon{"download", "\xef\x80\x99"},     Icon{"dragging", "\xef\x81\x87"},
    Icon{"drop", "\xef\x85\x89"},         Icon{"drop-to-surface", "\xef\x85\x89"},
    Icon{"duplicate", "\xef\x89\x8d"},    Icon{"edit", "\xef\x81\x80"},
    Icon{"ellipsis", "\xef\x85\x81"},     Icon{"error", "\xef\x81\x97"},
    Icon{"exchange", "\xef\x83\xac"},     Icon{"expand", "\xef\x84\x85"},
    Icon{"export", "\xef\x82\x8e"},       Icon{"external", "\xef\x82\x8e"},
    Icon{"eye", "\xef\x81\xae"},          Icon{"fault", "\xef\x81\x97"},
    Icon{"file", "\xef\x80\x96"},         Icon{"fill", "\xef\x81\xa5"},
    Icon{"film", "\xef\x80\x88"},         Icon{"filter", "\xef\x82\xb0"},
    Icon{"find", "\xef\x80\x82"},         Icon{"finding", "\xef\x81\xb1"},
    Icon{"findings", "\xef\x81\xb1"},     Icon{"first", "\xef\x81\x88"},
    Icon{"flag", "\xef\x80\xa4"},         Icon{"focus", "\xef\x81\x9b"},
    Icon{"folded", "\xef\x84\x85"},       Icon{"folder", "\xef\x84\x95"},
    Icon{"forget", "\xef\x80\x94"},       Icon{"forward", "\xef\x81\x8e"},
    Icon{"four", "\xef\x80\x89"},         Icon{"frame", "\xef\x80\xbe"},
    Icon{"frames", "\xef\x80\x88"},       Icon{"frusta", "\xef\x82\xb0"},
    Icon{"gauge", "\xef\x83\xa4"},        Icon{"glasses", "\xef\x87\xa5"},
    Icon{"globe", "\xef\x82\xac"},        Icon{"go", "\xef\x83\xab"},
    Icon{"grid", "\xef\x80\x8a"},         Icon{"group", "\xef\x89\x87"},
    Icon{"hand", "\xef\x89\x96"},         Icon{"help", "\xef\x81\x99"},
    Icon{"hidden", "\xef\x81\xb0"},       Icon{"hide", "\xef\x81\xb0"},
    Icon{"history", "\xef\x87\x9a"},      Icon{"hold", "\xef\x81\x8c"},
    Icon{"home", "\xef\x80\x95"},         Icon{"image", "\xef\x80\xbe"},
    Icon{"import", "\xef\x80\x99"},       Icon{"info", "\xef\x81\x9a"},
    Icon{"key", "\xef\x82\x84"},          Icon{"keyboard", "\xef\x84\x9c"},
    Icon{"keyframe", "\xef\x88\x99"},     Icon{"label", "\xef\x80\xab"},
    Icon{"last", "\xef\x81\x91"},         Icon{"lens", "\xef\x80\x82"},
    Icon{"light", "\xef\x83\xab"},        Icon{"lights", "\xef\x83\xab"},
    Icon{"link", "\xef\x83\x81"},         Icon{"list", "\xef\x80\xba"},
    Icon{"live", "\xef\x80\x92"},         Icon{"live-on", "\xef\x86\x92"},
    Icon{"lock", "\xef\x80\xa3"},         Icon{"lock-open", "\xef\x82\x9c"},
    Icon{"locked", "\xef\x80\xa3"},       Icon{"log", "\xef\x84\xa0"},
    Icon{"loop", "\xef\x80\x9e"},         Icon{"magnet", "\xef\x81\xb6"},
    Icon{"maximize", "\xef\x8b\x90"},     Icon{"measure", "\xef\x81\xbe"},
    Icon{"menu", "\xef\x83\x89"},         Icon{"mesh", "\xef\x86\xb2"},
    Icon{"minus", "\xef\x81\xa8"},        Icon{"move", "\xef\x81\x87"},
    Icon{"movie", "\xef\x80\x88"},        Icon{"new", "\xef\x80\x96"},
    Icon{"next", "\xef\x81\x91"},         Icon{"none", "\xef\x84\x8c"},
    Icon{"object", "\xef\x86\xb2"},       Icon{"objects", "\xef\x86\xb3"},
    Icon{"open", "\xef\x84\x95"},         Icon{"outline", "\xef\x80\xba"},
    Icon{"palette", "\xef\x84\xa0"},      Icon{"paste", "\xef\x83\xaa"},
    Icon{"pause", "\xef\x81\x8c"},        Icon{"pencil", "\xef\x81\x80"},
    Icon{"person", "\xef\x80\x87"},       Icon{"picture", "\xef\x80\xbe"},
    Icon{"pin", "\xef\x82\x8d"},          Icon{"plane", "\xef\x82\x96"},
    Icon{"play", "\xef\x81\x8b"},         Icon{"plug", "\xef\x87\xa6"},
    Icon{"plus", "\xef\x81\xa7"},         Icon{"point", "\xef\x81\x9b"},
    Icon{"power", "\xef\x80\x91"},        Icon{"previous", "\xef\x81\x88"},
    Icon{"projector", "\xef\x80\xbd"},    Icon{"projectors", "\xef\x80\xbd"},
    Icon{"properties", "\xef\x87\x9e"},   Icon{"push", "\xef\x82\x93"},
    Icon{"pushed", "\xef\x80\x8c"},       Icon{"question", "\xef\x81\x99"},
    Icon{"quit", "\xef\x82\x8b"},         Icon{"rabbit", "\xef\x86\xb2"},
    Icon{"recent", "\xef\x87\x9a"},       Icon{"redo", "\xef\x80\x9e"},
    Icon{"refresh", "\xef\x80\xa1"},      Icon{"reload", "\xef\x80\xa1"},
    Icon{"remedy", "\xef\x82\xad"},       Icon{"rename", "\xef\x81\x80"},
    Icon{"replace", "\xef\x81\xb9"},      Icon{"reset", "\xef\x83\xa2"},
    Icon{"restore", "\xef\x87\x9a"},      Icon{"restore-panes", "\xef\x81\xa6"},
    Icon{"rig", "\xef\x88\xb3"},          Icon{"room", "\xef\x86\xb2"},
    Icon{"rotate", "\xef\x80\xa1"},       Icon{"runtime", "\xef\x88\xb3"},
    Icon{"sample", "\xef\x80\xad"},       Icon{"save", "\xef\x83\x87"},
    Icon{"save-as", "\xef\x83\x87"},      Icon{"scale", "\xef\x82\xb2"},
    Icon{"search", "\xef\x80\x82"},       Icon{"select", "\xef\x89\x85"},
    Icon{"send", "\xef\x87\x98"},         Icon{"server", "\xef\x88\xb3"},
    Icon{"settings", "\xef\x80\x93"},     Icon{"sheet", "\xef\x82\x96"},
    Icon{"show", "\xef\x81\xae"},         Icon{"sight", "\xef\x81\x9b"},
    Icon{"simulate", "\xef\x84\x9b"},     Icon{"simulated", "\xef\x84\x9b"},
    Icon{"sky", "\xef\x83\x82"},          Icon{"slice", "\xef\x83\x9b"},
    Icon{"slices", "\xef\x83\x89"},       Icon{"sliders", "\xef\x87\x9e"},
    Icon{"slower", "\xef\x81\x8a"},       Icon{"snap", "\xef\x81\xb6"},
    Icon{"solo", "\xef\x80\x85"},         Icon{"spinner", "\xef\x84\x90"},
    Icon{"square", "\xef\x82\x96"},       Icon{"star", "\xef\x80\x85"},
    Icon{"start", "\xef\x81\x8b"},        Icon{"stepping", "\xef\x81\x91"},
    Icon{"stop", "\xef\x81\x8d"},         Icon{"sun", "\xef\x86\x85"},
    Icon{"surface", "\xef\x89\xac"},      Icon{"surfaces", "\xef\x89\xac"},
    Icon{"sweep", "\xef\x87\xbe"},        Icon{"table", "\xef\x83\x8e"},
    Icon{"tag", "\xef\x80\xab"},          Icon{"task", "\xef\x82\xae"},
    Icon{"template", "\xef\x80\xad"},     Icon{"text", "\xef\x80\xb1"},
    Icon{"time", "\xef\x80\x97"},         Icon{"timeline", "\xef\x80\x88"},
    Icon{"tint", "\xef\x87\xbc"},         Icon{"trash", "\xef\x80\x94"},
    Icon{"tree", "\xef\x83\xa8"},         Icon{"turn", "\xef\x80\xa1"},
    Icon{"undo", "\xef\x83\xa2"},         Icon{"unfolded", "\xef\x84\x87"},
    Icon{"ungroup", "\xef\x89\x88"},      Icon{"unhide", "\xef\x81\xae"},
    Icon{"unlink", "\xef\x84\xa7"},       Icon{"unlock", "\xef\x82\x9c"},
    Icon{"up", "\xef\x81\xb7"},           Icon{"upload", "\xef\x82\x93"},
    Icon{"user", "\xef\x80\x87"},         Icon{"view", "\xef\x81\xae"},
    Icon{"viewer", "\xef\x80\x87"},       Icon{"visible", "\xef\x81\xae"},
    Icon{"warning", "\xef\x81\xb1"},      Icon{"warning-sign", "\xef\x81\xb1"},
    Icon{"wifi", "\xef\x87\xab"},         Icon{"window", "\xef\x8b\x90"},
    Icon{"wrench", "\xef\x82\xad"},       Icon{"zoom", "\xef\x80\x8e"},
    Icon{"zoom-fit", "\xef\x81\xa6"},     Icon{"zoom-in", "\xef\x80\x8e"},
    Icon{"zoom-out", "\xef\x80\x90"},
};

static_assert(std::ranges::is_sorted(table, {}, &Icon::name));

const Icon* find(std::string_view name) {
  const auto* place = std::ranges::lower_bound(table, name, {}, &Icon::name);
  return place != table.end() && place->name == name ? place : nullptr;
}

}  // namespace

std::string_view icon(std::string_view name) {
  if (name.empty()) return "";
  const Icon* found = find(name);
  return found != nullptr ? found->glyph : "\xef\x84\x91";
}

bool has_icon(std::string_view name) { return find(name) != nullptr; }

}  // namespace focalstage
