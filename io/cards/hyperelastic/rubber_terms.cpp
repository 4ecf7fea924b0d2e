// Terms of relaxation beside a law of rubber. viscard's are those of Simo (1987), formula (2) of
// models/hyperelastic/finite_viscoelasticity.h: shares g_i of the deviator of the law at once, times tau_i,
// a constant bulk modulus. Conventions:
//   abaqus       *HYPERELASTIC, MODULI=INSTANTANEOUS; rows g_i, k_i = 0, tau_i of *VISCOELASTIC, TIME=PRONY.
//                The hereditary integral in the reference configuration, pushed forward "(see Simo, 1987)".
//                Source: Theory Guide 4.8.2; Keywords Reference.
//   ansys        TB,HYPER is the law at once; pairs g_i, tau_i of TB,PRONY,,,,SHEAR; without a BULK table
//                the bulk modulus is constant. Source: Command Reference. No public text with its rule at
//                large strain was found.
//   febio        g0 = 1 - sum g beside the law at once (g0 is 1 if it is not given), g_i, t_i = tau_i. The
//                recursion of H_i on the second Piola-Kirchhoff stress is Simo's. Source:
//                FEUncoupledViscoElasticMaterial.cpp.
//   openradioss  LAW62: mu_i, alpha_i of the law at once with 2 mu/alpha^2, gamma_i = g_i, tau_i, Poisson's
//                ratio. Simo's, with H_i <- exp(-x) H_i + exp(-x/2) (S_new - S_old). Source: sigeps62.F,
//                hm_read_mat62.F, matl62_visc_hyp.cfg. /VISC/PRONY, beside LAW82, 92 and others, adds a stress
//                that is linear in the rate of the strain (visc_prony.F), and is not used.
//   lsdyna       077: the law after all relaxation, rows G_i = g_i G_0, BETA_i = 1/tau_i. Fields as in PyDYNA.
//                The shear moduli act on the strain, not on the law's own stress, so the terms are right
//                at small strain only. No public text with the strain that they act on was found.
//   mfront       the behaviour has state variables for the stress at once and for H_i; rubber_mfront.cpp.
//   sfepy        no term of SfePy has a memory; the module integrates Simo's rule in numpy.
#include "io/cards/hyperelastic/rubber_terms.h"

#include "io/cards/column_fields.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

constexpr int kColumn = 20;

// Five to a line.
std::string cells_of_five(const std::vector<double>& numbers) {
  constexpr std::size_t kFive = 5;
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += real(numbers[i], kColumn);
    if (i % kFive == kFive - 1 || i + 1 == numbers.size()) text += "\n";
  }
  return text;
}

constexpr const char* kSfepyMemory = R"py(

def elastic_stress(F):
    """Deviatoric second Piola-Kirchhoff stress of the law at once; F has the shape (points, 3, 3)."""
    squares, axes = np.linalg.eigh(np.swapaxes(F, 1, 2) @ F)
    s = np.sqrt(squares) / np.linalg.det(F)[:, None] ** (1.0 / 3.0)
    x = np.sum(s**2, axis=1, keepdims=True) - 3.0
    kirchhoff = np.zeros_like(s)
    for _, name in TERMS:
        value = VALUES[name]
        if name == "mu":
            kirchhoff += value * s**2
        elif name == "kappa":
            kirchhoff -= value * s**-2
        elif name.startswith("ogden"):
            kirchhoff += value[0][0] * s ** value[0][1]
        elif name.startswith("yeoh"):
            factor, power = value[0]
            kirchhoff += 2.0 * factor * power * x ** (power - 1) * s**2
    kirchhoff -= kirchhoff.mean(axis=1, keepdims=True)
    return np.einsum("pia,pa,pja->pij", axes, kirchhoff / squares, axes)


