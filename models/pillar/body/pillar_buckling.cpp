#include "models/maths/text_of_number.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/system/krylov_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

// Where the rim of the bond makes the stress singular, the values of modes localised there decrease
// without bound as meshes are refined. These modes belong to the idealised corner, not the pillar.
// Therefore this many modes above a shift are searched for the one that bends the whole pillar.
constexpr int kMostModes = 8;

// v'K v of a shape, from strains: in the matrix a large bulk modulus times thin elements cancels, which at
// nu = 0.499999 leaves 0.1 % of rounding on 5 layers and 1 % on 6, and the energy of bending is small
// beside the entries.
double energy_of(const PillarModel& lateral, const Eigen::VectorXd& shape) {
  return shape.dot(lateral.stiffness_times(shape, shape));
}

// p of the shape's own quotient v'K v = -p v'K_sigma v; 0 if the stress stiffens this shape.
double quotient_Pa(const PillarModel& lateral, const SymmetricSparse& stress,
                   const Eigen::VectorXd& shape) {
  const double softened = -shape.dot(times(stress, shape));
  return softened > 0.0 ? energy_of(lateral, shape) / softened : 0.0;
}

// The pencil K + p K_sigma of a lateral model, and the criterion for a mode of the whole pillar.
struct BucklingPencil {
  const PillarModel& lateral;
  SymmetricSparse stiffness;
  const SymmetricSparse& stress;  // per Pa
  Eigen::VectorXd side;           // unit force sideways on the top
  double side_compliance = 0.0;

  // For vectors of unit energy, (f.v)^2 is the part of the side-force compliance due to the mode.
  bool is_of_the_pillar(const Eigen::VectorXd& mode) const {
    const double moved = side.dot(mode);
    return moved * moved > 0.5 * side_compliance;
  }
};

// Buckling pressures of the pairs above `least`, empty if not converged, and that of the first mode
// of the whole pillar.
template <typename Pressure>
Buckling found_among(const EigenPairs& pairs, const BucklingPencil& pencil, double least,
                     const Pressure& pressure_of) {
  Buckling result;
  for (Eigen::Index i = 0; pairs.converged && i < pairs.values.size(); ++i) {
    if (!(pairs.values[i] > least)) break;
    result.pressures_Pa.push_back(pressure_of(pairs.values[i]));
    if (result.pressure_Pa == 0.0 && pencil.is_of_the_pillar(pairs.vectors.col(i))) {
      result.pressure_Pa = result.pressures_Pa.back();
      result.shape = pairs.vectors.col(i);
    }
  }
  return result;
}

// Modes of largest theta in [K + shift K_sigma]^-1 K v = theta v, p = shift/(1 - 1/theta): the
// modes above the shift, ascending. Marks the pillar's own mode if it is among them.
Buckling buckling_above(const BucklingPencil& pencil, double shift_Pa, int count) {
  SymmetricSparse shifted = pencil.stiffness;
  shifted.coeffs() += shift_Pa * pencil.stress.coeffs();
  StiffnessFactor factor;
  pencil.lateral.factor(shifted, factor);
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(pencil.stiffness, x); };
  const PencilMap op = [&](const Eigen::VectorXd&, const Eigen::VectorXd& Kx) {
    return factor.solve(Kx);
  };
  const EigenPairs pairs =
      largest_eigenpairs(op, B, pencil.lateral.system().size(), count, {.tolerance = 1e-6});
  return found_among(pairs, pencil, 1.0,
                     [&](double theta) { return shift_Pa / (1.0 - 1.0 / theta); });
}

