#pragma once

#include <string>
#include <string_view>

namespace focalstage::uno_emulator {

/// The board's side of a pty, which a host opens as its serial port.
class PtyPort {
 public:
  PtyPort() = default;
  ~PtyPort() { unplug(); }
  PtyPort(const PtyPort&) = delete;
  PtyPort& operator=(const PtyPort&) = delete;

  /// Under another name than before. Throws if the system has no pty left.
  void plug_in();
  void unplug();
  bool plugged_in() const { return master_ >= 0; }
  /// What the host opens; empty while unplugged.
  const std::string& path() const { return path_; }
  /// A link of that name leads to the port wherever it is, and nowhere while it is unplugged.
  void set_link(const std::string& link);

  bool host_is_there() const;
  std::string read() const;
  /// What a host that is not there or does not read does not get is lost.
  void write(std::string_view bytes) const;

 private:
  void update_link() const;

  int master_ = -1;
  std::string path_;
  std::string last_;
  std::string link_;
};

}  // namespace focalstage::uno_emulator
