#include "fit/assembly/test_agreement.h"

#include "fit/search/separable.h"
#include "models/maths/dense.h"
#include "models/maths/distributions.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The rows of all tests and one row for each prior, as the answer leaves them.
struct Residual {
  Eigen::VectorXd left;
  Eigen::MatrixXd basis;  // residual after projection on what the parameters can describe
};

// own: columns of one test, from this row on, that count as further parameters.
Residual residual_of(const JointModel& model, const SpectralState& state, Index first_row,
                     const Eigen::MatrixXd& own) {
  const Index priors = model.n_nuisances(), rows = model.n_rows();
  Eigen::MatrixXd jacobian = full_jacobian(model, state);
  const Index n_parameters = jacobian.cols();
  jacobian.conservativeResize(rows + priors, Eigen::NoChange);
  jacobian.bottomRows(priors).setZero();
  jacobian.bottomRightCorner(priors, priors).diagonal() = model.prior_weight();
  jacobian.conservativeResize(Eigen::NoChange, n_parameters + own.cols());
  jacobian.rightCols(own.cols()).setZero();
  jacobian.block(first_row, n_parameters, own.rows(), own.cols()) = own;
  for (Index j = 0; j < jacobian.cols(); ++j) {
    const double norm = jacobian.col(j).norm();
    if (norm > 0.0) jacobian.col(j) /= norm;
  }
  Residual of;
  of.basis = PivotedQr(jacobian).basis();
  of.left.resize(rows + priors);
  of.left << model.data() - model.fitted(state), -model.prior_residual(state.nuisance);
  return of;
}

// A parabola in log time: 1, u, u^2 of each row, with u from -1 to 1.
Eigen::MatrixXd powers_of(const Eigen::VectorXd& ln_time) {
  const double middle = 0.5 * (ln_time.maxCoeff() + ln_time.minCoeff());
  const double half = std::max(0.5 * (ln_time.maxCoeff() - ln_time.minCoeff()), 1e-9);
  const Eigen::ArrayXd u = (ln_time.array() - middle) / half;
  Eigen::MatrixXd powers(ln_time.size(), 3);
  powers << Eigen::VectorXd::Ones(u.size()), u.matrix(), u.square().matrix();
  return powers;
}

// Departures of a test from the spectrum that the other tests can reveal.
struct Departures {
  Eigen::MatrixXd shape;  // rows of the test x directions, relative to its values
  Eigen::MatrixXd rows;   // all rows x directions, without what the parameters can do; orthogonal
};

// powers: of log time, as columns for each row of the test.
Departures departures(const Residual& of, Index first_row, const Eigen::VectorXd& value,
                      const Eigen::MatrixXd& powers) {
  constexpr double kTestable = 0.01;  // of the information in the test's own rows
  const Eigen::MatrixXd own = value.asDiagonal() * powers;
  const Cholesky gram(own.transpose() * own);
  const Eigen::MatrixXd unit = gram.over_upper(powers);  // of length one as rows of the test
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(of.left.size(), unit.cols());
  whole.middleRows(first_row, value.size()) = value.asDiagonal() * unit;
  whole -= of.basis * (of.basis.transpose() * whole);
  const EigenSystem system = symmetric_eigen(whole.transpose() * whole);
  Index kept = 0;
  const Index size = system.values.size();
  while (kept < size && system.values[size - 1 - kept] > kTestable) ++kept;
  return {unit * system.vectors.rightCols(kept), whole * system.vectors.rightCols(kept)};
}

struct Estimate {
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
  double freedom = 1.0;  // of the noise
};

