#include "io/flow/words/fit_text.h"

#include "fit/intervals/left_out.h"
#include "fit/intervals/viscosity.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace viscard {
namespace {

// The unit for moduli: 1.88e6 Pa is printed as "1.88 MPa".
struct Shown {
  double factor = 1.0;
  std::string unit;
};
Shown shown_modulus(const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  if (fitted.has_no_depth) return {1.0, "N"};
  if (fit.is_stiffness) return {1.0, "N/m"};
  const double size = std::abs(fit.E0_Pa);
  if (size >= 1e9) return {1e-9, "GPa"};
  if (size >= 1e6) return {1e-6, "MPa"};
  if (size >= 1e3) return {1e-3, "kPa"};
  return {1.0, "Pa"};
}

std::string range(const Interval& interval_95, double factor, int digits) {
  return fmt::format("{:.{}g} to {:.{}g}", interval_95.low * factor, digits,
                     interval_95.high * factor, digits);
}

void print_orders(const FitResult& fit, const std::string& unit, std::ostream& out) {
  constexpr std::size_t kShown = 12;
  std::size_t chosen = 0;
  while (chosen < fit.orders.size() && !fit.orders[chosen].is_chosen) ++chosen;
  const std::size_t first = chosen > kShown / 2 ? chosen - kShown / 2 : 0;
  out << fmt::format("\n  terms {:>14} {:>12} {:>12} {:>10}\n", "rss (" + unit + ")^2", "AICc",
                     "BIC", "cv");
  for (std::size_t i = first; i < std::min(fit.orders.size(), first + kShown); ++i) {
    const OrderRow& row = fit.orders[i];
    out << fmt::format("{} {:>5} {:>14.6g} {:>12.2f} {:>12.2f} {:>10.4g}\n",
                       row.is_chosen ? "*" : " ", row.n_terms, row.rss, row.aicc, row.bic, row.cv);
  }
}

// "frame 3.9 %, geometry 1.7 %"
std::string words_of_parts(const FitResult& fit) {
  std::string words;
  for (const SystematicPart& part : fit.systematic_parts) {
    words += fmt::format("{}{} {:.2g} %", words.empty() ? "" : ", ", part.cause,
                         100.0 * std::abs(part.E0));
  }
  return words;
}

// Effect of frame and load cell on the shares that relax.
void print_systematic_of_g(const FitResult& fit, std::ostream& out) {
  std::string words;
  for (std::size_t i = 0; i < fit.terms.size(); ++i) {
    const Interval wide = combined_intervals(fit, i).g_95;
    if (wide.high - wide.low < 1.01 * (fit.terms[i].g_95.high - fit.terms[i].g_95.low)) continue;
    words += fmt::format("{}g_{} {}", words.empty() ? "" : ", ", i + 1, range(wide, 1.0, 4));
  }
  if (!words.empty()) out << "  including it, shares are " << words << "\n";
}

void print_fractional(const FractionalDiagnosis& fractional, std::ostream& out) {
  constexpr double kStrong = 6.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  const double difference = fractional.bic_difference;
  out << fmt::format(
      "  fractional Zener: alpha {:.4g}, tau {:.4g} s, BIC minus that of the series {:+.1f}: {}\n",
      fractional.model.alpha, fractional.model.tau_s, difference,
      difference < -kStrong  ? "a power law describes the data better than the terms"
      : difference > kStrong ? "the terms describe the data better than a power law"
                             : "the data do not decide between the two");
}

// One line for each of several tests.
void print_tests(const FittedFile& fitted, std::ostream& out) {
  out << fmt::format("\n  {:<14} {:>8} {:>18} {:>6} {:>28} {:>9}\n", "test", "samples",
                     "noise of a sample", "terms", "% above the other tests", "chance");
  for (const FittedTest& test : fitted.result.tests) {
    const std::string noise = test.kind == FitKind::kDma
                                  ? fmt::format("{:.3g} %", 100.0 * test.noise.sigma)
                                  : fmt::format("{:.3g} {}", test.noise.sigma, test.fitted_unit);
    const Interval& range_95 = test.difference_95;
    const bool has_factor = range_95.high > range_95.low;
    const std::string difference =
        has_factor ? fmt::format("{:+.2g} ({:+.2g} to {:+.2g})", 100.0 * test.difference,
                                 100.0 * range_95.low, 100.0 * range_95.high)
                   : std::string("scale is free");
    out << fmt::format("{} {:<14} {:>8} {:>18} {:>6} {:>28} {:>9}\n", test.disagrees ? "!" : " ",
                       test.name, test.n_samples, noise, test.own_terms, difference,
                       test.freedom > 0 ? fmt::format("{:.2g}", test.p_value) : "-");
    if (test.noise.inflation > 1.0) {
      out << fmt::format("      noise: variance x {:.3g} for autocorrelation\n",
                         test.noise.inflation);
    }
    if (test.has_scale) {
      out << fmt::format("      values over those of the material: {:.5g}   95 % {}\n", test.scale,
                         range(test.scale_95, 1.0, 5));
    }
  }
  out << "  (terms: of its own fit; chance: of so large a difference between tests that agree)\n";
}

const char* text_of_form(const MasterCurve& curve) {
  if (curve.form == "wlf") return "the WLF law";
  if (curve.form == "arrhenius") return "the Arrhenius law";
  return curve.form == "smooth" ? "a smooth curve over 1/T" : "one free value for each temperature";
}

void print_laws(const FittedFile& fitted, std::ostream& out) {
  out << fmt::format("\n  {:<24} {:>10} {:>14} {:>26}\n", "law", "parameters", "rss",
                     "BIC minus that of series");
  for (const FittedLaw& law : fitted.result.laws) {
    out << fmt::format("{} {:<24} {:>10} {:>14.6g} {:>+26.1f}{}\n",
                       law.name == fitted.model ? "*" : " ", law.name, law.n_parameters, law.rss,
                       law.bic_difference, law.is_at_bound ? "   at the end of its range" : "");
    for (const LawParameter& one : law.parameters) {
      out << fmt::format("      {:<20} {:>14.6g}   95 % {}\n", one.name, one.value,
                         range(one.interval_95, 1.0, 6));
    }
  }
}

void print_master(const MasterCurve& curve, std::ostream& out) {
  out << fmt::format("  master curve at {:.4g} C from {} temperatures\n", curve.T_ref_C,
                     curve.factors.size());
  out << fmt::format(
      "  shift factors by {} (relative residual {:.2g} %), beside free ones ({:.2g} %)\n",
      text_of_form(curve), 100.0 * curve.residual, 100.0 * curve.free_residual);
  if (!curve.start_given.empty()) {
    out << (curve.is_start_as_given
                ? "  started from the shifts that were given\n"
                : "  the shifts that were given scatter clearly more than those of the rows, from "
                  "which the fit started\n");
  }
  const double ln_10 = std::log(10.0);
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    const ShiftFactor &factor = curve.factors[k], &free = curve.free_factors[k];
    out << fmt::format("    {:>8.4g} C   log10 a_T {:>9.4f} +- {:.2g}", factor.temperature_C,
                       factor.ln_a / ln_10, factor.ln_a_se / ln_10);
    out << fmt::format("   free {:>9.4f} +- {:.2g}", free.ln_a / ln_10, free.ln_a_se / ln_10);
    if (curve.has_vertical_shift) {
      out << fmt::format("   b_T {:.4f} +- {:.2g}", std::exp(factor.ln_b),
                         std::exp(factor.ln_b) * factor.ln_b_se);
    }
    out << "\n";
  }
  const ShiftLaws& laws = curve.laws;
  if (laws.wlf) {
    out << fmt::format("  {} WLF        C1 {:.5g} (95 % {}), C2 {:.5g} K (95 % {}), BIC {:.2f}\n",
                       laws.wlf_is_better ? "*" : " ", laws.wlf->C1, range(laws.wlf->C1_95, 1.0, 4),
                       laws.wlf->C2_K, range(laws.wlf->C2_K_95, 1.0, 4), laws.wlf_bic);
  }
  if (laws.arrhenius) {
    out << fmt::format("  {} Arrhenius  {:.5g} kJ/mol (95 % {}), BIC {:.2f}\n",
                       laws.wlf_is_better ? " " : "*", 1e-3 * laws.arrhenius->activation_J_mol,
                       range(laws.arrhenius->activation_J_mol_95, 1e-3, 4), laws.arrhenius_bic);
  }
}

