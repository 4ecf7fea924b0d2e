#include "fit/fit_dma.h"

#include "fit/assembly/assemble_result.h"
#include "fit/assembly/kramers_kronig.h"
#include "fit/assembly/slow_doubt.h"
#include "fit/assembly/solid_or_liquid.h"
#include "fit/curves/dma_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/kept_rows.h"
#include "fit/intervals/lack_of_fit.h"
#include "fit/intervals/left_out.h"
#include "fit/intervals/positive_intervals.h"
#include "fit/laws/law_fit.h"
#include "fit/samples/clean_data.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

namespace {

using Index = Eigen::Index;

struct FittedModel {
  std::unique_ptr<DmaModel> model;
  SpectralFit fit;

  double bic() const {
    const auto rows = static_cast<double>(model->n_rows());
    const auto parameters = static_cast<double>(model->n_common() + 2 * fit.state.n_terms());
    return rows * std::log(std::max(fit.rss, 1e-300) / rows) + parameters * std::log(rows);
  }
};

// True if a model with more in it leaves less than half of the sum of squares and BIC prefers it
// clearly. Below the rounding of the data all models are equally good.
bool is_much_better(const FittedModel& other, const FittedModel& fitted) {
  constexpr double kVeryStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  constexpr double kMuch = 2.0, kRounding = 1e-6;  // relative, of a value
  const double least = std::pow(kRounding, 2) * static_cast<double>(fitted.model->n_rows());
  return fitted.fit.rss > std::max(kMuch * other.fit.rss, least) &&
         other.bic() < fitted.bic() - kVeryStrong;
}

using ModelWith = std::function<std::unique_ptr<DmaModel>(bool with_dashpot, SlowTimes slow)>;

// The fit with a dashpot for what relaxes far faster than the measured frequencies, if terms within
// their range describe the data much worse.
void try_dashpot(const FitOptions& options, const std::vector<int>& blocks,
                 const ModelWith& model_with, SlowTimes slow, FittedModel& fitted) {
  // The profile of E_inf needs it as the first common column; constraints know no dashpot.
  if (!fitted.model->has_loss()) return;  // no storage modulus shows a dashpot
  if (!options.constraints.empty() || options.allow_negative) return;
  if (options.is_liquid && options.with_profiles) return;
  FittedModel other{model_with(/*with_dashpot=*/true, slow), {}};
  other.fit = fit_spectrum(*other.model, blocks, options);
  const bool is_used = other.fit.state.coefficients[other.model->dashpot()] > 0.0;
  if (is_used && is_much_better(other, fitted)) fitted = std::move(other);
}

// The fit of a liquid whose slowest time may lie far below the measured frequencies, if orders with a
// time at the end of the usual range were left out and describe the data much better.
void try_slow_dashpot(const FitOptions& options, const std::vector<int>& blocks,
                      const ModelWith& model_with, FittedModel& fitted) {
  // Laws of few parameters are compared with the series as it is within the usual range.
  if (!options.is_liquid || options.with_laws || !fitted.model->has_loss()) return;
  const Eigen::VectorXd& usual = fitted.fit.state.ln_tau;
  const bool is_at_end = usual.size() > 0 && fitted.model->is_longest(usual.maxCoeff());
  if (!fitted.fit.scores.wants_slower && !is_at_end) return;
  if (!options.constraints.empty() || options.allow_negative || options.with_profiles) return;
  FittedModel other{model_with(/*with_dashpot=*/false, SlowTimes::kFarBeyond), {}};
  other.fit = fit_spectrum(*other.model, blocks, options);
  try_dashpot(options, blocks, model_with, SlowTimes::kFarBeyond, other);
  const Eigen::VectorXd& ln_tau = other.fit.state.ln_tau;
  const bool is_used = ln_tau.size() > 0 && ln_tau.maxCoeff() > fitted.model->ln_tau_max();
  if (is_used && is_much_better(other, fitted)) fitted = std::move(other);
}

void report_dashpot(const FittedModel& fitted, FitResult& result) {
  const Index at = fitted.model->dashpot();
  if (at < 0) return;
  result.dashpot_Pa_s = fitted.fit.state.coefficients[at];
  result.dashpot_se_Pa_s = std::sqrt(std::max(0.0, fitted.fit.covariance(at, at)));
  result.flags.push_back(
      {"fast-dashpot", 0,
       "part of the loss modulus rises in proportion to the frequency, as that of a dashpot of " +
           text_of(*result.dashpot_Pa_s, 4) +
           " Pa s (a solvent, or relaxation far faster than the measured frequencies). The dashpot "
           "was fitted beside the terms; E0, the terms and the material do not contain it"});
}

constexpr const char* kSlowDashpot = "slow-dashpot";

// Of a liquid whose slowest time lies beyond the usual range: the record cannot tell its plateau
// from an equilibrium modulus with a slower relaxation above it.
void report_slow_dashpot(FitResult& result) {
  const FittedTerm& slowest = result.terms.back();
  result.E_inf_interval_95.high =
      std::max(result.E_inf_interval_95.high, slowest.modulus_Pa_95.high);
  result.flags.push_back(
      {kSlowDashpot, 0,
       "at the lowest frequencies the storage modulus is a plateau of " +
           text_of(slowest.modulus_Pa, 4) +
           " Pa, and the loss modulus falls as one over the frequency, as with a dashpot of " +
           text_of(slowest.modulus_Pa * slowest.tau_s, 3) +
           " Pa s in series: relaxation slower than the measured frequencies. The slowest term "
           "stands for it. Part of the plateau may be an equilibrium modulus, so the interval of "
           "E_inf reaches from 0 to the plateau. Lower frequencies would decide it"});
}

// What a fit says about E_inf = 0 is less sure beside a slow dashpot.
void drop_liquid_claim(FitResult& result) {
  const auto is_slow = [](const MaterialFlag& flag) { return flag.name == kSlowDashpot; };
  if (std::none_of(result.flags.begin(), result.flags.end(), is_slow)) return;
  std::erase_if(result.flags, [](const MaterialFlag& flag) { return flag.name == "liquid"; });
}

// Structure in the residuals of both moduli over frequency.
void examine_moduli(const DmaModel& model, const SpectralFit& fit, FitResult& result) {
  std::vector<double> at_Hz;
  for (Index i = 0; i < model.n_rows(); ++i) {
    at_Hz.push_back(model.frequency_Hz(i % model.n_frequencies()));
  }
  result.lack_of_fit = lack_of_fit(model, fit.state, at_Hz, fit.rss);
  flag_lack_of_fit({.unit = "%",
                    .scale = 100.0,
                    .at = "f",
                    .at_unit = "Hz",
                    .advice = "a wrong column or shift, or too few terms"},
                   result);
}

void add_curves(const DmaModel& model, const SpectralState& state, FitResult& result) {
  const Eigen::VectorXd fitted = model.fitted(state).cwiseProduct(model.row_sigma());
  const Eigen::VectorXd measured = model.data().cwiseProduct(model.row_sigma());
  const Eigen::VectorXd sigma = result.noise.sigma * model.row_sigma();
  const Index count = model.n_frequencies();
  for (Index i = 0; i < count; ++i) {
    const Index k = count + i;
    result.curves.add(model.frequency_Hz(i), measured[i], fitted[i], sigma[i]);
    if (!model.has_loss()) continue;
    result.curves.add_loss(measured[k], fitted[k], sigma[k]);
  }
  result.curves.unit = "Pa";
}

// The floor of one modulus by the likelihood of its residuals, normal with variances in proportion to
// value^2 + floor^2; 0 if a floor does not raise the logarithm of the likelihood by six (strong evidence,
// Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773).
double likely_floor_Pa(const Eigen::VectorXd& value_Pa, const Eigen::VectorXd& residual_Pa) {
  constexpr Index kFewest = 12;
  constexpr double kEnough = 6.0, kLeast = 1e-6, kMost = 10.0, kPerDecade = 8.0;
  const auto n = static_cast<double>(value_Pa.size());
  if (value_Pa.size() < kFewest) return 0.0;
  const auto log_likelihood = [&](double floor_Pa) {
    const Eigen::ArrayXd variance = value_Pa.array().square() + floor_Pa * floor_Pa;
    const double mean = (residual_Pa.array().square() / variance).mean();
    return -0.5 * (n * std::log(mean) + variance.log().sum());
  };
  const double largest_Pa = value_Pa.cwiseAbs().maxCoeff();
  const double without = log_likelihood(kLeast * largest_Pa);
  double best = without + kEnough, floor_Pa = 0.0;
  for (double share = kLeast; share < kMost; share *= std::pow(10.0, 1.0 / kPerDecade)) {
    const double one = log_likelihood(share * largest_Pa);
    if (!(one > best)) continue;
    best = one;
    floor_Pa = share * largest_Pa;
  }
  return floor_Pa;
}

ModulusFloors likely_floors(const DmaModel& model, const SpectralState& state) {
  const Eigen::VectorXd fitted = model.fitted(state);
  const Eigen::VectorXd value_Pa = fitted.cwiseProduct(model.row_sigma());
  const Eigen::VectorXd residual_Pa = (model.data() - fitted).cwiseProduct(model.row_sigma());
  const Index count = model.n_frequencies();
  return {likely_floor_Pa(value_Pa.head(count), residual_Pa.head(count)),
          model.has_loss() ? likely_floor_Pa(value_Pa.tail(count), residual_Pa.tail(count)) : 0.0};
}

void note_floors(const ModulusFloors& floors, double relative, FitResult& result) {
  if (floors.storage_Pa == 0.0 && floors.loss_Pa == 0.0) return;
  const auto part = [&](double floor_Pa) {
    return floor_Pa > 0.0 ? text_of(relative * floor_Pa, 2) + " Pa" : std::string("none");
  };
  result.flags.push_back({"noise-floor", 0,
                          "beside noise in proportion to the value (" +
                              text_of(100.0 * relative, 2) +
                              " %) the moduli have noise that does not depend on it (storage: " +
                              part(floors.storage_Pa) + ", loss: " + part(floors.loss_Pa) +
                              "). Each row weighs by both"});
}

// What a storage modulus without the loss modulus leaves open. Relaxation slower than its frequencies adds a
// constant, as E_inf does.
void report_storage_alone(FitResult& result) {
  std::erase_if(result.flags, [](const MaterialFlag& flag) {
    return flag.name == "slow-term-hidden" || flag.name == "slower-relaxation";
  });
  result.flags.push_back(
      {"storage-alone", 0,
       "only the storage modulus was given. It cannot show relaxation slower than the lowest "
       "frequency, which adds a constant as E_inf does (the interval of E_inf includes that), nor "
       "relaxation faster than the highest, which E0 lacks, nor a dashpot; and it cannot be "
       "checked against the "
       "loss modulus (Kramers-Kronig). Losses that follow from this result are those of its terms "
       "alone. Export the loss modulus or the phase as well"});
}

FitResult fit_moduli(std::span<const double> frequency_Hz, std::span<const double> storage_Pa,
                     std::span<const double> loss_Pa, const FitOptions& options) {
  // A block is a run of neighbouring frequencies; E' and E'' of one frequency share a block.
  std::vector<int> blocks = log_time_blocks(frequency_Hz, 0.0, 1);
  if (!loss_Pa.empty()) blocks.insert(blocks.end(), blocks.begin(), blocks.end());
  ModulusFloors floors;
  const ModelWith model_with = [&](bool with_dashpot, SlowTimes slow) {
    return std::make_unique<DmaModel>(frequency_Hz, storage_Pa, loss_Pa, options, with_dashpot,
                                      slow, floors);
  };
  FittedModel fitted{model_with(/*with_dashpot=*/false, SlowTimes::kNearRange), {}};
  const double usual_ln_tau = fitted.model->ln_tau_max();
  fitted.fit = fit_spectrum(*fitted.model, blocks, options);
  // Weights that are far off leave their mark on the residual, so that a second estimate follows.
  constexpr int kRounds = 2;
  constexpr double kRoundingOfData = 1e-6;  // relative
  for (int round = 0; round < kRounds; ++round) {
    // Several tests together weigh relative to the values only.
    if (options.keep_rows || fitted.fit.variance < kRoundingOfData * kRoundingOfData) break;
    const ModulusFloors found = likely_floors(*fitted.model, fitted.fit.state);
    const bool is_any = found.storage_Pa > 0.0 || found.loss_Pa > 0.0;
    if (!is_any && round == 0) break;
    floors = found;
    fitted.model = model_with(/*with_dashpot=*/false, SlowTimes::kNearRange);
    fitted.fit = fit_spectrum(*fitted.model, blocks, options);
  }
  try_dashpot(options, blocks, model_with, SlowTimes::kNearRange, fitted);
  try_slow_dashpot(options, blocks, model_with, fitted);
  const DmaModel& model = *fitted.model;
  const SpectralFit& fit = fitted.fit;
  FitResult result;
  result.kind = FitKind::kDma;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  fit_laws(model, fit, result);
  result.n_samples = frequency_Hz.size();
  result.fit_from_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.back());
  result.fit_to_s = 1.0 / (2.0 * std::numbers::pi * frequency_Hz.front());
  const TestWindow window{0.0, 0.0, result.fit_from_s, 3.0 * result.fit_to_s};
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
  carry_slow_doubt(model, fit, 2.0 * std::numbers::pi * frequency_Hz.front(), result);
  report_highest_storage(frequency_Hz.back(), result);
  report_dashpot(fitted, result);
  note_floors(floors, result.noise.sigma, result);
  if (model.ln_tau_max() > usual_ln_tau) report_slow_dashpot(result);
  examine_moduli(model, fit, result);
  if (options.with_curves) add_curves(model, fit.state, result);
  if (!model.has_loss()) {
    report_storage_alone(result);
    return result;
  }
  if (const auto found = kramers_kronig_break(model, fit.state.ln_tau)) {
    add_contradiction(*found, "", result);
  }
  if (options.keep_rows) {
    KeptRows kept{.shape = KeptRows::Shape::kOscillation, .window = window};
    kept.at.assign(frequency_Hz.begin(), frequency_Hz.end());
    kept.value.assign(storage_Pa.begin(), storage_Pa.end());
    kept.loss.assign(loss_Pa.begin(), loss_Pa.end());
    kept.with_dashpot = model.dashpot() >= 0;
    keep(std::move(kept), fit, result);
  }
  return result;
}

}  // namespace

