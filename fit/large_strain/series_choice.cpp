#include "fit/large_strain/series_choice.h"

#include "fit/large_strain/series_refine.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

bool is_at_end(const HyperelasticPoint& point, const LargeStrainRows& rows) {
  const TimeRange range = time_range(rows);
  constexpr double kTouch = 1e-3;
  return std::any_of(point.terms.begin(), point.terms.end(), [&](const RubberTerm& term) {
    return term.tau_s < range.low_s * (1.0 + kTouch) || term.tau_s > range.high_s * (1.0 - kTouch);
  });
}

bool lasts(const HyperelasticPoint& point, const LargeStrainRows& rows) {
  return !point.terms.empty() && point.terms.back().tau_s > rows.longest_test_s() / 3.0;
}

}  // namespace

std::size_t choose_series(const std::vector<HyperelasticPoint>& path, const LargeStrainRows& rows,
                          double n_effective, std::vector<RubberOrder>& orders) {
  constexpr double kStrong = 6.0;
  const auto n_readings = static_cast<double>(rows.n_readings());
  const double least = 1e-18 * rows.data().squaredNorm();  // below, rounding
  std::size_t best = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double p = static_cast<double>(path[i].moduli.size() + path[i].shapes.size()) +
                     2.0 * static_cast<double>(path[i].terms.size()) + 1.0;
    RubberOrder order;
    order.n_terms = static_cast<int>(path[i].terms.size());
    order.bic = n_effective * std::log(std::max(path[i].rss, least) / n_readings) +
                p * std::log(n_effective);
    order.is_eligible = path[i].is_converged && !is_at_end(path[i], rows);
    orders.push_back(order);
    if (order.is_eligible && (!orders[best].is_eligible || order.bic < orders[best].bic)) best = i;
  }
  while (best > 0 && lasts(path[best], rows)) {
    const auto better = [&](std::size_t a, std::size_t b) { return orders[a].bic < orders[b].bic; };
    std::size_t next = best;
    for (std::size_t i = 0; i < best; ++i) {
      if (orders[i].is_eligible && (next == best || better(i, next))) next = i;
    }
    if (next == best || orders[next].bic - orders[best].bic > kStrong) break;
    best = next;
  }
  orders[best].is_chosen = true;
  return best;
}

}  // namespace viscard
