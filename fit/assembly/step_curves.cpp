#include "fit/assembly/step_curves.h"

#include <cmath>

namespace viscard {

void fill_step_curves(const StepModel& model, const SpectralFit& fit, const std::string& unit,
                      FitResult& result) {
  const Eigen::VectorXd fitted =
      model.columns(fit.state.ln_tau, fit.state.nuisance, false).values * fit.state.coefficients;
  for (std::size_t i = 0; i < model.bins().size(); ++i) {
    const LogBin& bin = model.bins()[i];
    const double root = std::sqrt(bin.count);
    result.curves.time_s.push_back(bin.time_s);
    result.curves.measured.push_back(bin.value);
    result.curves.fitted.push_back(fitted[static_cast<Eigen::Index>(i)] / root);
    result.curves.sigma.push_back(result.noise.sigma / root);
  }
  result.curves.unit = unit;
}

}  // namespace viscard
