#pragma once

#include "fit/planning/predicted_errors.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One way to measure: a test, and how many times it is repeated on the same specimen.
struct ProtocolRow {
  TestPlan plan;
  int touches = 1;
  double total_s = 0.0;  // at the rig
  double peak_force_N = 0.0;
  // Smallest modulus of a term over its standard error, at the best guess. Below kClearTerm the fit
  // may miss that term, and then its result differs from the prediction.
  double weakest_term = 0.0;
  std::vector<ErrorCauses> errors;       // of the wanted quantities in their order, at the guess
  std::vector<double> worst_half_width;  // 95 %, relative: the largest over the doubt in the guess
  // Largest of half-width over tolerance; if it is 1 or less, all wanted tolerances are met. See
  // ProtocolStudy.
  double shortfall = 0.0;
  bool is_given = false;     // the test that the user gave
  bool is_on_front = false;  // no other row takes less time and falls as little short (within 2 %)
};

// A term adds two parameters. BIC takes them if the sum of squares over the variance falls by 2 ln n,
// 18 for 8000 readings, and two standard errors more make that nearly certain.
inline constexpr double kClearTerm = 6.0;

// Error against time at the rig.
struct ProtocolStudy {
  std::vector<WantedQuantity> wanted;
  // True if the systematic parts alone exceed the tolerance. No test can change that, so the
  // shortfall of the rows ignores the systematic parts of such a quantity.
  std::vector<bool> is_beyond_reach;
  std::vector<ProtocolRow> rows;  // ascending time: the front, and the given test
  std::size_t n_tried = 0;
  bool loses_terms =
      false;  // no test resolves all terms of the guess; otherwise such rows are left out
  std::optional<std::size_t> advised;  // the quickest row that meets all that is wanted ...
  // ... or else the row that misses the tolerances by the smallest factor.
  bool meets_all = false;
  std::optional<std::size_t>
      at_equal_time;  // the best row that takes no longer than the given test
};

struct ProtocolOptions {
  TestPlan base;              // its approach and retraction are kept
  bool is_given = false;      // base is a test given by the user, to be compared
  double deepest_m = 0.0;     // that the load cell allows
  double longest_s = 3600.0;  // at the rig
  int most_touches = 5;
  std::vector<Material> guesses;  // the first is the best one; the others span the doubt
  // Whether the rig may carry out a test (its checks before a run); empty: all.
  std::function<bool(const TestPlan&)> is_allowed;
  // Calls work(0) ... work(n - 1), possibly at the same time; empty: one after another.
  std::function<void(std::size_t n, const std::function<void(std::size_t)>& work)> for_each;
};

// Ramps and holds from quick to slow, with and without an unloading, with a hold after it of several
// lengths. The depth is the deepest that is allowed, and half of it.
std::vector<TestPlan> protocol_grid(const ProtocolOptions& options);

// Best guess first. Its modulus may be off by a factor of 1.3, shares of terms by 2, times by 2.
// A guess with a covariance is off by two standard errors in each direction instead.
std::vector<Material> guesses_about(const Material& guess);

// Throws what predicted_fit() throws, and std::invalid_argument if no test of the grid is allowed, and
// std::runtime_error if none fits into the time, naming the shortest time that one takes.
ProtocolStudy study_protocols(const Bench& bench, const std::vector<WantedQuantity>& wanted,
                              const ProtocolOptions& options);

}  // namespace viscard
