#pragma once

#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/hyperelastic_law.h"

namespace viscard {

// What a solver makes of a law at a change of volume.
enum class VolumeRule {
  kUnitVolume,      // W at the stretches s_i J^(-1/3)
  kWholeOgden,      // SfePy 2021.4: Ogden's principal Kirchhoff stresses, times J^((alpha - 2)/3)
  kIncompressible,  // J = 1
  // CalculiX, FrontISTR and OpenRadioss for Arruda and Boyce: (1/D) ((J^2 - 1)/2 - ln J), D = 2/K, instead of
  // (1/D) (J - 1)^2. Run by the tests in CalculiX 2.20.
  kLogarithmic,
  kLogSquared,  // FEBio (pressure_model 0, its default): K/2 (ln J)^2. Source: FEUncoupledMaterial.h of FEBio 4
};

// Nominal stress of a cube along its measured stretch, Pa, with the energy W + (K/2) (J - 1)^2 per volume at
// rest: closed but for the stretch of the free sides, whose stress is zero. The principal Kirchhoff stresses
// are tau_i = dev(dW/d ln s_i) + K J (J - 1), and the nominal stress is tau_1/s_1. Source: Holzapfel, Nonlinear
// Solid Mechanics (2000), 6.4. nan where no sides are free of stress (beyond the law's limit).
double cube_stress_Pa(const HyperelasticLaw& law, double bulk_Pa, Deformation deformation,
                      double stretch, VolumeRule rule);
// The same of a cube whose sides are held, so that its volume changes with the stretch.
double confined_stress_Pa(const HyperelasticLaw& law, double bulk_Pa, double stretch,
                          VolumeRule rule);

// Uniaxial nominal stresses of a cube with terms (Simo's rule of finite_viscoelasticity.h, exact for a second
// Piola-Kirchhoff stress that is linear in each step) behind the first time of the history, at finite K. What the
// branches keep is pushed forward as it is, as in FEUncoupledViscoElasticMaterial.cpp and in viscard's MFront
// behaviours; projected, its part along the present pressure is left out, which the pressure of free sides replaces up
// to the order of G/K.
std::vector<double> relaxing_stress_Pa(const HyperelasticLaw& law,
                                       const std::vector<RubberTerm>& terms, double bulk_Pa,
                                       const Course& history, VolumeRule rule, bool is_projected);

}  // namespace viscard
