#include "models/uncertainty/curved_propagation.h"

#include "models/uncertainty/sobol_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kCheckedPoints = 16;
constexpr Index kPropagatedPoints = 1 << 14;

// One result in one of the two forms.
struct Form {
  bool is_logarithm = false;
  double start = 0.0, sign = 1.0;
  VectorXd a, b;

  double value(const VectorXd& z) const {
    const double y = start + a.dot(z) + b.dot(z.cwiseAbs2());
    return is_logarithm ? sign * std::exp(y) : y;
  }
};

// The deviate that alone is not zero at a point, or -1.
Index only_deviate(const MatrixXd& points, Index row) {
  Index found = -1;
  for (Index d = 0; d < points.cols(); ++d) {
    if (points(row, d) == 0.0) continue;
    if (found >= 0) return -1;
    found = d;
  }
  return found;
}

// Takes the curvature by each deviate from the points where it alone is changed: the mean of what each leaves.
Form fitted(const LinearAnswer& linear, Index result, bool is_logarithm) {
  Form form;
  const double at_zero = linear.value[result];
  form.is_logarithm = is_logarithm;
  form.sign = at_zero < 0.0 ? -1.0 : 1.0;
  form.start = is_logarithm ? std::log(std::abs(at_zero)) : at_zero;
  form.a = linear.slope.row(result).transpose();
  if (is_logarithm) form.a /= at_zero;
  form.b = VectorXd::Zero(form.a.size());
  VectorXd count = form.b;
  for (Index i = 0; i < linear.ends.rows(); ++i) {
    const Index d = only_deviate(linear.ends, i);
    if (d < 0) continue;
    const double found = linear.at_ends(i, result);
    const double y = is_logarithm ? std::log(form.sign * found) : found;
    const double z = linear.ends(i, d);
    form.b[d] += (y - form.start - form.a[d] * z) / (z * z);
    count[d] += 1.0;
  }
  for (Index d = 0; d < count.size(); ++d) form.b[d] /= std::max(count[d], 1.0);
  return form;
}

// Largest difference to the function; infinite if a number is missing.
double disagreement_of(const Form& form, const MatrixXd& points, const VectorXd& found) {
  double largest = 0.0;
  for (Index i = 0; i < points.rows(); ++i) {
    const double difference = std::abs(form.value(points.row(i).transpose()) - found[i]);
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

// Variance of b z^2 for z of unit variance: 2 b^2 of a normal deviate, 4/5 b^2 of a uniform one.
double variance_of(double a, double b, bool is_uniform) {
  return a * a + (is_uniform ? 0.8 : 2.0) * b * b;
}

void propagate(const Form& form, const MatrixXd& points, Index result, CurvedAnswer& out) {
  std::vector<double> sample(static_cast<std::size_t>(points.rows()));
  double mean = 0.0;
  for (Index i = 0; i < points.rows(); ++i) {
    sample[static_cast<std::size_t>(i)] = form.value(points.row(i).transpose());
    mean += sample[static_cast<std::size_t>(i)] / static_cast<double>(points.rows());
  }
  double variance = 0.0;
  for (const double one : sample) variance += (one - mean) * (one - mean);
  out.deviation[result] = std::sqrt(variance / static_cast<double>(points.rows() - 1));
  out.intervals_95.push_back(middle_95(std::move(sample)));
}

}  // namespace

CurvedAnswer curved_answer(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           const LinearAnswer& linear) {
  const Index count = linear.slope.cols(), results = linear.value.size();
  // Points that the fit of the forms and their propagation do not use.
  constexpr std::uint64_t kSeed = 51;
  const MatrixXd other = deviates_from(shifted(sobol_points(kCheckedPoints, count), kSeed), inputs);
  MatrixXd points(linear.ends.rows() + kCheckedPoints, count);
  points << linear.ends, other;
  MatrixXd found(points.rows(), results);
  found << linear.at_ends, function(other);
  CurvedAnswer out;
  out.n_answers = static_cast<std::size_t>(kCheckedPoints);
  out.start = out.sign = out.deviation = out.disagreement = VectorXd::Zero(results);
  out.a = out.b = MatrixXd::Zero(results, count);
  out.shares = MatrixXd::Zero(results, static_cast<Index>(inputs.size()));
  const MatrixXd propagated = deviates_from(sobol_points(kPropagatedPoints, count), inputs);
  const std::vector<Index> first = first_deviates(inputs);
  for (Index r = 0; r < results; ++r) {
    Form form = fitted(linear, r, false);
    out.disagreement[r] = disagreement_of(form, points, found.col(r));
    const double size = linear.value[r];
    if (size != 0.0 && (found.col(r).array() / size > 0.0).all()) {
      const Form other_form = fitted(linear, r, true);
      const double other_error = disagreement_of(other_form, points, found.col(r));
      if (other_error < out.disagreement[r]) {
        form = other_form;
        out.disagreement[r] = other_error;
      }
    }
    out.is_logarithm.push_back(form.is_logarithm);
    out.start[r] = form.start;
    out.sign[r] = form.sign;
    out.a.row(r) = form.a.transpose();
    out.b.row(r) = form.b.transpose();
    propagate(form, propagated, r, out);
    for (std::size_t g = 0; g < inputs.size(); ++g) {
      for (Index d = first[g]; d < first[g + 1]; ++d) {
        out.shares(r, static_cast<Index>(g)) +=
            variance_of(form.a[d], form.b[d], inputs[g].is_uniform);
      }
    }
    const double all = out.shares.row(r).sum();
    if (all > 0.0) out.shares.row(r) /= all;
  }
  return out;
}

}  // namespace viscard
