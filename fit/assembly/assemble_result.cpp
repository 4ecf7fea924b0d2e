#include "fit/assembly/assemble_result.h"

#include "fit/assembly/continuous_spectrum.h"
#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/level_noise.h"
#include "fit/intervals/slow_noise.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/polish.h"
#include "fit/search/separable.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// The largest number of terms that leaves one row more than parameters. With as many parameters as
// rows the fit passes through every row, and nothing is left to estimate the noise.
int most_terms(const SpectralModel& model) {
  const Eigen::Index spare = model.n_rows() - 1 - model.n_common() - model.n_nuisances();
  return static_cast<int>(std::max<Eigen::Index>(0, spare / 2));
}

// Fits all orders, so that a requested order is as good as the same order in a free choice.
std::vector<SpectralState> path_for(const SpectralModel& model, const FitOptions& options) {
  OrderPathOptions path_options;
  path_options.max_terms =
      std::min(std::max(options.n_terms.value_or(0), options.max_terms), most_terms(model));
  const std::unique_ptr<SpectralModel> coarse = model.coarse();
  std::vector<SpectralState> path = order_path(coarse ? *coarse : model, path_options);
  if (coarse) {
    for (SpectralState& state : path) {
      const bool is_converged = state.is_converged;
      state = solve_coefficients(model, state.ln_tau, state.nuisance);
      state.is_converged = is_converged;
    }
    drop_useless_orders(path);
  }
  if (path.empty()) {
    throw std::runtime_error(
        "no model fits these data: every fitted modulus is zero. Check the sign of the fitted "
        "column");
  }
  return path;
}

// The requested order, or the next smaller one that the data can support.
std::size_t position_of(const std::vector<SpectralState>& path, int n_terms) {
  std::size_t position = 0;
  while (position + 1 < path.size() && path[position + 1].n_terms() <= n_terms) ++position;
  return position;
}

void note_fewer_terms(const SpectralModel& model, SpectralFit& fit) {
  const auto found = static_cast<int>(fit.path[fit.scores.chosen].n_terms());
  const int wanted = fit.options.n_terms.value_or(0);
  if (found == wanted || !fit.options.constraints.empty()) return;
  const int most = most_terms(model);
  const std::string why =
      found == most
          ? counted(static_cast<std::size_t>(model.n_rows()), "value") +
                " cannot determine more than " + std::to_string(most)
          : "no fit with more than " + std::to_string(found) + " describes these data better";
  fit.notes.push_back({"fewer-terms", 0,
                       counted(static_cast<std::size_t>(wanted), "term") +
                           (wanted == 1 ? " was" : " were") + " requested; " + why});
}

double variance_of(const SpectralModel& model, const SpectralState& state, double rss) {
  return rss / std::max(1.0, model.n_samples() - static_cast<double>(model.n_parameters(state)));
}

// A fit removes slow parts from its residual, which is therefore correlated negatively, all the more
// in few rows. Noise with less than the variance of white noise in its slow part counts as white.
Autoregression noise_of(const SpectralModel& model, const SpectralState& state) {
  Autoregression noise = autoregression(model.residual_series(state));
  return noise.inflation() > 1.0 ? noise : Autoregression{};
}

bool is_creep(const SpectralModel& model) {
  return model.n_common() > 0 && model.common()[0].name == "J_g";
}

// The interval of E_inf extends as far down as the likelihood allows with one more slow term
// (carry_order_doubt). In creep it does not: there, a retardation slower than a tenth of the record
// may be flow.
bool may_flow(const SpectralModel& model, const SpectralFit& fit, const FitResult& result) {
  if (fit.scores.wants_slower || result.E_inf_interval_95.low <= 0.0) return true;
  const double late = model.ln_tau_max() - std::log(30.0);  // ln_tau_max() is three records
  return is_creep(model) && fit.state.n_terms() > 0 && fit.state.ln_tau.maxCoeff() > late;
}

