#include "models/pillar/body/pillar_modes.h"

#include "models/maths/dense.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/stress_energy.h"
#include "models/pillar/system/krylov_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {

namespace {

// Whether an element lies next to a rim, where all are small in both directions.
bool is_next_to_rim(const PillarModel& model, const SectionElement& element) {
  constexpr double kSmall = 0.012;  // of the radius
  const double small_m = kSmall * model.radius_m();
  const Section& section = model.mesh().section;
  return section.x().length(element.column) < small_m && section.z().length(element.row) < small_m;
}

// Of the elements that `counts` names; all if it is empty.
SymmetricSparse stress_stiffness_of(const PillarModel& axial, const PillarState& state,
                                    const PillarModel& model,
                                    const std::function<bool(const SectionElement&)>& counts) {
  const auto form = [&](const SectionElement& element, double x, double z) {
    return gradient_form(axial.stress_at(state, element, x, z));
  };
  return model.system().varying_form(model.system().kinematics().gradient, form, counts);
}

}  // namespace

StressStiffness stress_stiffness_by_place(const PillarModel& axial, const PillarModel& model) {
  const PillarState state = axial.solve(-axial.top_traction());
  const auto is_rim = [&](const SectionElement& element) { return is_next_to_rim(model, element); };
  StressStiffness stress;
  stress.away_from_rims = stress_stiffness_of(axial, state, model, std::not_fn(is_rim));
  stress.whole = stress_stiffness_of(axial, state, model, is_rim);
  stress.whole.coeffs() += stress.away_from_rims.coeffs();
  return stress;
}

SymmetricSparse stress_stiffness_per_Pa(const PillarModel& axial, const PillarModel& model) {
  return stress_stiffness_of(axial, axial.solve(-axial.top_traction()), model, {});
}

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

// The pencil K, M of a model, searched from a shift upward: pairs of largest 1/(omega^2 + shift).
class ModeSearch {
 public:
  ModeSearch(const PillarModel& model, const SymmetricSparse& stiffness,
             StiffnessFactor::Product product)
      : model_(model),
        stiffness_(stiffness),
        product_(std::move(product)),
        mass_(model.mass()),
        elastic_(model, mass_) {
    mass_.prune(0.0);  // has the pattern of the stiffness, with zeros where fields do not couple
  }

  // `stiffening`: of the penalty at nu = 0.5. It leaves the modes as they are, but those of the
  // penalised matrix, which left_below() counts, come nearer to them.
  void start_at(double shift_1_s2, double stiffening = 1.0) {
    SymmetricSparse shifted = stiffness_;
    if (shift_1_s2 != 0.0) shifted.coeffs() += shift_1_s2 * model_.mass().coeffs();
    model_.factor(shifted, factor_, stiffening);
    if (!product_) return;
    const bool is_incompressible =
        std::isinf(model_.medium(kPillarRegion).bulk_Pa) && !model_.is_plane_stress();
    const double scale = is_incompressible ? stiffening : 1.0;  // others have no penalty
    factor_.refine_by(
        [this, shift_1_s2, scale](const Eigen::VectorXd& u, const Eigen::VectorXd& source) {
          Eigen::VectorXd force = product_(u, scale * source);
          if (shift_1_s2 != 0.0) force += shift_1_s2 * times(mass_, u);
          return force;
        });
  }
  // The square of the angular frequency of a shape of unit mass norm, 1/s^2, whose pair gives `of_pair`.
  double square_of(const Eigen::VectorXd& shape, double of_pair) const {
    return product_ ? shape.dot(product_(shape, shape)) : of_pair;
  }
  // From the last start upward; 0 vectors: what converges in a small space.
  EigenPairs find(int count, int largest_space) const {
    const LinearMap B = [&](const Eigen::VectorXd& x) { return times(mass_, x); };
    const PencilMap op = [&](const Eigen::VectorXd&, const Eigen::VectorXd& Mx) {
      return elastic_.of(factor_.solve(Mx));
    };
    // The error of the frequencies is the square of the residual, far below that of any mesh.
    return largest_eigenpairs(
        op, B, model_.system().size(), count,
        {.tolerance = 1e-6, .largest_space = largest_space, .is_quick = largest_space == 0});
  }
  // Number of modes below the start (Sylvester), without the rigid motions. At nu = 0.5 the modes
  // of the penalised matrix are counted; by min-max there are at least as many as modes of the
  // body. If the counts agree, the equation of the pressures is positive definite (inertia of a
  // saddle point: Gould, Math. Program. 32 (1985) 90).
  int left_below() const {
    const auto& options = model_.options();
    return factor_.negative_pivots() -
           (options.fixed_bottom ? 0 : rigid_motion_count(options.motion));
  }

 private:
  const PillarModel& model_;
  const SymmetricSparse& stiffness_;
  StiffnessFactor::Product product_;  // of the stiffness, if its entries keep too few digits
  SymmetricSparse mass_;
  WithoutRigidMotion elastic_;
  StiffnessFactor factor_;
};