// Rayleigh quotient iteration from the bent pillar. It converges to the mode next to this shape,
// past local modes at the rim that lie below or around it; each step triples the number of digits.
// Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 4. Returns 0 if it has converged to
// another mode.
// Reuses the order of elimination of `factor`. `shape` begins as that of the bent pillar.
double iterated_buckling_Pa(const BucklingPencil& pencil, Eigen::VectorXd& shape,
                            StiffnessFactor& factor) {
  constexpr int kSteps = 8;
  constexpr double kCloseEnough = 1e-5;  // of the last step; the next error is far smaller
  // Exactly at the load the matrix is singular; the nearer, the more its rounding weighs in a slender body.
  const double short_of = pencil.lateral.loses_digits() ? 0.9 : 1.0 - 1e-4;
  double pressure_Pa = quotient_Pa(pencil.lateral, pencil.stress, shape);
  for (int i = 0; i < kSteps && pressure_Pa > 0.0; ++i) {
    const SymmetricSparse softening = short_of * pressure_Pa * pencil.stress;
    SymmetricSparse shifted = pencil.stiffness;
    shifted.coeffs() += softening.coeffs();
    pencil.lateral.factor(shifted, factor);
    factor.refine_by(product_of(pencil.lateral, &softening));
    shape = factor.solve(pencil.lateral.stiffness_times(shape, shape));
    shape /= std::sqrt(energy_of(pencil.lateral, shape));
    const double next_Pa = quotient_Pa(pencil.lateral, pencil.stress, shape);
    const bool is_close = std::abs(next_Pa - pressure_Pa) <= kCloseEnough * pressure_Pa;
    pressure_Pa = next_Pa;
    if (is_close) return pencil.is_of_the_pillar(shape) ? pressure_Pa : 0.0;
  }
  return 0.0;
}

// Leaves the pressure unset if no mode of the whole pillar is found. The iteration from the bent pillar
// passes by local modes at the rim, which lie so close together that hundreds of vectors would be needed;
// without it the modes are searched, first in a small space.
Buckling search_buckling(const PillarModel& lateral, const SymmetricSparse& stress_per_Pa,
                         int count) {
  BucklingPencil pencil{lateral, lateral.stiffness(), stress_per_Pa, unit_top_force(lateral)};
  StiffnessFactor factor;
  const auto factor_unloaded = [&] {
    lateral.factor(pencil.stiffness, factor);
    factor.refine_by(product_of(lateral));
  };
  factor_unloaded();
  const Eigen::VectorXd bent = factor.solve(pencil.side);
  pencil.side_compliance = pencil.side.dot(bent);
  Buckling result{.shape = bent};
  // At nu = 0.5 the penalised matrix buckles below the body, and the iteration may go to and fro.
  const bool is_incompressible = std::isinf(lateral.medium(kPillarRegion).bulk_Pa);
  if (count == 1 && !is_incompressible) {
    result.pressure_Pa = iterated_buckling_Pa(pencil, result.shape, factor);
    if (result.pressure_Pa > 0.0) return result;
    factor_unloaded();
  }
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(pencil.stiffness, x); };
  const PencilMap op = [&](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return factor.solve(-times(pencil.stress, x));
  };
  // The error of the buckling factor is the square of the residual; a stiff volume leaves some
  // rounding noise in the residual.
  const EigenPairs pairs = largest_eigenpairs(op, B, lateral.system().size(), count,
                                              {.tolerance = 1e-6, .is_quick = count == 1});
  result = found_among(pairs, pencil, 0.0, [](double value) { return 1.0 / value; });
  if (result.pressure_Pa > 0.0) return result;
  if (count > 1 || is_incompressible) {
    result.shape = bent;
    result.pressure_Pa = iterated_buckling_Pa(pencil, result.shape, factor);
    if (result.pressure_Pa > 0.0) return result;
  }
  // The Rayleigh quotient of the pillar bent by a side force lies above its buckling pressure. A
  // search that starts a little below the quotient avoids local modes far below it.
  const double bent_Pa = quotient_Pa(lateral, stress_per_Pa, bent);
  for (const double share : {0.9, 0.8, 0.6, 0.4}) {
    if (!(bent_Pa > 0.0)) break;
    const Buckling above = buckling_above(pencil, share * bent_Pa, std::max(count, kMostModes));
    result.pressure_Pa = above.pressure_Pa;
    result.shape = above.shape;
    if (result.pressure_Pa > 0.0) return result;
  }
  return result;
}

// No mode buckles below the pressure if K + p K_sigma is positive definite (Sylvester). At nu = 0.5 the
// penalised matrix is softer than the body.
bool is_stable_under(double pressure_Pa, const PillarModel& lateral,
                     const SymmetricSparse& stress_per_Pa) {
  SymmetricSparse stiffness = lateral.stiffness();
  stiffness.coeffs() += pressure_Pa * stress_per_Pa.coeffs();
  StiffnessFactor factor;
  lateral.factor(stiffness, factor);
  return factor.negative_pivots() == 0;
}

