#include "fit/large_strain/rubber_checks.h"

#include "fit/large_strain/rubber_band.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

// Share of the stresses that a law may miss before it is not trusted.
constexpr double kMostMisfit = 0.1;

std::string percent(double share) {
  return text_of(100.0 * share, 2) + " %";
}

void check_reading(const LargeStrainTest& test, std::size_t i) {
  const double stretch = test.stretch[i];
  const bool is_possible = stretch > 0.0 || test.foam_test == FoamTest::kShear;
  if (std::isfinite(stretch) && is_possible && std::isfinite(test.nominal_stress_Pa[i])) return;
  throw std::runtime_error("reading " + std::to_string(i + 1) + " of the " + test.name +
                           " test has the stretch " + text_of(stretch) + " and the stress " +
                           text_of(test.nominal_stress_Pa[i]) +
                           " Pa; a stretch is positive (1 at rest), and both are finite");
}

// A stress that has the sign of the strain in most readings.
void check_signs(const LargeStrainTest& test) {
  double work = 0.0;
  const double rest = test.foam_test == FoamTest::kShear ? 0.0 : 1.0;
  for (std::size_t i = 0; i < test.stretch.size(); ++i) {
    work += test.nominal_stress_Pa[i] * (test.stretch[i] - rest);
  }
  if (work > 0.0) return;
  const auto is_zero = [](double stress_Pa) { return stress_Pa == 0.0; };
  if (std::all_of(test.nominal_stress_Pa.begin(), test.nominal_stress_Pa.end(), is_zero)) {
    throw std::runtime_error("every stress of the " + test.name +
                             " test is 0, so it shows no law; check that its column is the stress");
  }
  throw std::runtime_error(
      "the " + test.name +
      " test has stresses against its strains: compression has stretches below 1 and negative "
      "stresses. Flip a column, for instance --column stress_Pa=-HEADER, and see that the column "
      "of the stretch is not a strain");
}

void check_test(const LargeStrainTest& test) {
  constexpr std::size_t kLeast = 3;
  if (test.stretch.size() != test.nominal_stress_Pa.size()) {
    throw std::runtime_error("the " + test.name + " test has " +
                             std::to_string(test.stretch.size()) + " stretches, but " +
                             std::to_string(test.nominal_stress_Pa.size()) + " stresses");
  }
  if (test.stretch.size() < kLeast) {
    throw std::runtime_error("the " + test.name + " test has " +
                             counted(test.stretch.size(), "reading") +
                             "; a law needs 3 or more at different stretches");
  }
  for (std::size_t i = 0; i < test.stretch.size(); ++i) check_reading(test, i);
  const auto [low, high] = std::minmax_element(test.stretch.begin(), test.stretch.end());
  if (*high - *low < 1e-9) {
    throw std::runtime_error("all readings of the " + test.name + " test have the stretch " +
                             text_of(*low) + "; a law needs several stretches");
  }
  check_signs(test);
}

bool is_stable_in_tests(const std::vector<LargeStrainTest>& tests, const FittedRubber& fitted) {
  return std::all_of(tests.begin(), tests.end(), [&](const LargeStrainTest& test) {
    const StableRange range = fitted.foam
                                  ? stable_range(fitted.foam->law, test.foam_test)
                                  : fitted.stable[static_cast<std::size_t>(test.deformation)];
    const auto [low, high] = std::minmax_element(test.stretch.begin(), test.stretch.end());
    return range.contains(*low) && range.contains(*high);
  });
}

// "uniaxial 0.31 to 6.2; equibiaxial up to 2.2"; empty if the law is stable everywhere.
std::string text_of_ends(const FittedRubber& fitted) {
  std::string text;
  const auto& names = fitted.foam ? foam_test_names() : deformation_names();
  for (std::size_t d = 0; d < names.size(); ++d) {
    const StableRange range =
        fitted.foam ? stable_range(fitted.foam->law, static_cast<FoamTest>(d)) : fitted.stable[d];
    if (range.low_is_open && range.high_is_open) continue;
    text += text.empty() ? "" : "; ";
    text += names[d];
    if (!range.low_is_open) text += " from " + text_of(range.low, 3);
    if (!range.high_is_open) text += " up to " + text_of(range.high, 3);
  }
  return text;
}

void add_flag(FittedRubber& fitted, const std::string& name, const std::string& text,
              bool is_defect) {
  fitted.flags.push_back({name, 0, text});
  if (is_defect) fitted.is_trustworthy = false;
}

}  // namespace

void check_large_strain(const std::vector<LargeStrainTest>& tests,
                        const LargeStrainOptions& options) {
  if (tests.empty()) throw std::runtime_error("there is no test to fit");
  if (options.forms.empty()) throw std::runtime_error("there is no law to fit");
  for (const LargeStrainTest& test : tests) check_test(test);
  if (options.with_damage && options.n_terms.value_or(options.max_terms.value_or(0)) > 0) {
    throw std::runtime_error(
        "damage and terms of relaxation are asked for together, but solvers let the damage act on "
        "different parts of such a law; fit one of the two");
  }
  if (options.modulus && !(options.modulus->value_Pa > 0.0)) {
    throw std::runtime_error("the known modulus is " + text_of(options.modulus->value_Pa) +
                             " Pa; it must be positive");
  }
}

