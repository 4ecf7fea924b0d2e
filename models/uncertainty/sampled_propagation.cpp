#include "models/uncertainty/sampled_propagation.h"

#include "models/uncertainty/sobol_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kReplicates = 8;

// Points and answers of one replicate: two independent samples A and B, and A with one input of B each.
struct Replicate {
  MatrixXd points;   // A, B, then A with the first input from B, ...
  MatrixXd answers;  // one row for each point
};

MatrixXd points_of(Index n_points, const std::vector<UncertainInput>& inputs, std::uint64_t seed) {
  const std::vector<Index> first = first_deviates(inputs);
  const Index count = first.back();
  const MatrixXd cube = shifted(sobol_points(n_points, 2 * count), seed);
  const MatrixXd a = deviates_from(cube.leftCols(count), inputs);
  const MatrixXd b = deviates_from(cube.rightCols(count), inputs);
  MatrixXd all(n_points * static_cast<Index>(inputs.size() + 2), count);
  all.topRows(n_points) = a;
  all.middleRows(n_points, n_points) = b;
  for (std::size_t g = 0; g < inputs.size(); ++g) {
    auto block = all.middleRows(n_points * static_cast<Index>(g + 2), n_points);
    block = a;
    block.middleCols(first[g], inputs[g].n_deviates) = b.middleCols(first[g], inputs[g].n_deviates);
  }
  return all;
}

// Sums over the pairs of points that both have an answer.
struct PairMoments {
  double sum = 0.0;
  Index n = 0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum += value;
    ++n;
  }
  double mean() const { return n > 0 ? sum / static_cast<double>(n) : 0.0; }
};

// Variance of one result and what each input contributes, of one replicate. `linear` holds the linear
// answer at the same points about 0.
struct Variances {
  double variance = 0.0;
  std::vector<double> alone, with_others;
};

Variances variances_of(const VectorXd& answer, const VectorXd& linear, double center,
                       Index n_points, const std::vector<double>& linear_variance) {
  const auto y = [&](Index block, Index i) { return answer[block * n_points + i] - center; };
  const auto l = [&](Index block, Index i) { return linear[block * n_points + i]; };
  double whole = 0.0;
  for (const double part : linear_variance) whole += part;
  PairMoments mean;
  for (Index i = 0; i < n_points; ++i) {
    mean.add(y(0, i) - l(0, i));
    mean.add(y(1, i) - l(1, i));
  }
  const double offset = mean.mean();
  const auto z = [&](Index block, Index i) { return y(block, i) - offset; };
  PairMoments excess;
  for (Index block : {0, 1}) {
    for (Index i = 0; i < n_points; ++i) {
      excess.add(z(block, i) * z(block, i) - l(block, i) * l(block, i));
    }
  }
  Variances out{whole + excess.mean(), {}, {}};
  for (std::size_t g = 0; g < linear_variance.size(); ++g) {
    const auto mixed = static_cast<Index>(g + 2);
    PairMoments alone, with_others;
    for (Index i = 0; i < n_points; ++i) {
      alone.add(z(1, i) * z(mixed, i) - l(1, i) * l(mixed, i));
      with_others.add(0.5 *
                      (std::pow(z(0, i) - z(mixed, i), 2) - std::pow(l(0, i) - l(mixed, i), 2)));
    }
    out.alone.push_back(linear_variance[g] + alone.mean());
    out.with_others.push_back(linear_variance[g] + with_others.mean());
  }
  return out;
}

struct MeanAndError {
  double mean = 0.0, error = 0.0;
};
MeanAndError mean_and_error(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  MeanAndError out;
  for (const double value : values) out.mean += value / n;
  for (const double value : values) out.error += std::pow(value - out.mean, 2);
  out.error = std::sqrt(out.error / (n * (n - 1.0)));
  return out;
}

