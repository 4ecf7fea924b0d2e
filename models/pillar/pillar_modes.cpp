#include "models/pillar/pillar_modes.h"

#include "models/pillar/krylov_modes.h"
#include "models/pillar/pillar_loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// Stress stiffness of a lateral model per Pa of pressure on the top of the axial one.
SymmetricSparse stress_stiffness_per_Pa(const PillarModel& axial, const PillarModel& lateral) {
  const PillarState state = axial.solve(-axial.top_traction());
  const auto form = [&](const SectionElement& element, double x, double z) {
    const Eigen::VectorXd s = axial.stress_at(state, element, x, z);
    Eigen::Matrix3d stress;
    stress << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(9, 9);
    for (Eigen::Index k = 0; k < 3; ++k) D.block<3, 3>(3 * k, 3 * k) = stress;
    return D;
  };
  return lateral.system().varying_form(lateral.system().kinematics().gradient, form);
}

// Where the rim of the bond makes the stress singular, modes that live at the rim alone come down
// without bound as meshes are refined: they belong to the idealised corner, not to the pillar. So
// many modes are looked through for the one that bends the pillar as a whole.
constexpr int kMostModes = 8;

std::vector<PillarMode> modes_of(const PillarModel& model, const SymmetricSparse& stiffness,
                                 int count) {
  const SymmetricSparse mass = model.mass();
  // A free pillar's stiffness is singular; a shift far below its first elastic mode mends that.
  double shift = 0.0;
  if (!model.options().fixed_bottom) {
    const Medium& medium = model.medium(kPillarRegion);
    const double bar_rad_s =
        std::sqrt(medium.shear_Pa / medium.rho_kg_m3) / model.geometry().length_m;
    shift = 1e-4 * bar_rad_s * bar_rad_s;
  }
  SymmetricSparse shifted = stiffness;
  shifted.coeffs() += shift * mass.coeffs();
  StiffnessFactor factor;
  model.factor(shifted, factor);
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(mass, x); };
  const LinearMap op = [&](const Eigen::VectorXd& x) { return factor.solve(times(mass, x)); };
  // The frequencies' own error is the square of the residual: far below that of any mesh.
  const EigenPairs pairs = largest_eigenpairs(
      op, B, model.system().size(), count, {.tolerance = 1e-6, .largest_space = 60 + 10 * count});
  if (!pairs.converged) {
    throw std::runtime_error(
        "the lowest modes did not converge; ask for fewer, or for a finer mesh");
  }
  std::vector<PillarMode> modes;
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    const double square = 1.0 / pairs.values[i] - shift;
    modes.push_back(
        {std::sqrt(std::max(square, 0.0)) / (2.0 * std::numbers::pi), pairs.vectors.col(i)});
  }
  return modes;
}

}  // namespace

std::vector<PillarMode> lowest_modes(const PillarModel& model, int count) {
  return modes_of(model, model.stiffness(), count);
}

Buckling buckling(const PillarModel& axial, const PillarModel& lateral, int count) {
  const SymmetricSparse stress = stress_stiffness_per_Pa(axial, lateral);
  const SymmetricSparse stiffness = lateral.stiffness();
  StiffnessFactor factor;
  lateral.factor(stiffness, factor);
  const LinearMap B = [&](const Eigen::VectorXd& x) { return times(stiffness, x); };
  const LinearMap op = [&](const Eigen::VectorXd& x) { return factor.solve(-times(stress, x)); };
  const Eigen::VectorXd side = unit_top_force(lateral);
  const double side_compliance = side.dot(factor.solve(side));
  for (const int sought : {count, std::max(count, kMostModes)}) {
    // The factor's own error is the square of the residual; stiff volume leaves some noise in the
    // latter.
    const EigenPairs pairs =
        largest_eigenpairs(op, B, lateral.system().size(), sought, {.tolerance = 1e-6});
    if (!pairs.converged || !(pairs.values[0] > 0.0)) break;
    Buckling result;
    for (Eigen::Index i = 0; i < pairs.values.size() && pairs.values[i] > 0.0; ++i) {
      result.pressures_Pa.push_back(1.0 / pairs.values[i]);
      // Vectors of unit energy: (f.v)^2 is what the mode adds to the compliance under a side force.
      const double moved = side.dot(pairs.vectors.col(i));
      const bool is_of_the_pillar = moved * moved > 0.5 * side_compliance;
      if (result.pressure_Pa == 0.0 && is_of_the_pillar) {
        result.pressure_Pa = result.pressures_Pa.back();
      }
    }
    if (result.pressure_Pa > 0.0) return result;
  }
  throw std::runtime_error(
      "no buckling load of the pillar as a whole was found under this loading: the lowest modes "
      "are "
      "local ones at the rim of the bond; a pillar this stubby does not buckle sideways");
}

std::vector<PillarMode> modes_under_pressure(const PillarModel& axial, const PillarModel& lateral,
                                             double pressure_Pa, int count) {
  const double critical_Pa = buckling(axial, lateral).pressure_Pa;
  if (pressure_Pa >= critical_Pa) {
    throw std::runtime_error("a pressure of " + std::to_string(pressure_Pa) +
                             " Pa on the top is beyond the buckling pressure of " +
                             std::to_string(critical_Pa) +
                             " Pa: the straight pillar has no stable state to vibrate about");
  }
  SymmetricSparse stiffness = lateral.stiffness();
  stiffness.coeffs() += pressure_Pa * stress_stiffness_per_Pa(axial, lateral).coeffs();
  return modes_of(lateral, stiffness, count);
}

}  // namespace viscard
