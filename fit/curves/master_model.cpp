#include "fit/curves/master_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// A term's value and its derivative by ln tau or ln a, at u = ln(t/(a tau)) or -ln(w a tau).
struct Response {
  double value = 0.0, slope = 0.0;
};

Response relaxation(double u) {
  if (u > 6.7) return {};  // exp(-800)
  const double x = std::exp(u);
  const double value = std::exp(-x);
  return {value, x * value};
}

// x^2/(1 + x^2) and x/(1 + x^2) with x = exp(-u), without overflow.
Response storage(double u) {
  const double value =
      u > 0.0 ? std::exp(-2.0 * u) / (1.0 + std::exp(-2.0 * u)) : 1.0 / (1.0 + std::exp(2.0 * u));
  return {value, 2.0 * value * (1.0 - value)};
}

Response loss(double u) {
  const double value = 0.5 / std::cosh(std::min(std::abs(u), 350.0));
  return {value, value * (1.0 - 2.0 * storage(u).value)};
}

}  // namespace

MasterModel::MasterModel(const std::vector<MasterSegment>& segments, std::size_t reference,
                         const std::vector<double>& start, const FitOptions& options)
    : with_equilibrium_(!options.is_liquid) {
  std::vector<double> values;
  double largest = 0.0;
  for (const MasterSegment& segment : segments) {
    for (const double value : segment.value) largest = std::max(largest, std::abs(value));
  }
  double lowest_ln = 1e300, highest_ln = -1e300;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const MasterSegment& segment = segments[k];
    const bool is_dma = !segment.loss.empty();
    Index shift = -1;
    if (k != reference) {
      constexpr double kReach = 9.0;  // four decades on either side of the start value
      shift = n_nuisances();
      nuisances_.push_back(
          {"ln_a_" + std::to_string(k + 1), start[k], start[k] - kReach, start[k] + kReach, 1.0});
    }
    for (std::size_t i = 0; i < segment.value.size(); ++i) {
      const double ln_argument = is_dma ? -std::log(2.0 * std::numbers::pi * segment.argument[i])
                                        : std::log(segment.argument[i]);
      rows_.push_back({is_dma ? Kind::kStorage : Kind::kRelaxation, ln_argument, shift});
      values.push_back(segment.value[i]);
      if (is_dma) {
        rows_.push_back({Kind::kLoss, ln_argument, shift});
        values.push_back(segment.loss[i]);
      }
      lowest_ln = std::min(lowest_ln, ln_argument - start[k]);
      highest_ln = std::max(highest_ln, ln_argument - start[k]);
    }
  }
  const auto count = static_cast<Index>(values.size());
  data_.resize(count);
  sigma_.resize(count);
  for (Index i = 0; i < count; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    sigma_[i] = std::max(std::abs(value), 1e-3 * largest);
    data_[i] = value / sigma_[i];
  }
  if (with_equilibrium_) common_.push_back({"E_inf_Pa", /*is_free=*/false});
  may_be_negative_ = options.allow_negative;
  ln_tau_min_ = lowest_ln - std::log(3.0);
  ln_tau_max_ = highest_ln + std::log(3.0);
}

ModelColumns MasterModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                                  bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms);
  if (with_slopes) {
    out.term_slopes = Eigen::MatrixXd::Zero(n_rows(), n_terms);
    out.nuisance_slopes.assign(static_cast<std::size_t>(n_nuisances()),
                               Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms));
  }
  for (Index r = 0; r < n_rows(); ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const double weight = 1.0 / sigma_[r];
    const double ln_reduced = row.ln_argument - (row.shift < 0 ? 0.0 : nuisance[row.shift]);
    if (with_equilibrium_ && row.kind != Kind::kLoss) out.values(r, 0) = weight;
    for (Index i = 0; i < n_terms; ++i) {
      const double u = ln_reduced - ln_tau[i];
      const Response response = row.kind == Kind::kRelaxation ? relaxation(u)
                                : row.kind == Kind::kStorage  ? storage(u)
                                                              : loss(u);
      out.values(r, n_common() + i) = weight * response.value;
      if (!with_slopes) continue;
      out.term_slopes(r, i) = weight * response.slope;
      if (row.shift >= 0) {
        out.nuisance_slopes[static_cast<std::size_t>(row.shift)](r, n_common() + i) =
            weight * response.slope;
      }
    }
  }
  return out;
}

}  // namespace viscard
