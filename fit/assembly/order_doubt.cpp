#include "fit/assembly/slow_doubt.h"
#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

void widen(Interval& interval, double value, double error) {
  interval.low = std::min(interval.low, value - kNormal95 * error);
  interval.high = std::max(interval.high, value + kNormal95 * error);
}

double width(const Interval& interval) {
  return interval.high - interval.low;
}

// Creep without an instantaneous compliance has no finite E0, so it is no alternative.
bool starts_at_zero(const SpectralModel& model, const SpectralState& state) {
  return model.n_common() > 0 && model.common()[0].name == "J_g" && !(state.coefficients[0] > 0.0);
}

// With one more term at the end of the range, whose time the search may move.
double lowest_with_late_term(const SpectralModel& fine, const SpectralFit& fit, double step) {
  const std::unique_ptr<SpectralModel> coarse = fine.coarse();
  const SpectralModel& model = coarse ? *coarse : fine;
  const double least_rss =
      coarse ? solve_coefficients(model, fit.state.ln_tau, fit.state.nuisance).rss : fit.state.rss;
  SpectralState slower = fit.state;
  slower.ln_tau.conservativeResize(slower.n_terms() + 1);
  slower.ln_tau[slower.ln_tau.size() - 1] = model.ln_tau_max();
  return lowest_equilibrium(model, slower,
                            {.least_rss = least_rss, .variance = fit.variance, .step = step});
}

}  // namespace

void carry_order_doubt(const SpectralModel& model, const SpectralFit& fit,
                       const SeriesFromState& series_from_state, FitResult& result) {
  if (fit.options.n_terms) return;  // a requested order has no uncertainty
  constexpr double kStrong = 6.0;
  const Interval E0 = result.E0_interval_95;
  const Interval E_inf = result.E_inf_interval_95;
  std::string others;
  std::size_t last = 0;
  for (std::size_t i = 0; i < fit.path.size(); ++i) {
    const bool is_near =
        std::abs(fit.scores.rows[i].bic - fit.scores.rows[fit.scores.chosen].bic) < kStrong;
    if (i == fit.scores.chosen || !is_near || !is_within_range(model, fit.path[i])) continue;
    if (starts_at_zero(model, fit.path[i])) continue;
    const auto series = possible_series(model, fit.path[i], series_from_state);
    if (!series) continue;
    widen(result.E0_interval_95, instantaneous_modulus_Pa(*series), result.E0_se_Pa);
    widen(result.E_inf_interval_95, series->equilibrium_modulus_Pa, result.E_inf_se_Pa);
    others += (others.empty() ? "" : ", ") + std::to_string(fit.path[i].n_terms());
    last = static_cast<std::size_t>(fit.path[i].n_terms());
  }
  if (width(result.E0_interval_95) > 1.5 * width(E0) ||
      width(result.E_inf_interval_95) > 1.5 * width(E_inf)) {
    result.flags.push_back({"order-uncertain", 0,
                            "fits with " + others + (last == 1 ? " term" : " terms") +
                                " describe the data about as well; the intervals of E0 and E_inf "
                                "include their values"});
  }
  // From a tenth of the record on; ln_tau_max() is three times the record.
  const double late = model.ln_tau_max() - std::log(30.0);
  if (fit.state.n_terms() == 0 || fit.state.ln_tau.maxCoeff() < late) return;
  // Only if the state's parameter is the material's (no frame, no creep) with a constrained sign.
  const bool is_own =
      model.n_common() > 0 && !model.common()[0].is_free &&
      series_from_state(fit.state).equilibrium_modulus_Pa == fit.state.coefficients[0] &&
      fit.state.coefficients[0] > 0.0 && result.E_inf_se_Pa > 0.0;
  if (!is_own || model.may_be_negative()) return;
  result.E_inf_interval_95.low =
      std::min(result.E_inf_interval_95.low, lowest_with_late_term(model, fit, result.E_inf_se_Pa));
}

}  // namespace viscard
