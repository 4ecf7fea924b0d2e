#include "fit/order_choice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

using Index = Eigen::Index;

double n_parameters(const SpectralModel& model, const SpectralState& state) {
  return static_cast<double>(model.n_common() + 2 * state.n_terms() + model.n_nuisances());
}

// Mean and standard error of the paired difference of two lists of block errors.
bool is_worse_by_one_error(const std::vector<double>& a, const std::vector<double>& best) {
  const auto count = static_cast<double>(a.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) mean += (a[i] - best[i]) / count;
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(a[i] - best[i] - mean, 2);
  const double error = std::sqrt(square / (count * std::max(1.0, count - 1.0)));
  return mean > error;
}

}  // namespace

std::vector<double> left_out_errors(const SpectralModel& model, const SpectralState& state,
                                    const std::vector<int>& blocks) {
  Eigen::MatrixXd jacobian = full_jacobian(model, state);
  const Index linear = state.coefficients.size();
  const Eigen::VectorXd residual = model.data() - jacobian.leftCols(linear) * state.coefficients;
  for (Index j = 0; j < jacobian.cols(); ++j) {
    const double norm = jacobian.col(j).norm();
    if (norm > 0.0) jacobian.col(j) /= norm;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const Index rank = qr.rank();
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(jacobian.rows(), rank);

  const int n_blocks = blocks.empty() ? 0 : *std::max_element(blocks.begin(), blocks.end()) + 1;
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(n_blocks));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    rows[static_cast<std::size_t>(blocks[i])].push_back(static_cast<Index>(i));
  }
  std::vector<double> errors;
  for (const std::vector<Index>& block : rows) {
    if (block.empty()) continue;
    const Eigen::MatrixXd q = basis(block, Eigen::all);
    const Eigen::VectorXd r = residual(block);
    // A block that alone determines a parameter cannot be predicted; the floor keeps it finite.
    constexpr double kFloor = 1e-3;
    Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(rank, rank) * (1.0 + kFloor) - q.transpose() * q;
    const Eigen::VectorXd error = r + q * rest.ldlt().solve(q.transpose() * r);
    errors.push_back(error.squaredNorm());
  }
  return errors;
}

OrderScores choose_order(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input) {
  OrderScores scores;
  const double n_effective = std::max(2.0, input.n_samples / input.inflation);
  std::vector<std::vector<double>> errors;
  std::size_t best_bic = 0;
  std::size_t best_cv = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    OrderRow row;
    row.n_terms = static_cast<int>(path[i].n_terms());
    row.rss = path[i].rss + input.chi_square_added;
    const double p = n_parameters(model, path[i]);
    const double misfit = n_effective * std::log(std::max(row.rss, 1e-300) / input.n_samples);
    const double spare = n_effective - p - 1.0;
    row.aicc = spare > 0.0 ? misfit + 2.0 * p + 2.0 * p * (p + 1.0) / spare
                           : std::numeric_limits<double>::infinity();
    row.bic = misfit + p * std::log(n_effective);
    errors.push_back(left_out_errors(model, path[i], input.blocks));
    for (const double error : errors.back()) row.cv += error;
    row.cv = (row.cv + input.chi_square_added) / input.n_samples;
    scores.rows.push_back(row);
    if (row.bic < scores.rows[best_bic].bic) best_bic = i;
    if (row.cv < scores.rows[best_cv].cv) best_cv = i;
  }
  std::size_t choice = best_cv;
  for (std::size_t i = best_cv; i-- > 0;) {
    if (!is_worse_by_one_error(errors[i], errors[best_cv])) choice = i;
  }
  scores.chosen = std::min(choice, best_bic);
  if (!scores.rows.empty()) scores.rows[scores.chosen].is_chosen = true;
  return scores;
}

}  // namespace viscard
