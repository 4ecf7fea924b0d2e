#include "fit/fit_dma.h"

#include "fit/assembly/assemble_result.h"
#include "fit/curves/dma_model.h"
#include "fit/intervals/flags.h"
#include "fit/samples/clean_data.h"
#include "fit/search/nnls.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace viscard {

namespace {

using Index = Eigen::Index;

// Root mean square relative misfit of one half of the rows (E' or E'') for the best non-negative
// spectrum on a dense grid of times. No Prony series can have a smaller one.
double misfit_alone(const DmaModel& model, Index begin, Index count) {
  const double decades = (model.ln_tau_max() - model.ln_tau_min()) / std::log(10.0);
  const Index n = std::max<Index>(4, static_cast<Index>(6.0 * decades));
  const Eigen::VectorXd grid =
      Eigen::VectorXd::LinSpaced(n, model.ln_tau_min(), model.ln_tau_max());
  const Eigen::MatrixXd columns =
      model.columns(grid, Eigen::VectorXd(0), false).values.middleRows(begin, count);
  const Eigen::VectorXd data = model.data().segment(begin, count);
  const Eigen::VectorXd x = nonnegative_from_normal_equations(
      columns.transpose() * columns, columns.transpose() * data, free_columns(model, n));
  return (columns * x - data).norm() / std::sqrt(static_cast<double>(count));
}

// Storage and loss modulus of a linear material determine each other (Kramers-Kronig). Adds a flag
// if the data contradict that.
void flag_contradiction(const DmaModel& model, FitResult& result) {
  const Index count = model.n_rows() / 2;
  const double storage = misfit_alone(model, 0, count);
  const double loss = misfit_alone(model, count, count);
  constexpr double kMuch = 3.0, kVisible = 0.01;
  if (result.noise.sigma < kVisible || result.noise.sigma < kMuch * std::max(storage, loss)) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "storage alone can be fitted to %.2g %%, loss alone to %.2g %%, but both together only "
      "to %.2g %%: they do not belong to one linear material (Kramers-Kronig). Check the "
      "shift factors and the instrument's own loss",
      100.0 * storage, 100.0 * loss, 100.0 * result.noise.sigma);
  result.flags.push_back({"storage-loss-contradict", 0, text});
}

}  // namespace

FitResult fit_dma(const DmaData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 3;
  const CleanColumns clean =
      clean_columns({data.frequency_Hz, data.storage_Pa, data.loss_Pa}, kLeastRows);
  const std::vector<double>& frequency_Hz = clean.columns[0];
  if (!(frequency_Hz.front() > 0.0)) {
    throw std::runtime_error("a frequency of " + text_of(frequency_Hz.front()) +
                             " Hz cannot be fitted; frequencies must be positive");
  }
  for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
    if (clean.columns[1][i] != 0.0 || clean.columns[2][i] != 0.0) continue;
    char text[120];
    std::snprintf(text, sizeof text,
                  "storage and loss modulus are both zero at %.6g Hz: this is not a measurement. "
                  "Remove the row",
                  frequency_Hz[i]);
    throw std::runtime_error(text);
  }
  check_sign(clean.columns[1], "a storage modulus", "storage_modulus_Pa");
  const DmaModel model(frequency_Hz, clean.columns[1], clean.columns[2], options);
  // A block is a run of neighbouring frequencies; E' and E'' of one frequency belong to the same
  // block.
  std::vector<int> blocks = log_time_blocks(frequency_Hz, 0.0, 1);
  blocks.insert(blocks.end(), blocks.begin(), blocks.end());
  const SpectralFit fit = fit_spectrum(model, blocks, options);
  FitResult result;
  result.kind = FitKind::kDma;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  result.n_samples = frequency_Hz.size();
  result.n_left_out = clean.n_left_out;
  result.fit_from_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.back());
  result.fit_to_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.front());
  add_identifiability_flags(model, fit.state, fit.covariance,
                            {0.0, 0.0, result.fit_from_s, 3.0 * result.fit_to_s}, result);
  flag_contradiction(model, result);
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
