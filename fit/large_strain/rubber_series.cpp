#include "fit/large_strain/rubber_series.h"

#include "fit/search/nnls.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;

std::vector<double> times_of(const std::vector<RubberTerm>& terms) {
  std::vector<double> tau_s;
  for (const RubberTerm& term : terms) tau_s.push_back(term.tau_s);
  return tau_s;
}

// Moduli, shapes, g, ln tau.
Vector all_parameters(const HyperelasticPoint& point) {
  const Index n = point.moduli.size(), m = point.shapes.size();
  const auto k = static_cast<Index>(point.terms.size());
  Vector theta(n + m + 2 * k);
  theta.head(n + m) << point.moduli, point.shapes;
  for (Index i = 0; i < k; ++i) {
    const RubberTerm& term = point.terms[static_cast<std::size_t>(i)];
    theta[n + m + i] = term.g;
    theta[n + m + k + i] = std::log(term.tau_s);
  }
  return theta;
}

HyperelasticPoint point_from(HyperelasticForm form, const Vector& theta) {
  const Index n = n_moduli(form), m = n_shapes(form), k = (theta.size() - n - m) / 2;
  HyperelasticPoint point;
  point.moduli = theta.head(n);
  point.shapes = theta.segment(n, m);
  for (Index i = 0; i < k; ++i) {
    point.terms.push_back({theta[n + m + i], std::exp(theta[n + m + k + i])});
  }
  return point;
}

class SeriesCost : public ceres::CostFunction {
 public:
  SeriesCost(HyperelasticForm form, const LargeStrainRows& rows, int n_parameters)
      : form_(form), rows_(rows), n_parameters_(n_parameters) {
    set_num_residuals(static_cast<int>(rows.data().size()));
    mutable_parameter_block_sizes()->push_back(n_parameters);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Vector theta = Eigen::Map<const Vector>(parameters[0], n_parameters_);
    const HyperelasticPoint point = point_from(form_, theta);
    const auto parts =
        rows_.parts({form_, point.moduli, point.shapes}, times_of(point.terms), false);
    Eigen::Map<Vector> left(residuals, rows_.data().size());
    left = parts.at_once - rows_.data();
    for (Index i = 0; i < parts.relaxed.cols(); ++i) {
      left += point.terms[static_cast<std::size_t>(i)].g * (parts.relaxed.col(i) - parts.at_once);
    }
    if (!left.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> slopes(jacobians[0], rows_.data().size(), n_parameters_);
    slopes = series_jacobian(form_, rows_, point);
    return slopes.allFinite();
  }

 private:
  HyperelasticForm form_;
  const LargeStrainRows& rows_;
  int n_parameters_ = 0;
};

// The shares of these times, and the scale of the law, by non-negative least squares with the law
// held: data = A (1 - sum g) at_once + sum A g_i relaxed_i.
HyperelasticPoint with_shares(HyperelasticForm form, const LargeStrainRows& rows,
                              const HyperelasticPoint& law, const std::vector<double>& tau_s) {
  const auto parts = rows.parts({form, law.moduli, law.shapes}, tau_s, false);
  Eigen::MatrixXd columns(rows.data().size(), parts.relaxed.cols() + 1);
  columns << parts.at_once, parts.relaxed;
  HyperelasticPoint point = law;
  point.terms.clear();
  point.rss = std::numeric_limits<double>::infinity();
  if (!columns.allFinite()) return point;
  const std::vector<bool> none_free(static_cast<std::size_t>(columns.cols()), false);
  const Vector x = least_squares_with_signs(columns, rows.data(), none_free);
  const double scale = x.sum();
  if (!(scale > 0.0)) return point;
  point.moduli *= scale;
  point.rss = (columns * x - rows.data()).squaredNorm();
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    const double g = x[static_cast<Index>(i) + 1] / scale;
    if (g > 0.0) point.terms.push_back({g, tau_s[i]});
  }
  return point;
}

RubberTerm merged(const RubberTerm& a, const RubberTerm& b) {
  const double g = a.g + b.g;
  return {g, std::exp((a.g * std::log(a.tau_s) + b.g * std::log(b.tau_s)) / g)};
}

