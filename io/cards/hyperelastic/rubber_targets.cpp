#include "io/cards/hyperelastic/rubber_targets.h"

#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_terms.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// Abaqus and ANSYS: their manuals; CalculiX: rubber.f, run by the tests;
// FrontISTR: Hyperelastic.f90.
constexpr const char* kArrudaVolume = "; of Arruda-Boyce ((J^2 - 1)/2 - ln J)";
const std::string kOwnMu = "Ogden's own 2 mu_i/alpha_i, alpha_i";

RubberLaws keyword_laws() {
  return {"NEO HOOKE: C10",
          "MOONEY-RIVLIN: C10, C01",
          "YEOH: C10, C20, C30",
          "OGDEN: mu_i, alpha_i of sum 2 mu_i/alpha_i^2 (...)",
          "ARRUDA-BOYCE: mu, s_m",
          "",
          "HYPERFOAM: mu_i, alpha_i, nu_i of sum 2 mu_i/alpha_i^2 (...)"};
}

std::vector<RubberTarget> table() {
  return {
      {.name = "abaqus",
       .comment = "**",
       .write = [](const RubberNumbers& law,
                   const std::string& material) { return keyword_rubber(law, false, material); },
       .read = [](const std::string& text) { return read_keyword_rubber(text, false); },
       .laws = keyword_laws(),
       .volume =
           std::string("(J - 1)^2/D_1") + kArrudaVolume + "/D_1; D_1 = 2/K, 0: incompressible",
       .may_be_incompressible = true,
       .takes_terms = true,
       .terms = "the law at once, g_i of its deviator, constant bulk modulus, "
                "tau_i; Simo's rule at "
                "large strain (Theory Guide 4.8.2), not run",
       .damage = {"*MULLINS EFFECT: r, m, beta", ""}},
      {.name = "ansys",
       .comment = "!",
       .write = [](const RubberNumbers& law, const std::string&) { return ansys_rubber(law); },
       .read = read_ansys_rubber,
       .laws = {"NEO: mu = 2 C10", "MOONEY: C10, C01", "YEOH: C10, C20, C30", "OGDEN: " + kOwnMu,
                "BOYCE: mu, s_m", "GENT: mu, J_m"},
       .volume = std::string("(J - 1)^2/d") + kArrudaVolume + "/d; d = 2/K, 0: incompressible",
       .may_be_incompressible = true,
       .takes_terms = true,
       .most_terms = 100,
       .terms = "the law at once, g_i of its deviator, constant bulk modulus, "
                "tau_i; NOT CHECKED: no "
                "public text with its rule at large strain was found",
       .damage = {"", "no public text states the order of the constants of its TB,CDM,,,3,PSE2"}},
      {.name = "calculix",
       .comment = "**",
       .write = [](const RubberNumbers& law,
                   const std::string& material) { return keyword_rubber(law, true, material); },
       .read = [](const std::string& text) { return read_keyword_rubber(text, true); },
       .laws = keyword_laws(),
       .volume = std::string("(J - 1)^2/D_1") + kArrudaVolume + "/D_1; D_1 = 2/K",
       .terms = "ccx has no Prony series beside *HYPERELASTIC and ignores one",
       .damage = {"", "ccx skips *MULLINS EFFECT with a warning and runs the law without it"},
       .evidence = "run by viscard's tests in CalculiX 2.20, laws without terms"},
      {.name = "comsol",
       .comment = "%",
       .write = comsol_rubber,
       .read = read_comsol_rubber,
       .laws = {"Lame parameter mu = 2 C10", "C10, C01", "", "", "", ""},
       .volume = "by kappa = K of a nearly incompressible material",
       .terms = "the parameters are those of the law alone",
       .damage = {"", "its node Mullins Effect has no beta, and its page states no formula"}},
      {.name = "febio",
       .comment = "<!--",
       .write = febio_rubber,
       .read = read_febio_rubber,
       .laws = {"Mooney-Rivlin: c1 = C10, c2 = 0", "Mooney-Rivlin: c1 = C10, c2 = C01",
                "uncoupled hyperelastic: W of I1", "Ogden: c_i = 2 mu_i, m_i = alpha_i",
                "uncoupled hyperelastic: W of I1", "Gent: G = mu, Jm = J_m"},
       .volume = "k/2 (ln J)^2, FEBio's pressure_model 0",
       .takes_terms = true,
       .most_terms = 6,
       .terms = "the law at once with g0 = 1 - sum g, g_i, t_i = tau_i, "
                "constant bulk modulus; "
                "Simo's rule at large strain, run in FEBio 4.11 with Ogden",
       .damage = {"", "its elastic damage softens the first loading, too, and is another law"},
       .evidence = "Ogden, Mooney-Rivlin and Gent run in FEBio 4.11; of "
                   "'uncoupled hyperelastic' "
                   "(Yeoh, Arruda-Boyce) FEBio's parser and derivatives of W "
                   "were run, the material "
                   "not"},
      {.name = "frontistr",
       .comment = "#",
       .write = frontistr_rubber,
       .read = read_frontistr_rubber,
       .laws = {"NEOHOOKE: C10", "MOONEY-RIVLIN: C10, C01", "", "", "ARRUDA-BOYCE: mu, s_m", ""},
       .volume = std::string("(J - 1)^2/D") + kArrudaVolume + "/D; D = 2/K",
       .terms = "the last of !HYPERELASTIC and !VISCOELASTIC decides on the "
                "material",
       .evidence = "run in FrontISTR 5.9"},
      {.name = "lsdyna",
       .comment = "$",
       .write = lsdyna_rubber,
       .read = read_lsdyna_rubber,
       .laws = {"077_H: C10", "077_H: C10, C01", "077_H: C10, C20, C30", "077_O: " + kOwnMu, "", "",
                "HILL_FOAM: C_i = 2 mu_i/alpha_i, B_i = alpha_i, N = nu/(1 - 2 nu)"},
       .volume = "by Poisson's ratio of K and the law's shear modulus at rest",
       .needs_density = true,
       .takes_terms = true,
       .is_for_small_strain = true,
       .most_terms = 12,
       .terms = "approximated: the law after all relaxation and shear moduli "
                "G_i = g_i G_0 with "
                "BETA_i = 1/tau_i, right at small strain; NOT CHECKED at large "
                "strain, where it is "
                "not the fitted law"},
      {.name = "mfront",
       .comment = "//",
       .write = mfront_rubber,
       .read = read_mfront_rubber,
       .laws = {"C10", "C10, C01", "C10, C20, C30", "mu, alpha", "mu, s_m", "mu, J_m"},
       .volume = "K/2 (J - 1)^2",
       .has_density = false,
       .takes_terms = true,
       .terms = "the law at once, g_i of its deviator, constant bulk modulus, "
                "tau_i; the behaviour "
                "integrates Simo's rule, exact for a stress that is linear in "
                "each step",
       .evidence = "run in MTest 5.2"},
      {.name = "moose",
       .comment = "#",
       .write = moose_rubber,
       .read = read_moose_rubber,
       .laws = {"mu = 2 C10, lambda = K - 2 mu/3 of W = mu/2 (I1 - 3) - mu ln "
                "J + ...",
                "", "", "", "", ""},
       .volume = "lambda/2 (ln J)^2",
       .terms = "ComputeNeoHookeanStress has no memory"},
      {.name = "openradioss",
       .comment = "#",
       .write =
           [](const RubberNumbers& law, const std::string& material) {
             return law.terms.empty() ? openradioss_rubber(law, material)
                                      : openradioss_with_terms(law, material);
           },
       .read = read_openradioss_rubber,
       .laws = {"as Ogden: mu = 2 C10, alpha = 2", "as Ogden: mu = 2 C10, 2 C01, alpha = 2, -2",
                "LAW94: C10, C20, C30", "LAW82 (with terms LAW62): mu_i, alpha_i",
                "LAW92: mu, lambda_m = s_m", "",
                "LAW62: mu_i, alpha_i, nu_i of sum 2 mu_i/alpha_i^2 (...)"},
       .volume = "by D_1 = 2/K (LAW62: by Poisson's ratio)",
       .needs_density = true,
       .takes_terms = true,
       .most_terms = 50,
       .terms = "LAW62: the law at once, gamma_i = g_i of its deviator, tau_i; "
                "Simo's rule at large "
                "strain (its source), not run",
       .damage = {"/FAIL/MULLINS_OR: R, beta, m",
                  "its /FAIL/MULLINS_OR acts on LAW92, 95 and 100 only, which have no such law",
                  {HyperelasticForm::kNeoHooke, HyperelasticForm::kMooneyRivlin,
                   HyperelasticForm::kYeoh, HyperelasticForm::kArrudaBoyce},
                  "LAW100 without networks: C10, C01 or C10, C20, C30; LAW92: mu, lambda_m = s_m"}},
      {.name = "sfepy",
       .comment = "#",
       .write = [](const RubberNumbers& law, const std::string&) { return sfepy_rubber(law); },
       .read = read_sfepy_rubber,
       .laws = {"dw_tl_he_neohook: mu = 2 C10",
                "dw_tl_he_neohook: mu = 2 C10, dw_tl_he_mooney_rivlin: kappa = "
                "2 C01",
                "dw_tl_he_genyeoh: (C_p0, p)", "dw_tl_he_ogden: " + kOwnMu, "", ""},
       .volume = "dw_tl_bulk_penalty: K/2 (J - 1)^2",
       .takes_terms = true,
       .terms = "the law at once, g_i of its deviator, tau_i; SfePy has no "
                "memory: class Memory "
                "integrates Simo's rule in numpy",
       .evidence = "run by viscard's tests in SfePy 2021.4"}};
}

}  // namespace

const std::string& RubberLaws::of(HyperelasticForm form) const {
  using enum HyperelasticForm;
  if (is_ogden(form)) return ogden;
  return form == kNeoHooke       ? neo_hooke
         : form == kMooneyRivlin ? mooney_rivlin
         : form == kYeoh         ? yeoh
         : form == kArrudaBoyce  ? arruda_boyce
                                 : gent;
}

bool RubberDamage::takes(HyperelasticForm form) const {
  return !convention.empty() &&
         (forms.empty() || std::find(forms.begin(), forms.end(), form) != forms.end());
}

const std::vector<RubberTarget>& rubber_targets() {
  static const std::vector<RubberTarget> kTable = table();
  return kTable;
}

const RubberTarget& rubber_target(const std::string& name) {
  const auto& all = rubber_targets();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const RubberTarget& one) { return one.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const RubberTarget& target : all) names.push_back(target.name);
  throw std::invalid_argument("there is no card of rubber for '" + name + "'; use " +
                              listed(names));
}

}  // namespace viscard