// Profiles replace the intervals of the times if the times of the state are the material's own.
// With a frame in series they replace that of E_inf only, which is a function of the stage's E_inf
// alone. In creep the intervals from the covariance stay.
void add_profiles(const SpectralModel& model, const SpectralFit& fit,
                  const SeriesFromState& series_from_state, FitResult& result) {
  const PronySeries series = series_from_state(fit.state);
  if (is_creep(model) || static_cast<Eigen::Index>(series.terms.size()) != fit.state.n_terms())
    return;
  const Eigen::MatrixXd white = parameter_covariance(model, fit.state, fit.variance);
  result.profiles =
      profile_likelihoods(model, fit.state, fit.variance, fit.covariance, white, series_from_state);
  const bool are_own_times =
      model.n_common() == 0 || series.equilibrium_modulus_Pa == fit.state.coefficients[0];
  for (const ProfileCurve& curve : result.profiles) {
    if (curve.parameter == "E_inf") {
      result.E_inf_interval_95 = curve.interval_95;
    } else if (are_own_times) {
      const std::size_t term = std::stoul(curve.parameter.substr(7)) - 1;
      result.terms[term].tau_s_95 = {std::exp(curve.interval_95.low),
                                     std::exp(curve.interval_95.high)};
    }
  }
}

// Whether the coefficients and times of a state are those of the material.
bool is_own_series(const SpectralModel& model, const SpectralFit& fit,
                   const SeriesFromState& series_from_state) {
  if (is_creep(model)) return false;
  const PronySeries series = series_from_state(fit.state);
  const bool has_equilibrium =
      model.n_common() > 0 && model.common()[0].name.rfind("E_inf", 0) == 0;
  return static_cast<Eigen::Index>(series.terms.size()) == fit.state.n_terms() &&
         (!has_equilibrium || series.equilibrium_modulus_Pa == fit.state.coefficients[0]);
}

void take_level_noise(const SpectralModel& model, SpectralFit& fit) {
  const LevelNoise level = level_noise(model, fit.state, fit.noise.inflation());
  fit.row_scale = level.row_scale;
  if (!level.note.empty()) fit.notes.push_back({"noise-grows", 0, level.note});
}

void widen_for_slow_noise(const SpectralModel& model, SpectralFit& fit) {
  fit.slow = slow_noise(model, fit.state, fit.variance, fit.noise);
  const SlowNoise& slow = fit.slow;
  const bool is_doubtful = !slow.doubt.empty();
  fit.covariance =
      widened(fit.covariance,
              is_doubtful ? parameter_covariance(model, fit.state, fit.variance, {}, fit.row_scale)
                          : fit.covariance,
              slow);
  if (!slow.doubt.empty()) fit.notes.push_back({"slow-noise", 0, slow.doubt});
}

// Takes the optimum of the averages or, where they neglect too much, that of all samples. Of white
// noise they neglect 3e-10 of the sum of squares (BinShapes), of noise with a memory and of misfit
// much more.
void take_optimum(const SpectralModel& model, const SpectralState& averaged, SpectralFit& fit) {
  constexpr double kWhite = 1.1;
  fit.state = averaged;
  fit.rss = full_rss(model, averaged);
  Autoregression noise = noise_of(model, averaged);
  if (noise.inflation() > kWhite) {
    const PolishedState polished = polish_samples(model, averaged);
    fit.state = polished.state;
    fit.rss = polished.rss;
    noise = noise_of(model, fit.state);
  }
  fit.variance = variance_of(model, fit.state, fit.rss);
  if (!fit.options.white_noise) fit.noise = std::move(noise);
}

}  // namespace

double full_rss(const SpectralModel& model, const SpectralState& state) {
  return state.rss + model.hidden_rss(state);
}

