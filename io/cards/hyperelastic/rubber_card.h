#pragma once

#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/mullins_damage.h"
#include "models/quantities/plausible.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Solvers that a law of rubber is written for: abaqus, ansys, calculix, comsol, febio, frontistr,
// lsdyna, mfront, moose, openradioss, sfepy.
const std::vector<std::string>& rubber_card_targets();

// The bulk modulus of a solver that needs one and was given none, and how the header states it.
inline constexpr double kUsualBulkRatio = 1000.0;  // of the shear modulus at rest
inline constexpr const char* kUsualBulkText = "bulk modulus 1000 times the shear modulus at rest";

// Solver, units and what the law does not state.
struct RubberCardOptions {
  std::string target;
  std::string units = "SI";
  std::string material_name = "RUBBER";
  // None: incompressible for abaqus and ansys (their D or d = 0), and a thousand times the initial
  // shear modulus for the others, which need a number.
  std::optional<double> bulk_Pa = {};
  std::optional<double> density_kg_m3 = {};  // needed by lsdyna and openradioss
  bool accepts_flags = false;                // write a law that is not to be trusted
  bool may_approximate = false;              // terms that the solver takes at small strain only
  std::string elastic_only = {};  // "", "instantaneous", "long-term": the law without its terms
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any bulk modulus
  // For the header: sum and name of the file of the law, date and command line; empty: left out.
  std::string file_sha256 = {}, file_name = {}, created_at = {}, command = {};
};

// The card of a law. Each solver's convention, with its source, stands in its file of io/cards/targets.
// Throws std::invalid_argument for a target without this law (gent in abaqus, for instance), a missing
// density, a bulk modulus or density that is not positive, and numbers that calculix or frontistr would
// replace silently.
std::string rubber_card(const HyperelasticLaw& law, const RubberCardOptions& options);
// The law at once with terms of relaxation (Simo 1987), or with damage by the first loading. Throws the same,
// and std::invalid_argument for terms or damage that the target cannot take.
std::string rubber_card(const HyperelasticLaw& law, const std::vector<RubberTerm>& terms,
                        const RubberCardOptions& options,
                        const std::optional<MullinsDamage>& damage = {});

// The card of a foam: its volume is a part of the law, so that it takes no bulk modulus. Throws
// std::invalid_argument for a target without foams, unequal nu for lsdyna, and a missing density.
std::string foam_card(const FoamLaw& law, const RubberCardOptions& options);

// The law without terms: at once, or after all relaxation ("long-term").
HyperelasticLaw law_without_terms(const HyperelasticLaw& law, const std::vector<RubberTerm>& terms,
                                  const std::string& when);

}  // namespace viscard
