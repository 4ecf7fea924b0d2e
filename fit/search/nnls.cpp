#include "fit/search/nnls.h"

#include "models/maths/dense.h"

#include <algorithm>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Solves the normal equations of the columns in use. A small ridge keeps columns that are equal up
// to rounding from failing.
Eigen::VectorXd solve_passive(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
                              const std::vector<Index>& in_use) {
  const auto count = static_cast<Index>(in_use.size());
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd vector(count);
  for (Index i = 0; i < count; ++i) {
    const Index gi = in_use[static_cast<std::size_t>(i)];
    vector[i] = right[gi];
    for (Index j = 0; j < count; ++j) {
      matrix(i, j) = gram(gi, in_use[static_cast<std::size_t>(j)]);
    }
  }
  constexpr double kRidge = 1e-14;
  matrix.diagonal() *= 1.0 + kRidge;
  return SymmetricFactor(matrix).solve(vector);
}

std::vector<Index> chosen(const std::vector<bool>& in_use) {
  std::vector<Index> list;
  for (std::size_t j = 0; j < in_use.size(); ++j) {
    if (in_use[j]) list.push_back(static_cast<Index>(j));
  }
  return list;
}

// Moves x of the columns in use towards their free solution, up to the first bound. Returns the column that
// reaches it, -1: none.
Index step_towards(const Eigen::VectorXd& trial, const std::vector<Index>& list,
                   const std::vector<bool>& is_free, Eigen::VectorXd& x) {
  double share = 1.0;
  Index blocking = -1;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Index j = list[i];
    const double target = trial[static_cast<Index>(i)];
    if (is_free[static_cast<std::size_t>(j)] || target > 0.0) continue;
    const double limit = x[j] > 0.0 ? x[j] / (x[j] - target) : 0.0;
    if (blocking < 0 || limit < share) {
      share = limit;
      blocking = j;
    }
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    x[list[i]] += share * (trial[static_cast<Index>(i)] - x[list[i]]);
  }
  return blocking;
}

}  // namespace

Eigen::VectorXd nonnegative_from_normal_equations(const Eigen::MatrixXd& gram,
                                                  const Eigen::VectorXd& right,
                                                  const std::vector<bool>& is_free) {
  const Index count = right.size();
  // A unit diagonal makes the test of the gradient independent of the units of the columns.
  Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
  for (Index j = 0; j < count; ++j) {
    if (!(scale[j] > 0.0)) scale[j] = 1.0;
  }
  const Eigen::MatrixXd g =
      scale.cwiseInverse().asDiagonal() * gram * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd b = right.cwiseQuotient(scale);
  const double tolerance = 1e-12 * std::max(b.cwiseAbs().maxCoeff(), 1e-300);

  std::vector<bool> in_use = is_free;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
  const auto settle = [&] {  // inner loop: solve, go back to the first bound, drop its column
    for (int step = 0; step < 3 * static_cast<int>(count) + 10; ++step) {
      const std::vector<Index> list = chosen(in_use);
      if (list.empty()) return;
      const Eigen::VectorXd trial = solve_passive(g, b, list);
      const Index blocking = step_towards(trial, list, is_free, x);
      if (blocking < 0) return;
      x[blocking] = 0.0;
      in_use[static_cast<std::size_t>(blocking)] = false;
    }
  };
  settle();
  Index last_dropped = -1;
  for (int outer = 0; outer < 3 * static_cast<int>(count) + 10; ++outer) {
    const Eigen::VectorXd gradient = b - g * x;
    Index best = -1;
    for (Index j = 0; j < count; ++j) {
      if (in_use[static_cast<std::size_t>(j)] || j == last_dropped) continue;
      if (gradient[j] > tolerance && (best < 0 || gradient[j] > gradient[best])) best = j;
    }
    if (best < 0) break;
    in_use[static_cast<std::size_t>(best)] = true;
    settle();
    // Skip a column that rounding adds and removes again; it would cycle.
    last_dropped = in_use[static_cast<std::size_t>(best)] ? -1 : best;
  }
  return x.cwiseQuotient(scale);
}