// What was fitted, and which rows of the file are not part of it.
void print_source(const FittedFile& fitted, std::ostream& out) {
  const FitResult& fit = fitted.result;
  out << fmt::format("{}: {}, {}\n", fitted.path,
                     fit.tests.empty() ? std::string(name_of_kind(fit.kind))
                                       : counted(fit.tests.size(), "test") + " together",
                     counted(fit.n_samples, "sample"));
  if (!fitted.maker.empty()) {
    const bool is_book_only =
        fitted.maker.starts_with("Excel workbook") || fitted.maker.starts_with("MATLAB file");
    out << (is_book_only ? "  " : "  file of ") << fitted.maker << "\n";
  }
  for (const std::string& note : fitted.notes) out << "  " << note << "\n";
  if (fit.n_averages < fit.n_samples) {
    out << fmt::format("  fitted as {} in log time (--full-data: every sample)\n",
                       counted(fit.n_averages, "average"));
  }
  if (!fitted.chosen.empty()) out << "  chosen: " << fitted.chosen << "\n";
  if (fitted.n_before_test > 0) {
    out << "  not fitted: the " << counted(fitted.n_before_test, "row")
        << " before the first baseline, in which the rig looks for the surface\n";
  }
  if (const std::string left = left_out_text(fit); !left.empty()) out << "  " << left << "\n";
  if (fit.n_contacts > 1) {
    out << "  contact was made " << fit.n_contacts << " times; the record is fitted as a whole\n";
  }
  if (fitted.has_no_depth) {
    out << "  forces in N after a step of unknown depth; --depth gives stiffnesses\n";
  } else if (fit.is_stiffness && fit.kind == FitKind::kRelaxation) {
    out << "  stiffnesses in N/m: force over --depth\n";
  } else if (fit.is_stiffness) {
    out << "  stiffnesses in N/m: no punch geometry was given (--specimen, or --punch-diameter)\n";
  }
}

