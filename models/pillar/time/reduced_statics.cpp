#include "models/material/material.h"
#include "models/maths/dense.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/reduced_span.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct LaplaceModuli {
  double shear = 1.0, bulk = 1.0;
  // Every energy with these moduli is at least this share of the instantaneous one.
  double softest() const { return std::max(std::min({1.0, shear, bulk}), 1e-12); }
};

LaplaceModuli laplace_moduli_at(const ViscoelasticSystem& body, double s) {
  const RelativeModuli moduli = relative_moduli(body.terms, s);
  return {std::real(moduli.shear), body.incompressible ? 1.0 : std::real(moduli.bulk)};
}

// Laplace variables that cover every relaxation time: two per decade from well below the slowest
// rate to well above the fastest; none for a solid.
std::vector<LaplaceModuli> laplace_points(const ViscoelasticSystem& body) {
  const auto [fastest_s, slowest_s] = relaxation_times(body.terms);
  std::vector<LaplaceModuli> points;
  if (slowest_s == 0.0) return points;
  for (double s = 1e-2 / slowest_s; s < 20.0 / fastest_s; s *= std::sqrt(10.0)) {
    points.push_back(laplace_moduli_at(body, s));
  }
  return points;
}

void append_to(MatrixXd& matrix, const VectorXd& column) {
  matrix.conservativeResize(column.size(), matrix.cols() + 1);
  matrix.col(matrix.cols() - 1) = column;
}

// Vectors as columns, with those that the instantaneous stiffness maps on them or that it makes of
// them, so that energies of their sums need no solution of their own.
struct EnergyPairs {
  MatrixXd motion, force;  // unknowns x vectors, force = K_0 motion
};

// A problem K(s) u = side in the basis, and what is wrong with its solution.
struct Restricted {
  VectorXd c;             // in the basis
  double energy = 0.0;    // c' K c
  double residual = 0.0;  // norm of the residual in K(s)^-1, an upper bound
};

// The growing basis for the load and the outputs, sides() in this order. The residual of a restricted
// solution is a sum of vectors whose coefficients alone depend on s. Its Riesz representations in the
// instantaneous energy are kept, and cost one or two solutions for each vector of the basis.
class QuasiStaticBasis {
 public:
  QuasiStaticBasis(const ViscoelasticSystem& body, const std::vector<VectorXd>& outputs)
      : body_(body), span_(body), has_film_(body.elastic.coeffs().cwiseAbs().sum() > 0.0) {
    sides_.push_back(body.load);
    for (const VectorXd& output : outputs) sides_.push_back(output_of_motion(body, output));
    for (const VectorXd& side : sides_) {
      add_pair(span_.instantaneous().solve(side), side, of_sides_);
    }
    add(of_sides_.motion.col(0));
  }

  std::size_t count() const { return sides_.size(); }
  const ReducedSpan& span() const { return span_; }

  Restricted solved(std::size_t side, const LaplaceModuli& m) const {
    const auto column = static_cast<Index>(side);
    const MatrixXd small = span_.restricted(m.shear, m.bulk, 0.0).real();
    Restricted out;
    out.c = SymmetricFactor(small).solve(VectorXd(small_sides_.col(column)));
    out.energy = std::abs(out.c.dot(small * out.c));
    const auto rest = [&](const MatrixXd& of_side, const MatrixXd& whole, const MatrixXd& shear,
                          const MatrixXd& bulk) -> VectorXd {
      VectorXd sum = of_side.col(column) - whole * out.c - shear * ((m.shear - 1.0) * out.c);
      if (m.bulk != 1.0) sum -= bulk * ((m.bulk - 1.0) * out.c);
      return sum;
    };
    const VectorXd motion =
        rest(of_sides_.motion, of_basis_.motion, of_shear_.motion, of_bulk_.motion);
    const VectorXd force = rest(of_sides_.force, of_basis_.force, of_shear_.force, of_bulk_.force);
    out.residual = std::sqrt(std::max(motion.dot(force), 0.0) / m.softest());
    return out;
  }

  // The value of an output for a solution in the basis.
  double value(std::size_t output, const Restricted& solution) const {
    return small_sides_.col(static_cast<Index>(output)).dot(solution.c);
  }

  // Adds whole-body solutions; false if they bring nothing new.
  bool add_solutions(const std::vector<std::size_t>& which, const LaplaceModuli& m) {
    StiffnessFactor factor;
    span_.factor(m.shear, m.bulk, factor);
    bool grew = false;
    for (const std::size_t side : which) grew = add(factor.solve(sides_[side])) || grew;
    return grew;
  }