void add_rubber_flags(const std::vector<LargeStrainTest>& tests, const LargeStrainOptions& options,
                      bool is_converged, bool is_on_bound, const std::string& bounds,
                      FittedRubber& fitted) {
  const std::string ends = text_of_ends(fitted);
  if (!is_converged) {
    add_flag(fitted, "not-converged", "the least squares did not converge; omit this law", true);
  }
  if (!is_stable_in_tests(tests, fitted)) {
    add_flag(fitted, "unstable-in-range",
             "the law is not stable in the measured range (stable stretches: " + ends +
                 "); choose another law",
             true);
  } else if (!ends.empty()) {
    add_flag(fitted, "unstable-beyond", "stable stretches: " + ends, false);
  }
  if (fitted.rms_relative > kMostMisfit) {
    add_flag(
        fitted, "misfit",
        "the law misses the stresses by " + percent(fitted.rms_relative) + " (root mean square)",
        true);
  }
  if (is_on_bound) {
    add_flag(fitted, "on-bound",
             "a parameter ended at the end of its range" + (bounds.empty() ? "" : ", " + bounds) +
                 ", so that the data do not determine it; use a law with fewer parameters",
             true);
  }
  if (fitted.unseen.columns.size() > 0) {
    add_flag(fitted, "undetermined",
             "the data do not determine all parameters apart from each other, and intervals of "
             "those are infinite; use a law with fewer parameters, or fewer terms",
             true);
  }
  int n_readings = 0;
  for (const LargeStrainTest& test : tests) n_readings += static_cast<int>(test.stretch.size());
  if (n_readings <= fitted.n_parameters + (options.modulus ? -1 : 0)) {
    add_flag(fitted, "few-readings",
             counted(static_cast<std::size_t>(n_readings), "reading") + " for " +
                 counted(static_cast<std::size_t>(fitted.n_parameters), "parameter") +
                 ": the intervals mean nothing",
             true);
  }
  if (options.modulus && options.modulus->se_Pa > 0.0) {
    const double found_Pa = options.modulus->is_long_term ? fitted.E_inf_Pa : fitted.E0_Pa;
    const double off = std::abs(found_Pa - options.modulus->value_Pa);
    if (off > kNormal95 * options.modulus->se_Pa) {
      add_flag(fitted, "modulus-disagrees",
               "Young's modulus at rest is " + text_of(found_Pa, 4) +
                   " Pa, outside of the interval of the known modulus",
               false);
    }
  }
}

std::vector<RubberTestSummary> summaries_of(const std::vector<LargeStrainTest>& tests,
                                            const FittedRubber& fitted) {
  std::vector<RubberTestSummary> out;
  for (const LargeStrainTest& test : tests) {
    const std::vector<double> stress_Pa = stresses_Pa(fitted, test);
    const auto [low, high] = std::minmax_element(test.stretch.begin(), test.stretch.end());
    RubberTestSummary one{test.name,
                          test.deformation,
                          fitted.foam ? name_of(test.foam_test) : name_of(test.deformation),
                          test.stretch.size(),
                          *low,
                          *high};
    double sum = 0.0;
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double left = test.nominal_stress_Pa[i] - stress_Pa[i];
      sum += left * left;
    }
    one.rms_Pa = std::sqrt(sum / static_cast<double>(test.stretch.size()));
    out.push_back(one);
  }
  return out;
}

void add_residuals(const std::vector<LargeStrainTest>& tests, FittedRubber& fitted) {
  double of_stress = 0.0;
  for (const LargeStrainTest& test : tests) {
    const std::vector<double> stress_Pa = stresses_Pa(fitted, test);
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double measured = test.nominal_stress_Pa[i];
      const double left = measured - stress_Pa[i];
      fitted.rss += left * left;
      of_stress += measured * measured;
    }
  }
  fitted.rms_relative = std::sqrt(fitted.rss / of_stress);
}

std::size_t best_law(const std::vector<FittedRubber>& laws) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < laws.size(); ++i) {
    const bool is_better = laws[i].bic < laws[best].bic;
    if (laws[i].is_trustworthy != laws[best].is_trustworthy) {
      if (laws[i].is_trustworthy) best = i;
    } else if (is_better) {
      best = i;
    }
  }
  return best;
}

std::vector<MaterialFlag> notes_of(const std::vector<LargeStrainTest>& tests) {
  std::vector<MaterialFlag> notes;
  std::set<Deformation> seen;
  for (const LargeStrainTest& test : tests) seen.insert(test.deformation);
  if (seen.size() == 1) {
    notes.push_back({"one-deformation", 0,
                     "only " + name_of(*seen.begin()) +
                         " tests: what the law gives in other deformations is not measured, and "
                         "may be far off; add a planar or equibiaxial test"});
  }
  return notes;
}

}  // namespace viscard