// Mean, deviation and interval of one result from the samples A and B of all replicates.
void summarise(const std::vector<Replicate>& replicates, Index result, Index n_points,
               SampledResult& out) {
  std::vector<double> all, low, high;
  for (const Replicate& one : replicates) {
    std::vector<double> sample;
    for (Index i = 0; i < 2 * n_points; ++i) {
      if (std::isfinite(one.answers(i, result))) sample.push_back(one.answers(i, result));
    }
    all.insert(all.end(), sample.begin(), sample.end());
    const Interval interval = middle_95(sample);
    low.push_back(interval.low);
    high.push_back(interval.high);
  }
  out.interval_95 = middle_95(all);
  out.end_error = std::max(mean_and_error(low).error, mean_and_error(high).error);
  for (const double value : all) out.mean += value / static_cast<double>(all.size());
}

void find_shares(const std::vector<Replicate>& replicates, const LinearAnswer& linear, Index result,
                 const std::vector<double>& linear_variance, Index n_points, SampledResult& out) {
  std::vector<Variances> found;
  std::vector<double> variance;
  for (const Replicate& one : replicates) {
    const VectorXd about_0 = one.points * linear.slope.row(result).transpose();
    found.push_back(variances_of(one.answers.col(result), about_0, linear.value[result], n_points,
                                 linear_variance));
    variance.push_back(found.back().variance);
  }
  const double whole = mean_and_error(variance).mean;
  out.deviation = std::sqrt(std::max(0.0, whole));
  for (std::size_t g = 0; g < linear_variance.size(); ++g) {
    std::vector<double> alone, with_others;
    for (const Variances& one : found) {
      alone.push_back(whole > 0.0 ? one.alone[g] / whole : 0.0);
      with_others.push_back(whole > 0.0 ? one.with_others[g] / whole : 0.0);
    }
    const MeanAndError first = mean_and_error(alone);
    out.shares.push_back({first.mean, mean_and_error(with_others).mean, first.error});
  }
}

}  // namespace

SampledAnswer sampled_answer(const BatchFunction& function,
                             const std::vector<UncertainInput>& inputs, const LinearAnswer& linear,
                             const SamplingOptions& options) {
  constexpr Index kFewest = 8;  // points of a replicate, in A and in B
  const auto blocks = static_cast<Index>(inputs.size() + 2);
  const Index n_points =
      std::max(kFewest, static_cast<Index>(options.n_answers) / (blocks * kReplicates));
  MatrixXd points(n_points * blocks * kReplicates, count_deviates(inputs));
  for (Index k = 0; k < kReplicates; ++k) {
    points.middleRows(k * n_points * blocks, n_points * blocks) =
        points_of(n_points, inputs, options.seed + static_cast<std::uint64_t>(k));
  }
  const MatrixXd answers = function(points);
  SampledAnswer out;
  out.n_answers = static_cast<std::size_t>(points.rows());
  for (Index i = 0; i < answers.rows(); ++i) out.n_failed += answers.row(i).allFinite() ? 0 : 1;
  if (2 * out.n_failed > out.n_answers) {
    throw std::runtime_error("more than half of the points have no answer");
  }
  std::vector<Replicate> replicates;
  for (Index k = 0; k < kReplicates; ++k) {
    const Index from = k * n_points * blocks;
    replicates.push_back(
        {points.middleRows(from, n_points * blocks), answers.middleRows(from, n_points * blocks)});
  }
  const std::vector<Index> first = first_deviates(inputs);
  for (Index r = 0; r < answers.cols(); ++r) {
    std::vector<double> linear_variance;
    for (std::size_t g = 0; g < inputs.size(); ++g) {
      linear_variance.push_back(
          linear.slope.row(r).segment(first[g], inputs[g].n_deviates).squaredNorm());
    }
    SampledResult result;
    summarise(replicates, r, n_points, result);
    find_shares(replicates, linear, r, linear_variance, n_points, result);
    out.results.push_back(std::move(result));
  }
  return out;
}

}  // namespace viscard
