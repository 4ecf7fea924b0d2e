#include "fit/laws/scatter_levels.h"

#include "fit/laws/nested_likelihood.h"
#include "models/maths/golden_section.h"

#include <boost/math/special_functions/digamma.hpp>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kLevels = 3;
using Mask = std::array<bool, kLevels>;

// Minimises -2 ln L over the free deviations, one after the other. A deviation may be zero.
class DeviationSearch {
 public:
  DeviationSearch(const NestedLikelihood& likelihood, const Mask& is_free)
      : likelihood_(likelihood), is_free_(is_free) {}

  // From the whole range, then repeatedly in turn.
  double lowest(Deviations& at) const {
    for (std::size_t k = 0; k < kLevels; ++k) {
      if (is_free_[k]) scan(k, at);
    }
    return lowest_near(at);
  }

  // From values that are nearly right.
  double lowest_near(Deviations& at) const {
    constexpr int kMostSweeps = 40;
    constexpr double kGain = 1e-5;
    double best = likelihood_.minus_twice(at);
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      const double before = best;
      for (std::size_t k = 0; k < kLevels; ++k) {
        if (is_free_[k]) best = refined(k, at, best);
      }
      if (before - best < kGain) break;
    }
    return best;
  }

 private:
  double value(std::size_t k, Deviations at, double deviation) const {
    at[k] = deviation;
    return likelihood_.minus_twice(at);
  }

  void scan(std::size_t k, Deviations& at) const {
    constexpr int kSteps = 16;
    double best = value(k, at, 0.0), chosen = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double deviation = likelihood_.scale() * std::exp(-6.0 + 0.5 * i);
      const double now = value(k, at, deviation);
      if (now < best) {
        best = now;
        chosen = deviation;
      }
    }
    at[k] = chosen;
  }

  // The lowest point around at[k] or at zero; golden section in the logarithm.
  double refined(std::size_t k, Deviations& at, double best) const {
    const double smallest = 1e-4 * likelihood_.scale();
    const double from = at[k] > smallest ? at[k] : 0.05 * likelihood_.scale();
    const auto f = [&](double ln) { return value(k, at, std::exp(ln)); };
    const double ln_from = std::log(from);
    const double inner = std::exp(golden_section(f, ln_from - 0.6, ln_from + 0.6, 2e-3).best);
    for (const double candidate : {inner, 0.0}) {
      const double now = value(k, at, candidate);
      if (now >= best) continue;
      best = now;
      at[k] = candidate;
    }
    return best;
  }

  const NestedLikelihood& likelihood_;
  Mask is_free_;
};

// How much -2 ln L may rise within a 95 % interval. The quantile of chi^2 holds for many degrees of
// freedom n; for a variance estimated with few, the mean of the likelihood ratio is
// n (ln(n/2) - psi(n/2)) instead of 1 (Bartlett, Proc. R. Soc. A 160 (1937) 268).
double allowed_rise(int degrees_of_freedom) {
  constexpr double kChiSquare95 = 3.841458820694124;
  const double half = 0.5 * degrees_of_freedom;
  return kChiSquare95 * 2.0 * half * (std::log(half) - boost::math::digamma(half));
}

// Ends of the profile of deviation k, which is `best` at its lowest.
class Profile {
 public:
  Profile(const NestedLikelihood& likelihood, Mask is_free, std::size_t k, const Deviations& best,
          double lowest)
      : search_(likelihood, without(is_free, k)),
        k_(k),
        best_(best),
        limit_(lowest + allowed_rise(likelihood.degrees_of_freedom()[k])),
        scale_(likelihood.scale()) {}

  Interval interval() const {
    Interval out;
    if (is_outside(0.0)) {
      double low = best_[k_];
      while (!is_outside(low) && low > 1e-6 * scale_) low /= kStep;
      out.low = between(low, low * kStep);
    }
    double high = std::max(best_[k_], 0.02 * scale_);
    while (!is_outside(high) && high < 1e6 * scale_) high *= kStep;
    out.high = between(high, high / kStep);
    return out;
  }