// The pillar's own load with the whole stress, in the shape that is found without that of the rim.
Buckling own_buckling(const PillarModel& lateral, const StressStiffness& stress, int count) {
  Buckling found =
      search_buckling(lateral, count == 1 ? stress.away_from_rims : stress.whole, count);
  if (!(found.pressure_Pa > 0.0)) return found;
  const double searched_Pa = quotient_Pa(lateral, stress.away_from_rims, found.shape);
  found.pressure_Pa = quotient_Pa(lateral, stress.whole, found.shape);
  found.rim_share = searched_Pa / found.pressure_Pa - 1.0;
  return found;
}

// The stress stiffness per Pa with which a lateral model vibrates. Where modes of the rim buckle below the
// pressure it is that without the rim, scaled to the pillar's own load: f^2 goes as 1 - p/p_cr.
SymmetricSparse stress_below_buckling(const PillarModel& lateral, const StressStiffness& stress,
                                      double pressure_Pa) {
  if (is_stable_under(pressure_Pa, lateral, stress.whole)) return stress.whole;
  const Buckling found = own_buckling(lateral, stress, 1);
  if (!(found.pressure_Pa > 0.0)) return stress.whole;
  if (pressure_Pa < found.pressure_Pa) return (1.0 + found.rim_share) * stress.away_from_rims;
  throw BeyondBuckling("a pressure of " + text_of(pressure_Pa, 5) +
                           " Pa on the top is beyond the buckling pressure of " +
                           text_of(found.pressure_Pa, 5) +
                           " Pa; reduce it, because vibrations need a stable straight pillar",
                       found.pressure_Pa);
}

// Where the pillar would buckle on a rigid base, over the modulus of its film (Euler).
double strain_of_film(const PillarModel& lateral) {
  if (!lateral.geometry().film) return 0.0;
  const Medium& pillar = lateral.medium(kPillarRegion);
  const double slenderness = lateral.geometry().length_m / lateral.geometry().diameter_m;
  const double euler_Pa = std::pow(std::numbers::pi / (8.0 * slenderness), 2) * 2.0 *
                          (1.0 + pillar.poisson_ratio) * pillar.shear_Pa *
                          (lateral.options().rigid_top ? 4.0 : 1.0);
  return euler_Pa / lateral.mean_modulus_Pa(kFilmRegion);
}

std::string why_none_is_found(const PillarModel& lateral) {
  const PillarGeometry& pillar = lateral.geometry();
  constexpr double kGivesWay = 0.03;
  const double film_strain = strain_of_film(lateral);
  if (film_strain > kGivesWay) {
    return "the film gives way before the pillar buckles: a load at which the pillar would buckle "
           "on a "
           "rigid base compresses the film by about " +
           text_of(100.0 * film_strain, 2) +
           " %, and the stress at the rim of the bond makes the film itself unstable. Linear "
           "buckling does not describe that; take a stiffer film or a more slender pillar";
  }
  constexpr double kStubby = 1.0;  // length over diameter
  const double slenderness = pillar.length_m / pillar.diameter_m;
  const bool has_wide_tip = pillar.tip.width_m > 0.0;
  const std::string found = std::string("no buckling load of the whole pillar was found beside ") +
                            "local modes at the rim of the bond" +
                            (has_wide_tip ? " and in the rim of the tip. " : ". ");
  if (slenderness < kStubby) {
    return found + "A stubby pillar does not buckle sideways: its length is " +
           text_of(slenderness, 3) + " diameters";
  }
  return found + "Finer meshes show more of them: ask for a larger tolerance" +
         (has_wide_tip ? " or a thicker rim of the tip" : "");
}

}  // namespace

Buckling buckling(const PillarModel& axial, const PillarModel& lateral, int count) {
  Buckling found = own_buckling(lateral, stress_stiffness_by_place(axial, lateral), count);
  if (found.pressure_Pa > 0.0) return found;
  throw std::runtime_error(why_none_is_found(lateral));
}

SymmetricSparse stiffness_by_pressure(const PillarModel& axial, const PillarModel& model,
                                      double pressure_Pa) {
  const StressStiffness places = stress_stiffness_by_place(axial, model);
  const bool is_lateral = model.options().motion == Motion::kLateral;
  SymmetricSparse stress = is_lateral ? stress_below_buckling(model, places, pressure_Pa)
                           : is_stable_under(pressure_Pa, model, places.whole)
                               ? places.whole
                               : places.away_from_rims;
  stress.coeffs() *= pressure_Pa;
  return stress;
}

}  // namespace viscard