std::vector<double> time_grid(const TimeRange& range) {
  constexpr double kPerDecade = 4.0;
  const double decades = std::log10(range.high_s / range.low_s);
  const int n = std::max(2, static_cast<int>(std::ceil(kPerDecade * decades)));
  std::vector<double> tau_s;
  for (int i = 0; i <= n; ++i) tau_s.push_back(range.low_s * std::pow(10.0, decades * i / n));
  return tau_s;
}

// Neighbours on the grid are one term.
void merge_neighbours(std::vector<RubberTerm>& terms) {
  constexpr double kNear = 2.2;  // a little more than a step of the grid
  std::vector<RubberTerm> out;
  double last_s = 0.0;
  for (const RubberTerm& term : terms) {
    if (!out.empty() && term.tau_s < kNear * last_s) {
      out.back() = merged(out.back(), term);
    } else {
      out.push_back(term);
    }
    last_s = term.tau_s;
  }
  terms = std::move(out);
}

// Law and spectrum in turns.
HyperelasticPoint first_series(HyperelasticForm form, LargeStrainRows rows,
                               const HyperelasticPoint& elastic) {
  constexpr int kTurns = 3;
  const std::vector<double> grid = time_grid(time_range(rows));
  HyperelasticPoint best = with_shares(form, rows, elastic, grid);
  for (int turn = 1; turn < kTurns && !best.terms.empty(); ++turn) {
    rows.set_terms(best.terms);
    const HyperelasticPoint law = best_point(form, rows);
    const HyperelasticPoint next = with_shares(form, rows, law, grid);
    if (!(next.rss < best.rss)) break;
    best = next;
  }
  merge_neighbours(best.terms);
  return best;
}

// The point with more terms: the largest is divided until there are enough.
void divide_terms(HyperelasticPoint& point, std::size_t wanted) {
  constexpr double kApart = 2.5;
  while (!point.terms.empty() && point.terms.size() < wanted) {
    const auto largest =
        std::max_element(point.terms.begin(), point.terms.end(),
                         [](const RubberTerm& a, const RubberTerm& b) { return a.g < b.g; });
    const RubberTerm half{0.5 * largest->g, largest->tau_s * kApart};
    *largest = {half.g, largest->tau_s / kApart};
    point.terms.insert(largest + 1, half);
  }
}

// One term fewer: each removed, or merged with its neighbour, with the shares solved again.
std::vector<HyperelasticPoint> with_one_less(HyperelasticForm form, const LargeStrainRows& rows,
                                             const HyperelasticPoint& point) {
  std::vector<HyperelasticPoint> all;
  const auto add = [&](std::vector<RubberTerm> terms) {
    HyperelasticPoint next = with_shares(form, rows, point, times_of(terms));
    if (next.terms.size() == terms.size()) all.push_back(std::move(next));
  };
  for (std::size_t i = 0; i < point.terms.size(); ++i) {
    std::vector<RubberTerm> fewer = point.terms;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    add(fewer);
    if (i == fewer.size()) continue;
    fewer[i] = merged(point.terms[i], point.terms[i + 1]);
    if (std::isfinite(fewer[i].tau_s)) add(fewer);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.rss < b.rss; });
  return all;
}

}  // namespace

TimeRange time_range(const LargeStrainRows& rows) {
  return {rows.least_step_s() / 3.0, 3.0 * rows.longest_test_s()};
}

Eigen::MatrixXd series_jacobian(HyperelasticForm form, LargeStrainRows rows,
                                const HyperelasticPoint& point) {
  rows.set_terms(point.terms);
  const Index n = n_moduli(form) + n_shapes(form), k = static_cast<Index>(point.terms.size());
  Eigen::MatrixXd slopes(rows.data().size(), n + 2 * k);
  slopes.leftCols(n) = jacobian(form, rows, point);
  const auto parts = rows.parts({form, point.moduli, point.shapes}, times_of(point.terms), true);
  for (Index i = 0; i < k; ++i) {
    slopes.col(n + i) = parts.relaxed.col(i) - parts.at_once;
    slopes.col(n + k + i) = point.terms[static_cast<std::size_t>(i)].g * parts.by_ln_tau.col(i);
  }
  return slopes;
}

