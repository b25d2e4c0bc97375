#pragma once

#include <cstddef>
#include <vector>

namespace focalstage {

/// Where two things look alike (the point of subjective equality), from answers of two kinds.
struct EqualityEstimate {
  double value = 0.0;        ///< the level at which either answer is as likely
  double uncertainty = 0.0;  ///< one standard deviation of it
  double spread = 0.0;       ///< standard deviation of the person's own noise, in levels' units
  int answers = 0;
  bool inside = false;  ///< the value lies within the levels by its uncertainty and more
};

/// Asks at which of some levels two things look alike, in as few answers as it can (the psi method): each is "above"
/// (the level seems higher than that point) or not. An answer is taken to be "above" with the share that a normal
/// distribution about the point has below the level, but for one answer in twenty-five, which is a slip of the hand to
/// either side. What is known is a distribution over point and spread (even in the point, even in the logarithm of the
/// spread); the level asked next is that after which the point's variance is least to be expected (after Kontsevich and
/// Tyler 1999, with variance in place of entropy). No chance in it: the same answers give the same levels.
class EqualitySearch {
 public:
  /// `levels` rise; three at least.
  explicit EqualitySearch(std::vector<double> levels);

  std::size_t next() const;  ///< the index of the level to show
  void take(std::size_t level, bool above);
  EqualityEstimate estimate() const;

 private:
  std::size_t cells() const { return points_.size() * spreads_.size(); }

  std::vector<double> levels_;
  std::vector<double> points_;
  std::vector<double> spreads_;
  std::vector<double> weight_;  ///< [spread][point], sums to 1
  std::vector<double> above_;   ///< [level][spread][point]: how likely that answer is
  int answers_ = 0;
};

}  // namespace focalstage
