#include "io/cli/fit/fit_command.h"
#include "io/materials/material_json.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace viscard {
namespace {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const char* kind_name(FitKind kind) {
  constexpr const char* kNames[] = {"indentation", "relaxation", "creep", "dma"};
  return kNames[static_cast<std::size_t>(kind)];
}

Json terms_of(const FitResult& fit, const std::string& unit) {
  Json terms = Json::array();
  const std::string stem = fit.is_stiffness ? "stiffness" : "modulus";
  for (const FittedTerm& term : fit.terms) {
    Json row;
    row[stem + unit] = number(term.modulus_Pa);
    row["g"] = number(term.g);
    row["tau_s"] = number(term.tau_s);
    row[stem + "_se" + unit] = number(term.modulus_se_Pa);
    row["ln_tau_se"] = number(term.ln_tau_se);
    row["interval_95"][stem + unit] = json_from(term.modulus_Pa_95);
    row["interval_95"]["g"] = json_from(term.g_95);
    row["interval_95"]["tau_s"] = json_from(term.tau_s_95);
    terms.push_back(row);
  }
  return terms;
}

Json orders_of(const FitResult& fit) {
  Json orders = Json::array();
  for (const OrderRow& row : fit.orders) {
    orders.push_back({{"n_terms", row.n_terms},
                      {"rss", number(row.rss)},
                      {"aicc", number(row.aicc)},
                      {"bic", number(row.bic)},
                      {"cv", number(row.cv)},
                      {"chosen", row.is_chosen}});
  }
  return orders;
}

Json flags_of(const FitResult& fit) {
  Json flags = Json::array();
  for (const MaterialFlag& flag : fit.flags) {
    Json row{{"name", flag.name}};
    if (flag.term > 0) row["term"] = flag.term;
    row["text"] = flag.text;
    flags.push_back(row);
  }
  return flags;
}

Json profiles_of(const FitResult& fit) {
  Json profiles = Json::array();
  for (const ProfileCurve& curve : fit.profiles) {
    profiles.push_back({{"parameter", curve.parameter},
                        {"value", curve.value},
                        {"rise", curve.rise},
                        {"interval_95", json_from(curve.interval_95)}});
  }
  return profiles;
}

// The unit for moduli: 1.88e6 Pa is printed as "1.88 MPa".
struct Shown {
  double factor = 1.0;
  std::string unit;
};
Shown shown_modulus(const FitResult& fit) {
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

Json json_of(const TemperatureShift& shift, double chi2, double bic) {
  Json json;
  if (shift.law == ShiftLaw::kWlf) {
    json = {{"C1", number(shift.C1)},
            {"C2_K", number(shift.C2_K)},
            {"interval_95", {{"C1", json_from(shift.C1_95)}, {"C2_K", json_from(shift.C2_K_95)}}}};
  } else {
    json = {{"activation_J_mol", number(shift.activation_J_mol)},
            {"interval_95", {{"activation_J_mol", json_from(shift.activation_J_mol_95)}}}};
  }
  json["chi2"] = number(chi2);
  json["bic"] = number(bic);
  return json;
}

Json json_of(const MasterCurve& curve) {
  const ShiftLaws& laws = curve.laws;
  Json json{{"T_ref_C", number(curve.T_ref_C)}};
  json["factors"] = Json::array();
  for (const ShiftFactor& factor : curve.factors) {
    json["factors"].push_back({{"temperature_C", number(factor.temperature_C)},
                               {"ln_a", number(factor.ln_a)},
                               {"ln_a_se", number(factor.ln_a_se)}});
  }
  if (laws.wlf) json["wlf"] = json_of(*laws.wlf, laws.wlf_chi2, laws.wlf_bic);
  if (laws.arrhenius) {
    json["arrhenius"] = json_of(*laws.arrhenius, laws.arrhenius_chi2, laws.arrhenius_bic);
  }
  if (laws.better() != nullptr) json["better"] = laws.wlf_is_better ? "wlf" : "arrhenius";
  return json;
}

Json json_of(const FractionalDiagnosis& fractional) {
  return {{"E_inf_Pa", number(fractional.model.equilibrium_Pa)},
          {"E_1_Pa", number(fractional.model.branch_Pa)},
          {"tau_s", number(fractional.model.tau_s)},
          {"alpha", number(fractional.model.alpha)},
          {"chi_square", number(fractional.chi_square)},
          {"series_chi_square", number(fractional.series_chi_square)},
          {"bic_difference", number(fractional.bic_difference)}};
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

void print_master(const MasterCurve& curve, std::ostream& out) {
  out << fmt::format("  master curve at {:.4g} C from {} temperatures\n", curve.T_ref_C,
                     curve.factors.size());
  for (const ShiftFactor& factor : curve.factors) {
    out << fmt::format("    {:>8.4g} C   log10 a_T {:>9.4f} +- {:.2g}\n", factor.temperature_C,
                       factor.ln_a / std::log(10.0), factor.ln_a_se / std::log(10.0));
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

}  // namespace

Json json_from_fit(const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  const std::string unit = fit.is_stiffness ? "_N_m" : "_Pa";
  const std::string letter = fit.is_stiffness ? "K" : "E";
  Json json;
  json["file"] = fitted.path;
  json["kind"] = kind_name(fit.kind);
  json["trustworthy"] = fit.is_trustworthy;
  json[letter + "0" + unit] = number(fit.E0_Pa);
  json[letter + "_inf" + unit] = number(fit.E_inf_Pa);
  json[letter + "0_se" + unit] = number(fit.E0_se_Pa);
  json[letter + "_inf_se" + unit] = number(fit.E_inf_se_Pa);
  json[letter + "0_interval_95"] = json_from(fit.E0_interval_95);
  json[letter + "_inf_interval_95"] = json_from(fit.E_inf_interval_95);
  json["sum_g"] = number(fit.sum_g);
  json["sum_g_interval_95"] = json_from(fit.sum_g_95);
  json["terms"] = terms_of(fit, unit);
  json["rss"] = number(fit.rss);
  json["n_samples"] = fit.n_samples;
  json["n_terms"] = fit.terms.size();
  json["orders"] = orders_of(fit);
  json["flags"] = flags_of(fit);
  json["noise"] = {{"sigma", number(fit.noise.sigma)}, {"inflation", number(fit.noise.inflation)}};
  json["systematic_relative"] = number(fit.systematic_relative);
  json["gain_drift_relative"] = number(fit.gain_drift_relative);
  // Including the systematic part, in quadrature.
  json[letter + "0_combined_interval_95"] =
      json_from(combined_95(fit.E0_interval_95, fit.E0_Pa, fit.systematic_relative));
  json[letter + "_inf_combined_interval_95"] =
      json_from(combined_95(fit.E_inf_interval_95, fit.E_inf_Pa, fit.systematic_relative));
  if (fitted.temperature) {
    const RunTemperature& measured = *fitted.temperature;
    json["temperature"] = {{"mean_C", number(measured.mean_C)},
                           {"min_C", number(measured.min_C)},
                           {"max_C", number(measured.max_C)},
                           {"n_readings", measured.n_readings}};
  }
  json["fit_from_s"] = number(fit.fit_from_s);
  json["fit_to_s"] = number(fit.fit_to_s);
  if (fit.contact_position_m) json["contact_position_m"] = number(*fit.contact_position_m);
  if (fit.two_point) {
    json["two_point"] = {{"modulus_Pa", number(fit.two_point->modulus_Pa)},
                         {"se_Pa", number(fit.two_point->se_Pa)},
                         {"half_space_modulus_Pa", number(fit.two_point->half_space_modulus_Pa)},
                         {"bias", fit.two_point->bias}};
  }
  if (fit.n_bootstrap > 0) json["n_bootstrap"] = fit.n_bootstrap;
  if (!fit.profiles.empty()) json["profiles"] = profiles_of(fit);
  if (fitted.master) json["shift"] = json_of(*fitted.master);
  if (fitted.fractional) json["fractional_zener"] = json_of(*fitted.fractional);
  json["n_spikes"] = fit.n_spikes;
  json["n_left_out"] = fit.n_left_out;
  json["n_before_test"] = fitted.n_before_test;
  return json;
}

void print_fit(const FittedFile& fitted, std::ostream& out) {
  const FitResult& fit = fitted.result;
  const Shown shown = shown_modulus(fit);
  const char* letter = fit.is_stiffness ? "K" : "E";
  out << fmt::format("{}: {}, {}\n", fitted.path, kind_name(fit.kind),
                     counted(fit.n_samples, "sample"));
  if (fitted.n_before_test > 0) {
    out << "  not fitted: the " << counted(fitted.n_before_test, "row")
        << " before the first baseline, in which the rig looks for the surface\n";
  }
  if (fit.is_stiffness) {
    out << "  stiffnesses in N/m: no punch geometry was given (--specimen, or --punch-diameter)\n";
  }
  out << fmt::format("  {}0     {:>10.6g} {}   95 % {}\n", letter, fit.E0_Pa * shown.factor,
                     shown.unit, range(fit.E0_interval_95, shown.factor, 6));
  out << fmt::format("  {}_inf  {:>10.6g} {}   95 % {}\n", letter, fit.E_inf_Pa * shown.factor,
                     shown.unit, range(fit.E_inf_interval_95, shown.factor, 6));
  for (std::size_t i = 0; i < fit.terms.size(); ++i) {
    const FittedTerm& term = fit.terms[i];
    out << fmt::format("  g_{:<4} {:>10.5g}       95 % {:<22}  tau {:.4g} s   95 % {}\n", i + 1,
                       term.g, range(term.g_95, 1.0, 4), term.tau_s, range(term.tau_s_95, 1.0, 4));
  }
  if (fit.systematic_relative > 0.0) {
    out << fmt::format(
        "  systematic part, common to all moduli: {:.2g} % (geometry, calibration, frame); "
        "including it, E0 is {} {}\n",
        100.0 * fit.systematic_relative,
        range(combined_95(fit.E0_interval_95, fit.E0_Pa, fit.systematic_relative), shown.factor, 4),
        shown.unit);
  }
  if (fit.two_point) {
    out << fmt::format("  two points on the ramp: {:.5g} {} (half-space: {:.5g}); {}\n",
                       fit.two_point->modulus_Pa * shown.factor, shown.unit,
                       fit.two_point->half_space_modulus_Pa * shown.factor, fit.two_point->bias);
  }
  const std::string sigma_unit = fit.kind == FitKind::kDma ? "(relative)" : fitted.fitted_unit;
  out << fmt::format("  noise {:.3g} {}, variance x {:.3g} for autocorrelation\n", fit.noise.sigma,
                     sigma_unit, fit.noise.inflation);
  if (fitted.temperature) {
    const RunTemperature& measured = *fitted.temperature;
    out << fmt::format("  temperature {:.2f} C, measured: {:.2f} to {:.2f} C in {}\n",
                       measured.mean_C, measured.min_C, measured.max_C,
                       counted(measured.n_readings, "reading"));
  }
  if (fitted.master) print_master(*fitted.master, out);
  if (fitted.fractional) print_fractional(*fitted.fractional, out);
  print_orders(fit, fitted.fitted_unit, out);
  if (!fit.flags.empty()) out << "\n";
  for (const MaterialFlag& flag : fit.flags) {
    out << "  ! " << flag.name << ": " << flag.text << "\n";
  }
}

}  // namespace viscard