class Memory:
    """The law with its terms at all points (Simo 1987). After each step: advance(dt, stress) with
    elastic_stress(F), or SfePy's own stress. stress() is the deviatoric second Piola-Kirchhoff stress; the
    pressure is that of the body. Exact for a stress that is linear in each step; dt = 0 is a jump."""

    def __init__(self, points):
        self.elastic = np.zeros((points, 3, 3))
        self.branches = np.zeros((len(TAU), points, 3, 3))

    def advance(self, dt, elastic):
        x = dt / np.array(TAU)
        mean = -np.expm1(-x) / x if dt > 0.0 else np.ones_like(x)
        for i, branch in enumerate(self.branches):
            self.branches[i] = np.exp(-x[i]) * branch + mean[i] * (elastic - self.elastic)
        self.elastic = np.array(elastic)

    def stress(self):
        return (1.0 - sum(G)) * self.elastic + np.tensordot(G, self.branches, 1)
)py";

}  // namespace

std::string abaqus_terms(const RubberNumbers& law) {
  if (law.terms.empty()) return "";
  std::string text = "*VISCOELASTIC, TIME=PRONY\n";
  for (const RubberNumbers::Term& term : law.terms) {
    text += number_of_20(term.g) + ", 0, " + number_of_20(term.time) + "\n";
  }
  return text;
}

std::string ansys_terms(const RubberNumbers& law) {
  if (law.terms.empty()) return "";
  std::string text = fmt::format("TB,PRONY,1,1,{},SHEAR\n", law.terms.size());
  for (std::size_t i = 0; i < law.terms.size(); ++i) {
    text += fmt::format("TBDATA,{},{},{}\n", 2 * i + 1, number_of_20(law.terms[i].g),
                        number_of_20(law.terms[i].time));
  }
  return text;
}

std::string febio_terms(const RubberNumbers& law) {
  std::string text = fmt::format("  <g0>{}</g0>\n", number_of_20(law.long_term_share()));
  for (std::size_t i = 0; i < law.terms.size(); ++i) {
    text += fmt::format("  <g{0}>{1}</g{0}><t{0}>{2}</t{0}>\n", i + 1, number_of_20(law.terms[i].g),
                        number_of_20(law.terms[i].time));
  }
  return text;
}

std::string openradioss_with_terms(const RubberNumbers& law, const std::string& material) {
  if (!has_ogden_form(law.form)) {
    throw std::invalid_argument(
        "openradioss takes terms of relaxation in LAW62, which has no " + name_of(law.form) +
        " law; fit neo-hooke, mooney-rivlin or ogden with viscard fit --model, or write the law "
        "without them by --elastic-only long-term");
  }
  const RubberNumbers ogden = as_ogden(law);
  std::vector<double> shares, times;
  for (const RubberNumbers::Term& term : law.terms) {
    shares.push_back(term.g);
    times.push_back(term.time);
  }
  constexpr int kWhole = 10;
  return radioss_unit_block(law) + "/MAT/LAW62/1/1\n" + material + "\n#              RHO_I\n" +
         real(law.density, kColumn) +
         "\n#                 nu         N         M              mu_max\n" +
         real(poisson_ratio_of(law), kColumn) + right(std::to_string(ogden.moduli.size()), kWhole) +
         right(std::to_string(law.terms.size()), kWhole) + real(0.0, kColumn) + "\n# mu\n" +
         cells_of_five(ogden.moduli) + "# alpha\n" + cells_of_five(ogden.shapes) + "# gamma\n" +
         cells_of_five(shares) + "# tau\n" + cells_of_five(times);
}

std::string sfepy_memory(const RubberNumbers& law) {
  if (law.terms.empty()) return "";
  std::string shares, times;
  for (const RubberNumbers::Term& term : law.terms) {
    const char* comma = shares.empty() ? "" : ", ";
    shares += comma + number_of_20(term.g);
    times += comma + number_of_20(term.time);
  }
  return "\n\nG = [" + shares + "]\nTAU = [" + times + "]\n" + kSfepyMemory;
}

}  // namespace viscard
