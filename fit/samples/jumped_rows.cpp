#include "fit/samples/jumped_rows.h"

#include "fit/samples/reading_noise.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kFewestForJumps = 20;
constexpr double kSureJump =
    8.0;  // standard deviations of the noise: never by chance, not in a million rows

double largest_size_of(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

class Jumps {
 public:
  explicit Jumps(std::span<const double> values)
      : values_(values), least_(0.05 * largest_size_of(values)) {}

  double into(std::size_t i) const { return values_[i] - values_[i - 1]; }

  bool is_jump(std::size_t i) const {
    constexpr double kShare = 0.2;
    const double size = std::max(std::abs(values_[i]), std::abs(values_[i - 1]));
    return std::abs(into(i)) > std::max(kShare * size, least_);
  }

  // True if the rows jump away at begin and back at end, and stay away between.
  bool is_block(const RowRun& run) const {
    constexpr double kBack = 0.3, kAway = 0.5;
    const double out = into(run.begin), back = into(run.end);
    if (!(out * back < 0.0)) return false;
    const double gap = std::min(std::abs(out), std::abs(back));
    const double before = values_[run.begin - 1], after = values_[run.end];
    if (std::abs(after - before) > kBack * gap) return false;
    // The rows beside it are no spikes themselves, and no slope.
    constexpr std::size_t kCalm = 3;
    for (std::size_t k = 1; k < kCalm; ++k) {
      if (run.begin > k && std::abs(values_[run.begin - 1 - k] - before) > kAway * gap)
        return false;
      if (run.end + k < values_.size() && std::abs(values_[run.end + k] - after) > kAway * gap)
        return false;
    }
    const double sign = out > 0.0 ? 1.0 : -1.0;
    const double level = out > 0.0 ? std::max(before, after) : std::min(before, after);
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (sign * (values_[i] - level) < kAway * gap) return false;
    }
    return gap > kSureJump * noise_beside(values_, run.begin, run.end);
  }

 private:
  std::span<const double> values_;
  double least_;
};

}  // namespace

std::vector<RowRun> jumped_blocks(std::span<const double> values, const RestsBeside& rests) {
  if (values.size() < kFewestForJumps) return {};
  const Jumps jumps(values);
  std::vector<std::size_t> edges;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (jumps.is_jump(i)) edges.push_back(i);
  }
  // Where noise alone makes steps of a fifth, nothing can be told.
  constexpr std::size_t kMostEdges = 200, kShortest = 2;
  if (edges.size() > kMostEdges) return {};
  const std::size_t longest = values.size() / 4;
  std::vector<RowRun> blocks;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for (std::size_t j = k + 1; j < edges.size() && edges[j] - edges[k] <= longest; ++j) {
      const RowRun run{edges[k], edges[j]};
      if (run.length() < kShortest || !jumps.is_block(run) || !rests(run)) continue;
      blocks.push_back(run);
      k = j;
      break;
    }
  }
  return blocks;
}

std::optional<std::size_t> lost_from(std::span<const double> values, const RestsBeside& rests) {
  constexpr std::size_t kShortest = 2, kBefore = 5;
  constexpr double kAboutZero = 0.1, kTimes = 4.0;
  const std::size_t n = values.size();
  if (n < kFewestForJumps) return std::nullopt;
  double tail = std::abs(values[n - 1]);
  for (std::size_t i = n - 1; i > n / 2 && i > kBefore; --i) {  // the rest begins at row i
    tail = std::max(tail, std::abs(values[i]));
    const double before = std::abs(values[i - 1]);
    if (n - i < kShortest || !(before > 0.0) || tail > kAboutZero * before) continue;
    double steps = 0.0;
    for (std::size_t k = i - kBefore; k < i; ++k) {
      steps = std::max(steps, std::abs(values[k] - values[k - 1]));
    }
    const double step = std::abs(values[i] - values[i - 1]);
    const bool is_sure = step > std::max(kTimes * steps, kSureJump * noise_beside(values, i, n));
    if (is_sure && rests({i, n})) return i;
  }
  return std::nullopt;
}

}  // namespace viscard
