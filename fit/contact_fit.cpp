#include "fit/contact_fit.h"

#include "fit/assembly/assemble_result.h"
#include "fit/search/separable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// Largest change of the surface between two courses of contact.
double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// The same times and nuisances fitted to another model.
SpectralState fitted_again(const SpectralModel& model, const SpectralState& start) {
  SpectralState state = solve_coefficients(model, start.ln_tau, start.nuisance);
  if (start.ln_tau.size() + start.nuisance.size() == 0) return state;
  return quick_search(model, state, {.tolerance = 1e-10});
}

// Fits the whole record. The contact history of the series and the fit of the record are updated in
// turn until the contact history no longer changes. The number of terms is that of the state.
WholeRecord settled_record(const ContactTable& table, SpectralState state, PronySeries series,
                           bool with_drift, const FitOptions& options) {
  constexpr int kRounds = 12;
  constexpr double kSame = 1e-5;  // of the range of the depth
  const auto [low, high] = std::minmax_element(table.depth_m.begin(), table.depth_m.end());
  const bool may_drift = options.with_drift && options.drift != TableDrift::kNone;
  std::vector<double> last;
  Course last_touch;
  for (int round = 1;; ++round) {
    const double contact_m = table.contact.is_fitted ? state.nuisance[0] : 0.0;
    WholeRecord whole = whole_record(table, series, contact_m, may_drift);
    whole.input.with_drift |= with_drift;
    const bool is_same = largest_change(last, whole.input.input) <= kSame * (*high - *low) &&
                         relative_change(last_touch, whole.input.touch) <= kSameTouch;
    if (is_same || round == kRounds) return whole;
    last = whole.input.input;
    last_touch = whole.input.touch;
    const HistoryModel model(std::move(whole.input), options);
    state = fitted_again(model, state);
    series = relaxation_series_of(model, options.is_liquid)(state);
  }
}

}  // namespace

HistoryFit fit_history(HistoryInput input, const FitOptions& options) {
  HistoryFit of;
  of.input = std::move(input);
  of.model = std::make_unique<HistoryModel>(of.input, options);
  of.fit =
      fit_spectrum(*of.model, log_time_blocks(of.model->row_time_s(), of.zero_s(), 2), options);
  return of;
}

HistoryFit fit_whole(const ContactTable& table, HistoryFit fitted, const FitOptions& options) {
  constexpr int kOrders = 4;
  const bool with_drift = fitted.input.with_drift;
  for (int round = 0; round < kOrders; ++round) {
    const SpectralState start = fitted.fit.state;
    WholeRecord whole =
        settled_record(table, start, relaxation_series_of(*fitted.model, options.is_liquid)(start),
                       with_drift, options);
    fitted = fit_history(std::move(whole.input), options);
    fitted.n_contacts = whole.n_contacts;
    fitted.n_adhesion = whole.n_adhesion;
    if (fitted.fit.state.n_terms() == start.n_terms()) break;
  }
  return fitted;
}

}  // namespace viscard
