#include "fit/samples/reading_noise.h"

#include "fit/samples/median.h"
#include "fit/samples/noise_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace viscard {
namespace {

// The third difference of white noise has 1 + 9 + 9 + 1 = 20 times its variance.
const double kOfThirdDifference = 1.0 / (kMedianOfNormal * std::sqrt(20.0));

// Sizes of the noise beside sizes of the value.
struct SizesByLevel {
  std::vector<double> level, size;
};

// Variance in a class of values of about the same size.
struct LevelClass {
  double square = 0.0;    // mean square of the value
  double variance = 0.0;  // of the noise, from the median
  double count = 0.0;
};

std::vector<LevelClass> level_classes(const SizesByLevel& scatter, double of_median) {
  constexpr int kClasses = 12;  // each half as large as the one before; the last holds the rest
  constexpr std::size_t kFewest = 12;
  double largest = 0.0;
  for (const double level : scatter.level) largest = std::max(largest, std::abs(level));
  std::array<std::vector<double>, kClasses> sizes;
  std::array<double, kClasses> squares{};
  for (std::size_t i = 0; i < scatter.level.size(); ++i) {
    const double level = std::abs(scatter.level[i]);
    const double halvings = level > 0.0 ? std::log2(largest / level) : kClasses;
    const auto k = static_cast<std::size_t>(std::min(halvings, kClasses - 1.0));
    sizes[k].push_back(scatter.size[i]);
    squares[k] += level * level;
  }
  std::vector<LevelClass> classes;
  for (std::size_t k = 0; k < kClasses; ++k) {
    if (sizes[k].size() < kFewest) continue;
    const auto count = static_cast<double>(sizes[k].size());
    const double sigma = of_median * median(std::move(sizes[k]));
    classes.push_back({squares[k] / count, sigma * sigma, count});
  }
  return classes;
}

// True if the variance of the largest values exceeds that of the smallest by more than chance.
bool is_grown(const std::vector<LevelClass>& classes, double a, double b) {
  // A standard deviation from the median of n correlated third differences is known to about
  // 2/sqrt(n), its squared logarithm to 4/sqrt(n).
  constexpr double kScatter = 4.0, kDeviations = 4.0, kVisible = 1.5;
  const LevelClass &large = classes.front(), &small = classes.back();
  if (!(small.variance > 0.0)) return false;
  const double apart = std::log(large.variance / small.variance);
  const double chance = kScatter * std::sqrt(1.0 / large.count + 1.0 / small.count);
  const double fitted = (a + b * large.square) / (a + b * small.square);
  return apart > kDeviations * chance && fitted > kVisible * kVisible;
}

ReadingNoise noise_of_scatter(const SizesByLevel& scatter, double of_median) {
  const std::vector<LevelClass> classes = level_classes(scatter, of_median);
  if (classes.size() < 2) {
    const double sigma = of_median * median(scatter.size);
    return {sigma, 0.0, false};
  }
  // a + b x with weights count/variance^2 (the variance of a variance), found in a few rounds.
  double a = 0.0, b = 0.0, mean = 0.0, total = 0.0;
  for (const LevelClass& one : classes) {
    mean += one.count * one.variance;
    total += one.count;
  }
  a = mean / total;
  if (!(a > 0.0)) return {};
  const double least = 1e-6 * a;
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
    for (const LevelClass& one : classes) {
      const double expected = std::max(least, a + b * one.square);
      const double weight = one.count / (expected * expected);
      w += weight;
      wx += weight * one.square;
      wy += weight * one.variance;
      wxx += weight * one.square * one.square;
      wxy += weight * one.square * one.variance;
    }
    const double spread = w * wxx - wx * wx;
    if (!(spread > 0.0)) break;
    a = (wxx * wy - wx * wxy) / spread;
    b = (w * wxy - wx * wy) / spread;
    if (b < 0.0) {
      a = wy / w;
      b = 0.0;
    } else if (a < 0.0) {
      a = 0.0;
      b = wxy / wxx;
    }
  }
  // Values far below those of all classes have some noise, too.
  constexpr double kLeastFloor = 0.04;
  double smallest = classes.front().variance;
  for (const LevelClass& one : classes) smallest = std::min(smallest, one.variance);
  a = std::max(a, kLeastFloor * smallest);
  return {std::sqrt(a), std::sqrt(b), is_grown(classes, a, b)};
}

}  // namespace

double ReadingNoise::sigma(double value) const {
  return std::sqrt(variance(value));
}

ReadingNoise reading_noise(std::span<const double> values) {
  // Some thousand differences suffice for the medians: stretches all over a long record, and its
  // begin, where the values are largest and few.
  constexpr std::size_t kStretches = 64, kLength = 128, kFewest = 5;
  if (values.size() < kFewest) return {};
  SizesByLevel scatter;
  const auto add = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 3; i < end; ++i) {
      const double third = values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3];
      scatter.size.push_back(std::abs(third));
      scatter.level.push_back(0.5 * (values[i - 1] + values[i - 2]));
    }
  };
  if (values.size() <= kStretches * kLength) {
    add(0, values.size());
  } else {
    for (std::size_t k = 0; k < kStretches; ++k) {
      const std::size_t begin = (values.size() - kLength) * k / (kStretches - 1);
      add(begin, begin + kLength);
    }
  }
  return noise_of_scatter(scatter, kOfThirdDifference);
}

ReadingNoise noise_of_deviations(std::span<const double> values,
                                 std::span<const double> deviations) {
  constexpr std::size_t kEnough = 16384;
  SizesByLevel scatter;
  for (std::size_t i = 0; i < deviations.size(); i += 1 + deviations.size() / kEnough) {
    scatter.level.push_back(values[i]);
    scatter.size.push_back(std::abs(deviations[i]));
  }
  return noise_of_scatter(scatter, 1.0 / kMedianOfNormal);
}

std::vector<double> relative_sigmas(const ReadingNoise& noise, std::span<const double> values,
                                    std::span<const double> weights) {
  constexpr std::size_t kBeside = 4;
  const std::size_t n = values.size();
  std::vector<double> sigmas(n, 1.0);
  double square = 0.0, total = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0, count = 0.0;
    const std::size_t last = std::min(n, i + kBeside + 1);
    for (std::size_t k = i > kBeside ? i - kBeside : 0; k < last; ++k) {
      if (k == i) continue;
      sum += values[k];
      count += 1.0;
    }
    sigmas[i] = noise.sigma(count > 0.0 ? sum / count : values[i]);
    const double weight = weights.empty() ? 1.0 : weights[i];
    square += weight * sigmas[i] * sigmas[i];
    total += weight;
  }
  const double rms = std::sqrt(square / total);
  if (!(rms > 0.0)) return std::vector<double>(n, 1.0);
  for (double& sigma : sigmas) sigma /= rms;
  return sigmas;
}

double noise_beside(std::span<const double> values, std::size_t begin, std::size_t end) {
  constexpr std::size_t kBeside = 30;
  std::vector<double> sizes;
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from + 3; i < to; ++i) {
      sizes.push_back(
          std::abs(values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3]));
    }
  };
  add(begin > kBeside ? begin - kBeside : 0, begin);
  add(end, std::min(values.size(), end + kBeside));
  return sizes.empty() ? 0.0 : kOfThirdDifference * median(std::move(sizes));
}

}  // namespace viscard