// The moduli as they were measured, if not as Young's.
void print_measured(const FittedFile& fitted, const Shown& shown, std::ostream& out) {
  if (!fitted.modulus) return;
  const MeasuredModulus& modulus = *fitted.modulus;
  if (modulus.nu_95) {
    out << fmt::format("  nu     {:>10.4g}       95 % {}   from tests in shear and in tension\n",
                       modulus.nu, range(*modulus.nu_95, 1.0, 4));
  }
  if (modulus.kind == ModulusKind::kTension) return;
  const FitResult& fit = fitted.result;
  const ModulusKindText& text = text_of(modulus.kind);
  const double factor = shown.factor / modulus.young_factor();
  out << fmt::format("  moduli of {} ({}):\n", text.word, modulus.from);
  out << fmt::format("  {}0     {:>10.6g} {}   95 % {}\n", text.letter, fit.E0_Pa * factor,
                     shown.unit, range(fit.E0_interval_95, factor, 6));
  out << fmt::format("  {}_inf  {:>10.6g} {}   95 % {}\n", text.letter, fit.E_inf_Pa * factor,
                     shown.unit, range(fit.E_inf_interval_95, factor, 6));
  out << fmt::format("  {} with nu = {}{}:\n", text.conversion, modulus.nu,
                     modulus.is_nu_stated ? "" : " (assumed; --poisson-ratio)");
}

void print_moduli(const FittedFile& fitted, std::ostream& out) {
  const FitResult& fit = fitted.result;
  const Shown shown = shown_modulus(fitted);
  const char* letter = fitted.has_no_depth ? "F" : fit.is_stiffness ? "K" : "E";
  print_measured(fitted, shown, out);
  out << fmt::format("  {}0     {:>10.6g} {}   95 % {}\n", letter, fit.E0_Pa * shown.factor,
                     shown.unit, range(fit.E0_interval_95, shown.factor, 6));
  if (fit.first && fit.first->time_s > 0.0) {
    out << fmt::format("  {}(t_1) {:>10.6g} {}   95 % {}   at the first sample, t_1 = {:.3g} s\n",
                       letter, fit.first->modulus_Pa * shown.factor, shown.unit,
                       range(fit.first->interval_95, shown.factor, 6), fit.first->time_s);
  }
  if (fit.highest) {
    out << fmt::format(
        "  {}'(f_n) {:>9.6g} {}   95 % {}   at the highest frequency, f_n = {:.3g} Hz\n", letter,
        fit.highest->modulus_Pa * shown.factor, shown.unit,
        range(fit.highest->interval_95, shown.factor, 6), fit.highest->frequency_Hz);
  }
  out << fmt::format("  {}_inf  {:>10.6g} {}   95 % {}\n", letter, fit.E_inf_Pa * shown.factor,
                     shown.unit, range(fit.E_inf_interval_95, shown.factor, 6));
  if (const auto viscosity = viscosity_of(fit)) {
    out << fmt::format("  eta_0  {:>10.5g} Pa s  95 % {}   sum of E_i tau_i\n",
                       viscosity->value_Pa_s, range(viscosity->interval_95, 1.0, 4));
  }
  for (std::size_t i = 0; i < fit.terms.size(); ++i) {
    const FittedTerm& term = fit.terms[i];
    out << fmt::format("  g_{:<4} {:>10.5g}       95 % {:<22}  tau {:.4g} s   95 % {}\n", i + 1,
                       term.g, range(term.g_95, 1.0, 4), term.tau_s, range(term.tau_s_95, 1.0, 4));
  }
  if (fit.dashpot_Pa_s) {
    out << fmt::format("  dashpot beside the terms {:.4g} Pa s +- {:.2g}\n", *fit.dashpot_Pa_s,
                       fit.dashpot_se_Pa_s);
  }
  if (fit.systematic_relative > 0.0) {
    out << fmt::format(
        "  systematic part of E0: +-{:.2g} % at 95 %, standard uncertainty {:.2g} % ({}); "
        "including "
        "it, E0 is {} {}\n",
        100.0 * kNormal95 * fit.systematic_relative, 100.0 * fit.systematic_relative,
        words_of_parts(fit), range(combined_intervals(fit).E0_Pa, shown.factor, 4), shown.unit);
    print_systematic_of_g(fit, out);
  }
  if (fit.two_point) {
    out << fmt::format("  two points on the ramp: {:.5g} {} (half-space: {:.5g}); {}\n",
                       fit.two_point->modulus_Pa * shown.factor, shown.unit,
                       fit.two_point->half_space_modulus_Pa * shown.factor, fit.two_point->bias);
  }
}

