#include "fit/large_strain/rubber_term_checks.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr int kDefaultMostTerms = 6;

// How fast a test went: rates of the stretch in equal parts of its duration.
struct TestRates {
  double mean = 0.0;              // of the size
  bool rests_or_returns = false;  // a hold or an unloading
};

TestRates rates_of(const LargeStrainTest& test) {
  constexpr int kParts = 20;
  constexpr double kHold = 0.05;  // of the largest rate
  const Course history = history_of(test);
  const double first_s = history.front().time_s;
  const double part_s = (history.back().time_s - first_s) / kParts;
  if (!(part_s > 0.0)) return {};
  std::vector<double> rates;
  for (int k = 0; k < kParts; ++k) {
    const double change =
        value_at(history, first_s + (k + 1) * part_s) - value_at(history, first_s + k * part_s);
    rates.push_back(change / part_s);
  }
  const auto [low, high] = std::minmax_element(rates.begin(), rates.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  TestRates out;
  for (const double rate : rates) {
    out.mean += std::abs(rate) / kParts;
    out.rests_or_returns |= std::abs(rate) < kHold * largest;
  }
  out.rests_or_returns |= *low<-kHold * largest&& * high> kHold * largest;
  return out;
}

bool are_ascending(const LargeStrainTest& test) {
  const Course history = history_of(test);
  const auto is_finite = [](const CoursePoint& point) { return std::isfinite(point.time_s); };
  return std::all_of(history.begin(), history.end(), is_finite) &&
         std::ranges::is_sorted(history, {}, &CoursePoint::time_s) &&
         history.back().time_s > history.front().time_s;
}

// Why a test cannot show relaxation; empty if it can.
std::string without_times(const LargeStrainTest& test) {
  if (!has_times(test)) return "the " + test.name + " test has no times";
  if (!are_ascending(test)) return "the times of the " + test.name + " test do not ascend";
  return {};
}

// Duration of the first loading: until the stretch is within 2 % of its largest distance from 1.
double ramp_s(const LargeStrainTest& test) {
  const Course history = history_of(test);
  double farthest = 0.0;
  for (const CoursePoint& at : history) farthest = std::max(farthest, std::abs(at.value - 1.0));
  constexpr double kThere = 0.98;
  for (const CoursePoint& at : history) {
    if (std::abs(at.value - 1.0) >= kThere * farthest) return at.time_s - history.front().time_s;
  }
  return 0.0;
}

// Median step between the readings of all tests, the shortest first loading, the longest test.
struct Window {
  double sampling_s = 0.0, quickest_ramp_s = 0.0, to_s = 0.0;
};

Window window_of(const std::vector<LargeStrainTest>& tests) {
  Window out;
  out.quickest_ramp_s = ramp_s(tests.front());
  for (const LargeStrainTest& test : tests) {
    out.quickest_ramp_s = std::min(out.quickest_ramp_s, ramp_s(test));
    out.to_s = std::max(out.to_s, test.time_s.back() - test.time_s.front());
    for (std::size_t i = 1; i < test.time_s.size(); ++i) {
      const double step = test.time_s[i] - test.time_s[i - 1];
      if (step > 0.0 && (out.sampling_s == 0.0 || step < out.sampling_s)) out.sampling_s = step;
    }
  }
  return out;
}

void add_flags_of_term(const FittedRubberTerm& term, int number, const Window& window,
                       std::vector<MaterialFlag>& flags) {
  const auto add = [&](const char* name, const std::string& text) {
    flags.push_back({name, number, "term " + std::to_string(number) + ": " + text});
  };
  const std::string tau = "relaxation time " + text_of(term.tau_s, 3) + " s ";
  if (term.tau_s < 3.0 * window.sampling_s) {
    add("tau-below-sampling", tau + "is below three sampling intervals (" +
                                  text_of(3.0 * window.sampling_s, 3) +
                                  " s): time and share are not reliable");
  }
  if (term.tau_s < 0.2 * window.quickest_ramp_s) {
    add("tau-below-ramp", tau + "is below a fifth of the quickest loading (" +
                              text_of(0.2 * window.quickest_ramp_s, 3) +
                              " s): most of this term relaxed while the load rose");
  }
  if (term.tau_s > window.to_s / 3.0) {
    add("tau-beyond-window", tau + "is above a third of the longest test (" +
                                 text_of(window.to_s / 3.0, 3) +
                                 " s): the modulus after all relaxation is an upper bound only");
  }
  if (term.g_interval_95.low <= 0.0) {
    add("modulus-may-be-zero", "the 95 % interval of its share contains zero");
  }
}

// Terms of which only the sum of g is known: each g is between 0 and that sum.
void add_flags_of_pairs(FittedRubber& fitted) {
  constexpr double kStrong = 0.99;
  const auto n_terms = static_cast<Eigen::Index>(fitted.terms.size());
  const Eigen::Index first = fitted.series_covariance.rows() - 2 * n_terms;
  const auto covariance = [&](Eigen::Index i, Eigen::Index j) {
    return fitted.series_covariance(first + i, first + j);
  };
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    for (Eigen::Index j = i + 1; j < n_terms; ++j) {
      const double product = covariance(i, i) * covariance(j, j);
      const double correlation = product > 0.0 ? covariance(i, j) / std::sqrt(product) : 0.0;
      if (std::abs(correlation) <= kStrong) continue;
      auto& a = fitted.terms[static_cast<std::size_t>(i)];
      auto& b = fitted.terms[static_cast<std::size_t>(j)];
      for (Interval* interval : {&a.g_interval_95, &b.g_interval_95}) {
        interval->low = std::min(interval->low, 0.0);
        interval->high = std::max(interval->high, a.g + b.g);
      }
      const std::string number = std::to_string(i + 1);
      fitted.flags.push_back(
          {"terms-correlated", static_cast<int>(i) + 1,
           "terms " + number + " and " + std::to_string(j + 1) +
               ": only their shares together are determined (correlation above 0.99)"});
    }
  }
}

