#include "io/flow/large_strain/large_strain_files.h"
#include "models/hyperelastic/law_stability.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

std::string stretches(const StableRange& range) {
  const std::string low = range.low_is_open ? "" : text_of(range.low, 3);
  const std::string high = range.high_is_open ? "" : text_of(range.high, 3);
  if (low.empty() && high.empty()) return "all";
  if (low.empty()) return "up to " + high;
  return high.empty() ? "from " + low : low + " to " + high;
}

void print_tests(const FittedLargeStrain& fitted, std::ostream& out) {
  const LargeStrainResult& result = fitted.result;
  out << fmt::format("  {:<16} {:>8} {:>18} {:>16}\n", "test", "readings", "stretch",
                     "left by law kPa");
  for (const RubberTestSummary& test : result.tests) {
    out << fmt::format("  {:<16} {:>8} {:>18} {:>16.3g}\n", test.name, test.n_readings,
                       text_of(test.least_stretch, 4) + " to " + text_of(test.largest_stretch, 4),
                       1e-3 * test.rms_Pa);
  }
  for (std::size_t i = 0; i < result.tests.size(); ++i) {
    const CycleChoice& choice = fitted.cycles[i];
    if (choice.fitted == 0) continue;
    out << fmt::format("  {}: the loading of cycle {} of {} is fitted; {} left out (--cycle)\n",
                       result.tests[i].name, choice.fitted, choice.n_cycles,
                       counted(choice.n_left_out, "row"));
  }
}

// "yeoh + 2": with two terms.
std::string name_with_terms(const FittedRubber& fitted) {
  const std::string name = name_of(fitted);
  if (fitted.damage) return name + "+" + kMullinsName;
  return fitted.terms.empty() ? name : name + " + " + std::to_string(fitted.terms.size());
}

void print_laws(const LargeStrainResult& result, std::ostream& out) {
  std::size_t width = 14;
  for (const FittedRubber& law : result.laws) width = std::max(width, name_with_terms(law).size());
  out << fmt::format("\n  {:<{}} {:>10} {:>9} {:>10} {:>10} {:>22}   {}\n", "law", width,
                     "parameters", "rms %", "BIC", "E0 kPa", "95 %", "stable stretches (uniaxial)");
  for (std::size_t i = 0; i < result.laws.size(); ++i) {
    const FittedRubber& law = result.laws[i];
    out << fmt::format("{} {:<{}} {:>10} {:>9.3g} {:>10.2f} {:>10.5g} {:>22}   {}{}\n",
                       i == result.chosen ? "*" : " ", name_with_terms(law), width,
                       law.n_parameters, 100.0 * law.rms_relative, law.bic, 1e-3 * law.E0_Pa,
                       fmt::format("{:.5g} to {:.5g}", 1e-3 * law.E0_interval_95.low,
                                   1e-3 * law.E0_interval_95.high),
                       stretches(law.stable[0]), law.is_trustworthy ? "" : "   !");
  }
}

void print_terms(const FittedRubber& best, std::ostream& out) {
  if (best.orders.empty()) return;
  out << "    numbers of terms by BIC:";
  for (const RubberOrder& order : best.orders) {
    out << fmt::format(" {}{}: {:.1f}{}", order.is_chosen ? "*" : "", order.n_terms, order.bic,
                       order.is_eligible ? "" : " (not eligible)");
  }
  out << "\n";
  if (best.terms.empty()) return;
  for (std::size_t i = 0; i < best.terms.size(); ++i) {
    const FittedRubberTerm& term = best.terms[i];
    out << fmt::format("    {:<16} {:>14.6g}   95 % {:.6g} to {:.6g}\n", fmt::format("g_{}", i + 1),
                       term.g, term.g_interval_95.low, term.g_interval_95.high);
    out << fmt::format("    {:<16} {:>14.6g}   95 % {:.6g} to {:.6g}\n",
                       fmt::format("tau_{}_s", i + 1), term.tau_s, term.tau_s_interval_95.low,
                       term.tau_s_interval_95.high);
  }
  out << fmt::format(
      "    Young's modulus at rest: E0 {:.5g} kPa at once (the law above), E_inf {:.5g} kPa (95 % "
      "{:.5g} to {:.5g}) after all relaxation\n",
      1e-3 * best.E0_Pa, 1e-3 * best.E_inf_Pa, 1e-3 * best.E_inf_interval_95.low,
      1e-3 * best.E_inf_interval_95.high);
}

// marks_held: a parameter without error was not fitted.
void print_parameters(const std::vector<LawParameter>& parameters, bool marks_held,
                      std::ostream& out) {
  for (const LawParameter& one : parameters) {
    const bool is_held = marks_held && one.se == 0.0;
    out << fmt::format("    {:<16} {:>14.6g}   ", one.name, one.value)
        << (is_held ? std::string("held\n")
                    : fmt::format("95 % {:.6g} to {:.6g}\n", one.interval_95.low,
                                  one.interval_95.high));
  }
}

void print_damage(const FittedDamage& damage, std::ostream& out) {
  out << "    damage by the first loading: eta = 1 - erf((W_m - W)/(m + beta W_m))/r\n";
  print_parameters(damage.parameters, true, out);
  out << "    left by the law, share of the stresses:";
  const auto add = [&](const char* branch, const std::optional<double>& misfit) {
    if (misfit) out << fmt::format(" {} {:.2g} %", branch, 100.0 * *misfit);
  };
  add("first loading", damage.misfit_first_loading);
  add("unloading", damage.misfit_unloading);
  add("reloading", damage.misfit_reloading);
  out << "\n";
}

void print_best(const LargeStrainResult& result, std::ostream& out) {
  const FittedRubber& best = result.best();
  out << "\n  " << name_of(best) << "\n";
  print_parameters(best.parameters, best.foam.has_value(), out);
  print_terms(best, out);
  if (best.damage) print_damage(*best.damage, out);
  if (best.foam) {
    const FoamLaw& foam = best.foam->law;
    out << fmt::format("    at rest: G {:.5g} kPa, K {:.5g} kPa, Poisson's ratio {:.4g}\n",
                       1e-3 * shear_modulus_Pa(foam), 1e-3 * bulk_modulus_Pa(foam),
                       poisson_ratio(foam));
  }
  if (best.inflation > 1.0) {
    out << fmt::format(
        "    (variances times {:.3g}: the law leaves a structure in the residuals)\n",
        best.inflation);
  }
  for (std::size_t d = 0; d < best.stable.size(); ++d) {
    out << fmt::format("    stable stretches, {:<12} {}\n", deformation_names()[d],
                       stretches(best.stable[d]));
  }
  for (const MaterialFlag& flag : best.flags) out << "  " << flag.name << ": " << flag.text << "\n";
  for (const MaterialFlag& flag : result.notes) {
    out << "  " << flag.name << ": " << flag.text << "\n";
  }
}

}  // namespace

void print_large_strain(const FittedLargeStrain& fitted, std::ostream& out) {
  std::size_t n_readings = 0;
  for (const LargeStrainTest& test : fitted.tests) n_readings += test.stretch.size();
  out << counted(fitted.tests.size(), "test") << " at large strain, "
      << counted(n_readings, "reading") << "\n";
  print_tests(fitted, out);
  print_laws(fitted.result, out);
  print_best(fitted.result, out);
}

}  // namespace viscard