// Noise, drift and temperature of the record.
void print_spectrum(const FittedFile& fitted, std::ostream& out) {
  const ContinuousSpectrum& spectrum = *fitted.result.spectrum;
  const Shown shown = shown_modulus(fitted);
  const char* letter = fitted.has_no_depth ? "F" : fitted.result.is_stiffness ? "K" : "E";
  out << fmt::format(
      "\n  continuous spectrum over {:.3g} s to {:.3g} s; all of them allow {}0 {} {}",
      spectrum.from_s, spectrum.to_s, letter, range(spectrum.E0_95, shown.factor, 6), shown.unit);
  if (spectrum.E_inf_95.high > 0.0) {
    out << fmt::format(", {}_inf {} {}", letter, range(spectrum.E_inf_95, shown.factor, 6),
                       shown.unit);
  }
  out << fmt::format("\n  {:>12}   {:>12}   95 %, mean over half a decade\n", "tau (s)",
                     "H (" + shown.unit + ")");
  for (const SpectrumRow& row : spectrum.rows) {
    out << fmt::format("  {:>12.4g}   {:>12.4g}   {}\n", row.tau_s, row.H_Pa * shown.factor,
                       range(row.H_95, shown.factor, 4));
  }
}

void print_conditions(const FittedFile& fitted, std::ostream& out) {
  const FitResult& fit = fitted.result;
  const std::string sigma_unit = fit.kind == FitKind::kDma ? "(relative)" : fitted.fitted_unit;
  if (fit.tests.empty()) {
    out << fmt::format("  noise {:.3g} {}, variance x {:.3g} for autocorrelation\n",
                       fit.noise.sigma, sigma_unit, fit.noise.inflation);
  }
  if (fit.drift) {
    out << fmt::format("  drift {:.4g} {}/s, standard error {:.2g}\n", fit.drift->per_s,
                       fitted.fitted_unit, fit.drift->se_per_s);
  }
  if (fitted.temperature) {
    const RunTemperature& measured = *fitted.temperature;
    out << fmt::format("  temperature {:.2f} C, measured: {:.2f} to {:.2f} C in {}\n",
                       measured.mean_C, measured.min_C, measured.max_C,
                       counted(measured.n_readings, "reading"));
  }
}

}  // namespace

void print_fit(const FittedFile& fitted, std::ostream& out) {
  const FitResult& fit = fitted.result;
  print_source(fitted, out);
  print_moduli(fitted, out);
  print_conditions(fitted, out);
  if (fitted.master) print_master(*fitted.master, out);
  if (fitted.fractional) print_fractional(*fitted.fractional, out);
  if (!fit.tests.empty()) print_tests(fitted, out);
  print_orders(fit, fitted.fitted_unit, out);
  if (fit.spectrum) print_spectrum(fitted, out);
  if (!fit.laws.empty()) print_laws(fitted, out);
  if (!fit.flags.empty()) out << "\n";
  print_flags(fit.flags, out);
}

void print_flags(const std::vector<MaterialFlag>& flags, std::ostream& out) {
  std::vector<const MaterialFlag*> firsts;  // of each name and term or, of many terms, of each name
  for (const MaterialFlag& flag : flags) {
    const bool is_known = std::any_of(firsts.begin(), firsts.end(), [&](const MaterialFlag* one) {
      return one->name == flag.name && (one->text == flag.text || (one->term > 0 && flag.term > 0));
    });
    if (is_known) continue;
    firsts.push_back(&flag);
    std::string others;
    for (const MaterialFlag& other : flags) {
      if (&other == &flag || other.name != flag.name || other.term == 0 || flag.term == 0) continue;
      others += (others.empty() ? "" : ", ") + std::to_string(other.term);
    }
    out << "  ! " << flag.name << ": " << flag.text;
    if (!others.empty()) out << "; likewise term " << others;
    out << "\n";
  }
}

}  // namespace viscard
