#include "fit/compare_tests.h"

#include "fit/assembly/test_agreement.h"
#include "fit/intervals/flags.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {
namespace {

// The order with the best AICc, if it is larger: a misfit caused by too few terms is not a
// disagreement.
const SpectralState& generous_state(const SpectralFit& fit) {
  std::size_t best = fit.scores.chosen;
  for (std::size_t i = best + 1; i < fit.path.size(); ++i) {
    if (fit.scores.rows[i].aicc < fit.scores.rows[best].aicc) best = i;
  }
  return best == fit.scores.chosen ? fit.state : fit.path[best];
}

std::string percent(double share) {
  return text_of(100.0 * std::abs(share), 3);
}

std::string text_of_difference(const FittedTest& test) {
  const bool is_factor = std::abs(test.worst - test.difference) < 1e-12;
  const bool is_above = test.worst > 0.0;
  std::string text = "the " + test.name + " lies " + (is_factor ? "" : "up to ") +
                     percent(test.worst) + " % " + (is_above ? "above" : "below") +
                     " what the other tests allow (";
  if (is_factor) {
    const Interval& range = test.difference_95;
    text += "95 % " + percent(is_above ? range.low : range.high) + " to " +
            percent(is_above ? range.high : range.low) + " %, ";
  }
  return text + (test.p_value < 1e-12 ? "p below 1e-12" : "p = " + text_of(test.p_value, 2)) + ")";
}

// Larger than chance allows (all tests together), and large enough to matter for a material.
bool is_different(const TestAgreement& found, std::size_t n_tests) {
  constexpr double kSmall = 5e-3;   // of the values
  constexpr double kChance = 0.01;  // relative error reported for tests that agree
  return found.freedom > 0 && found.p_value <= kChance / static_cast<double>(n_tests) &&
         found.at_least > kSmall;
}

// The tests that differ. One wrong test makes all others differ from its predictions, so the most
// different test gets a free departure of its own; if three or more tests were given, the rest is
// compared without it.
std::vector<bool> different_tests(const JointTests& joint, const SpectralState& state,
                                  const Eigen::VectorXd& freedom,
                                  const std::vector<TestAgreement>& found) {
  std::vector<bool> differs;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    differs.push_back(is_different(found[k], found.size()));
    if (differs[k] && (!differs[worst] || found[k].p_value < found[worst].p_value)) worst = k;
  }
  if (found.size() < 3 || !differs[worst]) return differs;
  const std::vector<TestAgreement> rest =
      test_agreement(*joint.model, state, joint.groups, joint.ln_time, freedom, worst);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (k != worst) differs[k] = differs[k] && is_different(rest[k], found.size());
  }
  return differs;
}

}  // namespace

void compare_tests(const JointTests& joint, const SpectralFit& fit, const Eigen::VectorXd& freedom,
                   FitResult& result) {
  const SpectralState& state = generous_state(fit);
  const std::vector<TestAgreement> found =
      test_agreement(*joint.model, state, joint.groups, joint.ln_time, freedom);
  const std::vector<bool> differs = different_tests(joint, state, freedom, found);
  std::vector<const FittedTest*> different;
  for (std::size_t k = 0; k < found.size(); ++k) {
    FittedTest& test = result.tests[k];
    test.difference = found[k].difference;
    test.difference_95 = found[k].difference_95;
    test.worst = found[k].worst;
    test.p_value = found[k].p_value;
    test.freedom = found[k].freedom;
    test.disagrees = differs[k];
    if (test.disagrees) different.push_back(&test);
  }
  if (different.empty()) return;
  std::stable_sort(
      different.begin(), different.end(),
      [](const FittedTest* a, const FittedTest* b) { return a->p_value < b->p_value; });
  std::string text = "the tests do not belong to one linear material: ";
  for (const FittedTest* test : different) {
    text += (test == different.front() ? "" : "; ") + text_of_difference(*test);
  }
  add_defect(result, "tests-disagree",
             text +
                 ". Compare strain, temperature, specimen and geometry of the tests, or fit them "
                 "one by one");
}

}  // namespace viscard
