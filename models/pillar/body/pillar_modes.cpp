#include "models/pillar/body/pillar_modes.h"

#include "models/maths/dense.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/system/krylov_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {

SymmetricSparse stress_stiffness_per_Pa(const PillarModel& axial, const PillarModel& model) {
  const PillarState state = axial.solve(-axial.top_traction());
  const auto form = [&](const SectionElement& element, double x, double z) {
    const Eigen::VectorXd s = axial.stress_at(state, element, x, z);
    Eigen::Matrix3d stress;
    stress << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(9, 9);
    for (Eigen::Index k = 0; k < 3; ++k) D.block<3, 3>(3 * k, 3 * k) = stress;
    return D;
  };
  return model.system().varying_form(model.system().kinematics().gradient, form);
}

namespace {

// A motion without its rigid part: x - R (R'MR)^-1 R'M x. The elastic modes of a free body are
// those of its stiffness among these remaining motions.
class WithoutRigidMotion {
 public:
  WithoutRigidMotion(const PillarModel& model, const SymmetricSparse& mass) {
    if (model.options().fixed_bottom) return;
    rigid_ = rigid_motions(model);
    mass_rigid_ = mass.selfadjointView<Eigen::Lower>() * rigid_;
    masses_ = Cholesky(rigid_.transpose() * mass_rigid_);
  }
  Eigen::VectorXd of(Eigen::VectorXd x) const {
    if (rigid_.cols() > 0)
      x -= rigid_ * masses_.solve(Eigen::VectorXd(mass_rigid_.transpose() * x));
    return x;
  }

 private:
  Eigen::MatrixXd rigid_, mass_rigid_;
  Cholesky masses_;
};

// The stiffness of a free body is singular; adding this multiple of the mass makes it regular. The
// shift is far below the square of the first elastic frequency, which is of the order of the
// slowest medium's wave across the largest extent. It is also far above rounding, which is
// determined by the fastest medium.
double free_shift_1_s2(const PillarModel& model) {
  double slowest = std::numeric_limits<double>::infinity();  // squares of wave speeds
  double fastest = 0.0;
  for (int region = 0; region < (model.geometry().film ? 2 : 1); ++region) {
    const Medium& medium = model.medium(region);
    const double shear_Pa =
        medium.is_isotropic ? medium.shear_Pa : medium.stiffness_Pa.diagonal().tail(3).minCoeff();
    slowest = std::min(slowest, shear_Pa / medium.rho_kg_m3);
    fastest = std::max(fastest, shear_Pa / medium.rho_kg_m3);
  }
  const PillarGeometry& g = model.geometry();
  const double height_m = g.length_m + (g.film ? g.film->thickness_m : 0.0);
  const double across_m = g.film ? 2.0 * g.film->radius_m : g.diameter_m;
  const double extent_m = std::max(height_m, across_m);
  return std::max(1e-4 * slowest, 1e-11 * fastest) / (extent_m * extent_m);
}

// Where the rim of the bond makes the stress singular, the values of modes localised there decrease
// without bound as meshes are refined. These modes belong to the idealised corner, not the pillar.
// Therefore this many modes above a shift are searched for the one that bends the whole pillar.
constexpr int kMostModes = 8;

// The pencil K, M of a model, searched from a shift upward: pairs of largest 1/(omega^2 + shift).
class ModeSearch {
 public:
  ModeSearch(const PillarModel& model, const SymmetricSparse& stiffness)
      : model_(model), stiffness_(stiffness), mass_(model.mass()), elastic_(model, mass_) {
    mass_.prune(0.0);  // has the pattern of the stiffness, with zeros where fields do not couple
  }

