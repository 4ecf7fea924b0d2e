#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/samples/fit_data.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace viscard {

// Storage and loss modulus over frequency, fitted together, each with weight 1/value (equal
// relative errors): E' = E_inf + sum E_i x^2/(1 + x^2), E'' = sum E_i x/(1 + x^2), x = 2 pi f tau_i
// (fit/README.md, eq. 6). Rows: all E', then all E'' (none: the storage modulus alone). On request with a dashpot, E'' = eta w, which
// stands for all relaxation far faster than the measured frequencies, and with times far beyond the
// slow end: such a term is a plateau E' = E with a loss E'' = E/(w tau), a dashpot in series.
enum class SlowTimes { kNearRange, kFarBeyond };

// Absolute part of the noise of each modulus over its relative part, Pa: rows then weigh by 1 over the root
// of value^2 + floor^2. 0: relative noise only.
struct ModulusFloors {
  double storage_Pa = 0.0, loss_Pa = 0.0;
};

class DmaModel final : public SpectralModel {
 public:
  DmaModel(std::span<const double> frequency_Hz, std::span<const double> storage_Pa,
           std::span<const double> loss_Pa, const FitOptions& options, bool with_dashpot = false,
           SlowTimes slow = SlowTimes::kNearRange, const ModulusFloors& floors = {});

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  Eigen::VectorXd row_sigma() const override { return sigma_Pa_; }

  Eigen::Index n_frequencies() const { return static_cast<Eigen::Index>(angular_1_s_.size()); }
  bool has_loss() const { return n_rows() > n_frequencies(); }
  double frequency_Hz(Eigen::Index i) const;
  // Index of the dashpot among the common columns; -1 if there is none.
  Eigen::Index dashpot() const { return with_dashpot_ ? n_common() - 1 : -1; }

 private:
  std::vector<double> angular_1_s_;
  Eigen::VectorXd sigma_Pa_;
  bool with_equilibrium_ = true;
  bool with_dashpot_ = false;
};

}  // namespace viscard
