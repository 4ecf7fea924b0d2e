#pragma once

#include "fit/curves/shift_form.h"
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

// What a master model shifts, and in which form.
struct MasterShape {
  ShiftFormKind form = ShiftFormKind::kFree;
  double curvature_sd = 0.0;       // of kSmooth
  std::vector<double> fixed_ln_b;  // of kFixed; empty: none
  // Each segment but the reference has a factor b on its moduli; ln b has a normal prior, 0 +- 0.1.
  bool has_vertical = false;
  // Relative noise of a row; rows are divided by it too. The priors need rows of unit variance.
  double noise = 1.0;
};

// All segments share one spectrum, and each has its own factor on time and, if wanted, on the moduli
// (fit/README.md, "Temperatures"):
//   E_k(t) = b_k E(t/a_k),   E'_k(w) = b_k E'(w a_k),   E''_k(w) = b_k E''(w a_k)
// The parameters of the form of ln a, then the ln b_k, are nuisances. A row's weight is relative to
// its value, but to at least 1e-3 of the largest, because master curves span decades of modulus.
class MasterModel final : public SpectralModel {
 public:
  // start: ln a_k of all segments, 0 for the reference.
  MasterModel(const std::vector<MasterSegment>& segments, std::size_t reference,
              const std::vector<double>& start, const FitOptions& options,
              const MasterShape& shape = {});

  const ShiftForm& form() const { return form_; }
  Eigen::Index segment_of(Eigen::Index row) const {
    return rows_[static_cast<std::size_t>(row)].segment;
  }
  // Of all segments, from the nuisances; the reference has 0.
  Eigen::VectorXd ln_a(const Eigen::VectorXd& nuisance) const;
  Eigen::VectorXd ln_b(const Eigen::VectorXd& nuisance) const;

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  Eigen::VectorXd row_sigma() const override { return sigma_; }

 private:
  enum class Kind { kRelaxation, kStorage, kLoss };
  struct Row {
    Kind kind = Kind::kRelaxation;
    double ln_argument = 0.0;  // ln t, or -ln(2 pi f)
    Eigen::Index segment = 0;
  };
  void add_vertical(std::size_t n_segments);
  void fill_slopes(Eigen::Index row, const Eigen::VectorXd& by_ln_a,
                   const Eigen::MatrixXd& shift_slopes, ModelColumns& out) const;

  ShiftForm form_;
  Eigen::VectorXd fixed_ln_a_, fixed_ln_b_;  // of kFixed; empty: none
  Eigen::Index reference_ = 0;
  bool has_vertical_ = false;
  std::vector<Row> rows_;
  Eigen::VectorXd sigma_;
  bool with_equilibrium_ = true;
};

}  // namespace viscard
