#include "models/maths/text_of_number.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/system/krylov_modes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

// Where the rim of the bond makes the stress singular, the values of modes localised there decrease
// without bound as meshes are refined. These modes belong to the idealised corner, not the pillar.
// Therefore this many modes above a shift are searched for the one that bends the whole pillar.
constexpr int kMostModes = 8;

// p of the shape's own quotient v'K v = -p v'K_sigma v; 0 if the stress stiffens this shape. The energy
// v'K v comes from strains: in the matrix a large bulk modulus times thin elements cancels, which at nu =
// 0.499999 leaves 0.1 % of rounding on 5 layers and 1 % on 6. At nu = 0.5 the matrix has no such modulus.
double quotient_Pa(const PillarModel& lateral, const SymmetricSparse& stress,
                   const Eigen::VectorXd& shape) {
  const double softened = -shape.dot(times(stress, shape));
  if (!(softened > 0.0)) return 0.0;
  const bool is_incompressible = std::isinf(lateral.medium(kPillarRegion).bulk_Pa);
  return shape.dot(is_incompressible ? times(lateral.stiffness(), shape)
                                     : lateral.stiffness_times(shape, shape)) /
         softened;
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
  constexpr double kCloseEnough = 1e-5;  // of the last step; the next error is its cube
  double pressure_Pa = quotient_Pa(pencil.lateral, pencil.stress, shape);
  for (int i = 0; i < kSteps && pressure_Pa > 0.0; ++i) {
    SymmetricSparse shifted = pencil.stiffness;
    shifted.coeffs() += pressure_Pa * pencil.stress.coeffs();
    pencil.lateral.factor(shifted, factor);
    shape = factor.solve(times(pencil.stiffness, shape));
    shape /= std::sqrt(shape.dot(times(pencil.stiffness, shape)));
    const double next_Pa = quotient_Pa(pencil.lateral, pencil.stress, shape);
    const bool is_close = std::abs(next_Pa - pressure_Pa) <= kCloseEnough * pressure_Pa;
    pressure_Pa = next_Pa;
    if (is_close) return pencil.is_of_the_pillar(shape) ? pressure_Pa : 0.0;
  }
  return 0.0;
}

// Leaves the pressure unset if no mode of the whole pillar is found. The modes below it are searched
// only in a small space: local modes at the rim lie so close together that hundreds of vectors would
// be needed, and the iteration from the bent pillar passes by them with a few factorisations.
Buckling search_buckling(const PillarModel& lateral, const SymmetricSparse& stress_per_Pa,
                         int count) {
  BucklingPencil pencil{lateral, lateral.stiffness(), stress_per_Pa, unit_top_force(lateral)};
  StiffnessFactor factor;
  lateral.factor(pencil.stiffness, factor);
  const Eigen::VectorXd bent = factor.solve(pencil.side);
  pencil.side_compliance = pencil.side.dot(bent);
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(pencil.stiffness, x); };
  const PencilMap op = [&](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return factor.solve(-times(pencil.stress, x));
  };
  // The error of the buckling factor is the square of the residual; a stiff volume leaves some
  // rounding noise in the residual.
  const EigenPairs pairs = largest_eigenpairs(op, B, lateral.system().size(), count,
                                              {.tolerance = 1e-6, .is_quick = count == 1});
  Buckling result = found_among(pairs, pencil, 0.0, [](double value) { return 1.0 / value; });
  if (result.pressure_Pa > 0.0) return result;
  result.shape = bent;
  result.pressure_Pa = iterated_buckling_Pa(pencil, result.shape, factor);
  if (result.pressure_Pa > 0.0) return result;
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

std::string why_none_is_found(const PillarGeometry& pillar) {
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
  throw std::runtime_error(why_none_is_found(lateral.geometry()));
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
