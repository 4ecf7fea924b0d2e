#include "fit/search/order_choice.h"

#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kStrongBic = 6.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773

// True if the mean paired difference of the block errors exceeds zero by this many standard errors,
// over the blocks that both orders can predict.
bool is_worse(const std::vector<LeftOut>& a, const std::vector<LeftOut>& best,
              double standard_errors = 1.0) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].is_predictable || !best[i].is_predictable) continue;
    differences.push_back(a[i].squared_error - best[i].squared_error);
  }
  const auto count = static_cast<double>(differences.size());
  if (count < 2.0) return false;
  double mean = 0.0;
  for (const double difference : differences) mean += difference / count;
  double square = 0.0;
  for (const double difference : differences) square += std::pow(difference - mean, 2);
  return mean > standard_errors * std::sqrt(square / (count * (count - 1.0)));
}

// Orthonormal basis of the span of the columns (of unit length): from the Gram matrix if it is well
// conditioned, otherwise by QR, with pivoting if the columns are nearly dependent.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  constexpr double kHidden = 1e-5, kNearlyDependent = 1e-9;
  const Cholesky gram(gram_of(columns));
  if (gram.is_definite() && gram.smallest_pivot() > kHidden) return gram.over_upper(columns);
  if (columns.rows() >= columns.cols()) {
    const HouseholderQr quick(columns);
    if (quick.smallest_pivot() > kNearlyDependent) return quick.basis();
  }
  return PivotedQr(columns).basis();
}

// Error of predicting the rows r from all others, (1 - q q^T)^-1 r, where q holds these rows of an
// orthonormal basis of the model. Uses the smaller of q q^T and q^T q.
LeftOut left_out_error(const Eigen::Ref<const Eigen::MatrixXd>& q,
                       const Eigen::Ref<const Eigen::VectorXd>& r) {
  LeftOut out;
  out.squared_error = r.squaredNorm();
  if (q.cols() == 0) return out;
  const bool is_short = q.rows() <= q.cols();
  const Eigen::MatrixXd leverage = is_short ? Eigen::MatrixXd(q.lazyProduct(q.transpose()))
                                            : Eigen::MatrixXd(q.transpose().lazyProduct(q));
  constexpr double kAlone = 0.9;
  if (q.squaredNorm() < kAlone) {  // the trace is an upper bound of the eigenvalues
    const Cholesky rest(Eigen::MatrixXd::Identity(leverage.rows(), leverage.cols()) - leverage);
    if (is_short) {
      out.squared_error = rest.solve(Eigen::VectorXd(r)).squaredNorm();
    } else {
      out.squared_error = (r + q * rest.solve(Eigen::VectorXd(q.transpose() * r))).squaredNorm();
    }
    return out;
  }
  const EigenSystem system = symmetric_eigen(leverage);
  out.is_predictable = system.values.maxCoeff() < kAlone;
  if (!out.is_predictable) return out;
  const Eigen::VectorXd rest = (1.0 - system.values.array()).inverse();
  const Eigen::MatrixXd& w = system.vectors;
  if (is_short) {
    out.squared_error = rest.cwiseProduct(w.transpose() * r).squaredNorm();
  } else {
    const Eigen::VectorXd shares = rest.cwiseProduct(w.transpose() * (q.transpose() * r));
    out.squared_error = (r + q * (w * shares)).squaredNorm();
  }
  return out;
}

}  // namespace

std::vector<LeftOut> left_out_errors(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<int>& blocks) {
  // Nuisances stay fixed: one block may hold all information about one of them (the unloading and
  // its start), and that is no evidence for or against a term.
  Eigen::MatrixXd jacobian = full_jacobian(model, state);
  jacobian.conservativeResize(Eigen::NoChange, jacobian.cols() - model.n_nuisances());
  const Index linear = state.coefficients.size();
  const Eigen::VectorXd residual = model.data() - jacobian.leftCols(linear) * state.coefficients;
  for (Index j = 0; j < jacobian.cols(); ++j) {
    const double norm = jacobian.col(j).norm();
    if (norm > 0.0) jacobian.col(j) /= norm;
  }
  const Eigen::MatrixXd basis = orthonormal_basis(jacobian);

  const int n_blocks = blocks.empty() ? 0 : *std::max_element(blocks.begin(), blocks.end()) + 1;
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(n_blocks));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    rows[static_cast<std::size_t>(blocks[i])].push_back(static_cast<Index>(i));
  }
  std::vector<LeftOut> errors;
  for (const std::vector<Index>& block : rows) {
    if (block.empty()) continue;
    const auto count = static_cast<Index>(block.size());
    if (block.back() - block.front() + 1 == count) {  // contiguous block: no copy
      errors.push_back(left_out_error(basis.middleRows(block.front(), count),
                                      residual.segment(block.front(), count)));
    } else {
      errors.push_back(left_out_error(Eigen::MatrixXd(basis(block, Eigen::all)),
                                      Eigen::VectorXd(residual(block))));
    }
  }
  return errors;
}

bool is_within_range(const SpectralModel& model, const SpectralState& state) {
  return state.n_terms() == 0 ||
         !(model.is_shortest(state.ln_tau.minCoeff()) || model.is_longest(state.ln_tau.maxCoeff()));
}

OrderRow scored_order(int n_terms, double p, double rss, double n_samples,
                      const OrderScores& scores) {
  OrderRow row;
  row.n_terms = n_terms;
  row.rss = rss;
  const double n = scores.n_effective;
  const double misfit = n * std::log(std::max(rss, scores.least_rss) / n_samples);
  const double spare = n - p - 1.0;
  row.aicc = spare > 0.0 ? misfit + 2.0 * p + 2.0 * p * (p + 1.0) / spare
                         : std::numeric_limits<double>::infinity();
  row.bic = misfit + p * std::log(n);
  return row;
}

