#include "models/uncertainty/linear_propagation.h"

#include "models/maths/interval.h"
#include "models/uncertainty/sobol_points.h"
#include "models/uncertainty/uncertain_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirstStep = 0.25;  // standard deviations
constexpr int kLevels = 6;           // the smallest step is 0.25/32

std::vector<bool> uniform_deviates(const std::vector<UncertainInput>& inputs) {
  std::vector<bool> all;
  for (const UncertainInput& input : inputs) {
    all.insert(all.end(), static_cast<std::size_t>(input.n_deviates), input.is_uniform);
  }
  return all;
}

MatrixXd answers_at(const BatchFunction& function, const MatrixXd& points, LinearAnswer& answer) {
  answer.n_answers += static_cast<std::size_t>(points.rows());
  return function(points);
}

// Ridders' tableau of one derivative of all results.
struct Tableau {
  std::vector<VectorXd> last_row;
  VectorXd best, error;
};

// Adds the central difference of the next smaller step.
void extrapolate(const VectorXd& difference, Tableau& tableau) {
  std::vector<VectorXd> row{difference};
  double power = 4.0;  // the error of a central difference falls by 4 as the step is halved
  for (const VectorXd& before : tableau.last_row) {
    row.push_back(row.back() + (row.back() - before) / (power - 1.0));
    power *= 4.0;
  }
  if (tableau.last_row.empty()) {
    tableau.best = difference;
    tableau.error = VectorXd::Constant(difference.size(), std::numeric_limits<double>::infinity());
  }
  for (std::size_t k = 1; k < row.size(); ++k) {
    for (Index r = 0; r < difference.size(); ++r) {
      const double error = std::max(std::abs(row[k][r] - row[k - 1][r]),
                                    std::abs(row[k][r] - tableau.last_row[k - 1][r]));
      if (!(error < tableau.error[r])) continue;
      tableau.error[r] = error;
      tableau.best[r] = row[k][r];
    }
  }
  tableau.last_row = std::move(row);
}

void take_slopes(const std::vector<Tableau>& tableaus, const std::vector<Index>& deviates,
                 LinearAnswer& answer) {
  for (const Index d : deviates) {
    answer.slope.col(d) = tableaus[static_cast<std::size_t>(d)].best;
    answer.slope_error.col(d) = tableaus[static_cast<std::size_t>(d)].error;
  }
}

// Those of the deviates whose derivatives are not settled. Rounding limits what a difference can show.
std::vector<Index> unsettled(const LinearAnswer& answer, const std::vector<Index>& deviates,
                             double tolerance) {
  constexpr double kRounding = 1e-12;
  const VectorXd allowed =
      (tolerance * standard_uncertainty(answer)).cwiseMax(kRounding * answer.value.cwiseAbs());
  std::vector<Index> left;
  for (const Index d : deviates) {
    if ((answer.slope_error.col(d).array() > allowed.array()).any()) left.push_back(d);
  }
  return left;
}

// Derivatives by these deviates. Returns those by which the function has none, because it has no answer at
// a point near 0.
std::vector<Index> find_slopes(const BatchFunction& function, const std::vector<Index>& deviates,
                               double tolerance, LinearAnswer& answer) {
  const Index count = answer.slope.cols();
  std::vector<Tableau> tableaus(static_cast<std::size_t>(count));
  std::vector<Index> left = deviates, taken, lost;
  double step = kFirstStep;
  for (int level = 0; level < kLevels && !left.empty(); ++level, step *= 0.5) {
    const auto n = static_cast<Index>(left.size());
    MatrixXd points = MatrixXd::Zero(2 * n, count);
    for (Index i = 0; i < n; ++i) {
      points(2 * i, left[static_cast<std::size_t>(i)]) = step;
      points(2 * i + 1, left[static_cast<std::size_t>(i)]) = -step;
    }
    const MatrixXd found = answers_at(function, points, answer);
    taken.clear();
    for (Index i = 0; i < n; ++i) {
      const Index d = left[static_cast<std::size_t>(i)];
      if (!found.middleRows(2 * i, 2).allFinite()) {
        lost.push_back(d);
        continue;
      }
      taken.push_back(d);
      const VectorXd difference = (found.row(2 * i) - found.row(2 * i + 1)) / (2.0 * step);
      extrapolate(difference, tableaus[static_cast<std::size_t>(d)]);
    }
    take_slopes(tableaus, taken, answer);
    left = level > 0 ? unsettled(answer, taken, tolerance) : taken;
  }
  return lost;
}

