#include "fit/curves/model_variant.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"
#include "models/maths/interval.h"
#include "models/maths/may_stop.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

Index block_length(Index rows, double inflation) {
  const double rho = (inflation - 1.0) / (inflation + 1.0);
  const double ratio = rho / (1.0 - rho * rho);
  const double length = std::cbrt(6.0 * ratio * ratio * static_cast<double>(rows));
  return std::clamp<Index>(static_cast<Index>(std::ceil(length)), 1, std::max<Index>(1, rows / 4));
}

// The drawn values, one list per quantity.
struct Drawn {
  std::vector<double> E0, E_inf, sum_g;
  std::vector<std::vector<double>> modulus, g, tau;

  void add(const PronySeries& series) {
    E0.push_back(instantaneous_modulus_Pa(series));
    E_inf.push_back(series.equilibrium_modulus_Pa);
    sum_g.push_back(1.0 - E_inf.back() / E0.back());
    modulus.resize(series.terms.size());
    g.resize(series.terms.size());
    tau.resize(series.terms.size());
    for (std::size_t i = 0; i < series.terms.size(); ++i) {
      modulus[i].push_back(series.terms[i].modulus_Pa);
      g[i].push_back(series.terms[i].modulus_Pa / E0.back());
      tau[i].push_back(series.terms[i].relaxation_time_s);
    }
  }
};

}  // namespace

void bootstrap_intervals(const SpectralModel& model, const SpectralState& state,
                         const SeriesFromState& series_from_state, const BootstrapOptions& options,
                         FitResult& result) {
  const Eigen::VectorXd fitted = model.fitted(state);
  const Index rows = model.n_rows();
  const Index n_parameters = state.coefficients.size() + state.n_terms() + model.n_nuisances();
  // The residuals of a fit are smaller than the noise; correct for the degrees of freedom used.
  const double grow = std::sqrt(static_cast<double>(rows) /
                                static_cast<double>(std::max<Index>(1, rows - n_parameters)));
  const Eigen::VectorXd residual = grow * (model.data() - fitted);
  const Index length = block_length(rows, options.inflation);
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd prior_sd = model.of_nuisances(&Nuisance::prior_sd);
  Drawn drawn;
  for (int draw = 0; draw < options.n_resamples; ++draw) {
    may_stop();
    if (options.progress) options.progress(static_cast<double>(draw) / options.n_resamples);
    Eigen::VectorXd data = fitted;
    for (Index begin = 0; begin < rows; begin += length) {
      const auto from = static_cast<Index>(random() % static_cast<std::uint64_t>(rows));
      for (Index k = 0; k < std::min(length, rows - begin); ++k) {
        data[begin + k] += residual[(from + k) % rows];
      }
    }
    ModelVariant resampled(model, std::move(data));
    // A prior is a reading of its nuisance, so it scatters from resample to resample too.
    Eigen::VectorXd priors = state.nuisance;
    for (Index k = 0; k < priors.size(); ++k) {
      if (prior_sd[k] > 0.0) priors[k] += prior_sd[k] * normal(random);
    }
    resampled.move_priors(priors);
    const SpectralState refitted =
        quick_search(resampled, state, {.max_iterations = 60, .tolerance = 1e-8});
    const auto series = possible_series(resampled, refitted, series_from_state);
    if (series && series->terms.size() == result.terms.size()) drawn.add(*series);
  }
  if (drawn.E0.size() < 20) return;  // too few values for percentiles
  result.E0_interval_95 = middle_95(drawn.E0);
  result.E_inf_interval_95 = middle_95(drawn.E_inf);
  result.sum_g_95 = middle_95(drawn.sum_g);
  for (std::size_t i = 0; i < result.terms.size(); ++i) {
    result.terms[i].modulus_Pa_95 = middle_95(drawn.modulus[i]);
    result.terms[i].g_95 = middle_95(drawn.g[i]);
    result.terms[i].tau_s_95 = middle_95(drawn.tau[i]);
  }
  result.n_bootstrap = static_cast<int>(drawn.E0.size());
}

}  // namespace viscard