namespace {

// A time above a third of the record. ln_tau_max() is three times the record.
bool outlasts_record(const SpectralModel& model, const SpectralState& state) {
  return state.n_terms() > 0 && state.ln_tau.maxCoeff() > model.ln_tau_max() - std::log(9.0);
}

// Scores of every order of the path.
struct Candidates {
  std::vector<OrderRow> rows;
  std::vector<std::vector<LeftOut>> errors;
  std::vector<bool> is_eligible;
  std::size_t best_bic = 0, best_cv = 0;  // among the eligible
  double n_effective = 1.0, least_rss = 0.0;
};

Candidates candidates_of(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input) {
  Candidates all;
  // If even the largest order does not fit, its residual is not noise and its autocorrelation does
  // not measure information. So assume at least five independent values per parameter.
  const double granted =
      std::min(input.n_samples, 5.0 * static_cast<double>(model.n_parameters(path.back())));
  const double n_effective = std::max(granted, input.n_samples / input.inflation);
  for (const SpectralState& state : path) {
    all.is_eligible.push_back(is_within_range(model, state));
  }
  if (std::find(all.is_eligible.begin(), all.is_eligible.end(), true) == all.is_eligible.end()) {
    all.is_eligible.assign(path.size(), true);
  }
  // Rounding of the data limits the sum of squares: below this value all orders are equally good.
  constexpr double kRounding = 2.2e-16;
  const double least_rss = std::max(kRounding * kRounding * model.data().squaredNorm(), 1e-300);
  const double noise = std::max(input.rss.back(), least_rss);
  all.n_effective = n_effective;
  all.least_rss = least_rss;
  OrderScores scale;
  scale.n_effective = n_effective;
  scale.least_rss = least_rss;
  std::optional<std::size_t> best_bic, best_cv;
  for (std::size_t i = 0; i < path.size(); ++i) {
    OrderRow row = scored_order(static_cast<int>(path[i].n_terms()),
                                static_cast<double>(model.n_parameters(path[i])), input.rss[i],
                                input.n_samples, scale);
    all.errors.push_back(left_out_errors(model, path[i], input.blocks));
    row.cv = row.rss - path[i].rss;  // the part within averages
    for (const LeftOut& block : all.errors.back()) row.cv += block.squared_error;
    row.cv /= noise;
    all.rows.push_back(row);
    if (!all.is_eligible[i]) continue;
    if (!best_bic || row.bic < all.rows[*best_bic].bic) best_bic = i;
    if (!best_cv || row.cv < all.rows[*best_cv].cv) best_cv = i;
  }
  all.best_bic = *best_bic;
  all.best_cv = *best_cv;
  return all;
}

constexpr double kVeryStrong = 10.0;  // as kStrongBic

// The blocks of a long hold are few beside its readings, and their errors scatter: cross-validation may
// not see a term that the readings show very clearly. The smallest order from `choice` on that the BIC of
// the readings (with the memory of their noise) does not reject.
std::size_t not_against_bic(const Candidates& all, std::size_t choice) {
  const double most = all.rows[all.best_bic].bic + kVeryStrong;
  while (choice < all.best_bic && (!all.is_eligible[choice] || all.rows[choice].bic > most)) {
    ++choice;
  }
  return choice;
}

// Drift of the force and autocorrelated noise look like a term slower than a third of the record.
// Such a term needs strong evidence; otherwise the next smaller order without one replaces it.
std::size_t without_lasting_term(const SpectralModel& model, const std::vector<SpectralState>& path,
                                 const Candidates& all, std::size_t chosen) {
  if (!outlasts_record(model, path[chosen])) return chosen;
  constexpr double kStandardErrors = 3.0;
  for (std::size_t i = chosen; i-- > 0;) {
    if (all.rows[i].bic - all.rows[chosen].bic > kStrongBic ||
        is_worse(all.errors[i], all.errors[all.best_cv], kStandardErrors)) {
      return chosen;
    }
    if (all.is_eligible[i] && !outlasts_record(model, path[i])) return i;
  }
  return chosen;
}

}  // namespace

OrderScores choose_order(const SpectralModel& model, const std::vector<SpectralState>& path,
                         const ChoiceInput& input) {
  Candidates all = candidates_of(model, path, input);
  std::size_t choice = all.best_cv;
  for (std::size_t i = all.best_cv; i-- > 0;) {
    if (all.is_eligible[i] && !is_worse(all.errors[i], all.errors[all.best_cv])) choice = i;
  }
  choice = not_against_bic(all, std::min(choice, all.best_bic));
  OrderScores scores;
  scores.chosen = without_lasting_term(model, path, all, choice);
  scores.rows = std::move(all.rows);
  scores.n_effective = all.n_effective;
  scores.least_rss = all.least_rss;
  scores.rows[scores.chosen].is_chosen = true;
  // Orders that are not eligible although they describe the data much better.
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool better = scores.rows[i].bic < scores.rows[scores.chosen].bic - kVeryStrong;
    if (all.is_eligible[i] || !better) continue;
    scores.wants_faster |= model.is_shortest(path[i].ln_tau.minCoeff());
    scores.wants_slower |= model.is_longest(path[i].ln_tau.maxCoeff());
  }
  return scores;
}

}  // namespace viscard
