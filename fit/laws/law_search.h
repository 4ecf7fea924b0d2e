#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/laws/law_values.h"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace viscard {

// The model's columns on a fine grid of times, shared by all laws.
struct LawColumns {
  LogGrid grid;
  Eigen::MatrixXd common, terms;
};
LawColumns columns_on_grid(const SpectralModel& model, const Eigen::VectorXd& nuisance);

// One choice of the time and the exponent with the best coefficients.
struct LawPoint {
  double ln_tau = 0.0, exponent = 0.5;
  Eigen::VectorXd weights;   // of the law's decay on the grid
  Eigen::VectorXd linear;    // of the common columns in use, then the amplitude
  Eigen::VectorXd residual;  // of the rows
  double rss = std::numeric_limits<double>::infinity();

  double amplitude() const { return linear[linear.size() - 1]; }
};

// Least squares of one law in its time and exponent, with the coefficients solved at every step.
class LawSearch {
 public:
  LawSearch(const SpectralModel& model, const LawColumns& columns, LawKind kind, bool is_creep);

  const LawForm& form() const { return form_; }
  // Common columns of the model that the law has too, and the place of E_inf (J_g) among them.
  const std::vector<Eigen::Index>& used() const { return used_; }
  std::optional<std::size_t> constant() const { return constant_; }
  Eigen::Index n_shapes() const { return form_.has_time ? 2 : 1; }  // time, exponent

  Eigen::VectorXd kernel(const LawPoint& point) const { return columns_.terms * point.weights; }
  LawPoint at(double ln_tau, double exponent) const;
  // The best of a grid, then Levenberg-Marquardt from the two best points.
  LawPoint best() const;
  bool is_at_bound(const LawPoint& point) const;
  // The point with one shape (0: time, if the law has one) changed, within its bounds.
  LawPoint moved(const LawPoint& point, Eigen::Index shape, double step) const;

 private:
  LawPoint refined(LawPoint point) const;
  LawPoint within(double ln_tau, double exponent) const;
  const DecaySpectrum& spectrum(double exponent) const;

  const SpectralModel& model_;
  const LawColumns& columns_;
  bool is_creep_;
  LawForm form_;
  std::vector<Eigen::Index> used_;
  std::vector<bool> is_free_;
  std::optional<std::size_t> constant_;
  double ln_low_ = 0.0, ln_high_ = 0.0;
  // The spectrum at the exponent that was used last; most steps change the time alone.
  mutable std::optional<DecaySpectrum> last_;
  mutable double last_exponent_ = 0.0;
};

}  // namespace viscard
