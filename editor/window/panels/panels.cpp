#include "editor/window/panels/panels.h"

#include "editor/window/panels/bar_panel.h"
#include "editor/window/panels/file_panel.h"
#include "editor/window/panels/findings_panel.h"
#include "editor/window/panels/history_panel.h"
#include "editor/window/panels/log_panel.h"
#include "editor/window/panels/notice_panel.h"
#include "editor/window/panels/outline_panel.h"
#include "editor/window/panels/palette_panel.h"
#include "editor/window/panels/properties_panel.h"
#include "editor/window/panels/question_panel.h"
#include "editor/window/panels/solve_panel.h"
#include "editor/window/panels/start_panel.h"
#include "editor/window/panels/timeline_panel.h"

namespace focalstage {

std::vector<std::unique_ptr<Panel>> make_panels() {
  std::vector<std::unique_ptr<Panel>> panels;
  panels.push_back(make_bar_panel());
  panels.push_back(make_outline_panel());
  panels.push_back(make_properties_panel());
  panels.push_back(make_timeline_panel());
  panels.push_back(make_start_panel());
  panels.push_back(make_findings_panel());
  panels.push_back(make_history_panel());
  panels.push_back(make_log_panel());
  panels.push_back(make_solve_panel());
  panels.push_back(make_notice_panel());
  panels.push_back(make_palette_panel());
  panels.push_back(make_file_panel());
  panels.push_back(make_question_panel());
  return panels;
}

}  // namespace focalstage