 private:
  static constexpr double kStep = 1.5;
  static Mask without(Mask is_free, std::size_t k) {
    is_free[k] = false;
    return is_free;
  }
  bool is_outside(double deviation) const {
    Deviations at = best_;
    at[k_] = deviation;
    return search_.lowest_near(at) > limit_;
  }
  double between(double outside, double inside) const {
    for (int i = 0; i < 9; ++i) {
      const double middle = std::sqrt(outside * inside);
      (is_outside(middle) ? outside : inside) = middle;
    }
    return std::sqrt(outside * inside);
  }

  DeviationSearch search_;
  std::size_t k_;
  Deviations best_;
  double limit_, scale_;
};

// Why a level has no degrees of freedom, and where its scatter appears.
void add_notes(Scatter& scatter, int degree) {
  const std::array<ScatterLevel*, kLevels> levels{&scatter.touch, &scatter.specimen,
                                                  &scatter.ratio};
  const std::array<std::string, kLevels> names{"touches", "specimens", "ratios"};
  const std::array<std::string, kLevels> why{
      "every specimen was touched once", "there is one specimen at each ratio",
      "the law has " + std::to_string(degree + 1) + " coefficients, as many as there are ratios"};
  std::string hidden;
  for (std::size_t k = 0; k < kLevels; ++k) {
    if (!is_identified(*levels[k])) {
      levels[k]->note = why[k];
      hidden += (hidden.empty() ? "" : " and ") + names[k];
      continue;
    }
    if (!hidden.empty()) levels[k]->note = "includes the scatter between " + hidden;
    hidden.clear();
  }
}

double median_error(const std::vector<NestedRecord>& records) {
  std::vector<double> errors;
  for (const NestedRecord& one : records) errors.push_back(std::sqrt(one.variance));
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

}  // namespace

Scatter scatter_of(const std::string& quantity, const std::vector<NestedRecord>& records,
                   const RatioModel& law, int degree) {
  Scatter out{.quantity = quantity, .mean = 0.0, .own_error = median_error(records)};
  for (const NestedRecord& one : records) {
    out.mean += one.value / static_cast<double>(records.size());
  }
  const NestedLikelihood likelihood(records, law, degree);
  Mask is_free{};
  Deviations at{};
  for (std::size_t k = 0; k < kLevels; ++k) {
    is_free[k] = likelihood.degrees_of_freedom()[k] > 0;
    if (is_free[k]) at[k] = 0.3 * likelihood.scale();
  }
  const double lowest = DeviationSearch(likelihood, is_free).lowest(at);
  const std::array<ScatterLevel*, kLevels> levels{&out.touch, &out.specimen, &out.ratio};
  for (std::size_t k = 0; k < kLevels; ++k) {
    if (!is_free[k]) continue;
    levels[k]->degrees_of_freedom = likelihood.degrees_of_freedom()[k];
    levels[k]->deviation = at[k];
    levels[k]->interval_95 = Profile(likelihood, is_free, k, at, lowest).interval();
  }
  add_notes(out, degree);
  return out;
}

std::vector<Scatter> scatter_levels(const std::vector<RatioEstimate>& records,
                                    const RatioModel& law) {
  std::vector<NestedRecord> moduli, shares;
  bool has_terms = false;
  for (const RatioEstimate& one : records) {
    moduli.push_back({one.theta[0], one.covariance(0, 0), one.specimen, one.ratio});
    const Eigen::Index n = one.theta.size() / 2;
    const Eigen::VectorXd g = one.theta.segment(1, n).array().exp();
    constexpr double kLeast = 1e-18;  // a record without terms has no error of its own
    const double variance = g.dot(one.covariance.block(1, 1, n, n) * g) + kLeast;
    shares.push_back({g.sum(), variance, one.specimen, one.ratio});
    has_terms = has_terms || n > 0;
  }
  std::vector<Scatter> out{scatter_of("ln_E0", moduli, law, law.form.E0_degree)};
  if (has_terms) {
    const int degree = law.form.g_degree == kPerRatio ? 1 : law.form.g_degree;
    out.push_back(scatter_of("sum_g", shares, law, degree));
  }
  return out;
}

}  // namespace viscard
