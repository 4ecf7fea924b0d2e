#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/curves/master_model.h"
#include "fit/master_start.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace viscard {

// A form of the shifts, fitted with the number of terms that all forms share.
struct FormFit {
  MasterShape shape;
  std::shared_ptr<const MasterModel> model;
  SpectralState state;
  // Sum of squares of the rows without the priors, not divided by the noise.
  double rss = 0.0;
  double parameters = 0.0;  // number of shifts that the data determine, priors deducted
};

// Fits the segments of one master curve in several forms. Refers to its arguments.
class Forms {
 public:
  Forms(const std::vector<MasterSegment>& segments, const MasterStart& start,
        const std::vector<int>& blocks, const FitOptions& options)
      : segments_(segments), start_(start), blocks_(blocks), options_(options) {}

  std::unique_ptr<MasterModel> model(const MasterShape& shape, const Eigen::VectorXd& ln_a) const;
  // Fits a form from the times and shifts of another fit.
  FormFit fit(const MasterShape& shape, const Eigen::VectorXd& ln_tau,
              const Eigen::VectorXd& ln_a) const;
  // The order path at fixed shifts.
  SpectralFit at_fixed(const Eigen::VectorXd& ln_a, const std::vector<double>& ln_b) const;
  // Chooses the weight of the second differences by cross-validation, from a tight prior to a loose
  // one, so that shifts that the data hardly determine stay at their start values.
  FormFit smooth(const FormFit& first) const;
  // By BIC, with the inflation of the fit with vertical shifts: if isotherms differ by a factor
  // each, the residuals are correlated in blocks and look like slow noise.
  bool prefers_vertical(const FormFit& plain, const FormFit& vertical) const;

 private:
  double determined(const FormFit& fit) const;
  double predicted_error(const FormFit& fit) const;

  const std::vector<MasterSegment>& segments_;
  const MasterStart& start_;
  const std::vector<int>& blocks_;
  const FitOptions& options_;
};

// Sum of squares of the free shifts and the variance of one row, for the comparison of forms.
struct Yardstick {
  double rows = 0.0, rss = 0.0, parameters = 0.0, variance = 0.0, inflation = 1.0;

  // True if the form describes the data worse than free shifts in both of two ways: the rise of the
  // sum of squares is significant (in units of the noise it exceeds its degrees of freedom by four
  // standard deviations), and the residual is visibly larger. Significance alone is not enough,
  // because free shifts also follow the error of a finite number of terms.
  bool is_worse(const FormFit& form) const;
  double bic(const FormFit& form) const;
};

Yardstick yardstick_of(const FormFit& free, const FormFit& smooth, const FitOptions& options);

}  // namespace viscard
