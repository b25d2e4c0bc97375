#include "devices/rig/rig_tables.h"

#include "core/base/periodic.h"

namespace focalstage {

Exposures exposures_of(const Score& score, const std::vector<TableTrigger>& triggers, double latency_s) {
  Exposures exposures;
  exposures.period_s = score.drive.period_s;
  exposures.form = score.form;
  for (const TableTrigger& trigger : triggers) exposures.start_s.push_back(trigger.at_s + latency_s);
  exposures.exposure_s = score.exposure_s;
  return exposures;
}

BoardTable shutter_table(const Score& score, double edge_s) {
  BoardTable table;
  table.period_s = score.drive.period_s;
  for (const Side eye : both_sides) {
    if (!score.shutter[eye]) continue;
    // A shutter that is open over the period's end closes in the next one.
    const ShutterWindow& window = *score.shutter[eye];
    const double open_s = wrapped_s(window.open_s - edge_s, table.period_s);
    table.shutter[eye] = {open_s, open_s + wrapped_s(window.close_s - window.open_s, table.period_s)};
  }
  return table;
}

BoardTable board_table(const Score& score, const std::vector<TableTrigger>& triggers, double pulse_s) {
  BoardTable table = shutter_table(score, 0.0);
  table.pulse_s = pulse_s;
  for (const TableTrigger& trigger : triggers) table.trigger_s.push_back(trigger.at_s);
  return table;
}

}  // namespace focalstage