void search_orders(const SpectralModel& model, const std::vector<int>& blocks,
                   std::optional<double> inflation, SpectralFit& fit) {
  fit.path = path_for(model, fit.options);
  ChoiceInput choice;
  choice.n_samples = model.n_samples();
  choice.blocks = blocks;
  for (const SpectralState& state : fit.path) choice.rss.push_back(full_rss(model, state));
  choice.inflation = inflation ? *inflation : noise_of(model, fit.path.back()).inflation();
  fit.scores = choose_order(model, fit.path, choice);
  if (!fit.options.n_terms) return;
  for (OrderRow& row : fit.scores.rows) row.is_chosen = false;
  fit.scores.chosen = position_of(fit.path, *fit.options.n_terms);
  fit.scores.rows[fit.scores.chosen].is_chosen = true;
}

SpectralFit fit_spectrum(const SpectralModel& model, const std::vector<int>& blocks,
                         const FitOptions& options) {
  SpectralFit fit;
  fit.options = options;
  search_orders(model, blocks, options.white_noise ? std::optional(1.0) : std::nullopt, fit);
  if (options.n_terms) note_fewer_terms(model, fit);
  // The quick search comes near the optimum and leaves little work for the slower ones.
  const SpectralState near = quick_search(model, fit.path[fit.scores.chosen], {.tolerance = 1e-10});
  take_optimum(model, polish(model, refine(model, near)), fit);
  take_level_noise(model, fit);
  fit.covariance = parameter_covariance(model, fit.state, fit.variance, fit.noise, fit.row_scale);
  if (!options.white_noise) widen_for_slow_noise(model, fit);
  if (!options.constraints.empty()) constrain(model, options, fit);
  return fit;
}

void keep(KeptRows rows, const SpectralFit& fit, FitResult& result) {
  rows.variance = fit.variance;
  rows.noise = fit.noise;
  rows.slow = fit.slow;
  rows.row_scale = fit.row_scale;
  rows.n_parameters = result.evidence.n_parameters;
  result.kept = std::make_shared<const KeptRows>(std::move(rows));
}

void fill_result(const SpectralModel& model, const SpectralFit& fit,
                 const SeriesFromState& series_from_state, FitResult& result) {
  fill_parameters(model, fit.state, fit.covariance, series_from_state, result);
  if (fit.options.constraints.empty()) {
    if (fit.options.with_profiles) add_profiles(model, fit, series_from_state, result);
    if (fit.options.n_bootstrap > 0) {
      bootstrap_intervals(model, fit.state, series_from_state,
                          {.n_resamples = fit.options.n_bootstrap,
                           .inflation = fit.noise.inflation(),
                           .progress = fit.options.resampled},
                          result);
    }
    carry_order_doubt(model, fit, series_from_state, result);
    if (fit.options.with_spectrum && is_own_series(model, fit, series_from_state)) {
      result.spectrum = continuous_spectrum(model, fit);
    }
  }
  result.flags.insert(result.flags.end(), fit.notes.begin(), fit.notes.end());
  result.orders = fit.scores.rows;
  result.noise.sigma = std::sqrt(fit.variance);
  result.noise.inflation = fit.noise.inflation();
  if (fit.scores.wants_faster) {
    result.flags.push_back({"faster-relaxation", 0,
                            "part of the relaxation is faster than the first samples can show: E0 "
                            "is the modulus at the first sample, a lower bound"});
  }
  if (fit.scores.wants_slower) {
    result.flags.push_back(
        {"slower-relaxation", 0,
         fit.options.is_liquid
             ? "the record does not show the slowest relaxation: the viscosity is a lower bound"
             : "the material still relaxes at the end of the record: E_inf is an upper bound"});
  }
  result.rss = fit.rss;
  result.evidence = {fit.rss, model.n_samples(), fit.noise.inflation(),
                     static_cast<int>(model.n_parameters(fit.state))};
  result.may_flow = may_flow(model, fit, result);
  const Eigen::VectorXd sigma = model.row_sigma();
  if (sigma.size() > 0) {  // convert every rss to the unit of the data
    const auto in_unit = [&](const SpectralState& state) {
      const Eigen::VectorXd left = model.fitted(state) - model.data();
      return model.in_unit_of_samples(left).squaredNorm() + model.hidden_rss_in_unit(state);
    };
    result.rss = in_unit(fit.state);
    // In the same proportion as the weighted sums, which fall with every term.
    const double unit = fit.rss > 0.0 ? result.rss / fit.rss : 1.0;
    for (OrderRow& row : result.orders) row.rss *= unit;
  }
  result.n_samples = static_cast<std::size_t>(model.n_samples());
  result.n_averages = static_cast<std::size_t>(model.n_rows());
  result.is_converged = fit.state.is_converged;
  judge(result);
}

