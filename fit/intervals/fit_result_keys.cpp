#include "fit/intervals/fit_result_keys.h"

#include "fit/intervals/viscosity.h"

#include <algorithm>

namespace viscard {
namespace {

const std::vector<const char*> kKinds{"indentation", "relaxation", "creep", "dma", "several"};

void show_keys(ResultVisitor& v, const OrderRow& row) {
  v("n_terms", row.n_terms, "number of terms");
  v("rss", row.rss, "as above");
  v("aicc", row.aicc, "corrected Akaike criterion");
  v("bic", row.bic, "Bayes criterion");
  v("cv", row.cv, "cross-validation");
  v("chosen", row.is_chosen, "whether it was taken");
}

void show_keys(ResultVisitor& v, const SystematicPart& part) {
  v("cause", part.cause, "frame, load cell or geometry");
  v("E0", part.E0, "relative change of E0");
  v("g", part.g, "of the g_i; empty: none");
  v("tau_s", part.tau, "of the relaxation times; empty: none");
}

void show_intervals(ResultVisitor& v, const TermUncertainty& of, const std::string& modulus) {
  v(modulus, of.modulus_Pa_95, "of the modulus, [low, high]");
  v("g", of.g_95, "of g, [low, high]");
  v("tau_s", of.tau_s_95, "of tau_s, [low, high]");
}

// i: from 0.
void show_term(ResultVisitor& v, const FitResult& fit, std::size_t i, const ModulusNames& names) {
  const std::string modulus = names.stem + names.unit;
  const FittedTerm term = i < fit.terms.size() ? fit.terms[i] : FittedTerm{};
  v(modulus, term.modulus_Pa, "modulus of the term; stiffness or force without geometry");
  v("g", term.g, "relative modulus");
  v("tau_s", term.tau_s, "relaxation time");
  v(names.stem + "_se" + names.unit, term.modulus_se_Pa, "its standard error");
  v("ln_tau_se", term.ln_tau_se, "standard error of ln tau");
  v.object("interval_95", "95 % intervals", [&] { show_intervals(v, term, modulus); });
  v.object("combined_interval_95", "the same with the systematic parts, in quadrature", [&] {
    show_intervals(v, i < fit.terms.size() ? combined_intervals(fit, i) : TermUncertainty{},
                   modulus);
  });
}

}  // namespace

ModulusNames modulus_names(bool is_stiffness, bool has_no_depth) {
  if (has_no_depth) return {"F", "force", "_N"};
  return is_stiffness ? ModulusNames{"K", "stiffness", "_N_m"} : ModulusNames{};
}

void show_moduli(ResultVisitor& v, const FitResult& fit, const ModulusNames& names) {
  const auto& [letter, stem, unit] = names;
  v(letter + "0" + unit, fit.E0_Pa,
    "instantaneous modulus E; stiffness K in N/m without punch geometry; force F in N without a "
    "depth");
  v(letter + "_inf" + unit, fit.E_inf_Pa, "equilibrium modulus, stiffness or force");
  v(letter + "0_se" + unit, fit.E0_se_Pa, "standard error of E0");
  v(letter + "_inf_se" + unit, fit.E_inf_se_Pa, "standard error of E_inf");
  v(letter + "0_interval_95", fit.E0_interval_95, "95 % interval of E0, [low, high]");
  v(letter + "_inf_interval_95", fit.E_inf_interval_95, "95 % interval of E_inf, [low, high]");
  const auto viscosity = viscosity_of(fit);
  v.when(viscosity.has_value(), [&] {
    const Viscosity of = viscosity.value_or(Viscosity{});
    v("viscosity_Pa_s", of.value_Pa_s, "sum of E_i tau_i of a liquid");
    v("viscosity_interval_95", of.interval_95, "its 95 % interval, [low, high]");
  });
  v("sum_g", fit.sum_g, "sum of all g");
  v("sum_g_interval_95", fit.sum_g_95, "its 95 % interval, [low, high]");
  std::vector<std::size_t> numbers(fit.terms.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  v.list("terms", "the Prony series, shortest time first", numbers,
         [&](std::size_t i) { show_term(v, fit, i, names); });
}

void show_keys(ResultVisitor& v, const NoiseEstimate& noise) {
  v("sigma", noise.sigma, "standard deviation in the unit of the fitted column");
  v("inflation", noise.inflation, "factor on the variance for autocorrelation");
}

void show_quality(ResultVisitor& v, const FitResult& fit) {
  v("rss", fit.rss,
    "sum of squared residuals over all samples, unweighted, in the unit of the fitted column");
  v("n_samples", fit.n_samples, "samples that were fitted");
  v("n_averages", fit.n_averages, "averages in log time that stand for them");
  v("n_terms", fit.terms.size(), "number of terms");
  v.list("orders", "the numbers of terms that were compared", fit.orders,
         [&](const OrderRow& row) { show_keys(v, row); });
  v("bic_liquid_minus_solid", fit.bic_liquid_minus_solid,
    "BIC without minus BIC with an equilibrium modulus");
  v("flags", fit.flags, "what limits the trust in the result");
  v("noise", fit.noise, "of the samples");
}

void show_systematic(ResultVisitor& v, const FitResult& fit, const ModulusNames& names) {
  v("systematic_relative", fit.systematic_relative,
    "relative standard uncertainty of E0 from geometry, calibration and frame");
  v.list("systematic_parts", "what one standard deviation of each cause changes, all together",
         fit.systematic_parts, [&](const SystematicPart& part) { show_keys(v, part); });
  v("gain_drift_relative", fit.gain_drift_relative, "drift of the gain that the record shows");
  const ModulusIntervals combined = combined_intervals(fit);
  v(names.letter + "0_combined_interval_95", combined.E0_Pa,
    "the same with the systematic part, in quadrature, [low, high]");
  v(names.letter + "_inf_combined_interval_95", combined.E_inf_Pa,
    "the same with the systematic part, in quadrature, [low, high]");
}

void show_measured_ends(ResultVisitor& v, const FitResult& fit, const ModulusNames& names) {
  v.when(fit.first.has_value(), [&] {
    const FirstModulus first = fit.first.value_or(FirstModulus{});
    v(names.letter + "_first_sample" + names.unit, first.modulus_Pa,
      "relaxation modulus at the first sample");
    v(names.letter + "_first_sample_interval_95", first.interval_95,
      "its 95 % interval, [low, high]");
    v("first_sample_s", first.time_s, "time of the first sample");
  });
  v.when(fit.highest.has_value(), [&] {
    const HighestStorage highest = fit.highest.value_or(HighestStorage{});
    v(names.letter + "_storage_highest" + names.unit, highest.modulus_Pa,
      "storage modulus at the highest frequency");
    v(names.letter + "_storage_highest_interval_95", highest.interval_95,
      "its 95 % interval, [low, high]");
    v("highest_frequency_Hz", highest.frequency_Hz, "highest frequency of an oscillation");
  });
}

void show_lack_of_fit(ResultVisitor& v, const FitResult& fit, const std::string& fitted_unit) {
  v.when(fit.drift.has_value(), [&] {
    const FittedDrift drift = fit.drift.value_or(FittedDrift{});
    v.object("drift", "linear in time", [&] {
      v("per_s", drift.per_s, "slope");
      v("se_per_s", drift.se_per_s, "its standard error");
      v("unit", fitted_unit + "/s", "its unit");
    });
  });
  v.when(fit.lack_of_fit.has_value(), [&] {
    const LackOfFit lack = fit.lack_of_fit.value_or(LackOfFit{});
    v.object("lack_of_fit", "what the series does not describe", [&] {
      v("structure", lack.structure, "size of what is left that is no noise");
      v("noise", lack.noise, "size of the noise");
      v("significant", lack.is_significant, "whether it is more than chance");
    });
  });
}

void show_rig(ResultVisitor& v, const FitResult& fit) {
  v("fit_from_s", fit.fit_from_s, "begin of the window");
  v("fit_to_s", fit.fit_to_s, "end of the window");
  v("contact_position_m", fit.contact_position_m, "where the punch touched");
  v.when(fit.stage_speed.has_value(), [&] {
    v("stage_speed", fit.stage_speed.value_or(1.0), "factor on the time of the stage");
    v("stage_speed_se", fit.stage_speed_se, "its standard error");
  });
  v.when(fit.dashpot_Pa_s.has_value(), [&] {
    v("dashpot_Pa_s", fit.dashpot_Pa_s.value_or(0.0), "dashpot beside the terms");
    v("dashpot_se_Pa_s", fit.dashpot_se_Pa_s, "its standard error");
  });
  v.when(fit.two_point.has_value(), [&] {
    const TwoPointModulus two = fit.two_point.value_or(TwoPointModulus{});
    v.object("two_point", "the modulus from two points on the ramp", [&] {
      v("modulus_Pa", two.modulus_Pa, "with the layer");
      v("se_Pa", two.se_Pa, "standard error");
      v("half_space_modulus_Pa", two.half_space_modulus_Pa, "of a half-space");
      v("bias", two.bias, "which way it is off");
    });
  });
}

void show_keys(ResultVisitor& v, const ProfileCurve& profile) {
  v("parameter", profile.parameter, "its name");
  v("value", profile.value, "values");
  v("rise", profile.rise, "rise of the sum of squares there");
  v("interval_95", profile.interval_95, "the interval, [low, high]");
}

void show_keys(ResultVisitor& v, const ContinuousSpectrum& spectrum) {
  v("from_s", spectrum.from_s, "shortest relaxation time of the spectrum");
  v("to_s", spectrum.to_s, "longest one");
  v("E0_interval_95", spectrum.E0_95,
    "what all spectra over these times allow for E0, [low, high]");
  v("E_inf_interval_95", spectrum.E_inf_95, "likewise for E_inf, [low, high]; 0 of a liquid");
  v.list("rows", "H(tau) = dE/d ln tau, shortest time first", spectrum.rows,
         [&](const SpectrumRow& row) {
           v("tau_s", row.tau_s, "relaxation time");
           v("H", row.H_Pa,
             "mean of the smoothest spectrum over half a decade, in the unit of the modulus");
           v("H_interval_95", row.H_95, "what all spectra allow for that mean, [low, high]");
         });
}

void show_keys(ResultVisitor& v, const FittedLaw& law) {
  v("name", law.name, "its name");
  v("n_parameters", law.n_parameters, "their number");
  v("rss", law.rss, "as above");
  v("bic", law.bic, "Bayes criterion");
  v("bic_difference", law.bic_difference, "to the series");
  v("at_bound", law.is_at_bound, "whether a parameter is at its bound");
  v.map("parameters", "by name, with the unit", law.parameters, [&](const LawParameter& one) {
    v.object(one.name, "one parameter", [&] {
      v("value", one.value, "its value");
      v("se", one.se, "standard error");
      v("interval_95", one.interval_95, "95 % interval, [low, high]");
    });
  });
  v.object("series", "its Prony series", [&] {
    v("n_terms", law.series.terms.size(), "number of terms");
    v("largest_error", law.series_error, "relative");
    v("t_min_s", law.t_min_s, "begin of the window");
    v("t_max_s", law.t_max_s, "end of the window");
  });
}

void show_keys(ResultVisitor& v, const FittedTest& test, const std::string& file) {
  const auto& [letter, stem, unit] = modulus_names(test.is_stiffness);
  const bool is_sweep = test.kind == FitKind::kDma;
  v("name", test.name, "its name");
  v.word("kind", kKinds[static_cast<std::size_t>(test.kind)], kKinds, "its kind");
  v.when(!file.empty(), [&] { v("file", file, "its file"); });
  v("n_samples", test.n_samples, "samples");
  v("unit", is_sweep ? "relative" : test.fitted_unit, "unit of rss and noise");
  v("rss", test.rss, "as above");
  v("noise", test.noise, "of the samples");
  v("from_s", test.from_s, "begin of the window");
  v("to_s", test.to_s, "end of the window");
  v.when(test.has_scale, [&] {
    v("scale", test.scale, "factor between this test and the material");
    v("scale_interval_95", test.scale_95, "its 95 % interval, [low, high]");
  });
  v.object("alone", "this test fitted alone", [&, &letter = letter, &unit = unit] {
    v("n_terms", test.own_terms, "number of terms");
    v(letter + "0" + unit, test.own_E0_Pa,
      "instantaneous modulus (E) or stiffness (K) of the test alone");
    v(letter + "0_interval_95", test.own_E0_95, "its 95 % interval, [low, high]");
    v(letter + "_inf" + unit, test.own_E_inf_Pa,
      "equilibrium modulus or stiffness of the test alone");
    v(letter + "_inf_interval_95", test.own_E_inf_95, "its 95 % interval, [low, high]");
    v("rss", test.own_rss, "as above");
  });
  v.object("difference", "between the answer and the test alone", [&] {
    v("relative", test.difference, "relative difference");
    v("interval_95", test.difference_95, "its 95 % interval, [low, high]");
    v("worst", test.worst, "largest in the window");
    v("p_value", test.p_value, "of the F test");
    v("degrees_of_freedom", test.freedom, "of the test");
    v("disagrees", test.disagrees, "whether the tests contradict each other");
  });
  v.object("residuals", "curves of the test", [&] {
    const FitCurves& curves = test.curves;
    v.when(!is_sweep, [&] { v("time_s", curves.time_s, "times"); });
    v.when(is_sweep, [&] { v("frequency_Hz", curves.time_s, "frequencies"); });
    v("measured", curves.measured, "measured");
    v("fitted", curves.fitted, "fitted");
    v("sigma", curves.sigma, "standard deviations");
    v.when(!curves.loss_measured.empty(), [&] {
      v("loss_measured", curves.loss_measured, "loss modulus");
      v("loss_fitted", curves.loss_fitted, "fitted");
      v("loss_sigma", curves.loss_sigma, "standard deviations");
    });
  });
}

void show_arrays(ResultVisitor& v, const FitResult& fit) {
  v("covariance", fit.covariance, "of the parameters, in their units");
  v("covariance_parameters", fit.covariance_parameters, "names of its rows, with the unit");
  v.object("curves", "averages of the data, and the fit", [&] {
    const FitCurves& curves = fit.curves;
    v("at", curves.time_s, "in s; of an oscillation in Hz");
    v("measured", curves.measured, "in `unit`");
    v("fitted", curves.fitted, "likewise");
    v("sigma", curves.sigma, "standard deviations");
    v("unit", curves.unit, "of the fitted column");
    v.when(!curves.loss_measured.empty(), [&] {
      v("loss_measured", curves.loss_measured, "loss modulus");
      v("loss_fitted", curves.loss_fitted, "the fit");
      v("loss_sigma", curves.loss_sigma, "standard deviations");
    });
  });
}

}  // namespace viscard
