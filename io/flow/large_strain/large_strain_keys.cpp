// The keys of fits of rubber.
#include "fit/intervals/fitted_law.h"
#include "fit/large_strain/large_strain_result.h"
#include "io/basics/json_string.h"
#include "io/basics/written_path.h"
#include "io/flow/large_strain/large_strain_files.h"
#include "io/materials/material_json.h"
#include "io/results/result_json.h"
#include "models/hyperelastic/law_stability.h"

#include <limits>

namespace viscard {
namespace {

// An end that the search did not reach is infinite.
Interval interval_of(const StableRange& range) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  return {range.low_is_open ? -kOpen : range.low, range.high_is_open ? kOpen : range.high};
}

void show_parameters(ResultVisitor& v, const char* meaning,
                     const std::vector<LawParameter>& parameters) {
  v.list("parameters", meaning, parameters, [&](const LawParameter& one) {
    v("name", one.name, "with its unit");
    v("value", one.value, "its value");
    v("se", one.se, "standard error");
    v("interval_95", one.interval_95, "95 % interval");
  });
}

void show_series(ResultVisitor& v, const FittedRubber& fitted) {
  v.list("terms", "terms of relaxation, by ascending time; empty: elastic", fitted.terms,
         [&](const FittedRubberTerm& term) {
           v("g", term.g, "share of the instantaneous stress");
           v("g_interval_95", term.g_interval_95, "95 % interval");
           v("tau_s", term.tau_s, "relaxation time");
           v("tau_s_interval_95", term.tau_s_interval_95, "95 % interval");
         });
  v("series_covariance", fitted.series_covariance,
    "of the parameters, the g and the ln tau_s, in that order; empty without terms");
  v.list("orders", "numbers of terms that were tried; empty if none were asked for", fitted.orders,
         [&](const RubberOrder& order) {
           v("n_terms", order.n_terms, "number of terms");
           v("bic", order.bic, "criterion");
           v("eligible", order.is_eligible,
             "it converged, and no time ended at the end of its range");
           v("chosen", order.is_chosen, "the one that is used");
         });
}

void show_damage(ResultVisitor& v, const FittedDamage& damage) {
  v("name", kMullinsName, "mullins-or: Ogden and Roxburgh");
  show_parameters(v, "r, m_Pa and beta", damage.parameters);
  v("covariance", damage.covariance, "of the parameters of the law, then of r, m_Pa and beta");
  v("one_maximum", damage.has_one_maximum,
    "all unloading is from one maximum: beta is held at 0, and m holds for this maximum");
  v("misfit_first_loading", number_or_null(damage.misfit_first_loading),
    "root mean square over that of the stresses of the first loading");
  v("misfit_unloading", number_or_null(damage.misfit_unloading), "the same of unloading");
  v("misfit_reloading", number_or_null(damage.misfit_reloading),
    "the same of reloading; null without readings");
}

void show_foam(ResultVisitor& v, const FittedFoam& foam) {
  const bool is_fitted = foam.law.mu_Pa.size() > 0;
  v("G_Pa", is_fitted ? shear_modulus_Pa(foam.law) : 0.0, "shear modulus at rest");
  v("K_Pa", is_fitted ? bulk_modulus_Pa(foam.law) : 0.0, "bulk modulus at rest");
  v("poisson_ratio", is_fitted ? poisson_ratio(foam.law) : 0.0, "at rest, of both moduli");
  v("one_poisson_ratio", foam.has_one_nu, "all terms have one");
  v("poisson_ratio_given", foam.nu_is_given, "it was not measured");
}

void show_law(ResultVisitor& v, const FittedRubber& fitted) {
  v("name", name_of(fitted),
    "neo-hooke, mooney-rivlin, yeoh, ogden-1, ogden-2, ogden-3, arruda-boyce, gent, or a foam: "
    "hyperfoam-1, -2 or -3");
  show_parameters(v, "moduli, then shapes", fitted.parameters);
  v("covariance", fitted.covariance, "of the parameters, in their order");
  v("E0_Pa", fitted.E0_Pa, "Young's modulus at rest; with terms, at once");
  v("E0_interval_95", fitted.E0_interval_95, "its 95 % interval");
  v("E_inf_Pa", fitted.E_inf_Pa, "Young's modulus at rest after all relaxation");
  v("E_inf_interval_95", fitted.E_inf_interval_95, "its 95 % interval");
  show_series(v, fitted);
  v.when(fitted.foam.has_value(), [&] {
    v.object("foam", "what only a foam has (--model hyperfoam)",
             [&] { show_foam(v, fitted.foam.value_or(FittedFoam{})); });
  });
  v.when(fitted.damage.has_value(), [&] {
    v.object("damage", "softening by the first loading, with --model LAW+mullins-or",
             [&] { show_damage(v, fitted.damage.value_or(FittedDamage{})); });
  });
  v("n_parameters", fitted.n_parameters, "number of parameters");
  v("rss_Pa2", fitted.rss, "sum of squared residuals, unweighted");
  v("rms_relative", fitted.rms_relative, "root of it over the sum of squared stresses");
  v("aicc", fitted.aicc, "criterion");
  v("bic", fitted.bic, "criterion");
  v("inflation", fitted.inflation, "of variances, by the memory of the residuals");
  v.object("stable_stretch", "stretches in which the law is stable; null: no end found", [&] {
    for (std::size_t d = 0; d < fitted.stable.size(); ++d) {
      v(deformation_names()[d], interval_of(fitted.stable[d]), "least and largest");
    }
  });
  v("flags", fitted.flags, "what to know about it");
  v("trustworthy", fitted.is_trustworthy, "the law may be used");
}

// The shortest step and the duration; nothing without times.
std::optional<Interval> times_of(const LargeStrainTest& test) {
  if (!has_times(test)) return std::nullopt;
  double step_s = 0.0;
  for (std::size_t i = 1; i < test.time_s.size(); ++i) {
    const double step = test.time_s[i] - test.time_s[i - 1];
    if (step > 0.0 && (step_s == 0.0 || step < step_s)) step_s = step;
  }
  return Interval{step_s, test.time_s.back() - test.time_s.front()};
}

// A test with what was taken of its file.
struct ShownTest {
  RubberTestSummary summary;
  std::string file, sha256;
  std::optional<Interval> times;
  CycleChoice cycles;
};

void show_test(ResultVisitor& v, const ShownTest& test) {
  v("name", test.summary.name, "uniaxial, uniaxial 2 ...");
  v("deformation", test.summary.kind,
    "uniaxial, planar or equibiaxial; of a foam also confined, volumetric or shear");
  v("file", test.file, "its table");
  v("sha256", test.sha256, "of the table");
  v("n_readings", test.summary.n_readings, "fitted readings");
  v("stretch", Interval{test.summary.least_stretch, test.summary.largest_stretch},
    "least and largest; of shear the tangent of its angle");
  v("rms_Pa", test.summary.rms_Pa, "left by the chosen law");
  v.or_null("time_s", test.times, "shortest step and duration; null without times");
  v("n_cycles", test.cycles.n_cycles, "cycles of loading");
  v("cycle", test.cycles.fitted, "whose loading is fitted, from 1; 0: all rows");
  v("n_left_out", test.cycles.n_left_out, "rows that are not fitted");
  v("softening", number_or_null(test.cycles.softening),
    "of the stress from the first to the last cycle");
}

}  // namespace

void show_keys(ResultVisitor& v, const FittedLargeStrain& fitted) {
  const LargeStrainResult& result = fitted.result;
  const FittedRubber best = result.laws.empty() ? FittedRubber{} : result.best();
  std::vector<ShownTest> tests;
  auto files = fitted.files;
  write_paths_of(files);
  for (std::size_t i = 0; i < result.tests.size(); ++i) {
    tests.push_back({result.tests[i], files[i].path, fitted.sums[i], times_of(fitted.tests[i]),
                     fitted.cycles[i]});
  }
  v("law", name_of(best), "the chosen law");
  v("trustworthy", best.is_trustworthy, "it may be used");
  v.list("laws", "all laws", result.laws, [&](const FittedRubber& law) { show_law(v, law); });
  v.list("tests", "the tests, in their order", tests,
         [&](const ShownTest& test) { show_test(v, test); });
  v("flags", result.notes, "what to know about it");
}

std::string file_of_large_strain(const FittedLargeStrain& fitted) {
  nlohmann::ordered_json json{{"schema", "viscard-hyperelastic/1"}};
  json.update(json_from_result(fitted));
  add_body_sum(json);
  return text_from_json(json, 2) + "\n";
}

}  // namespace viscard
