#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

#include <utility>

namespace viscard {

// The same model with other data. The base must outlive it.
class ModelVariant : public SpectralModel {
 public:
  ModelVariant(const SpectralModel& base, Eigen::VectorXd data) : base_(base) {
    data_ = std::move(data);
    common_ = base.common();
    nuisances_ = base.nuisances();
    may_be_negative_ = base.may_be_negative();
    ln_tau_min_ = base.ln_tau_min();
    ln_tau_max_ = base.ln_tau_max();
  }

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override {
    return base_.columns(ln_tau, nuisance, with_slopes);
  }

  double sample_variance() const override { return base_.sample_variance(); }

  // Moves the means of the priors to these values.
  void move_priors(const Eigen::VectorXd& means) {
    for (std::size_t k = 0; k < nuisances_.size(); ++k) {
      nuisances_[k].prior = means[static_cast<Eigen::Index>(k)];
    }
  }

 protected:
  const SpectralModel& base_;
};

// The same model with one more row, weight (E_inf - value) = 0, that holds the first common column
// (the equilibrium modulus) at a value. With a weight of 1e4 over its standard error, in units of
// the rows' noise, E_inf departs from the value by less than 1e-8 of the change. The row's own
// contribution to the sum of squares is as small.
class PinnedEquilibrium final : public ModelVariant {
 public:
  PinnedEquilibrium(const SpectralModel& base, double value, double weight)
      : ModelVariant(base, with_row(base.data(), weight * value)), weight_(weight) {}

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override {
    ModelColumns out = base_.columns(ln_tau, nuisance, with_slopes);
    add_row(out.values);
    out.values(out.values.rows() - 1, 0) = weight_;
    if (with_slopes) add_row(out.term_slopes);
    for (Eigen::MatrixXd& slopes : out.nuisance_slopes) add_row(slopes);
    return out;
  }

 private:
  static Eigen::VectorXd with_row(const Eigen::VectorXd& data, double last) {
    Eigen::VectorXd more(data.size() + 1);
    more << data, last;
    return more;
  }
  static void add_row(Eigen::MatrixXd& matrix) {
    matrix.conservativeResize(matrix.rows() + 1, Eigen::NoChange);
    matrix.row(matrix.rows() - 1).setZero();
  }
  double weight_;
};

}  // namespace viscard
