#pragma once

#include "io/cards/unit_system.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A law in the units of its card: moduli and K (0: incompressible) in its unit of stress, shapes
// without unit, the density (0: not known) in its own.
struct RubberNumbers {
  HyperelasticForm form = HyperelasticForm::kNeoHooke;
  std::vector<double> moduli, shapes;
  double bulk = 0.0;
  double shear = 0.0;  // modulus at rest, in the unit of stress
  double density = 0.0;
  const UnitSystem* units = nullptr;
  // A share of the law at once that relaxes, and its time in the unit of the card.
  struct Term {
    double g = 0.0, time = 0.0;
  };
  std::vector<Term> terms;
  // Softening by the first loading (mullins_damage.h); m in the unit of stress.
  struct Damage {
    double r = 0.0, m = 0.0, beta = 0.0;
  };
  std::optional<Damage> damage = std::nullopt;
  // A foam (foam_law.h), which stands in the place of form, moduli and shapes; mu in the unit of stress.
  struct FoamTerm {
    double mu = 0.0, alpha = 0.0, nu = 0.0;
    double beta() const { return nu / (1.0 - 2.0 * nu); }
  };
  std::vector<FoamTerm> foam = {};

  // Share that is left after all relaxation.
  double long_term_share() const {
    double share = 1.0;
    for (const Term& term : terms) share -= term.g;
    return share;
  }
  double d() const { return bulk > 0.0 ? 2.0 / bulk : 0.0; }
};

bool is_ogden(HyperelasticForm form);
// mu_1, alpha_1, mu_2, alpha_2 ...
std::vector<double> pairs_of(const RubberNumbers& law);
// Ogden, and the laws that equal one of Ogden: Neo-Hooke and Mooney-Rivlin.
bool has_ogden_form(HyperelasticForm form);
// Moduli mu_i and exponents alpha_i of the Ogden energy that equals the law.
RubberNumbers as_ogden(const RubberNumbers& law);
double poisson_ratio_of(const RubberNumbers& law);
// The block /UNIT of OpenRadioss.
std::string radioss_unit_block(const RubberNumbers& law);
// Cards of solvers that take nothing else than rows of numbers. Conventions and sources stand in
// rubber_rows.cpp. They throw std::invalid_argument for laws that the solver has not, for a density that
// it needs, and for numbers that it would misread.
std::string keyword_rubber(const RubberNumbers& law, bool is_calculix, const std::string& material);
std::string ansys_rubber(const RubberNumbers& law);
std::string febio_rubber(const RubberNumbers& law, const std::string& material);
std::string frontistr_rubber(const RubberNumbers& law, const std::string& material);
std::string lsdyna_rubber(const RubberNumbers& at_once, const std::string& material);
std::string openradioss_rubber(const RubberNumbers& law, const std::string& material);

// Cards of foams. Conventions and sources stand in foam_cards.cpp.
std::string keyword_foam(const RubberNumbers& foam, bool is_calculix, const std::string& material);
std::string lsdyna_foam(const RubberNumbers& foam, const std::string& material);
std::string openradioss_foam(const RubberNumbers& foam, const std::string& material);

// Cards that are a part of a model's text: a Python module, blocks of an input file, parameters.
// Conventions and sources stand in rubber_models.cpp and rubber_mfront.cpp. They throw std::invalid_argument
// for laws that the
// solver has not, or for which no public text gives its convention.
std::string sfepy_rubber(const RubberNumbers& law);
std::string moose_rubber(const RubberNumbers& law, const std::string& material);
std::string mfront_rubber(const RubberNumbers& law, const std::string& material);
std::string comsol_rubber(const RubberNumbers& law, const std::string& material);

}  // namespace viscard