// Whether the first-order function has the answer's value. Solvers that iterate agree to
// about 1e-8.
bool has_value_of(const LinearAnswer& answer, const VectorXd& value, const VectorXd& value_errors) {
  constexpr double kSameValue = 1e-6;  // relative
  VectorXd allowed = kSameValue * answer.value.cwiseAbs();
  if (value_errors.size() > 0) allowed = allowed.cwiseMax(value_errors);
  const VectorXd off = (value - answer.value).cwiseAbs();
  return (off.array() <= allowed.array()).all();
}

// Takes what derivatives it can from first-order answers; returns the deviates that are left.
std::vector<Index> find_first_order_slopes(const BatchFunction& first_order,
                                           const std::vector<Index>& deviates, double tolerance,
                                           const VectorXd& value_errors, LinearAnswer& answer) {
  const std::size_t before = answer.n_answers;
  const MatrixXd zero = MatrixXd::Zero(1, answer.slope.cols());
  std::vector<Index> left = deviates;
  const VectorXd value = answers_at(first_order, zero, answer).row(0).transpose();
  if (has_value_of(answer, value, value_errors)) {
    left = find_slopes(first_order, deviates, tolerance, answer);
    // Where the mesh jumps between two points the differences of its answers do not settle.
    constexpr double kSettled = 1e-4;  // of the standard uncertainty
    for (const Index d : unsettled(answer, deviates, std::max(tolerance, kSettled))) {
      if (std::find(left.begin(), left.end(), d) == left.end()) left.push_back(d);
    }
  }
  answer.n_first_order = answer.n_answers - before;
  for (const Index d : deviates) {
    answer.by_solver[static_cast<std::size_t>(d)] =
        std::find(left.begin(), left.end(), d) == left.end();
  }
  return left;
}

// Each input at either end of its interval, then the points where each linear result has its ends.
MatrixXd end_points(const LinearAnswer& answer, const std::vector<bool>& are_uniform) {
  const Index count = answer.slope.cols(), n_results = answer.slope.rows();
  MatrixXd points = MatrixXd::Zero(2 * (count + n_results), count);
  for (Index d = 0; d < count; ++d) {
    points(2 * d, d) = kNormal95;
    points(2 * d + 1, d) = -kNormal95;
  }
  const VectorXd deviation = standard_uncertainty(answer);
  for (Index r = 0; r < n_results; ++r) {
    if (!(deviation[r] > 0.0)) continue;
    const Index row = 2 * (count + r);
    points.row(row) = kNormal95 * answer.slope.row(r) / deviation[r];
    points.row(row + 1) = -points.row(row);
  }
  for (Index d = 0; d < count; ++d) {
    if (!are_uniform[static_cast<std::size_t>(d)]) continue;
    points.col(d) =
        points.col(d).cwiseMax(-kLargestUniformDeviate).cwiseMin(kLargestUniformDeviate);
  }
  return points;
}