void add_flag_of_sum(FittedRubber& fitted) {
  const double left = fitted.E_inf_Pa / fitted.E0_Pa;
  if (left < 0.0) {
    fitted.flags.push_back({"sum-of-g", 0,
                            "the shares of the terms add up to " + text_of(1.0 - left, 4) +
                                ", but at most 1 can relax; use fewer terms or a longer hold"});
    fitted.is_trustworthy = false;
  } else if (fitted.E_inf_interval_95.low <= 0.0) {
    fitted.flags.push_back({"sum-of-g", 0,
                            "the interval of the modulus after all relaxation reaches zero: all "
                            "of the stress may relax"});
  }
}

}  // namespace

bool has_several_rates(const std::vector<LargeStrainTest>& tests) {
  constexpr double kApart = 2.0;
  double least = 0.0, largest = 0.0;
  for (const LargeStrainTest& test : tests) {
    const TestRates rates = rates_of(test);
    if (rates.rests_or_returns) return true;
    least = least == 0.0 ? rates.mean : std::min(least, rates.mean);
    largest = std::max(largest, rates.mean);
  }
  return largest >= kApart * least;
}

int most_terms_of(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                  std::vector<MaterialFlag>& notes) {
  const bool is_asked = options.n_terms || options.max_terms;
  const int most = options.n_terms.value_or(options.max_terms.value_or(kDefaultMostTerms));
  if (most == 0) return 0;
  const bool has_any = std::any_of(tests.begin(), tests.end(), has_times);
  for (const LargeStrainTest& test : tests) {
    const std::string why = without_times(test);
    if (why.empty()) continue;
    if (is_asked) {
      throw std::runtime_error(
          why +
          ", so that no relaxation can be fitted; add a column time_s to every "
          "table, or ask for 0 terms");
    }
    if (has_any) notes.push_back({"no-relaxation", 0, why + ": the laws are elastic"});
    return 0;
  }
  if (is_asked || has_several_rates(tests)) return most;
  notes.push_back(
      {"no-relaxation", 0,
       "the tests have times, but one rate and no hold: they cannot show relaxation apart "
       "from the law, which is elastic; add a hold, or a test at another rate"});
  return 0;
}

void add_term_flags(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                    FittedRubber& fitted) {
  const auto found = static_cast<int>(fitted.terms.size());
  if (const int wanted = options.n_terms.value_or(found); found < wanted) {
    fitted.flags.push_back({"fewer-terms", 0,
                            counted(static_cast<std::size_t>(wanted), "term") +
                                (wanted == 1 ? " was" : " were") +
                                " requested; no fit with more than " + std::to_string(found) +
                                " that differ in time describes these data better"});
  }
  if (fitted.terms.empty()) return;
  const Window window = window_of(tests);
  add_flags_of_pairs(fitted);
  for (std::size_t i = 0; i < fitted.terms.size(); ++i) {
    add_flags_of_term(fitted.terms[i], static_cast<int>(i) + 1, window, fitted.flags);
  }
  add_flag_of_sum(fitted);
  constexpr double kRest = 0.02;
  for (const LargeStrainTest& test : tests) {
    const double first = history_of(test).front().value;
    if (std::abs(first - 1.0) < kRest) continue;
    fitted.flags.push_back({"step-before-record", 0,
                            "the " + test.name + " test begins at the stretch " +
                                text_of(first, 4) +
                                ", which is taken as a jump at its first time; let the record "
                                "begin before loading"});
  }
  if (has_several_rates(tests)) return;
  fitted.flags.push_back({"one-rate", 0,
                          "the tests have one rate and no hold, which shows nothing of the terms: "
                          "they and the law can replace each other; add a hold or another rate"});
  fitted.is_trustworthy = false;
}

}  // namespace viscard
