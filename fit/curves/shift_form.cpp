#include "fit/curves/shift_form.h"

#include "models/material/temperature_shift.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kReach = 9.0;  // four decades on either side of the start value

Eigen::VectorXd inverse_kelvin(const std::vector<double>& temperature_C) {
  Eigen::VectorXd inverse(static_cast<Index>(temperature_C.size()));
  for (Index k = 0; k < inverse.size(); ++k) {
    inverse[k] = 1.0 / (temperature_C[static_cast<std::size_t>(k)] - kAbsoluteZero_C);
  }
  return inverse;
}

// Rows: the mean slope over x, then the scaled second differences. x ascends or descends.
Eigen::MatrixXd slope_and_curvature(const Eigen::VectorXd& x) {
  const Index n = x.size();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n - 1, n);
  rows(0, 0) = -1.0;
  rows(0, n - 1) = 1.0;
  for (Index k = 1; k + 1 < n; ++k) {
    const double before = std::abs(x[k] - x[k - 1]), after = std::abs(x[k + 1] - x[k]);
    const double scale = 1.0 / std::sqrt(0.5 * (before + after));
    rows(k, k - 1) = scale / before;
    rows(k, k) = -scale * (1.0 / before + 1.0 / after);
    rows(k, k + 1) = scale / after;
  }
  return rows;
}

}  // namespace

ShiftForm::ShiftForm(ShiftFormKind kind, std::vector<double> temperature_C, std::size_t reference,
                     double curvature_sd)
    : kind_(kind), curvature_sd_(curvature_sd) {
  const auto n = static_cast<Index>(temperature_C.size());
  const auto ref = static_cast<Index>(reference);
  const Eigen::VectorXd inverse = inverse_kelvin(temperature_C);
  warmer_K_ =
      Eigen::Map<const Eigen::VectorXd>(temperature_C.data(), n).array() - temperature_C[reference];
  switch (kind) {
    case ShiftFormKind::kFixed:
      map_.resize(n, 0);
      from_ln_a_.resize(0, n);
      return;
    case ShiftFormKind::kWlf:
      n_parameters_ = 2;
      return;
    case ShiftFormKind::kArrhenius:
      map_ = 1000.0 * (inverse.array() - inverse[ref]).matrix();
      from_ln_a_ = map_.transpose() / map_.squaredNorm();
      break;
    case ShiftFormKind::kFree:
    case ShiftFormKind::kSmooth: {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, n);
      if (kind == ShiftFormKind::kSmooth) {
        const double range = std::abs(inverse[n - 1] - inverse[0]);
        rows.topRows(n - 1) = slope_and_curvature(inverse / range);
      } else {
        for (Index k = 0; k + 1 < n; ++k) rows(k, k < ref ? k : k + 1) = 1.0;
      }
      rows(n - 1, ref) = 1.0;
      from_ln_a_ = rows.topRows(n - 1);
      const LuFactor factor(rows);
      map_ = factor.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n))).leftCols(n - 1);
      map_.row(ref).setZero();
      break;
    }
  }
  n_parameters_ = map_.cols();
}

Eigen::VectorXd ShiftForm::wlf_column(double inverse_C2_1_K) const {
  return -warmer_K_.cwiseQuotient((1.0 + inverse_C2_1_K * warmer_K_.array()).matrix());
}

Eigen::VectorXd ShiftForm::ln_a(const Eigen::VectorXd& parameters) const {
  if (kind_ != ShiftFormKind::kWlf) return map_ * parameters;
  return parameters[0] * wlf_column(parameters[1]);
}

Eigen::MatrixXd ShiftForm::slopes(const Eigen::VectorXd& parameters) const {
  if (kind_ != ShiftFormKind::kWlf) return map_;
  Eigen::MatrixXd slopes(warmer_K_.size(), 2);
  slopes.col(0) = wlf_column(parameters[1]);
  slopes.col(1) = parameters[0] * slopes.col(0).cwiseAbs2();
  return slopes;
}

double ShiftForm::largest_inverse_C2_1_K() const {
  constexpr double kFromPole = 0.97;
  const double coldest_K = warmer_K_.minCoeff();
  return coldest_K < 0.0 ? kFromPole / -coldest_K : 1.0;
}

Eigen::VectorXd ShiftForm::nearest(const Eigen::VectorXd& ln_a) const {
  if (kind_ != ShiftFormKind::kWlf) return from_ln_a_ * ln_a;
  Eigen::VectorXd best = Eigen::VectorXd::Zero(2);
  double least = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double inverse = largest_inverse_C2_1_K() * i / kSteps;
    const Eigen::VectorXd column = wlf_column(inverse);
    const double slope = std::max(0.0, column.dot(ln_a) / column.squaredNorm());
    const double misfit = (ln_a - slope * column).squaredNorm();
    if (!(misfit < least)) continue;
    least = misfit;
    best << slope, inverse;
  }
  return best;
}

std::vector<Nuisance> ShiftForm::nuisances(const Eigen::VectorXd& start_ln_a) const {
  const Eigen::VectorXd start = nearest(start_ln_a);
  std::vector<Nuisance> list;
  const auto add = [&](const std::string& name, double low, double high, double scale) {
    const double from = start[static_cast<Index>(list.size())];
    list.push_back({name, std::clamp(from, low, high), low, high, scale});
  };
  if (kind_ == ShiftFormKind::kWlf) {
    add("wlf_slope_1_K", 0.0, 30.0, 0.1);
    add("wlf_inverse_C2_1_K", 0.0, largest_inverse_C2_1_K(), 1e-3);
  } else if (kind_ == ShiftFormKind::kArrhenius) {
    add("arrhenius_kK", 0.0, 500.0, 1.0);
  } else {
    const bool is_free = kind_ == ShiftFormKind::kFree;
    for (Index j = 0; j < n_parameters_; ++j) {
      const double reach =
          is_free ? kReach : kReach / std::max(map_.col(j).cwiseAbs().maxCoeff(), 1e-9);
      add((is_free  ? "ln_a_"
           : j == 0 ? "slope_"
                    : "curvature_") +
              std::to_string(j + 1),
          start[j] - reach, start[j] + reach, is_free ? 1.0 : reach / kReach);
      if (!is_free && j > 0) list.back().prior_sd = curvature_sd_;
    }
  }
  return list;
}

}  // namespace viscard