void fill_step_curves(const StepModel& model, const SpectralFit& fit, const std::string& unit,
                      FitResult& result) {
  const Eigen::VectorXd fitted = model.fitted(fit.state);
  for (std::size_t i = 0; i < model.bins().size(); ++i) {
    const LogBin& bin = model.bins()[i];
    const double root = std::sqrt(bin.count) / bin.sigma;
    result.curves.add(bin.time_s, bin.value, fitted[static_cast<Eigen::Index>(i)] / root,
                      result.noise.sigma / root);
  }
  result.curves.unit = unit;
}

void fill_history_curves(const HistoryModel& model, const SpectralFit& fit, const std::string& unit,
                         std::vector<double> motion_start_s, FitResult& result) {
  const Eigen::VectorXd fitted = model.fitted_samples(fit.state);
  const std::vector<std::size_t> begins = model.row_begins();
  const std::vector<double>& output = model.input().output;
  for (std::size_t r = 0; r + 1 < begins.size(); ++r) {
    const double at_s = model.row_time_s()[r];
    if (!motion_start_s.empty() && !(at_s > motion_start_s.front())) continue;
    const auto count = static_cast<double>(begins[r + 1] - begins[r]);
    double measured = 0.0, of_fit = 0.0;
    for (std::size_t i = begins[r]; i < begins[r + 1]; ++i) {
      measured += output[i] / count;
      of_fit += fitted[static_cast<Eigen::Index>(i)] / count;
    }
    result.curves.add(at_s, measured, of_fit, result.noise.sigma / std::sqrt(count));
  }
  result.curves.unit = unit;
  result.curves.motion_start_s = std::move(motion_start_s);
}

void note_weights(const StepModel& model, const ReadingNoise& noise, const std::string& unit,
                  FitResult& result) {
  if (!model.is_weighed()) return;
  const Eigen::VectorXd sigma = model.relative_sigma();
  result.flags.push_back(
      {"noise-grows", 0,
       "the noise grows with the value, from " + text_of(sigma.minCoeff(), 2) + " to " +
           text_of(sigma.maxCoeff(), 2) + " times its root mean square (between neighbours: " +
           text_of(100.0 * noise.share, 2) + " % of the value, at least " +
           text_of(noise.floor, 2) + " " + unit + "). Each sample weighs by its own noise"});
}

SeriesFromState relaxation_series_of(const SpectralModel& model, bool is_liquid) {
  return [&model, is_liquid](const SpectralState& state) {
    PronySeries series{is_liquid ? 0.0 : state.coefficients[0], {}};
    for (Eigen::Index i = 0; i < state.n_terms(); ++i) {
      series.terms.push_back({state.coefficients[model.n_common() + i], std::exp(state.ln_tau[i])});
    }
    return series;
  };
}

std::vector<int> log_time_blocks(std::span<const double> time_s, double zero_s,
                                 std::size_t shortest) {
  std::vector<int> blocks;
  int block = 0;
  std::size_t begin = 0;
  constexpr double kRatio = 1.2589254117941673;  // 10^(1/10)
  const std::size_t longest = std::max(shortest, time_s.size() / 50);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double since_begin = std::abs(time_s[begin] - zero_s);
    const bool is_wide = std::abs(time_s[i] - zero_s) >= kRatio * since_begin;
    if (i >= begin + longest || (i >= begin + shortest && is_wide)) {
      ++block;
      begin = i;
    }
    blocks.push_back(block);
  }
  return blocks;
}

}  // namespace viscard
