#include "fit/fit_master_curve.h"
#include "models/maths/result_visitor.h"

namespace viscard {
namespace {

void show_factors(ResultVisitor& v, const char* key, const char* what, const MasterCurve& curve,
                  const std::vector<ShiftFactor>& factors) {
  v.list(key, what, factors, [&](const ShiftFactor& factor) {
    v("temperature_C", factor.temperature_C, "of the isotherm");
    v("ln_a", factor.ln_a, "logarithm of the factor on time");
    v("ln_a_se", factor.ln_a_se, "its standard error");
    v.when(curve.has_vertical_shift, [&] {
      v("ln_b", factor.ln_b, "logarithm of the factor on the moduli");
      v("ln_b_se", factor.ln_b_se, "its standard error");
    });
  });
}

void show_fit_of_law(ResultVisitor& v, double chi2, double bic) {
  v("chi2", chi2, "of the factors about the law");
  v("bic", bic, "Bayes criterion");
}

void show_laws(ResultVisitor& v, const ShiftLaws& laws) {
  v.when(laws.wlf.has_value(), [&] {
    const TemperatureShift wlf = laws.wlf.value_or(TemperatureShift{});
    v.object("wlf", "WLF law", [&] {
      v("C1", wlf.C1, "a pure number");
      v("C2_K", wlf.C2_K, "second constant");
      v.object("interval_95", "95 % intervals", [&] {
        v("C1", wlf.C1_95, "of C1, [low, high]");
        v("C2_K", wlf.C2_K_95, "of C2_K, [low, high]");
      });
      show_fit_of_law(v, laws.wlf_chi2, laws.wlf_bic);
    });
  });
  v.when(laws.arrhenius.has_value(), [&] {
    const TemperatureShift arrhenius = laws.arrhenius.value_or(TemperatureShift{});
    v.object("arrhenius", "Arrhenius law", [&] {
      v("activation_J_mol", arrhenius.activation_J_mol, "activation energy");
      v.object("interval_95", "95 % intervals", [&] {
        v("activation_J_mol", arrhenius.activation_J_mol_95, "of the energy, [low, high]");
      });
      show_fit_of_law(v, laws.arrhenius_chi2, laws.arrhenius_bic);
    });
  });
  v.when(laws.better() != nullptr, [&] {
    v.word("better", laws.wlf_is_better ? "wlf" : "arrhenius", {"wlf", "arrhenius"},
           "which law describes the factors better");
  });
}

}  // namespace

void show_keys(ResultVisitor& v, const MasterCurve& curve) {
  v("T_ref_C", curve.T_ref_C, "reference temperature");
  show_factors(v, "factors", "as taken, one for each temperature", curve, curve.factors);
  v.word("form", curve.form.empty() ? "free" : curve.form, {"arrhenius", "wlf", "smooth", "free"},
         "what the factors taken follow");
  v("residual_relative", curve.residual, "root mean square of the residuals with these factors");
  show_factors(v, "free_factors", "one free value for each temperature", curve, curve.free_factors);
  v("free_residual_relative", curve.free_residual, "the same with free factors");
  v.when(!curve.start_given.empty(), [&] {
    v.list("start_shifts", "start values that were given", curve.start_given,
           [&](const StartShift& one) {
             v("temperature_C", one.temperature_C, "of the isotherm");
             v("log10_a", one.log10_a, "decimal logarithm of the factor on time");
           });
    v.word("started_from", curve.is_start_as_given ? "given" : "rows", {"given", "rows"},
           "given: these; rows: the rows led elsewhere, with a clearly smaller scatter");
  });
  v("left_out", curve.left_out, "isotherms that are not part of it, and why");
  show_laws(v, curve.laws);
}

}  // namespace viscard