Estimate estimate_of(const Departures& of, const Residual& residual,
                     const std::vector<NoiseGroup>& groups, const Eigen::VectorXd& freedom) {
  const Eigen::MatrixXd gram = of.rows.transpose() * of.rows;
  const Eigen::MatrixXd weights = of.rows * gram.diagonal().cwiseInverse().asDiagonal();
  Estimate found;
  found.value = weights.transpose() * residual.left;
  Index n_data = 0;
  for (const NoiseGroup& group : groups) n_data += group.n_rows;
  const Eigen::MatrixXd of_priors = weights.bottomRows(weights.rows() - n_data);
  found.covariance = of_priors.transpose() * of_priors;
  const std::vector<Eigen::MatrixXd> parts = covariance_by_group(weights, groups);
  for (const Eigen::MatrixXd& part : parts) found.covariance += part;
  const Cholesky factor(found.covariance);
  double sum = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double share =
        factor.solve(parts[k]).trace() / static_cast<double>(found.covariance.rows());
    sum += share * share / freedom[static_cast<Index>(k)];
  }
  found.freedom = sum > 0.0 ? 1.0 / sum : 1e9;
  return found;
}

double p_value_of(const Estimate& found) {
  const auto size = static_cast<double>(found.value.size());
  const double square = found.value.dot(Cholesky(found.covariance).solve(found.value));
  return f_upper_tail(square / size, size, found.freedom);
}

// At the time where the departure exceeds its error most.
void find_worst(const Departures& of, const Estimate& found, TestAgreement& agreement) {
  for (Index row = 0; row < of.shape.rows(); ++row) {
    const Eigen::VectorXd at = of.shape.row(row).transpose();
    const double value = at.dot(found.value);
    const double error = std::sqrt(std::max(0.0, at.dot(found.covariance * at)));
    const double beyond = std::abs(value) - kNormal95 * error;
    if (row > 0 && beyond <= agreement.at_least) continue;
    agreement.at_least = beyond;
    agreement.worst = value;
  }
}

TestAgreement agreement_of(std::size_t k, const JointModel& model, const SpectralState& state,
                           const Residual& residual, const std::vector<NoiseGroup>& groups,
                           const Eigen::VectorXd& ln_time, const Eigen::VectorXd& freedom) {
  const Eigen::VectorXd value = model.moduli_part(k, state);
  const Eigen::MatrixXd powers = powers_of(ln_time);
  TestAgreement agreement;
  const Departures all = departures(residual, model.first_row(k), value, powers);
  agreement.freedom = static_cast<int>(all.rows.cols());
  if (agreement.freedom == 0) return agreement;
  const Estimate found = estimate_of(all, residual, groups, freedom);
  find_worst(all, found, agreement);
  agreement.p_value = p_value_of(found);
  const Departures factor = departures(residual, model.first_row(k), value, powers.leftCols(1));
  if (factor.rows.cols() == 0) return agreement;
  const Estimate one = estimate_of(factor, residual, groups, freedom);
  const double per = factor.shape(0, 0);
  const double error = std::abs(per) * std::sqrt(one.covariance(0, 0));
  agreement.difference = per * one.value[0];
  agreement.difference_95 = {agreement.difference - kNormal95 * error,
                             agreement.difference + kNormal95 * error};
  const double p_factor = p_value_of(one);
  const bool is_factor = p_factor < agreement.p_value;
  agreement.p_value = std::min(1.0, 2.0 * std::min(agreement.p_value, p_factor));
  const double beyond = std::abs(agreement.difference) - kNormal95 * error;
  if (is_factor || beyond > agreement.at_least) {
    agreement.at_least = beyond;
    agreement.worst = agreement.difference;
  }
  return agreement;
}

}  // namespace

std::vector<TestAgreement> test_agreement(const JointModel& model, const SpectralState& state,
                                          const std::vector<NoiseGroup>& groups,
                                          const std::vector<Eigen::VectorXd>& ln_time,
                                          const Eigen::VectorXd& freedom,
                                          std::optional<std::size_t> freed) {
  Eigen::MatrixXd own;
  if (freed) own = model.moduli_part(*freed, state).asDiagonal() * powers_of(ln_time[*freed]);
  const Residual residual = residual_of(model, state, freed ? model.first_row(*freed) : 0, own);
  std::vector<TestAgreement> found;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    found.push_back(agreement_of(k, model, state, residual, groups, ln_time[k], freedom));
  }
  return found;
}

}  // namespace viscard
