#include "models/uncertainty/sample_polynomial.h"

#include "models/maths/dense.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// (s^2 - 1)/sqrt(2) of a normal deviate (Hermite), sqrt(5)/2 (s^2 - 1) of a uniform one (Legendre).
double square_factor(bool is_uniform) {
  return is_uniform ? 0.5 * std::sqrt(5.0) : 1.0 / std::numbers::sqrt2;
}

VectorXd values_of_term(const PolynomialTerm& term, const std::vector<bool>& are_uniform,
                        const MatrixXd& points) {
  VectorXd first = points.col(term.first);
  if (term.second < 0) return first;
  if (term.second != term.first) return first.cwiseProduct(points.col(term.second));
  const double factor = square_factor(are_uniform[static_cast<std::size_t>(term.first)]);
  return factor * (first.array().square() - 1.0);
}

MatrixXd columns_of(const std::vector<PolynomialTerm>& terms, const std::vector<bool>& are_uniform,
                    const MatrixXd& points) {
  MatrixXd columns(points.rows(), static_cast<Index>(terms.size()));
  for (std::size_t k = 0; k < terms.size(); ++k) {
    columns.col(static_cast<Index>(k)) = values_of_term(terms[k], are_uniform, points);
  }
  return columns;
}

// As many terms as there are points for.
std::vector<PolynomialTerm> chosen_terms(const std::vector<std::size_t>& input_of, Index n_points) {
  constexpr Index kPointsPerTerm = 4;
  const auto count = static_cast<Index>(input_of.size());
  const auto input = [&](Index d) { return input_of[static_cast<std::size_t>(d)]; };
  std::vector<PolynomialTerm> terms;
  for (Index d = 0; d < count; ++d) terms.push_back({d, -1, input(d), input(d)});
  if (n_points < 2 * kPointsPerTerm * count) return terms;
  for (Index d = 0; d < count; ++d) terms.push_back({d, d, input(d), input(d)});
  if (n_points < kPointsPerTerm * (2 * count + count * (count - 1) / 2)) return terms;
  for (Index a = 0; a < count; ++a) {
    for (Index b = a + 1; b < count; ++b) terms.push_back({a, b, input(a), input(b)});
  }
  return terms;
}

}  // namespace

SamplePolynomial fitted_polynomial(const MatrixXd& points, const MatrixXd& answers,
                                   const std::vector<UncertainInput>& inputs) {
  SamplePolynomial out;
  std::vector<std::size_t> input_of;
  for (std::size_t g = 0; g < inputs.size(); ++g) {
    const auto n = static_cast<std::size_t>(inputs[g].n_deviates);
    input_of.insert(input_of.end(), n, g);
    out.are_uniform.insert(out.are_uniform.end(), n, inputs[g].is_uniform);
  }
  std::vector<Index> rows;
  for (Index i = 0; i < answers.rows(); ++i) {
    if (answers.row(i).allFinite()) rows.push_back(i);
  }
  MatrixXd good_points(static_cast<Index>(rows.size()), points.cols());
  MatrixXd good_answers(static_cast<Index>(rows.size()), answers.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    good_points.row(static_cast<Index>(i)) = points.row(rows[i]);
    good_answers.row(static_cast<Index>(i)) = answers.row(rows[i]);
  }
  out.terms = chosen_terms(input_of, good_points.rows());
  MatrixXd columns(good_points.rows(), static_cast<Index>(out.terms.size()) + 1);
  columns.col(0).setOnes();
  columns.rightCols(columns.cols() - 1) = columns_of(out.terms, out.are_uniform, good_points);
  // The columns are nearly orthogonal, so that the normal equations lose nothing.
  const VectorXd center = good_answers.colwise().mean().transpose();
  const MatrixXd about_center = good_answers.rowwise() - center.transpose();
  const MatrixXd found =
      Cholesky(columns.transpose() * columns).solve(MatrixXd(columns.transpose() * about_center));
  out.mean = center + found.row(0).transpose();
  out.coefficients = found.bottomRows(found.rows() - 1);
  return out;
}

MatrixXd values_of(const SamplePolynomial& polynomial, const MatrixXd& points) {
  return columns_of(polynomial.terms, polynomial.are_uniform, points) * polynomial.coefficients;
}

}  // namespace viscard
