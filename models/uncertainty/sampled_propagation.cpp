#include "models/uncertainty/sampled_propagation.h"

#include "models/uncertainty/sample_polynomial.h"
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

// One replicate: two independent samples A and B, then A with the first input from B, and so on. One row
// for each point.
struct Replicate {
  MatrixXd answers;
  MatrixXd polynomial;  // fitted to the answers, about its mean
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

// Mean over the pairs of points that both have an answer.
struct PairMean {
  double sum = 0.0;
  Index n = 0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum += value;
    ++n;
  }
  double mean() const { return n > 0 ? sum / static_cast<double>(n) : 0.0; }
};

// Variance of one result, and what each input contributes alone and with others.
struct Variances {
  double variance = 0.0;
  std::vector<double> alone, with_others;
};

// Of one replicate, with a polynomial whose variances are known as control variate. `answer` and
// `polynomial` hold both at the points of the replicate, each about its mean.
Variances variances_of(const VectorXd& answer, const VectorXd& polynomial, Index n_points,
                       const Variances& known) {
  const auto y = [&](Index block, Index i) { return answer[block * n_points + i]; };
  const auto l = [&](Index block, Index i) { return polynomial[block * n_points + i]; };
  PairMean excess;
  for (const Index block : {0, 1}) {
    for (Index i = 0; i < n_points; ++i) {
      excess.add(y(block, i) * y(block, i) - l(block, i) * l(block, i));
    }
  }
  Variances out{known.variance + excess.mean(), known.alone, known.with_others};
  for (std::size_t g = 0; g < known.alone.size(); ++g) {
    const auto mixed = static_cast<Index>(g + 2);
    PairMean alone, with_others;
    for (Index i = 0; i < n_points; ++i) {
      alone.add(y(1, i) * (y(mixed, i) - y(0, i)) - l(1, i) * (l(mixed, i) - l(0, i)));
      with_others.add(0.5 *
                      (std::pow(y(0, i) - y(mixed, i), 2) - std::pow(l(0, i) - l(mixed, i), 2)));
    }
    out.alone[g] += alone.mean();
    out.with_others[g] += with_others.mean();
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
  std::vector<std::vector<double>> samples(replicates.size());
  std::vector<double> all;
  for (std::size_t k = 0; k < replicates.size(); ++k) {
    const MatrixXd& answers = replicates[k].answers;
    for (Index i = 0; i < 2 * n_points; ++i) {
      if (std::isfinite(answers(i, result))) samples[k].push_back(answers(i, result));
    }
    all.insert(all.end(), samples[k].begin(), samples[k].end());
  }
  const double n = 2.0 * static_cast<double>(n_points) * static_cast<double>(replicates.size());
  out.failed_share = 1.0 - static_cast<double>(all.size()) / n;
  out.interval_95 = middle_95(all, out.failed_share);
  std::vector<double> low, high;
  for (const std::vector<double>& sample : samples) {
    const Interval interval = middle_95(sample, out.failed_share);
    low.push_back(interval.low);
    high.push_back(interval.high);
  }
  if (std::isfinite(out.interval_95.low)) {
    out.end_error = std::max(mean_and_error(low).error, mean_and_error(high).error);
  }
  for (const double value : all) out.mean += value / static_cast<double>(all.size());
}

// The contributions of the polynomial itself.
Variances known_variances(const SamplePolynomial& polynomial, Index result, std::size_t n_inputs) {
  Variances known{0.0, std::vector<double>(n_inputs, 0.0), std::vector<double>(n_inputs, 0.0)};
  for (std::size_t k = 0; k < polynomial.terms.size(); ++k) {
    const PolynomialTerm& term = polynomial.terms[k];
    const double square = std::pow(polynomial.coefficients(static_cast<Index>(k), result), 2);
    known.variance += square;
    known.with_others[term.first_input] += square;
    if (term.first_input == term.second_input) {
      known.alone[term.first_input] += square;
    } else {
      known.with_others[term.second_input] += square;
    }
  }
  return known;
}

void find_shares(const std::vector<Replicate>& replicates, const SamplePolynomial& polynomial,
                 Index result, std::size_t n_inputs, Index n_points, SampledResult& out) {
  const Variances known = known_variances(polynomial, result, n_inputs);
  std::vector<Variances> found;
  std::vector<double> variance;
  for (const Replicate& one : replicates) {
    const VectorXd about_mean = one.answers.col(result).array() - polynomial.mean[result];
    found.push_back(variances_of(about_mean, one.polynomial.col(result), n_points, known));
    variance.push_back(found.back().variance);
  }
  const double whole = mean_and_error(variance).mean;
  out.deviation = std::sqrt(std::max(0.0, whole));
  for (std::size_t g = 0; g < n_inputs; ++g) {
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
                             const std::vector<UncertainInput>& inputs,
                             const SamplingOptions& options) {
  constexpr Index kFewest = 8;  // points of a replicate, in A and in B
  const auto blocks = static_cast<Index>(inputs.size() + 2);
  const Index n_points =
      std::max(kFewest, static_cast<Index>(options.n_answers) / (blocks * kReplicates));
  const Index of_one = n_points * blocks;
  MatrixXd points(of_one * kReplicates, count_deviates(inputs));
  for (Index k = 0; k < kReplicates; ++k) {
    points.middleRows(k * of_one, of_one) =
        points_of(n_points, inputs, options.seed + static_cast<std::uint64_t>(k));
  }
  const MatrixXd answers = function(points);
  SampledAnswer out;
  out.n_answers = static_cast<std::size_t>(points.rows());
  for (Index i = 0; i < answers.rows(); ++i) out.n_failed += answers.row(i).allFinite() ? 0 : 1;
  if (2 * out.n_failed > out.n_answers) {
    throw std::runtime_error("more than half of the points have no answer");
  }
  const SamplePolynomial polynomial = fitted_polynomial(points, answers, inputs);
  const MatrixXd smooth = values_of(polynomial, points);
  std::vector<Replicate> replicates;
  for (Index k = 0; k < kReplicates; ++k) {
    replicates.push_back(
        {answers.middleRows(k * of_one, of_one), smooth.middleRows(k * of_one, of_one)});
  }
  for (Index r = 0; r < answers.cols(); ++r) {
    SampledResult result;
    summarise(replicates, r, n_points, result);
    find_shares(replicates, polynomial, r, inputs.size(), n_points, result);
    out.results.push_back(std::move(result));
  }
  return out;
}

}  // namespace viscard
