#include "models/pillar/time/relaxed_modes.h"

#include "models/maths/dense.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/time/reduced_span.h"
#include "models/pillar/time/scalar_pencil.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// An approximate mode: s, and its vector in the basis.
struct Pair {
  Complex s;
  Eigen::VectorXcd y;
};

// If a mode loses more of its shape than this while its loss grows, its identity is lost.
constexpr double kSameMode = 0.7;

[[noreturn]] void refuse_lost(Complex s) {
  throw std::runtime_error("a strongly damped mode near " +
                           text_of(std::abs(s) / (2.0 * std::numbers::pi), 4) +
                           " Hz cannot be followed; ask for fewer modes");
}

// Modes above the requested ones; they separate the directions that the basis lacks.
constexpr int kSpare = 2;

class RelaxedSearch {
 public:
  RelaxedSearch(const PillarModel& model, ViscoelasticSystem body, int count, double tolerance)
      : model_(model),
        body_(std::move(body)),
        tolerance_(tolerance),
        known_(std::min(count + kSpare, model.system().size() - rigid_count())),
        instantaneous_(lowest_modes(model, stiffness_at(body_, 1.0, 1.0), known_,
                                    product_at(body_, 1.0, 1.0))),
        lifted_(lifted_body()),
        span_(regular_body()) {
    for (const PillarMode& mode : instantaneous_) span_.add(mode.shape);
  }

  // Adds the modes at the storage moduli of this frequency and of the mode with that number. The
  // basis then holds all modes up to that one: moduli rise with frequency (Voss & Werner 1982).
  void add_relaxed_shapes(double omega_rad_s, int highest) {
    add_modes_at(omega_rad_s);
    Eigen::VectorXd y;
    const double highest_rad_s = storage_mode(highest, y);
    if (highest_rad_s > 0.0) add_modes_at(highest_rad_s);
  }

  // The mode with this number (from 0) in the basis, from its shape with the storage moduli.
  Pair within_basis(int number) {
    Eigen::VectorXd y;
    storage_mode(number, y);
    Pair pair{{}, y.cast<Complex>()};
    pair.s = oscillation_of(pencil_of(pair.y), body_.terms);
    if (pair.s == 0.0) return pair;
    iterate(pair);
    const double overlap = std::abs((pair.y.transpose() * (span_.small_mass() * y)).value()) /
                           std::sqrt(std::abs(pair.y.dot(span_.small_mass() * pair.y)) *
                                     y.dot(span_.small_mass() * y));
    if (overlap < kSameMode) refuse_lost(pair.s);
    return pair;
  }

  // Unknowns of the model.
  Eigen::VectorXcd shape_of(const Pair& pair) const {
    Eigen::VectorXcd shape(span_.basis().rows());
    shape.real() = span_.basis() * pair.y.real();
    shape.imag() = span_.basis() * pair.y.imag();
    return shape;
  }

  // Lets the basis grow by the residual of the mode until its error is small; returns that error.
  double refine(Pair& pair);
  // An upper bound of the error that needs no factorisation.
  double quick_error(const Pair& pair) const;

