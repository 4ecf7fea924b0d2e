#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/curves/step_model.h"
#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Creep compliance as a function of the relaxation spectrum, so that creep can share a spectrum with
// other tests. In Laplace space s^2 E J = 1. About a reference series E_r with compliance J_r a change
// of the relaxation modulus changes the compliance by dJ = -s^2 J_r^2 dE, and s^2 J_r E_r = 1, so that
//   J(t) - 2 J_r(t) = sum_i E_i c(t; tau_i),  c = -L^-1[G^2/(s + 1/tau)],  G = s J_r = 1/(s E_r)
// (fit/README.md, eq. 7): linear in the moduli for any spectrum. Fits with the reference moved to the
// last answer are Gauss-Newton steps. At their end the columns are the exact derivatives.
class CreepRows final : public SpectralModel {
 public:
  // As StepModel: sorted times, finite values, both must outlive the model.
  CreepRows(std::span<const double> time_s, std::span<const double> compliance_1_Pa,
            const PronySeries& reference, const FitOptions& options);

  void refer_to(const PronySeries& series);

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  std::vector<std::size_t> row_begins() const override { return step_.row_begins(); }
  double n_samples() const override { return step_.n_samples(); }
  double hidden_rss(const SpectralState& state) const override;
  double sample_variance() const override { return step_.sample_variance(); }

  // The measured compliance of each row, and that of the state, exactly.
  const Eigen::VectorXd& measured() const { return step_.data(); }
  Eigen::VectorXd compliance_of(const SpectralState& state) const;

  const StepModel& step() const { return step_; }

 private:
  SpectralState creep_state(const PronySeries& series) const;
  PronySeries series_of(const SpectralState& state) const;

  StepModel step_;
  bool with_equilibrium_ = true;
  Eigen::MatrixXcd s_1_s_;   // points of the integral of each row ...
  Eigen::MatrixXcd weight_;  // ... and their weights times -G^2
};

}  // namespace viscard
