#pragma once

#include <chrono>
#include <string>

namespace focalstage {

/// How far long work has come, on stderr: a bar with the time left on a terminal, a plain line every few seconds
/// otherwise, nothing when quiet.
class Progress {
 public:
  enum class Style { automatic, quiet };

  Progress(std::string title, Style style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of `of`; `unit` names them ("frame"), or is empty for a share alone.
  void update(double done, double of, const std::string& unit);

  /// Removes the bar, so that what is printed next starts on a clean line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double done, double of, const std::string& unit, double elapsed_s);
  void print_line(double done, double of, const std::string& unit, double elapsed_s);

  std::string title_;
  bool quiet_ = false;
  bool terminal_ = false;
  bool drawn_ = false;
  bool ended_ = false;
  Clock::time_point started_ = Clock::now();
  Clock::time_point shown_{};
};

/// "3 s", "2 min 05 s", "1 h 02 min".
std::string duration_text(double seconds);

/// The bar itself, without colours: `[########------------]`.
std::string bar_text(double share, int cells);

}  // namespace focalstage
