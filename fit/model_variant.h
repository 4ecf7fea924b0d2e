#pragma once

#include "fit/spectral_model.h"

#include <Eigen/Core>

#include <utility>

namespace viscard {

// The same model of other data, and if asked without its first common column (the equilibrium
// modulus, whose share the caller has taken off the data). The base must outlive it.
class ModelVariant final : public SpectralModel {
 public:
  ModelVariant(const SpectralModel& base, Eigen::VectorXd data, bool without_first)
      : base_(base), skipped_(without_first ? 1 : 0) {
    data_ = std::move(data);
    common_.assign(base.common().begin() + skipped_, base.common().end());
    nuisances_ = base.nuisances();
    may_be_negative_ = base.may_be_negative();
    ln_tau_min_ = base.ln_tau_min();
    ln_tau_max_ = base.ln_tau_max();
  }

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override {
    ModelColumns out = base_.columns(ln_tau, nuisance, with_slopes);
    if (skipped_ == 0) return out;
    const auto rest = [&](Eigen::MatrixXd& matrix) {
      matrix = Eigen::MatrixXd(matrix.rightCols(matrix.cols() - skipped_));
    };
    rest(out.values);
    for (Eigen::MatrixXd& slopes : out.nuisance_slopes) rest(slopes);
    return out;
  }

  double sample_variance() const override { return base_.sample_variance(); }

 private:
  const SpectralModel& base_;
  Eigen::Index skipped_;
};

}  // namespace viscard