// A point without an answer disagrees without limit.
void find_disagreement(const BatchFunction& function, const std::vector<bool>& are_uniform,
                       LinearAnswer& answer) {
  answer.ends = end_points(answer, are_uniform);
  answer.at_ends = answers_at(function, answer.ends, answer);
  const MatrixXd& points = answer.ends;
  const MatrixXd& found = answer.at_ends;
  const MatrixXd linear = (points * answer.slope.transpose()).rowwise() + answer.value.transpose();
  answer.disagreement = VectorXd::Zero(answer.value.size());
  for (Index r = 0; r < answer.value.size(); ++r) {
    for (Index i = 0; i < points.rows(); ++i) {
      const double difference = std::abs(found(i, r) - linear(i, r));
      answer.disagreement[r] = std::isfinite(difference)
                                   ? std::max(answer.disagreement[r], difference)
                                   : std::numeric_limits<double>::infinity();
    }
  }
}

}  // namespace

LinearAnswer linear_slopes(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           double tolerance, const BatchFunction& first_order,
                           const VectorXd& value_errors) {
  const Index count = count_deviates(inputs);
  LinearAnswer answer;
  answer.value = answers_at(function, MatrixXd::Zero(1, count), answer).row(0);
  if (!answer.value.allFinite()) {
    throw std::runtime_error("the answer does not exist with the values that are given");
  }
  answer.slope = MatrixXd::Zero(answer.value.size(), count);
  answer.slope_error = answer.slope;
  answer.by_solver.assign(static_cast<std::size_t>(count), false);
  std::vector<Index> deviates(static_cast<std::size_t>(count));
  std::iota(deviates.begin(), deviates.end(), Index{0});
  if (first_order) {
    deviates = find_first_order_slopes(first_order, deviates, tolerance, value_errors, answer);
  }
  if (!find_slopes(function, deviates, tolerance, answer).empty()) {
    throw std::runtime_error("the answer does not exist close to the values that are given");
  }
  return answer;
}

LinearAnswer linear_answer(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           double tolerance, const BatchFunction& first_order,
                           const VectorXd& value_errors) {
  LinearAnswer answer = linear_slopes(function, inputs, tolerance, first_order, value_errors);
  find_disagreement(function, uniform_deviates(inputs), answer);
  return answer;
}

VectorXd standard_uncertainty(const LinearAnswer& answer) {
  return answer.slope.rowwise().norm();
}

MatrixXd variance_shares(const LinearAnswer& answer, const std::vector<UncertainInput>& inputs) {
  const std::vector<Index> first = first_deviates(inputs);
  MatrixXd shares = MatrixXd::Zero(answer.slope.rows(), static_cast<Index>(inputs.size()));
  for (Index r = 0; r < shares.rows(); ++r) {
    const double variance = answer.slope.row(r).squaredNorm();
    if (!(variance > 0.0)) continue;
    for (Index g = 0; g < shares.cols(); ++g) {
      const auto at = static_cast<std::size_t>(g);
      shares(r, g) =
          answer.slope.row(r).segment(first[at], inputs[at].n_deviates).squaredNorm() / variance;
    }
  }
  return shares;
}

std::vector<Interval> intervals_95(const LinearAnswer& answer,
                                   const std::vector<UncertainInput>& inputs) {
  std::vector<Interval> intervals;
  const bool are_normal = std::none_of(inputs.begin(), inputs.end(),
                                       [](const UncertainInput& i) { return i.is_uniform; });
  if (are_normal) {
    const VectorXd deviation = standard_uncertainty(answer);
    for (Index r = 0; r < answer.value.size(); ++r) {
      const double half = kNormal95 * deviation[r];
      intervals.push_back({answer.value[r] - half, answer.value[r] + half});
    }
    return intervals;
  }
  constexpr Index kPoints = 1 << 14;
  const MatrixXd points = deviates_from(sobol_points(kPoints, answer.slope.cols()), inputs);
  const MatrixXd spread = points * answer.slope.transpose();
  for (Index r = 0; r < answer.value.size(); ++r) {
    std::vector<double> sample(spread.col(r).begin(), spread.col(r).end());
    const Interval around = middle_95(sample);
    intervals.push_back({answer.value[r] + around.low, answer.value[r] + around.high});
  }
  return intervals;
}

}  // namespace viscard
