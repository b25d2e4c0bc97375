#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "devices/roles/trigger_board.h"
#include "devices/uno/dialogue.h"
#include "devices/uno/settings.h"

namespace focalstage::uno {

/// A worker owns the port. Calls hand it requests and wait; `dark` goes before them, also before one that is under way.
class UnoBoard final : public TriggerBoard {
 public:
  explicit UnoBoard(UnoSettings settings);
  ~UnoBoard() override { close(); }

  focalstage::Status open() override;
  void close() override;
  DeviceId id() const override;
  DeviceState state() const override;
  focalstage::Status identify() override;
  focalstage::Status load(const BoardTable& table) override;
  focalstage::Status arm() override;
  bool dark() noexcept override;
  BoardReport report() const override;

 private:
  enum class Purpose { load, arm, identify };

  /// What a caller wants done. It waits, so it may lie on its stack.
  struct Job {
    Purpose purpose;
    std::vector<std::string> commands;
    double deadline_s;
    std::optional<focalstage::Status> outcome;
  };

  // The caller's side.
  focalstage::Status connect();
  Result<StatusLine> greet(Dialogue& dialogue) const;
  void start(Dialogue dialogue, const StatusLine& first);
  void stop_worker();
  focalstage::Status hand_over(Job job);
  focalstage::Status fail(const Fault& fault);

  // The worker's.
  void run(Dialogue& dialogue);
  focalstage::Status turn(Dialogue& dialogue);
  focalstage::Status make_dark(Dialogue& dialogue, std::uint64_t asked);
  focalstage::Status do_job(Dialogue& dialogue, Job& job);
  Result<Reply> answer_to(Dialogue& dialogue, const std::string& command, double deadline_s);
  Result<Reply> answer_in_time(Dialogue& dialogue, const std::string& command, double deadline_s);
  focalstage::Status say_all(Dialogue& dialogue, const Job& job);
  focalstage::Status beat(Dialogue& dialogue);
  focalstage::Status take_unasked(Dialogue& dialogue);
  void take_status(const Dialogue& dialogue, const StatusLine& status, double asked_s);
  focalstage::Status ask_for_lens_edge(Dialogue& dialogue);
  focalstage::Status done(Dialogue& dialogue, const Job& job);
  void went_dark(unsigned reason);
  bool comes_first() const;

  const UnoSettings settings_;
  const Waker waker_;
  std::mutex lifecycle_;  ///< open and close, one after the other
  std::mutex asking_;     ///< one job at a time; `dark` does not take it
  std::jthread worker_;
  double next_beat_s_ = 0.0;       ///< of the worker alone
  double next_lens_s_ = 0.0;       ///< of the worker alone; never, once its firmware says that it knows no such thing
  unsigned newest_lens_edge_ = 0;  ///< of the worker alone

  mutable std::mutex mutex_;  ///< what follows, for moments only
  std::condition_variable changed_;
  DevicePhase phase_ = DevicePhase::off;
  std::optional<Fault> fault_;
  double heard_s_ = 0.0;
  DeviceId id_;
  BoardReport report_;
  bool loaded_ = false;                ///< a table, since it was opened
  std::optional<StatusLine> newest_;   ///< since it was opened
  std::uint64_t board_bad_lines_ = 0;  ///< as the board counts, since it was opened
  bool at_work_ = false;               ///< the worker has a board
  bool stopping_ = false;
  Job* job_ = nullptr;
  std::uint64_t dark_asked_ = 0;
  std::uint64_t dark_told_ = 0;
};

}  // namespace focalstage::uno
