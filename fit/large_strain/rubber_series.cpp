#include "fit/large_strain/rubber_series.h"

#include "fit/large_strain/series_refine.h"
#include "fit/search/nnls.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;

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
  const auto add = [&](const std::vector<RubberTerm>& terms) {
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

// Terms whose times coincide are one: only the sum of their g is determined.
HyperelasticPoint without_equals(HyperelasticForm form, const LargeStrainRows& rows,
                                 HyperelasticPoint point) {
  constexpr double kEqual = 1.05;
  for (std::size_t i = 1; i < point.terms.size();) {
    if (point.terms[i].tau_s > kEqual * point.terms[i - 1].tau_s) {
      ++i;
      continue;
    }
    point.terms[i - 1] = merged(point.terms[i - 1], point.terms[i]);
    point.terms.erase(point.terms.begin() + static_cast<std::ptrdiff_t>(i));
    point = refined_series(form, rows, point);
    i = 1;
  }
  return point;
}

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
    best = without_equals(form, rows, std::move(best));
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