FitResult fit_dma(const DmaData& data, const FitOptions& options) {
  constexpr std::size_t kLeastRows = 3;
  std::vector<std::span<const double>> columns{data.frequency_Hz, data.storage_Pa};
  const bool has_loss = !data.loss_Pa.empty();
  if (has_loss) columns.emplace_back(data.loss_Pa);
  const CleanViews clean(columns, kLeastRows);
  const auto frequency_Hz = clean.column(0), storage_Pa = clean.column(1);
  const auto loss_Pa = has_loss ? clean.column(2) : std::span<const double>{};
  if (!(frequency_Hz.front() > 0.0)) {
    throw std::runtime_error("a frequency of " + text_of(frequency_Hz.front()) +
                             " Hz cannot be fitted; frequencies must be positive");
  }
  for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
    if (!has_loss && storage_Pa[i] == 0.0) {
      throw std::runtime_error("the storage modulus is zero at " + text_of(frequency_Hz[i]) +
                               " Hz: this is not a measurement. Remove the row");
    }
    if (storage_Pa[i] != 0.0 || loss_Pa[i] != 0.0) continue;
    throw std::runtime_error("storage and loss modulus are both zero at " +
                             text_of(frequency_Hz[i]) +
                             " Hz: this is not a measurement. Remove the row");
  }
  check_sign(storage_Pa, "a storage modulus", "storage_modulus_Pa");
  check_loss_sign(loss_Pa);
  FitResult result = fit_solid_or_liquid(options, [&](const FitOptions& as) {
    return fit_moduli(frequency_Hz, storage_Pa, loss_Pa, as);
  });
  drop_liquid_claim(result);
  add_left_out(result, left_out::kNotANumber, clean.n_left_out());
  flag_left_out(result);
  keep_intervals_positive(options, result);
  return result;
}

}  // namespace viscard
