#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace focalstage {

/// Who a display says that it is (VESA E-EDID 1.4, base block). Connector numbers change with every plugging in; this
/// does not.
struct EdidIdentity {
  std::string maker;  ///< three letters
  int product = 0;
  std::string name;    ///< as its maker calls it; may be empty
  std::string serial;  ///< in words, or else the number; may be empty

  bool operator==(const EdidIdentity&) const = default;
};

/// Nothing where this is no EDID or its sum is wrong.
std::optional<EdidIdentity> parse_edid(std::span<const std::uint8_t> bytes);

/// "TXN 4500 'DLP' 17".
std::string describe(const EdidIdentity& identity);

}  // namespace focalstage
