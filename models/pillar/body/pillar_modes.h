#pragma once

#include "models/pillar/body/pillar_model.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// An undamped mode of free vibration.
struct PillarMode {
  double frequency_Hz = 0.0;
  Eigen::VectorXd shape;  // unknowns of the model, unit mass norm
};

// The stiffness of a free body is singular; adding this multiple of the mass makes it regular. The
// shift is far below the square of the first elastic frequency, which is of the order of the
// slowest medium's wave across the largest extent. It is also far above rounding, which is
// determined by the fastest medium.
double free_shift_1_s2(const PillarModel& model);

// The lowest undamped modes of one family of motion, ascending. For a body with a free bottom the
// modes are its elastic ones, orthogonal to the rigid motions. Each mode of a harmonic m >= 1
// represents two. Throws std::runtime_error if the iteration does not converge.
std::vector<PillarMode> lowest_modes(const PillarModel& model, int count);
// The same with another stiffness of the model: relaxed, or with that of a stress; `product` gives its
// products with more digits than its entries have, or is empty.
std::vector<PillarMode> lowest_modes(const PillarModel& model, const SymmetricSparse& stiffness,
                                     int count, StiffnessFactor::Product product = {});

// The product of a model's stiffness, and of that of a stress (or null), from strains. Empty where the
// entries of the matrix serve as well. Both must outlive it.
StiffnessFactor::Product product_of(const PillarModel& model,
                                    const SymmetricSparse* stress = nullptr);

// Pressure on the top at which the straight pillar buckles sideways (linear buckling with the full
// stress field of the loaded pillar, dead load):
//   (K + p K_sigma) v = 0, K_sigma = int sigma_ij (d_i u_k)(d_j u_k) dV   (eq. 21)
// Source: Washizu, Variational Methods in Elasticity and Plasticity (1982), ch. 5.
// The axial model provides the stresses; the lateral one must have the same mesh. Modes localised
// at the singular rim of the bond are skipped: the pillar's own mode is the lowest one that has
// more than half of its compliance under a side force. Throws std::runtime_error if there is no
// such mode near the Rayleigh quotient of the pillar bent by a side force.
// The search leaves out the stress next to the rim (StressStiffness), which counts to first order in
// pressure_Pa; with count > 1 it is searched with the whole stress.
struct Buckling {
  double pressure_Pa = 0.0;          // at which the pillar as a whole buckles
  double rim_share = 0.0;            // of pressure_Pa, from the stress next to the rim
  std::vector<double> pressures_Pa;  // of the lowest modes, ascending, including local ones
  Eigen::VectorXd shape;             // of the pillar as a whole, of unit energy
};
Buckling buckling(const PillarModel& axial, const PillarModel& lateral, int count = 1);

// Stress stiffness K_sigma per Pa as below: `whole`, and without elements next to a rim, smaller in both
// directions than 0.012 of the pillar's radius. The stress there is singular. It makes modes of the rim
// itself buckle, at loads that fall with every layer of the mesh until they hide the pillar's own.
struct StressStiffness {
  SymmetricSparse whole, away_from_rims;
};
StressStiffness stress_stiffness_by_place(const PillarModel& axial, const PillarModel& model);

// Stress stiffness K_sigma (eq. 21) of a model in any family of motion of a cylinder, per Pa of
// pressure on the top of the axial one. Both must have the same mesh.
SymmetricSparse stress_stiffness_per_Pa(const PillarModel& axial, const PillarModel& model);

// A pressure beyond that at which the pillar buckles on its mesh.
class BeyondBuckling : public std::runtime_error {
 public:
  BeyondBuckling(const std::string& what, double critical_Pa)
      : std::runtime_error(what), critical_Pa_(critical_Pa) {}
  double critical_Pa() const { return critical_Pa_; }

 private:
  double critical_Pa_;
};

// Stress stiffness p K_sigma of a model under a pressure on the top of the axial one; without the stress next
// to the rim if modes of the rim buckle below the pressure. Throws BeyondBuckling if the model is lateral
// and the pillar would buckle.
SymmetricSparse stiffness_by_pressure(const PillarModel& axial, const PillarModel& model,
                                      double pressure_Pa);

// Lowest modes of any family of a cylinder under a pressure on the top. Throws BeyondBuckling if
// lateral modes are asked for.
std::vector<PillarMode> modes_under_pressure(const PillarModel& axial, const PillarModel& model,
                                             double pressure_Pa, int count);

}  // namespace viscard
