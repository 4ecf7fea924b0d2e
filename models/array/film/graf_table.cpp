#include "models/array/film/graf_table.h"

#include "models/maths/bessel_orders.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr int kPoints = 12;  // per panel
// A panel is as long as twice its way to the singular distance: 3.7^-12 = 1e-7 is left. It is at least this
// share of that distance.
constexpr double kOfGap = 2.0, kLeastPanel = 0.05;

// Runs of functions of equal order.
struct Run {
  Eigen::Index first, count;
  int order;
};
std::vector<Run> runs_of(const std::vector<int>& order) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (runs.empty() || runs.back().order != order[i]) {
      runs.push_back({static_cast<Eigen::Index>(i), 0, order[i]});
    }
    ++runs.back().count;
  }
  return runs;
}

double parity(int of) {
  return of % 2 == 0 ? 1.0 : -1.0;
}

int largest_of(const std::vector<int>& order) {
  return order.empty() ? 0 : *std::max_element(order.begin(), order.end());
}

}  // namespace

GrafTable::GrafTable(const std::vector<double>& k_1_m, const RadialWaves& receivers,
                     const RadialWaves& sources, const Range& range)
    : reach_m_(range.reach_m),
      orders_(std::max(2, 1 + largest_of(receivers.order) + largest_of(sources.order))),
      receivers_(receivers.amplitude.cols()) {
  std::vector<double> breaks_m = {range.nearest_m};
  while (breaks_m.back() < reach_m_ || breaks_m.size() < 2) {
    const double from_m = breaks_m.back();
    const double panel_m =
        std::max(kOfGap * (from_m - range.singular_m), kLeastPanel * range.singular_m);
    const bool is_last = from_m + panel_m > reach_m_ && reach_m_ > from_m;
    breaks_m.push_back(is_last ? reach_m_ : from_m + panel_m);
  }
  panels_ = ChebyshevPanels(std::move(breaks_m), kPoints, [&](double distance_m) {
    return values_at(distance_m, k_1_m, receivers, sources);
  });
}

Eigen::RowVectorXd GrafTable::values_at(double distance_m, const std::vector<double>& k_1_m,
                                        const RadialWaves& receivers,
                                        const RadialWaves& sources) const {
  Eigen::MatrixXd J(orders_, static_cast<Eigen::Index>(k_1_m.size()));
  for (std::size_t i = 0; i < k_1_m.size(); ++i) {
    bessel_orders(k_1_m[i] * distance_m, J.col(static_cast<Eigen::Index>(i)));
  }
  Eigen::MatrixXd differences(receivers_, sources.amplitude.cols());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(receivers_, sources.amplitude.cols());
  for (const Run& to : runs_of(receivers.order)) {
    const Eigen::MatrixXd read = receivers.amplitude.middleCols(to.first, to.count).transpose();
    for (const Run& from : runs_of(sources.order)) {
      const auto waves = sources.amplitude.middleCols(from.first, from.count);
      const int m = from.order, n = to.order;
      const double sign = m < n ? parity(n - m) : 1.0;  // J_-s = (-1)^s J_s
      differences.block(to.first, from.first, to.count, from.count) =
          sign * (read * J.row(std::abs(m - n)).asDiagonal()) * waves;
      if (n == 0) continue;
      sums.block(to.first, from.first, to.count, from.count) =
          parity(n) * (read * J.row(m + n).asDiagonal()) * waves;
    }
  }
  Eigen::RowVectorXd values(2 * sums.size());
  values << differences.reshaped().transpose(), sums.reshaped().transpose();
  return values;
}

Eigen::MatrixXd GrafTable::between(const std::vector<AngularFunction>& receivers,
                                   const std::vector<AngularFunction>& sources, double x_m,
                                   double y_m) const {
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(receivers.size()),
                                               static_cast<Eigen::Index>(sources.size()));
  const double distance_m = std::hypot(x_m, y_m);
  if (distance_m > reach_m_) return seen;
  const Eigen::RowVectorXd at = panels_.at(distance_m);
  const Eigen::Index half = at.size() / 2;
  Eigen::VectorXd cosine(orders_), sine(orders_);
  for (int s = 0; s < orders_; ++s) {
    cosine[s] = std::cos(s * std::atan2(y_m, x_m));
    sine[s] = std::sin(s * std::atan2(y_m, x_m));
  }
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const int m = sources[s].order, n = receivers[r].order;
      const Eigen::Index entry = receivers[r].radial + receivers_ * sources[s].radial;
      const double less = at[entry], more = at[half + entry];
      const double less_cos = less * cosine[std::abs(m - n)];
      const double less_sin = less * (m < n ? -1.0 : 1.0) * sine[std::abs(m - n)];
      const double more_cos = more * cosine[m + n], more_sin = more * sine[m + n];
      double value = 0.0;
      if (sources[s].is_sine) {
        value = receivers[r].is_sine ? less_cos - more_cos : less_sin + more_sin;
      } else {
        value = receivers[r].is_sine ? more_sin - less_sin : less_cos + more_cos;
      }
      seen(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(s)) = value;
    }
  }
  return seen;
}

}  // namespace viscard
