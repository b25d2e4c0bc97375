#include "core/compile/stack_solver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/compile/stack_fields.h"

namespace focalstage {
namespace {

/// Multiplications that one eye and channel may cost, and rounds within them.
constexpr double work_limit = 2.5e10;
constexpr int most_rounds = 40;
constexpr int least_rounds = 6;

/// Light moves only where it helps by more than this: the weight of a change against the error of all focuses.
constexpr double pull = 0.002;

int rounds_for(const StackPlan& plan) {
  double work = 0.0;
  for (const StackTile& tile : plan.tiles) {
    const double once = tile_samples * static_cast<double>(tile.shares.size());
    work += (tile.counted != 0 ? once : 0.0) + (tile.any_free() ? once : 0.0);
  }
  return std::clamp(static_cast<int>(work_limit / std::max(work, 1.0)), least_rounds, most_rounds);
}

bool has(std::uint64_t bits, int i) { return (bits >> i & 1) != 0; }

class Solver {
 public:
  Solver(const StackPlan& plan, const StackProblem& problem, const Kernel& kernel, std::stop_token stop)
      : plan_(plan),
        problem_(problem),
        kernel_(kernel),
        stop_(std::move(stop)),
        tiles_(plan.tiles.size()),
        slices_(plan.slice_count()),
        foci_(plan.focus_count()),
        step_(1.0 / (1.05 * static_cast<double>(slices_ * foci_) + weight())) {}

  StackSolution run() {
    StackSolution out;
    first_ = errors_of_linear();
    const StackField start = first_;
    change_.assign(tiles_ * slices_ * tile_samples, 0.0f);
    ahead_ = change_;
    const int rounds = rounds_for(plan_);
    double momentum = 1.0;
    for (int round = 0; round < rounds && !stop_.stop_requested(); ++round) {
      const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
      see(ahead_);
      const bool uphill = descend((momentum - 1.0) / next);
      momentum = uphill ? 1.0 : next;
      if (uphill) ahead_ = change_;
    }
    see(change_);
    accept(out);
    out.change = std::move(change_);
    return out;
  }

 private:
  double weight() const { return pull * static_cast<double>(foci_); }

  /// What linear filtering leaves to be seen, in the asked cells.
  StackField errors_of_linear() {
    StackField errors = problem_.target;
    each_tile([&](std::size_t slot) {
      float* const cells = &errors[slot * foci_ * tile_samples];
      if (plan_.tiles[slot].asked != 0) see_tile(kernel_, plan_, problem_.linear, slot, -1.0f, cells);
      mask(plan_.tiles[slot].asked, cells);
    });
    return errors;
  }

  void mask(std::uint64_t bits, float* cells) const {
    for (std::size_t k = 0; k < foci_; ++k) {
      for (int i = 0; i < tile_samples; ++i) {
        if (!has(bits, i)) cells[k * tile_samples + static_cast<std::size_t>(i)] = 0.0f;
      }
    }
  }

  /// The errors that a change of the light leaves.
  void see(const StackField& change) {
    errors_.resize(first_.size());
    each_tile([&](std::size_t slot) {
      float* const cells = &errors_[slot * foci_ * tile_samples];
      std::copy_n(&first_[slot * foci_ * tile_samples], foci_ * tile_samples, cells);
      if (plan_.tiles[slot].counted == 0) return;
      see_tile(kernel_, plan_, change, slot, -1.0f, cells);
      mask(plan_.tiles[slot].counted, cells);
    });
  }

  /// One step down from `ahead_`, and a look further along the way that was taken. Whether that way leads up.
  bool descend(double further) {
    std::vector<double> uphill(tiles_, 0.0);
    each_tile([&](std::size_t slot) {
      const StackTile& tile = plan_.tiles[slot];
      if (!tile.any_free()) return;
      thread_local std::vector<float> down;
      down.assign(slices_ * tile_samples, 0.0f);
      trace_back_tile(kernel_, plan_, errors_, slot, down.data());
      for (std::size_t n = 0; n < slices_; ++n) {
        for (int i = 0; i < tile_samples; ++i) {
          if (!has(tile.free[n], i)) continue;
          const std::size_t local = n * tile_samples + static_cast<std::size_t>(i);
          const std::size_t at = slot * slices_ * tile_samples + local;
          const double from = ahead_[at];
          const double wanted = from + step_ * (static_cast<double>(down[local]) - weight() * from);
          const double low = -static_cast<double>(problem_.linear[at]);
          const double high = std::max(0.0, static_cast<double>(problem_.most[at]) + low);
          const double now = std::clamp(wanted, low, high);
          const double way = now - change_[at];
          uphill[slot] += (from - now) * way;
          change_[at] = static_cast<float>(now);
          ahead_[at] = static_cast<float>(now + further * way);
        }
      }
    });
    double sum = 0.0;
    for (const double each : uphill) sum += each;
    return sum > 0.0;
  }