 private:
  bool add(VectorXd v) {
    if (body_.incompressible && span_.count() > 0) {
      // What v adds to the basis may be so small that its rounding changes the volume: the nearest motion
      // that keeps the volume, in the energy.
      v -= span_.projected(v);
      v = span_.instantaneous().solve(times(stiffness_at(body_, 1.0, 1.0), v));
    }
    if (!span_.add(v)) return false;
    small_sides_.resize(span_.count(), static_cast<Index>(sides_.size()));
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      small_sides_.col(static_cast<Index>(i)) = span_.basis().transpose() * sides_[i];
    }
    const VectorXd kept = span_.basis().rightCols<1>();
    const VectorXd of_shear = span_.shear_image().rightCols<1>();
    const VectorXd of_bulk = span_.bulk_image().rightCols<1>();
    const VectorXd by_shear = span_.instantaneous().solve(of_shear);
    add_pair(kept, span_.elastic_image().rightCols<1>() + of_shear + of_bulk, of_basis_);
    add_pair(by_shear, of_shear, of_shear_);
    if (body_.incompressible) return true;
    // Without a film the two parts are the whole.
    add_pair(has_film_ ? span_.instantaneous().solve(of_bulk) : kept - by_shear, of_bulk, of_bulk_);
    return true;
  }

  // `force` has the pressures of an incompressible body, which move nothing. What the matrices make
  // of the motion is its force without them.
  void add_pair(const VectorXd& motion, const VectorXd& force, EnergyPairs& pairs) const {
    append_to(pairs.motion, motion);
    append_to(pairs.force, body_.incompressible
                               ? times(body_.elastic, motion) + shear_times(body_, motion)
                               : force);
  }

  const ViscoelasticSystem& body_;
  ReducedSpan span_;
  bool has_film_;
  std::vector<VectorXd> sides_;
  MatrixXd small_sides_;  // in the basis, as columns
  EnergyPairs of_sides_, of_basis_, of_shear_, of_bulk_;
};

// The worst error of a basis, as a multiple of what is allowed, and where it is.
struct Worst {
  double excess = 0.0;
  LaplaceModuli at;
  std::vector<std::size_t> sides;  // whose solutions mend it
  double error = 0.0;              // largest of an output, relative
  double of_solutions = 0.0;       // largest of a solution, in the energy norm
};

Worst worst_of(const QuasiStaticBasis& basis, const std::vector<LaplaceModuli>& points,
               const QuasiStaticGoals& goals) {
  constexpr double kFloor = 1e-3;  // of the largest value of an output
  Worst worst;
  const auto judge = [&](double excess, const LaplaceModuli& m, std::size_t side) {
    if (!(excess > worst.excess)) return;
    worst.excess = excess;
    worst.at = m;
    worst.sides = {0};
    if (side > 0) worst.sides.push_back(side);
  };
  std::vector<Restricted> primal;
  for (const LaplaceModuli& m : points) primal.push_back(basis.solved(0, m));
  for (std::size_t side = 0; side < basis.count(); ++side) {
    double largest = 0.0;
    for (const Restricted& one : primal)
      largest = std::max(largest, std::abs(basis.value(side, one)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Restricted dual = side == 0 ? primal[i] : basis.solved(side, points[i]);
      const double size = std::max(std::abs(basis.value(side, primal[i])), kFloor * largest);
      // An output that the load does not reach has no size.
      const double error = size > 0.0 ? primal[i].residual * dual.residual / size : 0.0;
      worst.error = std::max(worst.error, error);
      judge(error / goals.tolerance, points[i], side);
      if (!(dual.energy > 0.0)) continue;
      const double of_solution = dual.residual / std::sqrt(dual.energy);
      worst.of_solutions = std::max(worst.of_solutions, of_solution);
      judge(of_solution / goals.of_solutions, points[i], side);
    }
  }
  return worst;
}

}  // namespace

ReducedBody reduce_quasi_static(const ViscoelasticSystem& system, const QuasiStaticGoals& goals) {
  QuasiStaticBasis basis(system, goals.outputs);
  const std::vector<LaplaceModuli> points = laplace_points(system);
  constexpr int kLargest = 60;
  Worst worst = worst_of(basis, points, goals);
  while (worst.excess > 1.0 && basis.span().count() < kLargest) {
    // Rounding: no better answer exists.
    if (!basis.add_solutions(worst.sides, worst.at)) break;
    worst = worst_of(basis, points, goals);
  }
  ReducedBody result = basis.span().reduced();
  result.error = worst.error;
  result.error_of_solutions = worst.of_solutions;
  return result;
}

}  // namespace viscard