// The lowest modes, found piece by piece. Modes of a slender body's section lie so close together
// above their cut-off that a search from far below does not separate them; one from just below does.
// Spectrum slicing: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 3.
class SlicedModes {
 public:
  SlicedModes(const PillarModel& model, const SymmetricSparse& stiffness, int count,
              StiffnessFactor::Product product)
      : search_(model, stiffness, std::move(product)),
        wanted_(static_cast<std::size_t>(count)),
        shift_1_s2_(model.options().fixed_bottom ? 0.0 : free_shift_1_s2(model)) {
    search_.start_at(shift_1_s2_);
    for (int piece = 0; piece < kMostPieces; ++piece) {
      const EigenPairs pairs = search_.find(left(), 0);
      keep(pairs);
      if (pairs.converged || !move_below(pairs)) break;
    }
    for (bool goes_on = true; goes_on && left() > 0;) {
      const EigenPairs pairs = search_.find(left(), 200 + 10 * count);
      keep(pairs);
      goes_on = left() > 0 && move_below(pairs);
    }
    if (left() > 0) {
      throw std::runtime_error(
          "the lowest modes did not converge; ask for fewer modes or a finer mesh");
    }
  }

  std::vector<PillarMode> modes() const {
    std::vector<PillarMode> modes;
    for (const auto& [square_1_s2, shape] : found_) {
      modes.push_back({std::sqrt(std::max(square_1_s2, 0.0)) / (2.0 * std::numbers::pi), shape});
    }
    return modes;
  }

 private:
  static constexpr int kMostPieces = 6;
  // How far below the next mode a search starts again, relative to the square of its frequency.
  static constexpr std::array kFarStarts = {0.02, 0.05, 0.12};
  static constexpr std::array kNearStarts = {0.0005, 0.002, 0.006};
  // With ten times the shear modulus as penalty modes of the section lie per cents too low.
  static constexpr double kStiffening = 100.0;

  int left() const { return static_cast<int>(wanted_ - found_.size()); }
  void keep(const EigenPairs& pairs) {
    for (int i = 0; i < pairs.leading; ++i) {
      const double of_pair = 1.0 / pairs.values[i] - shift_1_s2_;
      found_.emplace_back(search_.square_of(pairs.vectors.col(i), of_pair), pairs.vectors.col(i));
    }
  }
  // Starts again just below the first mode that has not converged, and drops the modes found above
  // it. The distance depends on how accurately that mode is known; a search from 2 % below already
  // knows it better. The start is not moved if modes in between would be missed.
  bool move_below(const EigenPairs& pairs) {
    if (!(pairs.leading < pairs.values.size() && pairs.values[pairs.leading] > 0.0)) return false;
    const double next_1_s2 = 1.0 / pairs.values[pairs.leading] - shift_1_s2_;
    const bool is_near = next_1_s2 + shift_1_s2_ < 0.03 * next_1_s2;
    for (const double below : is_near ? kNearStarts : kFarStarts) {
      const double start_1_s2 = (1.0 - below) * next_1_s2;
      if (!(start_1_s2 > (1.0 + 0.2 * below) * -shift_1_s2_)) break;
      std::size_t lower = 0;
      while (lower < found_.size() && found_[lower].first < start_1_s2) ++lower;
      search_.start_at(-start_1_s2, is_near ? kStiffening : 1.0);
      if (search_.left_below() != static_cast<int>(lower)) continue;
      found_.resize(lower);
      shift_1_s2_ = -start_1_s2;
      return true;
    }
    search_.start_at(shift_1_s2_);
    return false;
  }

  ModeSearch search_;
  std::size_t wanted_;
  double shift_1_s2_;                                      // added to the stiffness, times the mass
  std::vector<std::pair<double, Eigen::VectorXd>> found_;  // squares of angular frequencies, shapes
};

std::vector<PillarMode> modes_of(const PillarModel& model, const SymmetricSparse& stiffness,
                                 int count, StiffnessFactor::Product product = {}) {
  return SlicedModes(model, stiffness, count, std::move(product)).modes();
}

}  // namespace

StiffnessFactor::Product product_of(const PillarModel& model, const SymmetricSparse* stress) {
  if (!model.loses_digits()) return {};
  return [&model, stress](const Eigen::VectorXd& u, const Eigen::VectorXd& source) {
    Eigen::VectorXd force = model.stiffness_times(u, source);
    if (stress != nullptr) force += times(*stress, u);
    return force;
  };
}

std::vector<PillarMode> lowest_modes(const PillarModel& model, int count) {
  return modes_of(model, model.stiffness(), count, product_of(model));
}

std::vector<PillarMode> lowest_modes(const PillarModel& model, const SymmetricSparse& stiffness,
                                     int count, StiffnessFactor::Product product) {
  return modes_of(model, stiffness, count, std::move(product));
}

std::vector<PillarMode> modes_under_pressure(const PillarModel& axial, const PillarModel& model,
                                             double pressure_Pa, int count) {
  const SymmetricSparse stress = stiffness_by_pressure(axial, model, pressure_Pa);
  SymmetricSparse stiffness = model.stiffness();
  stiffness.coeffs() += stress.coeffs();
  return modes_of(model, stiffness, count, product_of(model, &stress));
}

}  // namespace viscard