  EigenPairs from(double shift_1_s2, int count, int largest_space) {
    if (shift_1_s2 == 0.0) {
      model_.factor(stiffness_, factor_);
    } else {
      SymmetricSparse shifted = stiffness_;
      shifted.coeffs() += shift_1_s2 * model_.mass().coeffs();
      model_.factor(shifted, factor_);
    }
    const LinearMap B = [&](const Eigen::VectorXd& x) { return times(mass_, x); };
    const PencilMap op = [&](const Eigen::VectorXd&, const Eigen::VectorXd& Mx) {
      return elastic_.of(factor_.solve(Mx));
    };
    // The error of the frequencies is the square of the residual, far below that of any mesh.
    return largest_eigenpairs(op, B, model_.system().size(), count,
                              {.tolerance = 1e-6, .largest_space = largest_space});
  }
  // Number of modes below the last search's shift (Sylvester), without the rigid motions.
  int left_below() const {
    const auto& options = model_.options();
    return factor_.negative_pivots() -
           (options.fixed_bottom ? 0 : rigid_motion_count(options.motion));
  }

 private:
  const PillarModel& model_;
  const SymmetricSparse& stiffness_;
  SymmetricSparse mass_;
  WithoutRigidMotion elastic_;
  StiffnessFactor factor_;
};

// Modes of a slender body's section lie so close together above their cut-off that a search from
// zero cannot separate them; a search from just below the lowest of them can.
EigenPairs search_from_below(ModeSearch& search, const EigenPairs& rough, double& shift_1_s2,
                             int count) {
  constexpr double kJustBelow = 0.98;  // of omega^2, which is known to about 1e-3 at this point
  if (!(rough.values.size() > 0 && rough.values[0] > 0.0)) return rough;
  shift_1_s2 -= kJustBelow / rough.values[0];
  EigenPairs pairs = search.from(shift_1_s2, count, 200 + 10 * count);
  pairs.converged = pairs.converged && search.left_below() == 0;
  return pairs;
}

std::vector<PillarMode> modes_of(const PillarModel& model, const SymmetricSparse& stiffness,
                                 int count) {
  ModeSearch search(model, stiffness);
  double shift_1_s2 = model.options().fixed_bottom ? 0.0 : free_shift_1_s2(model);
  EigenPairs pairs = search.from(shift_1_s2, count, 60 + 10 * count);
  if (!pairs.converged) pairs = search_from_below(search, pairs, shift_1_s2, count);
  if (!pairs.converged) {
    throw std::runtime_error(
        "the lowest modes did not converge; ask for fewer modes or a finer mesh");
  }
  std::vector<PillarMode> modes;
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    const double square = 1.0 / pairs.values[i] - shift_1_s2;
    modes.push_back(
        {std::sqrt(std::max(square, 0.0)) / (2.0 * std::numbers::pi), pairs.vectors.col(i)});
  }
  return modes;
}

}  // namespace

std::vector<PillarMode> lowest_modes(const PillarModel& model, int count) {
  return modes_of(model, model.stiffness(), count);
}

std::vector<PillarMode> lowest_modes(const PillarModel& model, const SymmetricSparse& stiffness,
                                     int count) {
  return modes_of(model, stiffness, count);
}

