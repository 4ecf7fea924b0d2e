#include "fit/curves/dma_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Index = Eigen::Index;

// x/(1 + x^2), x^2/(1 + x^2) and their derivatives by ln x, without overflow for small or large x.
struct Debye {
  double storage, loss, storage_slope, loss_slope;
};

Debye debye(double x) {
  const double inverse = 1.0 / x;
  const double loss = x > 1.0 ? inverse / (1.0 + inverse * inverse) : x / (1.0 + x * x);
  const double storage = x > 1.0 ? 1.0 / (1.0 + inverse * inverse) : x * x / (1.0 + x * x);
  return {storage, loss, 2.0 * loss * loss, loss * (1.0 - 2.0 * storage)};
}

}  // namespace

DmaModel::DmaModel(std::span<const double> frequency_Hz, std::span<const double> storage_Pa,
                   std::span<const double> loss_Pa, const FitOptions& options, bool with_dashpot,
                   SlowTimes slow_times, const ModulusFloors& floors)
    : with_dashpot_(with_dashpot) {
  const auto count = static_cast<Index>(frequency_Hz.size());
  const bool has_loss = !loss_Pa.empty();
  data_.resize(has_loss ? 2 * count : count);
  sigma_Pa_.resize(data_.size());
  for (Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    angular_1_s_.push_back(2.0 * std::numbers::pi * frequency_Hz[k]);
    // A loss modulus near zero has the error of the complex modulus, not one relative to itself.
    const double size_Pa = has_loss ? std::hypot(storage_Pa[k], loss_Pa[k]) : storage_Pa[k];
    sigma_Pa_[i] = std::hypot(std::max(std::abs(storage_Pa[k]), 0.01 * size_Pa), floors.storage_Pa);
    data_[i] = storage_Pa[k] / sigma_Pa_[i];
    if (!has_loss) continue;
    sigma_Pa_[count + i] =
        std::hypot(std::max(std::abs(loss_Pa[k]), 0.01 * size_Pa), floors.loss_Pa);
    data_[count + i] = loss_Pa[k] / sigma_Pa_[count + i];
  }
  with_equilibrium_ = !options.is_liquid;
  if (with_equilibrium_) common_.push_back({"E_inf", false});
  if (with_dashpot_) common_.push_back({"eta_Pa_s", false});
  may_be_negative_ = options.allow_negative;
  const auto [slow, fast] = std::minmax_element(angular_1_s_.begin(), angular_1_s_.end());
  ln_tau_min_ = -std::log(3.0 * *fast);
  // A loss factor of 1e-3 at the slowest frequency is the least that a weight of 1 % can show.
  ln_tau_max_ = -std::log(*slow / (slow_times == SlowTimes::kFarBeyond ? 1e3 : 3.0));
}

double DmaModel::frequency_Hz(Index i) const {
  return angular_1_s_[static_cast<std::size_t>(i)] / (2.0 * std::numbers::pi);
}

ModelColumns DmaModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& /*nuisance*/,
                               bool with_slopes) const {
  const auto count = static_cast<Index>(angular_1_s_.size());
  const Index n_terms = ln_tau.size();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms);
  if (with_slopes) out.term_slopes.resize(n_rows(), n_terms);
  if (with_equilibrium_) out.values.col(0).head(count) = sigma_Pa_.head(count).cwiseInverse();
  if (with_dashpot_) {
    out.values.col(dashpot()).tail(count) =
        Eigen::Map<const Eigen::VectorXd>(angular_1_s_.data(), count)
            .cwiseQuotient(sigma_Pa_.tail(count));
  }
  for (Index i = 0; i < n_terms; ++i) {
    const double tau_s = std::exp(ln_tau[i]);
    for (Index k = 0; k < count; ++k) {
      const Debye d = debye(angular_1_s_[static_cast<std::size_t>(k)] * tau_s);
      out.values(k, n_common() + i) = d.storage / sigma_Pa_[k];
      if (with_slopes) out.term_slopes(k, i) = d.storage_slope / sigma_Pa_[k];
      if (!has_loss()) continue;
      out.values(count + k, n_common() + i) = d.loss / sigma_Pa_[count + k];
      if (with_slopes) out.term_slopes(count + k, i) = d.loss_slope / sigma_Pa_[count + k];
    }
  }
  return out;
}

}  // namespace viscard
