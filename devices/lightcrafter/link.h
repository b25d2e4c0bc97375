#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"
#include "devices/lightcrafter/packets.h"

namespace focalstage::lightcrafter {

/// Reports to and from one device, whatever carries them. What comes short is nothing.
class Reports {
 public:
  Reports() = default;
  Reports(const Reports&) = delete;
  Reports& operator=(const Reports&) = delete;
  virtual ~Reports() = default;

  enum class Got { report, nothing, gone };

  virtual bool write(const Report& report) = 0;
  virtual Got read(Report& report, int timeout_ms) = 0;
};

/// Opens the HID node of a unit: by address, by serial, or the first there is. "projector.absent",
/// "projector.permission", or "projector.busy" where this program has it open already.
Result<std::unique_ptr<Reports>> open_hid(const std::string& serial, const std::string& address);

/// Messages and their answers, each with a deadline. For one thread at a time. "projector.lost": it is gone;
/// "projector.silent": no answer in time; "projector.refused": it said no; "projector.hurried": see below.
class Link {
 public:
  /// `hurry`: while it is set, waiting for ordinary answers is given up, so that darkness need not wait for them.
  Link(std::unique_ptr<Reports> reports, double answer_s, const std::atomic<bool>& hurry);

  Status write(Command command, std::span<const std::uint8_t> payload);
  Result<Bytes> read(Command command);
  /// Not given up in a hurry; with a deadline of its own.
  Status write_at_once(Command command, std::span<const std::uint8_t> payload, double answer_s);
  Result<Bytes> read_at_once(Command command, double answer_s);

 private:
  struct Wait {
    double answer_s;
    bool at_once;
  };
  Status write(Command command, std::span<const std::uint8_t> payload, Wait wait);
  Result<Bytes> read(Command command, Wait wait);
  Status send(std::span<const std::uint8_t> message);
  Result<Answer> answer(Command command, bool to_read, std::uint8_t sequence, Wait wait);

  std::unique_ptr<Reports> reports_;
  double answer_s_;
  const std::atomic<bool>& hurry_;
  std::uint8_t sequence_ = 0;
  bool echoes_ = false;  ///< it was seen to echo sequence numbers: then an answer to something else is told by them
};

}  // namespace focalstage::lightcrafter