  /// Tiles whose light can meet, under one number each.
  std::vector<std::size_t> islands() const {
    std::vector<std::size_t> root(tiles_);
    for (std::size_t i = 0; i < tiles_; ++i) root[i] = i;
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    const int columns = plan_.grid.columns();
    const int rows = plan_.grid.rows();
    for (std::size_t i = 0; i < tiles_; ++i) {
      const StackTile& tile = plan_.tiles[i];
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 1}, std::pair{0, 1}, std::pair{1, 1}}) {
        const int column = tile.column + dx;
        const int row = tile.row + dy;
        if (column < 0 || column >= columns || row >= rows) continue;
        const std::int32_t other = plan_.slot_of[static_cast<std::size_t>(row * columns + column)];
        if (other < 0) continue;
        const std::size_t a = find(i);
        const std::size_t b = find(static_cast<std::size_t>(other));
        root[std::max(a, b)] = std::min(a, b);
      }
    }
    for (std::size_t i = 0; i < tiles_; ++i) root[i] = find(i);
    return root;
  }

  static double sum_of_squares(const float* cells, std::size_t count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += static_cast<double>(cells[i]) * cells[i];
    return sum;
  }

  void accept(StackSolution& out) {
    const std::vector<std::size_t> island = islands();
    const std::size_t cells = foci_ * tile_samples;
    std::vector<double> before(tiles_, 0.0);
    std::vector<double> after(tiles_, 0.0);
    for (std::size_t i = 0; i < tiles_; ++i) {
      before[island[i]] += sum_of_squares(&first_[i * cells], cells);
      after[island[i]] += sum_of_squares(&errors_[i * cells], cells);
    }
    for (std::size_t i = 0; i < tiles_; ++i) {
      const bool better = after[island[i]] < before[island[i]];
      if (better && plan_.tiles[i].asked != 0) ++out.accepted_tiles;
      if (!better) std::fill_n(&change_[i * slices_ * tile_samples], slices_ * tile_samples, 0.0f);
      StackField left(better ? errors_.begin() + static_cast<std::ptrdiff_t>(i * cells)
                             : first_.begin() + static_cast<std::ptrdiff_t>(i * cells),
                      better ? errors_.begin() + static_cast<std::ptrdiff_t>((i + 1) * cells)
                             : first_.begin() + static_cast<std::ptrdiff_t>((i + 1) * cells));
      mask(plan_.tiles[i].asked, left.data());
      out.linear.sum += sum_of_squares(&first_[i * cells], cells);
      out.optimal.sum += sum_of_squares(left.data(), cells);
      const auto count = static_cast<std::size_t>(__builtin_popcountll(plan_.tiles[i].asked)) * foci_;
      out.linear.count += count;
      out.optimal.count += count;
    }
  }

  template <class Work>
  void each_tile(const Work& work) {
    tbb::parallel_for(std::size_t{0}, tiles_, [&](std::size_t slot) {
      if (!stop_.stop_requested()) work(slot);
    });
  }

  const StackPlan& plan_;
  const StackProblem& problem_;
  const Kernel& kernel_;
  std::stop_token stop_;
  std::size_t tiles_;
  std::size_t slices_;
  std::size_t foci_;
  double step_;
  StackField first_;   ///< errors of the linear images
  StackField errors_;  ///< of the light at work
  StackField change_;
  StackField ahead_;
};

}  // namespace

StackSolution solve_stack(const StackPlan& plan, const StackProblem& problem, const Kernel& kernel,
                          std::stop_token stop) {
  return Solver(plan, problem, kernel, std::move(stop)).run();
}

}  // namespace focalstage
