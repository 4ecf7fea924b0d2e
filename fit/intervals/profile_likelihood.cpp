#include "fit/curves/model_variant.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kPinned = 1e4;  // see fit/curves/model_variant.h
constexpr int kMostSteps = 16;   // half standard errors on either side

struct Axis {
  double best = 0.0, step = 0.0, low = 0.0, high = 0.0;
};

// Rise of the sum of squares with the parameter held, and the material's own parameter there.
struct Point {
  double rise = 0.0, shown = 0.0;
};
using Hold = std::function<Point(double)>;

// Steps from the estimate to one side until the rise exceeds its limit or the bound is reached.
// `hold` fits all other parameters with this one held, starting from its previous result.
double walk(const Axis& axis, double sign, double shown_best, const Hold& hold,
            ProfileCurve& curve) {
  double last = shown_best;
  double last_root = 0.0;
  const double bound = sign > 0.0 ? axis.high : axis.low;
  const double wanted = std::sqrt(kChiSquare95);
  for (int k = 1; k <= kMostSteps; ++k) {
    const double value = std::clamp(axis.best + sign * k * axis.step, axis.low, axis.high);
    const Point at = hold(value);
    const double root = std::sqrt(std::max(0.0, at.rise));
    curve.value.push_back(at.shown);
    curve.rise.push_back(root * root);
    if (root >= wanted) {  // interpolate the square root, which is nearly linear
      return last + (at.shown - last) * (wanted - last_root) / std::max(root - last_root, 1e-300);
    }
    if (value == bound) return at.shown;
    last = at.shown;
    last_root = root;
  }
  return std::isfinite(bound) ? hold(bound).shown : bound;
}

ProfileCurve profile(const std::string& name, const Axis& axis, double shown_best,
                     const std::function<Hold()>& fresh_hold) {
  ProfileCurve curve;
  curve.parameter = name;
  curve.interval_95.low = walk(axis, -1.0, shown_best, fresh_hold(), curve);
  std::reverse(curve.value.begin(), curve.value.end());
  std::reverse(curve.rise.begin(), curve.rise.end());
  curve.value.push_back(shown_best);
  curve.rise.push_back(0.0);
  curve.interval_95.high = walk(axis, 1.0, shown_best, fresh_hold(), curve);
  return curve;
}

bool is_usable(double variance) {
  return std::isfinite(variance) && variance > 0.0;
}

}  // namespace

std::vector<ProfileCurve> profile_likelihoods(const SpectralModel& model,
                                              const SpectralState& state, double variance,
                                              const Eigen::MatrixXd& covariance,
                                              const Eigen::MatrixXd& white,
                                              const SeriesFromState& series_from_state) {
  std::vector<ProfileCurve> curves;
  const RefineOptions options{.max_iterations = 40, .tolerance = 1e-8};
  const auto scale_of = [&](Index j) { return variance * covariance(j, j) / white(j, j); };
  const PronySeries best = series_from_state(state);
  const bool has_equilibrium = model.n_common() > 0 && !model.common()[0].is_free;
  if (has_equilibrium && is_usable(covariance(0, 0))) {
    const double se = std::sqrt(covariance(0, 0));
    const double low = model.may_be_negative() ? -std::numeric_limits<double>::infinity() : 0.0;
    const Axis axis{state.coefficients[0], 0.5 * se, low, std::numeric_limits<double>::infinity()};
    curves.push_back(profile("E_inf", axis, best.equilibrium_modulus_Pa, [&] {
      return [&, start = state](double value) mutable {
        const double weight = kPinned * std::sqrt(variance / covariance(0, 0));
        start = quick_search(PinnedEquilibrium(model, value, weight), start, options);
        return Point{(start.rss - state.rss) / scale_of(0),
                     series_from_state(start).equilibrium_modulus_Pa};
      };
    }));
  }
  for (Index i = 0; i < state.n_terms(); ++i) {
    const Index j = state.coefficients.size() + i;
    if (!is_usable(covariance(j, j))) continue;
    const Axis axis{state.ln_tau[i], 0.5 * std::sqrt(covariance(j, j)), model.ln_tau_min(),
                    model.ln_tau_max()};
    const auto shown = [&series_from_state](const SpectralState& at, Index term) {
      const PronySeries series = series_from_state(at);
      const auto slot = static_cast<std::size_t>(term);
      return slot < series.terms.size() ? std::log(series.terms[slot].relaxation_time_s)
                                        : std::numeric_limits<double>::quiet_NaN();
    };
    curves.push_back(profile("ln_tau_" + std::to_string(i + 1), axis, shown(state, i), [&, i, j] {
      return [&, j, start = state, at = i](double value) mutable {
        start.ln_tau[at] = value;
        RefineOptions held = options;
        held.held = at;
        start = quick_search(model, start, held);
        at = std::find(start.ln_tau.begin(), start.ln_tau.end(), value) - start.ln_tau.begin();
        at = std::min(at, start.n_terms() - 1);
        return Point{(start.rss - state.rss) / scale_of(j), shown(start, at)};
      };
    }));
  }
  return curves;
}

}  // namespace viscard