 private:
  void add_modes_at(double omega_rad_s) {
    const RelativeModuli m = storage_at(body_.terms, omega_rad_s);
    const SymmetricSparse stiffness = stiffness_at(body_, m.shear.real(), m.bulk.real());
    for (const PillarMode& mode : lowest_modes(model_, stiffness, known_,
                                               product_at(body_, m.shear.real(), m.bulk.real()))) {
      span_.add(mode.shape);
    }
  }
  // Frequency of a mode if only the storage moduli act, rad/s; 0: none. Sets its vector, and the
  // share of the spectrum that separates it from the directions missing in the basis.
  double storage_mode(int number, Eigen::VectorXd& y);
  // Under a pressure the stress at the rim of the bond grows without bound as layers become thinner,
  // and modes of the finest ones buckle long before the pillar does. They are no modes of the pillar
  // (pillar_buckling.cpp), and lie as far below zero as their own stiffness is high; the pillar's own
  // modes fall by no more than their frequency squared without the pressure.
  Eigen::Index rim_modes_among(const Eigen::VectorXd& ascending_1_s2) const {
    const double highest_1_s2 = std::pow(first_guess_rad_s(known_ - 1), 2);
    Eigen::Index count = 0;
    while (count + known_ < ascending_1_s2.size() && ascending_1_s2[count] < -highest_1_s2) ++count;
    return count;
  }
  int rigid_count() const {
    const auto& options = model_.options();
    return options.fixed_bottom ? 0 : rigid_motion_count(options.motion);
  }
  double first_guess_rad_s(int number) const {
    return 2.0 * std::numbers::pi * instantaneous_[static_cast<std::size_t>(number)].frequency_Hz;
  }
  // A free body has no stiffness against rigid motions: its pencil is shifted by some mass.
  std::optional<ViscoelasticSystem> lifted_body() {
    if (model_.options().fixed_bottom) return std::nullopt;
    ViscoelasticSystem lifted = body_;
    shift_1_s2_ = 0.1 * std::pow(first_guess_rad_s(0), 2);
    lifted.elastic.coeffs() += shift_1_s2_ * body_.mass.coeffs();
    return lifted;
  }
  const ViscoelasticSystem& regular_body() const { return lifted_ ? *lifted_ : body_; }
  ScalarPencil pencil_of(const Eigen::VectorXcd& y) const {
    const auto form = [&y](const Eigen::MatrixXcd& matrix) -> Complex {
      return (y.transpose() * matrix * y).value();
    };
    return {form(span_.restricted(0.0, 0.0, shift_1_s2_)), form(span_.small_shear()),
            form(span_.small_bulk()), form(span_.small_mass())};
  }
  // Nonlinear Rayleigh quotient iteration in the basis (Ruhe 1973).
  void iterate(Pair& pair) const;
  // T(s) of the whole body times the pair's vector.
  Eigen::VectorXcd residual_of(const Pair& pair) const {
    const RelativeModuli m = relative_moduli(body_.terms, pair.s);
    Eigen::VectorXcd r = span_.image_of(m.shear, m.bulk, shift_1_s2_ - pair.s * pair.s, pair.y);
    r.real() = span_.without_pressures(r.real());
    r.imag() = span_.without_pressures(r.imag());
    return r;
  }
  // Error of s from r' P^-1 r of its residual: T'(s) weighs the change of s.
  double error_from(const Pair& pair, double residual2) const {
    const ScalarPencil pencil = pencil_of(pair.y);
    const double slope = std::abs(pencil.slope(pair.s, slopes_at(body_.terms, pair.s)));
    return residual2 / (gap_ * slope * std::abs(pair.s));
  }

  const PillarModel& model_;
  ViscoelasticSystem body_;
  double tolerance_;
  int known_;
  double shift_1_s2_ = 0.0;
  std::vector<PillarMode> instantaneous_;
  std::optional<ViscoelasticSystem> lifted_;
  ReducedSpan span_;
  double gap_ = 1.0;
};

double RelaxedSearch::storage_mode(int number, Eigen::VectorXd& y) {
  double omega = first_guess_rad_s(number);
  for (int i = 0; i < 6; ++i) {
    const RelativeModuli m = storage_at(body_.terms, omega);
    const EigenSystem all = generalized_eigen(span_.restricted(m.shear, m.bulk, shift_1_s2_).real(),
                                              span_.small_mass());
    const Eigen::Index first = rim_modes_among(all.values);
    y = all.vectors.col(first + number);
    const double next = all.values[first + known_ - 1];
    gap_ = number < known_ - 1 ? std::max(1.0 - all.values[first + number] / next, 0.05) : 1.0;
    const double before = omega;
    omega = storage_frequency_rad_s(pencil_of(y.cast<Complex>()), body_.terms, omega);
    if (omega == 0.0 || std::abs(omega - before) < 1e-6 * omega) break;
  }
  return omega;
}

void RelaxedSearch::iterate(Pair& pair) const {
  constexpr int kMostIterations = 40;
  constexpr double kSettled = 1e-11;  // the basis has unit energy, so that T is of order one
  for (int step = 0; step < kMostIterations; ++step) {
    pair.s = root_near(pencil_of(pair.y), {body_.terms}, pair.s);
    const RelativeModuli m = relative_moduli(body_.terms, pair.s);
    const Eigen::MatrixXcd T = span_.restricted(m.shear, m.bulk, shift_1_s2_ - pair.s * pair.s);
    if ((T * pair.y).norm() <= kSettled * pair.y.norm()) return;
    const RelativeModuli slope = slopes_at(body_.terms, pair.s);
    const Eigen::VectorXcd image = slope.shear * (span_.small_shear() * pair.y) +
                                   slope.bulk * (span_.small_bulk() * pair.y) +
                                   2.0 * pair.s * (span_.small_mass() * pair.y);
    const Eigen::VectorXcd next = ComplexLuFactor(T).solve(image);
    if (!next.allFinite()) return;  // exactly singular: y is the mode
    pair.y = next.normalized();
  }
  refuse_lost(pair.s);
}