Eigen::VectorXd nonnegative_by_qr(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                                  const std::vector<bool>& is_free) {
  const Index count = columns.cols();
  Eigen::VectorXd scale = columns.colwise().norm().transpose();
  for (Index j = 0; j < count; ++j) {
    if (!(scale[j] > 0.0)) scale[j] = 1.0;
  }
  const Eigen::MatrixXd a = columns * scale.cwiseInverse().asDiagonal();
  const double tolerance = 1e-12 * std::max(data.norm(), 1e-300);
  std::vector<bool> in_use = is_free;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
  const auto trial_of = [&](const std::vector<Index>& list) {
    return PivotedQr(a(Eigen::all, list)).solve(data);
  };
  // False if the column that was just added does not become positive: rounding alone called for it.
  const auto settle = [&](Index added) {
    for (int step = 0; step < 3 * static_cast<int>(count) + 10; ++step) {
      const std::vector<Index> list = chosen(in_use);
      if (list.empty()) return true;
      const Eigen::VectorXd trial = trial_of(list);
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (step == 0 && list[i] == added && !(trial[static_cast<Index>(i)] > 0.0)) return false;
      }
      const Index blocking = step_towards(trial, list, is_free, x);
      if (blocking < 0) return true;
      x[blocking] = 0.0;
      in_use[static_cast<std::size_t>(blocking)] = false;
    }
    return true;
  };
  settle(-1);
  std::vector<bool> is_refused(in_use.size(), false);
  for (int outer = 0; outer < 3 * static_cast<int>(count) + 10; ++outer) {
    const Eigen::VectorXd gradient = a.transpose() * (data - a * x);
    Index best = -1;
    for (Index j = 0; j < count; ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (in_use[k] || is_refused[k]) continue;
      if (gradient[j] > tolerance && (best < 0 || gradient[j] > gradient[best])) best = j;
    }
    if (best < 0) break;
    const auto k = static_cast<std::size_t>(best);
    in_use[k] = true;
    if (settle(best)) {
      std::fill(is_refused.begin(), is_refused.end(), false);
    } else {
      in_use[k] = false;
      is_refused[k] = true;
    }
  }
  return x.cwiseQuotient(scale);
}

bool SignedLeastSquares::solve(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                               const std::vector<bool>& is_free) {
  const std::vector<Index> list = chosen(in_use_);
  x_.setZero();
  is_empty_ = list.empty();
  if (is_empty_) return true;
  Eigen::MatrixXd part(columns.rows(), static_cast<Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    part.col(static_cast<Index>(i)) = columns.col(list[i]);
  }
  Eigen::VectorXd scale = part.colwise().norm().transpose();
  for (Index i = 0; i < scale.size(); ++i) {
    if (!(scale[i] > 0.0)) scale[i] = 1.0;
  }
  part = part * scale.cwiseInverse().asDiagonal();
  qr_ = PivotedQr(part);
  const Eigen::VectorXd solution = qr_.solve(data).cwiseQuotient(scale);
  bool is_feasible = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    x_[list[i]] = solution[static_cast<Index>(i)];
    is_feasible &= is_free[static_cast<std::size_t>(list[i])] || x_[list[i]] >= 0.0;
  }
  return is_feasible;
}

SignedLeastSquares::SignedLeastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                                       const std::vector<bool>& is_free)
    : in_use_(static_cast<std::size_t>(columns.cols()), true),
      x_(Eigen::VectorXd::Zero(columns.cols())) {
  if (solve(columns, data, is_free)) return;
  const Eigen::VectorXd guess = nonnegative_from_normal_equations(
      columns.transpose() * columns, columns.transpose() * data, is_free);
  for (std::size_t j = 0; j < in_use_.size(); ++j) {
    in_use_[j] = is_free[j] || guess[static_cast<Index>(j)] > 0.0;
  }
  // QR may find a wrong sign that rounding hid in the normal equations: solve without the column.
  while (!solve(columns, data, is_free)) {
    for (std::size_t j = 0; j < in_use_.size(); ++j) {
      if (!is_free[j] && x_[static_cast<Index>(j)] < 0.0) in_use_[j] = false;
    }
  }
}

Eigen::MatrixXd SignedLeastSquares::outside(const Eigen::MatrixXd& vectors) const {
  if (is_empty_) return vectors;
  const Eigen::MatrixXd rotated = qr_.rotated(vectors);
  return rotated.bottomRows(vectors.rows() - qr_.rank());
}

}  // namespace viscard
