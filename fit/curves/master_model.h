#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/samples/fit_data.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Rows of a master curve at one temperature. argument: time in s since the step, or frequency in Hz
// if `loss` is given beside `value` (storage modulus).
struct MasterSegment {
  double temperature_C = 0.0;
  std::vector<double> argument;
  std::vector<double> value;
  std::vector<double> loss;  // empty: relaxation
};

// All segments share one spectrum, and each has its own factor on time (fit/README.md,
// "Temperatures"):
//   E_k(t) = E(t/a_k),   E'_k(w) = E'(w a_k),   E''_k(w) = E''(w a_k)
// The ln a_k of all segments but the reference are nuisances. A row's weight is relative to its
// value, but to at least 1e-3 of the largest, because master curves span decades of modulus.
class MasterModel final : public SpectralModel {
 public:
  // start: ln a_k of all segments, 0 for the reference.
  MasterModel(const std::vector<MasterSegment>& segments, std::size_t reference,
              const std::vector<double>& start, const FitOptions& options);

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  Eigen::VectorXd row_sigma() const override { return sigma_; }

 private:
  enum class Kind { kRelaxation, kStorage, kLoss };
  struct Row {
    Kind kind = Kind::kRelaxation;
    double ln_argument = 0.0;  // ln t, or -ln(2 pi f)
    Eigen::Index shift = -1;   // index of the nuisance; -1: the reference
  };
  std::vector<Row> rows_;
  Eigen::VectorXd sigma_;
  bool with_equilibrium_ = true;
};

}  // namespace viscard
