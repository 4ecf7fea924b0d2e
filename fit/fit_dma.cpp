#include "fit/fit_dma.h"

#include "fit/assembly/assemble_result.h"
#include "fit/curves/dma_model.h"
#include "fit/intervals/flags.h"
#include "fit/laws/law_fit.h"
#include "fit/samples/clean_data.h"
#include "fit/search/nnls.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
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
  const auto percent = [](double share) { return text_of(100.0 * share, 2) + " %"; };
  result.flags.push_back(
      {"storage-loss-contradict", 0,
       "storage alone can be fitted to " + percent(storage) + ", loss alone to " + percent(loss) +
           ", but both together only to " + percent(result.noise.sigma) +
           ": they do not belong to one linear material (Kramers-Kronig). Check the shift factors "
           "and the instrument's own loss"});
}

}  // namespace

FitResult fit_dma(const DmaData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 3;
  const CleanViews clean({data.frequency_Hz, data.storage_Pa, data.loss_Pa}, kLeastRows);
  const auto frequency_Hz = clean.column(0), storage_Pa = clean.column(1),
             loss_Pa = clean.column(2);
  if (!(frequency_Hz.front() > 0.0)) {
    throw std::runtime_error("a frequency of " + text_of(frequency_Hz.front()) +
                             " Hz cannot be fitted; frequencies must be positive");
  }
  for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
    if (storage_Pa[i] != 0.0 || loss_Pa[i] != 0.0) continue;
    throw std::runtime_error("storage and loss modulus are both zero at " +
                             text_of(frequency_Hz[i]) +
                             " Hz: this is not a measurement. Remove the row");
  }
  check_sign(storage_Pa, "a storage modulus", "storage_modulus_Pa");
  const DmaModel model(frequency_Hz, storage_Pa, loss_Pa, options);
  // A block is a run of neighbouring frequencies; E' and E'' of one frequency share a block.
  std::vector<int> blocks = log_time_blocks(frequency_Hz, 0.0, 1);
  blocks.insert(blocks.end(), blocks.begin(), blocks.end());
  const SpectralFit fit = fit_spectrum(model, blocks, options);
  FitResult result;
  result.kind = FitKind::kDma;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  fit_laws(model, fit, result);
  result.n_samples = frequency_Hz.size();
  result.n_left_out = clean.n_left_out();
  result.fit_from_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.back());
  result.fit_to_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.front());
  add_identifiability_flags(model, fit.state, fit.covariance,
                            {0.0, 0.0, result.fit_from_s, 3.0 * result.fit_to_s}, result);
  flag_contradiction(model, result);
  if (options.with_curves) {
    const Eigen::VectorXd fitted = model.fitted(fit.state);
    for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
      const double scale_Pa = model.row_sigma()[static_cast<Index>(i)];
      result.curves.add(frequency_Hz[i], storage_Pa[i], fitted[static_cast<Index>(i)] * scale_Pa,
                        result.noise.sigma * scale_Pa);
    }
    result.curves.unit = "Pa";
  }
  return result;
}

}  // namespace viscard