HyperelasticPoint refined_series(HyperelasticForm form, const LargeStrainRows& rows,
                                 const HyperelasticPoint& start) {
  Vector theta = all_parameters(start);
  const Index n = n_moduli(form), m = n_shapes(form);
  const auto k = static_cast<Index>(start.terms.size());
  ceres::Problem problem;
  problem.AddParameterBlock(theta.data(), static_cast<int>(theta.size()));
  const auto hold_within = [&](Index i, double low, double high) {
    theta[i] = std::clamp(theta[i], low, high);
    problem.SetParameterLowerBound(theta.data(), static_cast<int>(i), low);
    problem.SetParameterUpperBound(theta.data(), static_cast<int>(i), high);
  };
  const ShapeBounds bounds = shape_bounds(form, rows);
  const TimeRange range = time_range(rows);
  constexpr double kLarge = 1e12;
  for (Index i = 0; i < n && !is_sign_free(form); ++i) hold_within(i, 0.0, kLarge);
  for (Index i = n; i < n + m; ++i) hold_within(i, bounds.low, bounds.high);
  for (Index i = n + m; i < n + m + k; ++i) {
    hold_within(i, 0.0, 2.0);
    hold_within(i + k, std::log(range.low_s), std::log(range.high_s));
  }
  problem.AddResidualBlock(new SeriesCost(form, rows, static_cast<int>(theta.size())), nullptr,
                           theta.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-11;
  options.parameter_tolerance = 1e-9;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  HyperelasticPoint point = point_from(form, theta);
  point.rss = 2.0 * summary.final_cost;
  point.is_converged = summary.IsSolutionUsable();
  std::sort(point.terms.begin(), point.terms.end(),
            [](const RubberTerm& a, const RubberTerm& b) { return a.tau_s < b.tau_s; });
  return point;
}

namespace {

std::vector<HyperelasticPoint> path_within(HyperelasticForm form, const LargeStrainRows& rows,
                                           std::optional<int> n_terms, int most_terms) {
  const HyperelasticPoint elastic = best_point(form, rows);
  HyperelasticPoint start = first_series(form, rows, elastic);
  const auto most = static_cast<std::size_t>(n_terms.value_or(most_terms));
  if (n_terms) divide_terms(start, most);
  std::vector<HyperelasticPoint> path;
  constexpr std::size_t kTried = 2;
  std::vector<HyperelasticPoint> starts;
  if (!start.terms.empty()) starts.push_back(std::move(start));
  while (!starts.empty()) {
    HyperelasticPoint best;
    for (std::size_t i = 0; i < std::min(kTried, starts.size()); ++i) {
      HyperelasticPoint point = refined_series(form, rows, starts[i]);
      if (point.rss < best.rss) best = std::move(point);
    }
    if (best.terms.empty()) break;
    if (best.terms.size() <= most) path.insert(path.begin(), best);
    starts = with_one_less(form, rows, best);
    if (best.terms.size() == 1 || (n_terms && best.terms.size() <= most)) break;
  }
  if (!n_terms || path.empty()) path.insert(path.begin(), elastic);
  return path;
}

}  // namespace

// A heavy row of a known modulus makes a narrow ridge, on which a search from afar stands still: the
// path is that of a light row, and its points follow the row as it becomes heavy.
std::vector<HyperelasticPoint> series_path(HyperelasticForm form, const LargeStrainRows& rows,
                                           std::optional<int> n_terms, int most_terms) {
  if (!rows.has_known_modulus()) return path_within(form, rows, n_terms, most_terms);
  LargeStrainRows light = rows;
  light.limit_known_modulus(0.1);
  std::vector<HyperelasticPoint> path = path_within(form, light, n_terms, most_terms);
  for (const double share : {1.0, 10.0, 100.0, LargeStrainRows::kExactWithTerms}) {
    light.limit_known_modulus(share);
    for (HyperelasticPoint& point : path) {
      point = point.terms.empty() ? best_point(form, light) : refined_series(form, light, point);
    }
  }
  return path;
}

}  // namespace viscard