namespace {

// The pencil K + p K_sigma of a lateral model, and the criterion for a mode of the whole pillar.
struct BucklingPencil {
  const PillarModel& lateral;
  SymmetricSparse stiffness, stress;
  Eigen::VectorXd side;  // unit force sideways on the top
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

// p of the shape's own quotient v'K v = -p v'K_sigma v; 0 if the stress stiffens this shape.
double quotient_Pa(const BucklingPencil& pencil, const Eigen::VectorXd& shape) {
  const double softened = -shape.dot(times(pencil.stress, shape));
  return softened > 0.0 ? shape.dot(times(pencil.stiffness, shape)) / softened : 0.0;
}

// Rayleigh quotient iteration from the bent pillar: it converges to the mode next to this shape,
// past local modes at the rim that lie below or around it, each step with three times the digits.
// Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 4. 0: it has led elsewhere.
double iterated_buckling_Pa(const BucklingPencil& pencil, Eigen::VectorXd shape) {
  constexpr int kSteps = 8;
  constexpr double kCloseEnough = 1e-5;  // of the last step; the next error is its cube
  double pressure_Pa = quotient_Pa(pencil, shape);
  for (int i = 0; i < kSteps && pressure_Pa > 0.0; ++i) {
    SymmetricSparse shifted = pencil.stiffness;
    shifted.coeffs() += pressure_Pa * pencil.stress.coeffs();
    StiffnessFactor factor;
    pencil.lateral.factor(shifted, factor);
    shape = factor.solve(times(pencil.stiffness, shape));
    shape /= std::sqrt(shape.dot(times(pencil.stiffness, shape)));
    const double next_Pa = quotient_Pa(pencil, shape);
    const bool is_close = std::abs(next_Pa - pressure_Pa) <= kCloseEnough * pressure_Pa;
    pressure_Pa = next_Pa;
    if (is_close) return pencil.is_of_the_pillar(shape) ? pressure_Pa : 0.0;
  }
  return 0.0;
}

// Leaves the pressure unset if no mode of the whole pillar is found.
Buckling search_buckling(const PillarModel& axial, const PillarModel& lateral, int count) {
  BucklingPencil pencil{lateral, lateral.stiffness(), stress_stiffness_per_Pa(axial, lateral),
                        unit_top_force(lateral)};
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
  const EigenPairs pairs =
      largest_eigenpairs(op, B, lateral.system().size(), count, {.tolerance = 1e-6});
  Buckling result = found_among(pairs, pencil, 0.0, [](double value) { return 1.0 / value; });
  if (result.pressure_Pa > 0.0) return result;
  result.pressure_Pa = iterated_buckling_Pa(pencil, bent);
  if (result.pressure_Pa > 0.0) return result;
  // The Rayleigh quotient of the pillar bent by a side force lies above its buckling pressure. A
  // search that starts a little below the quotient avoids local modes far below it.
  const double bent_Pa = quotient_Pa(pencil, bent);
  for (const double share : {0.9, 0.8, 0.6, 0.4}) {
    if (!(bent_Pa > 0.0)) break;
    result.pressure_Pa =
        buckling_above(pencil, share * bent_Pa, std::max(count, kMostModes)).pressure_Pa;
    if (result.pressure_Pa > 0.0) return result;
  }
  return result;
}

}  // namespace

Buckling buckling(const PillarModel& axial, const PillarModel& lateral, int count) {
  Buckling found = search_buckling(axial, lateral, count);
  if (found.pressure_Pa > 0.0) return found;
  throw std::runtime_error(
      "no buckling load of the whole pillar was found beside local modes at the rim of the bond. A "
      "stubby pillar does not buckle sideways; for a slender one ask for a larger tolerance");
}

void require_below_buckling(const PillarModel& axial, const PillarModel& lateral,
                            double pressure_Pa) {
  const double critical_Pa = search_buckling(axial, lateral, 1).pressure_Pa;
  if (!(critical_Pa > 0.0 && pressure_Pa >= critical_Pa)) return;
  throw BeyondBuckling("a pressure of " + text_of(pressure_Pa, 5) +
                           " Pa on the top is beyond the buckling pressure of " +
                           text_of(critical_Pa, 5) +
                           " Pa; reduce it, because vibrations need a stable straight pillar",
                       critical_Pa);
}

std::vector<PillarMode> modes_under_pressure(const PillarModel& axial, const PillarModel& model,
                                             double pressure_Pa, int count) {
  if (model.options().motion == Motion::kLateral) {
    require_below_buckling(axial, model, pressure_Pa);
  }
  SymmetricSparse stiffness = model.stiffness();
  stiffness.coeffs() += pressure_Pa * stress_stiffness_per_Pa(axial, model).coeffs();
  return modes_of(model, stiffness, count);
}

}  // namespace viscard
