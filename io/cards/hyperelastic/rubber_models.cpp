// Conventions, beside the energies of models/hyperelastic/hyperelastic_law.h:
//   sfepy    sum of its terms: dw_tl_he_neohook with mu = 2 C10, dw_tl_he_mooney_rivlin with kappa = 2 C01,
//            dw_tl_he_genyeoh with (C_p0, p) for each power p, dw_tl_he_ogden with Ogden's own
//            (2 mu_i/alpha_i, alpha_i), dw_tl_bulk_penalty with K. It has no term of Arruda and Boyce or of
//            Gent. Source: sfepy/terms/terms_hyperelastic_tl.py of SfePy 2021.4; run there by the tests.
//   moose    ComputeNeoHookeanStress alone: lambda = K - 2 mu/3 and mu = 2 C10 of the second
//            Piola-Kirchhoff stress (lambda ln J - mu) C^-1 + mu I, whose energy is mu/2 (I1 - 3) - mu ln J +
//            lambda/2 (ln J)^2. Source: ComputeNeoHookeanStress.C of idaholab/moose; not run.
//   comsol   the Lame parameter mu = 2 C10, or C10 and C01, with the bulk modulus kappa of "nearly
//            incompressible". Source: Structural Mechanics Module User's Guide 5.5 and 6.0, Hyperelastic
//            Material; not run. The page names the numbers of the other laws without their energies, so
//            they are refused.
#include "io/cards/hyperelastic/rubber_rows.h"
#include "io/cards/hyperelastic/rubber_terms.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

using LawForm = HyperelasticForm;

// A term of SfePy, and the number or numbers that it takes.
struct SfepyTerm {
  const char* term;
  std::string name;   // of its parameter
  std::string value;  // in Python
};

std::vector<SfepyTerm> sfepy_terms(const RubberNumbers& law) {
  const auto pair = [](double factor, double exponent) {
    return fmt::format("[[{}, {}]]", number_of_20(factor), number_of_20(exponent));
  };
  std::vector<SfepyTerm> out;
  if (is_ogden(law.form)) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      const double own = 2.0 * law.moduli[i] / law.shapes[i];
      out.push_back({"dw_tl_he_ogden", fmt::format("ogden{}", i + 1), pair(own, law.shapes[i])});
    }
  } else if (law.form == LawForm::kYeoh) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      out.push_back({"dw_tl_he_genyeoh", fmt::format("yeoh{}", i + 1),
                     pair(law.moduli[i], static_cast<double>(i + 1))});
    }
  } else {
    out.push_back({"dw_tl_he_neohook", "mu", number_of_20(2.0 * law.moduli[0])});
    if (law.moduli.size() > 1) {
      out.push_back({"dw_tl_he_mooney_rivlin", "kappa", number_of_20(2.0 * law.moduli[1])});
    }
  }
  out.push_back({"dw_tl_bulk_penalty", "K", number_of_20(law.bulk)});
  return out;
}

}  // namespace

std::string sfepy_rubber(const RubberNumbers& law) {
  std::string values, terms;
  for (const SfepyTerm& term : sfepy_terms(law)) {
    values += fmt::format("    \"{}\": {},\n", term.name, term.value);
    terms += fmt::format("    (\"{}\", \"{}\"),\n", term.term, term.name);
  }
  std::string text = law.terms.empty() ? "" : "import numpy as np\n\n";
  text += "VALUES = {\n" + values + "}\nTERMS = (\n" + terms + ")\n";
  if (law.density > 0.0) text += "DENSITY = " + number_of_20(law.density) + "\n";
  if (is_ogden(law.form)) {
    text +=
        "# SfePy 2021.4 takes the exponents of whole stretches instead of isochoric ones: its "
        "stress is "
        "off\n# by about (J - 1) (2 - alpha)/3, so K must be large beside the shear modulus.\n";
  }
  return text +
         "\n\ndef material():\n"
         "    \"\"\"Values of a Material, or of an entry of `materials` in a problem file.\"\"\"\n"
         "    return dict(VALUES)\n"
         "\n\ndef terms(name=\"rubber\", virtual=\"v\", state=\"u\"):\n"
         "    \"\"\"Expressions for Term.new(); name is that of the Material.\"\"\"\n"
         "    return [f\"{term}({name}.{value}, {virtual}, {state})\" for term, value in TERMS]\n"
         "\n\ndef equation(name=\"rubber\", integral=\"i\", region=\"Omega\", virtual=\"v\", "
         "state=\"u\"):\n"
         "    \"\"\"Virtual work of the stress, for `equations` of a problem file.\"\"\"\n"
         "    return \" + \".join(\n"
         "        f\"{term}.{integral}.{region}({name}.{value}, {virtual}, {state})\" for term, "
         "value "
         "in TERMS\n"
         "    )\n" +
         sfepy_memory(law);
}

std::string moose_rubber(const RubberNumbers& law, const std::string& material) {
  const double mu = 2.0 * law.moduli[0];
  std::string text = fmt::format(
      "[Materials]\n  [{}]\n    type = ComputeNeoHookeanStress\n    lambda = {}\n    mu = {}\n"
      "    large_kinematics = true\n  []\n"
      "  [strain]\n    type = ComputeLagrangianStrain\n"
      "    displacements = 'disp_x disp_y disp_z'\n    large_kinematics = true\n  []\n",
      material, number_of_20(law.bulk - 2.0 * mu / 3.0), number_of_20(mu));
  if (law.density > 0.0) {
    text += fmt::format(
        "  [density]\n    type = GenericConstantMaterial\n    prop_names = 'density'\n"
        "    prop_values = '{}'\n  []\n",
        number_of_20(law.density));
  }
  return text + "[]\n";
}

std::string comsol_rubber(const RubberNumbers& law, const std::string& material) {
  const std::string stress = comsol_unit(law.units->stress);
  const auto row = [&](const char* suffix, double value, const std::string& unit,
                       const char* words) {
    return fmt::format("{}_{} {}[{}] \"{}\"\n", material, suffix, value, unit, words);
  };
  std::string text;
  if (law.form == LawForm::kNeoHooke) {
    text = row("mu", 2.0 * law.moduli[0], stress, "Neo-Hookean, Lame parameter mu");
  } else {
    text = row("C10", law.moduli[0], stress, "Mooney-Rivlin, two parameters, C10") +
           row("C01", law.moduli[1], stress, "Mooney-Rivlin, two parameters, C01");
  }
  text += row("kappa", law.bulk, stress, "bulk modulus, nearly incompressible material");
  if (law.density > 0.0)
    text += row("rho", law.density, comsol_unit(law.units->density), "density");
  return text;
}

}  // namespace viscard
