#include "devices/uno/faults.h"

#include "devices/uno/table.h"

namespace focalstage::uno {

namespace {

std::string pins_of(const std::string& bits) {
  const int failed = bits.empty() ? 0 : bits.front() - '0';
  std::string names;
  if ((failed & 1) != 0) names += " D4";
  if ((failed & 2) != 0) names += " D5";
  if ((failed & 4) != 0) names += " D9";
  return names;
}

}  // namespace

Fault darkness(const std::string& path, unsigned reason) {
  switch (reason) {
    case 2:
      return {"board.sync_lost", path, "it went dark: the sync edge did not come, or not when it should",
              "see the cable to D8 and what gives out the edge, then arm again"};
    case 3:
      return {"board.host_silent", path, "it went dark: it heard nothing from this computer for 500 ms",
              "see the USB cable and the computer's load, then arm again"};
    case 4:
      return {"board.late", path, "it went dark: a trigger came too late, or D9 was not as it was driven",
              "see that nothing else drives D9, then arm again"};
    default:
      return {"board.dark", path, "it went dark by itself, for reason " + std::to_string(reason), "arm again"};
  }
}

Fault restarted(const std::string& path, unsigned cause) {
  std::string why = "for no known reason";
  if ((cause & 8U) != 0) why = "by its watchdog: its program hung";
  if ((cause & 4U) != 0) why = "as its voltage broke down";
  if ((cause & 2U) != 0) why = "by its reset line";
  if ((cause & 1U) != 0) why = "as its power came";
  return {"uno.reset", path, "the board restarted " + why, "see its power and cable, then open it again"};
}

Fault refusal(const std::string& path, const std::string& command, unsigned code) {
  if (command == "ARM" && code == 5) {
    return {"board.unsynced", path, "there is no sync edge, or its period is over 3 % off the table's",
            "start the lens drive, and see the cable to D8"};
  }
  if (command == "ARM" && code == 6) {
    return {"board.table", path, "the board has no table", "load one first"};
  }
  if (code == 7) {
    return {"uno.running", path, "the board does this only while it is dark", "make it dark first"};
  }
  return table_fault(command, code);
}

Fault failed_test(const std::string& path, const std::string& bits) {
  return {"uno.pins", path, "these pins are not as they are driven:" + pins_of(bits),
          "see what else is connected to them"};
}

}  // namespace focalstage::uno