double RelaxedSearch::quick_error(const Pair& pair) const {
  const Eigen::VectorXcd r = residual_of(pair);
  const double size = std::hypot(span_.dual_norm(r.real()), span_.dual_norm(r.imag()));
  const RelativeModuli m = storage_at(body_.terms, pair.s.imag());
  const double softest = std::min(m.shear.real(), body_.incompressible ? 1.0 : m.bulk.real());
  return error_from(pair, size * size / softest);
}

double RelaxedSearch::refine(Pair& pair) {
  const RelativeModuli m = storage_at(body_.terms, pair.s.imag());
  StiffnessFactor factor;
  span_.factor(m.shear.real(), m.bulk.real(), factor);
  double error = 0.0;
  constexpr int kMostRounds = 60;
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::VectorXcd r = residual_of(pair);
    const Eigen::VectorXd real = factor.solve(Eigen::VectorXd(r.real()));
    const Eigen::VectorXd imaginary = factor.solve(Eigen::VectorXd(r.imag()));
    error = error_from(pair, std::abs(r.real().dot(real) + r.imag().dot(imaginary)));
    if (error <= tolerance_) return error;
    const bool grew = span_.add(real);
    if (!(span_.add(imaginary) || grew)) return error;
    Eigen::VectorXcd longer = Eigen::VectorXcd::Zero(span_.count());
    longer.head(pair.y.size()) = pair.y;
    pair.y = longer;
    iterate(pair);
  }
  throw std::runtime_error("a damped mode near " +
                           text_of(pair.s.imag() / (2.0 * std::numbers::pi), 4) +
                           " Hz converges too slowly; ask for fewer modes or a larger tolerance");
}

RelaxedMode mode_of(Complex s) {
  return {.frequency_Hz = s.imag() / (2.0 * std::numbers::pi),
          .damping_ratio = -s.real() / std::abs(s),
          .s = s,
          .shape = {}};
}

void refuse_doubles(const std::vector<Complex>& found) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!oscillates(found[i]) || std::abs(found[i] - found[j]) > 1e-9 * std::abs(found[i])) {
        continue;
      }
      throw std::runtime_error("two damped modes near " +
                               text_of(found[i].imag() / (2.0 * std::numbers::pi), 4) +
                               " Hz cannot be distinguished; ask for fewer modes");
    }
  }
}

}  // namespace

std::vector<RelaxedMode> relaxed_modes(const PillarModel& model, ViscoelasticSystem body, int count,
                                       double tolerance) {
  RelaxedSearch search(model, std::move(body), count, tolerance);
  std::vector<RelaxedMode> modes;
  std::vector<Complex> found;
  bool has_relaxed_shapes = false;
  for (int number = 0; number < count; ++number) {
    Pair pair = search.within_basis(number);
    if (oscillates(pair.s) && !has_relaxed_shapes && search.quick_error(pair) > tolerance) {
      search.add_relaxed_shapes(pair.s.imag(), count - 1);
      has_relaxed_shapes = true;
      pair = search.within_basis(number);
    }
    if (!oscillates(pair.s)) {
      modes.push_back({.frequency_Hz = 0.0, .damping_ratio = 1.0, .s = 0.0, .shape = {}});
      continue;
    }
    double error = search.quick_error(pair);
    if (error > tolerance) error = search.refine(pair);
    modes.push_back(mode_of(pair.s));
    modes.back().error = error;
    modes.back().shape = search.shape_of(pair);
    found.push_back(pair.s);
  }
  refuse_doubles(found);
  return modes;
}

RelaxedMode relaxed_mode_nearby(const ViscoelasticSystem& body, Complex s,
                                const Eigen::VectorXcd& shape) {
  return mode_of(root_near(scalar_pencil(body, shape), {body.terms}, s));
}

}  // namespace viscard
