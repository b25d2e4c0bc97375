#include "editor/cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace focalstage {
namespace {

constexpr std::chrono::milliseconds bar_interval{80};
constexpr std::chrono::milliseconds line_interval{2000};
constexpr int least_bar_cells = 10;
constexpr int most_bar_cells = 30;

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string count_text(double done, double of, const std::string& unit) {
  if (unit.empty()) return "";
  char text[96];
  std::snprintf(text, sizeof text, "  %s %.0f of %.0f", unit.c_str(), done, of);
  return text;
}

std::string left_text(double done, double of, double elapsed_s) {
  if (done <= 0.0 || done >= of || elapsed_s < 0.3) return "";
  return "  " + duration_text(elapsed_s * (of - done) / done) + " left";
}

}  // namespace

std::string duration_text(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  char text[64];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

std::string bar_text(double share, int cells) {
  const int full = static_cast<int>(std::floor(std::clamp(share, 0.0, 1.0) * cells + 1e-9));
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(cells - full), '-') + "]";
}

Progress::Progress(std::string title, Style style)
    : title_(std::move(title)), quiet_(style == Style::quiet), terminal_(isatty(STDERR_FILENO) == 1) {
  if (!terminal_) shown_ = started_;  // what is quickly done needs no lines
}

Progress::~Progress() { clear(); }

void Progress::update(double done, double of, const std::string& unit) {
  if (quiet_ || ended_ || of <= 0.0) return;
  const auto now = Clock::now();
  ended_ = done >= of;
  const bool last = ended_;
  const auto interval = terminal_ ? bar_interval : line_interval;
  const bool quickly_done = last && !terminal_ && shown_ == started_;
  if (quickly_done || (!last && now - shown_ < interval)) return;
  shown_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - started_).count();
  if (terminal_) {
    draw_bar(done, of, unit, elapsed_s);
  } else {
    print_line(done, of, unit, elapsed_s);
  }
}

void Progress::draw_bar(double done, double of, const std::string& unit, double elapsed_s) {
  const double share = done / of;
  char percent[16];
  std::snprintf(percent, sizeof percent, " %3.0f %%", std::floor(100.0 * share));
  const std::string start = title_ + "  ";
  const std::string end = percent + count_text(done, of, unit) + left_text(done, of, elapsed_s);
  const int room = terminal_columns() - 1 - static_cast<int>(start.size() + end.size()) - 2;
  std::string line = start + bar_text(share, std::clamp(room, least_bar_cells, most_bar_cells)) + end;
  line.resize(std::min(line.size(), static_cast<std::size_t>(terminal_columns() - 1)));
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::print_line(double done, double of, const std::string& unit, double elapsed_s) {
  std::fprintf(stderr, "%s: %.0f %%%s%s\n", title_.c_str(), std::floor(100.0 * done / of),
               count_text(done, of, unit).c_str(), done >= of ? "" : left_text(done, of, elapsed_s).c_str());
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace focalstage
