#include "fit/fit_dma.h"

#include "fit/assemble_result.h"
#include "fit/clean_data.h"
#include "fit/dma_model.h"
#include "fit/flags.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {

using Index = Eigen::Index;

FitResult fit_dma(const DmaData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 3;
  const CleanColumns clean =
      clean_columns({data.frequency_Hz, data.storage_Pa, data.loss_Pa}, kLeastRows);
  const std::vector<double>& frequency_Hz = clean.columns[0];
  if (!(frequency_Hz.front() > 0.0)) {
    throw std::runtime_error("a frequency of " + std::to_string(frequency_Hz.front()) +
                             " Hz cannot be fitted; frequencies must be positive");
  }
  const DmaModel model(frequency_Hz, clean.columns[1], clean.columns[2], options);
  // Blocks are runs of neighbouring frequencies; E' and E'' of one frequency go together.
  std::vector<int> blocks = log_time_blocks(frequency_Hz, 0.0, 1);
  blocks.insert(blocks.end(), blocks.begin(), blocks.end());
  const SpectralFit fit = fit_spectrum(model, blocks, options);
  FitResult result;
  result.kind = FitKind::kDma;
  fill_result(
      model, fit,
      [&](const SpectralState& state) {
        PronySeries series{options.is_liquid ? 0.0 : state.coefficients[0], {}};
        for (Index i = 0; i < state.n_terms(); ++i) {
          series.terms.push_back(
              {state.coefficients[model.n_common() + i], std::exp(state.ln_tau[i])});
        }
        return series;
      },
      result);
  result.n_samples = frequency_Hz.size();
  result.n_left_out = clean.n_left_out;
  result.fit_from_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.back());
  result.fit_to_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.front());
  add_identifiability_flags(model, fit.state, fit.covariance,
                            {0.0, 0.0, result.fit_from_s, 3.0 * result.fit_to_s}, result);
  if (options.with_curves) {
    const Eigen::VectorXd fitted =
        model.columns(fit.state.ln_tau, fit.state.nuisance, false).values * fit.state.coefficients;
    for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
      const double scale_Pa = model.row_sigma()[static_cast<Index>(i)];
      result.curves.time_s.push_back(frequency_Hz[i]);
      result.curves.measured.push_back(clean.columns[1][i]);
      result.curves.fitted.push_back(fitted[static_cast<Index>(i)] * scale_Pa);
      result.curves.sigma.push_back(result.noise.sigma * scale_Pa);
    }
    result.curves.unit = "Pa";
  }
  return result;
}

}  // namespace viscard
