#include "fit/intervals/grouped_covariance.h"

#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"
#include "models/maths/dense.h"

#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The columns of the jacobian that are not zero, each of unit length: Q R, with a row for each prior.
struct SeenColumns {
  std::vector<Index> seen;
  Eigen::VectorXd norm;
  Eigen::MatrixXd basis, upper_inverse;
};

SeenColumns seen_columns(const SpectralModel& model, const SpectralState& state) {
  Eigen::MatrixXd jacobian = full_jacobian(model, state);
  const Index count = jacobian.cols(), priors = model.n_nuisances();
  jacobian.conservativeResize(model.n_rows() + priors, Eigen::NoChange);
  jacobian.bottomRows(priors).setZero();
  jacobian.bottomRightCorner(priors, priors).diagonal() = model.prior_weight();
  SeenColumns of;
  of.norm.resize(count);
  Eigen::MatrixXd scaled(jacobian.rows(), count);
  for (Index j = 0; j < count; ++j) {
    of.norm[j] = jacobian.col(j).norm();
    if (!(of.norm[j] > 0.0)) continue;
    scaled.col(static_cast<Index>(of.seen.size())) = jacobian.col(j) / of.norm[j];
    of.seen.push_back(j);
  }
  const HouseholderQr qr(scaled.leftCols(static_cast<Index>(of.seen.size())));
  of.basis = qr.basis();
  of.upper_inverse = qr.upper_inverse();
  return of;
}

}  // namespace

std::vector<Eigen::MatrixXd> covariance_by_group(const Eigen::MatrixXd& rows_by_value,
                                                 const std::vector<NoiseGroup>& groups) {
  std::vector<Eigen::MatrixXd> parts;
  for (const NoiseGroup& group : groups) {
    const Eigen::MatrixXd rows =
        scaled_rows(rows_by_value.middleRows(group.first_row, group.n_rows), group.row_scale);
    const Eigen::MatrixXd white = group.variance * rows.transpose() * rows;
    Eigen::MatrixXd part = white;
    if (!group.noise.phi.empty()) {
      part = group.variance * rows.transpose() * correlated_rows(rows, group.begins, group.noise);
      add_slow_part(part, white.diagonal(), group.noise);
    }
    parts.push_back(widened(part, white, group.slow));
  }
  return parts;
}

Eigen::MatrixXd grouped_covariance(const SpectralModel& model, const SpectralState& state,
                                   const std::vector<NoiseGroup>& groups) {
  const SeenColumns of = seen_columns(model, state);
  const auto used = static_cast<Index>(of.seen.size());
  // Each parameter is a linear function of the rows: Q R^-T.
  const Eigen::MatrixXd by_parameter = of.basis * of.upper_inverse.transpose();
  const Eigen::MatrixXd of_priors = by_parameter.bottomRows(model.n_nuisances());
  Eigen::MatrixXd sum = of_priors.transpose() * of_priors;
  for (const Eigen::MatrixXd& part : covariance_by_group(by_parameter, groups)) sum += part;
  const Index count = of.norm.size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  for (Index a = 0; a < used; ++a) {
    for (Index b = 0; b < used; ++b) {
      const Index i = of.seen[static_cast<std::size_t>(a)];
      const Index j = of.seen[static_cast<std::size_t>(b)];
      covariance(i, j) = sum(a, b) / (of.norm[i] * of.norm[j]);
    }
  }
  return covariance;
}

Eigen::VectorXd leverage_by_group(const SpectralModel& model, const SpectralState& state,
                                  const std::vector<NoiseGroup>& groups) {
  const Eigen::MatrixXd basis = seen_columns(model, state).basis;
  Eigen::VectorXd leverage(static_cast<Index>(groups.size()));
  for (std::size_t k = 0; k < groups.size(); ++k) {
    leverage[static_cast<Index>(k)] =
        basis.middleRows(groups[k].first_row, groups[k].n_rows).squaredNorm();
  }
  return leverage;
}

}  // namespace viscard
