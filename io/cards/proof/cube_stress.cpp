#include "io/cards/proof/cube_stress.h"

#include "io/cards/law_numbers.h"
#include "models/maths/branch_step.h"

#include <cmath>
#include <limits>

namespace viscard {
namespace {

// Principal Kirchhoff stresses without the pressure.
Eigen::Vector3d deviator_Pa(const HyperelasticLaw& law, const Eigen::Vector3d& log_strain,
                            VolumeRule rule) {
  const double volume = log_strain.sum();  // ln J
  const Eigen::Vector3d shape = log_strain.array() - volume / 3.0;
  Eigen::VectorXd moduli_Pa = law.moduli_Pa;
  if (rule == VolumeRule::kWholeOgden && is_ogden(law.form))
    moduli_Pa.array() *= ((law.shapes.array() - 2.0) * volume / 3.0).exp();
  const Eigen::Vector3d stress =
      principal_columns(law.form, law.shapes, shape, false).values * moduli_Pa;
  return stress.array() - stress.mean();
}

// Logarithms of the stretches with those of the free sides.
Eigen::Vector3d with_sides(Deformation deformation, double measured, double side) {
  if (deformation == Deformation::kPlanar) return {measured, 0.0, side};
  if (deformation == Deformation::kEquibiaxial) return {measured, measured, side};
  return {measured, side, side};
}

// Kirchhoff stress of the volume: J dU/dJ.
double volume_stress_Pa(double bulk_Pa, double J, VolumeRule rule) {
  if (rule == VolumeRule::kLogarithmic) return 0.5 * bulk_Pa * (J * J - 1.0);
  if (rule == VolumeRule::kLogSquared) return bulk_Pa * std::log(J);
  return bulk_Pa * J * (J - 1.0);
}

}  // namespace

double confined_stress_Pa(const HyperelasticLaw& law, double bulk_Pa, double stretch,
                          VolumeRule rule) {
  const Eigen::Vector3d strain{std::log(stretch), 0.0, 0.0};
  return (deviator_Pa(law, strain, rule)[0] + volume_stress_Pa(bulk_Pa, stretch, rule)) / stretch;
}

double cube_stress_Pa(const HyperelasticLaw& law, double bulk_Pa, Deformation deformation,
                      double stretch, VolumeRule rule) {
  if (rule == VolumeRule::kIncompressible) return nominal_stress_Pa(law, deformation, stretch);
  const double measured = std::log(stretch);
  // Kirchhoff stress of a free side, which rises with its stretch.
  const auto side_Pa = [&](double side) {
    const Eigen::Vector3d strain = with_sides(deformation, measured, side);
    const double J = std::exp(strain.sum());
    return deviator_Pa(law, strain, rule)[2] + volume_stress_Pa(bulk_Pa, J, rule);
  };
  const double isochoric = strain_direction(deformation)[2] * measured;
  double low = isochoric - 0.5, high = isochoric + 0.5;
  if (!(side_Pa(low) < 0.0) || !(side_Pa(high) > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (side_Pa(middle) < 0.0 ? low : high) = middle;
  }
  const Eigen::Vector3d strain = with_sides(deformation, measured, 0.5 * (low + high));
  // tau_3 = 0, so that the pressure is minus its deviator.
  const Eigen::Vector3d stress_Pa = deviator_Pa(law, strain, rule);
  return (stress_Pa[0] - stress_Pa[2]) / stretch;
}

std::vector<double> relaxing_stress_Pa(const HyperelasticLaw& law,
                                       const std::vector<RubberTerm>& terms, double bulk_Pa,
                                       const Course& history, VolumeRule rule, bool is_projected) {
  double lasting = 1.0;
  for (const RubberTerm& term : terms) lasting -= term.g;
  Eigen::Vector3d elastic = Eigen::Vector3d::Zero();  // second Piola-Kirchhoff stress of the law
  std::vector<Eigen::Vector3d> branches(terms.size(), elastic);
  double side = 0.0;  // logarithm of the stretch of the sides
  std::vector<double> out;
  for (std::size_t n = 1; n < history.size(); ++n) {
    const double step_s = history[n].time_s - history[n - 1].time_s,
                 measured = std::log(history[n].value);
    std::vector<Eigen::Vector3d> next;
    Eigen::Vector3d now;
    // Principal Kirchhoff stresses without the pressure, at the logarithm of a side's stretch.
    const auto stress_Pa = [&](double of_side) -> Eigen::Vector3d {
      const Eigen::Vector3d strain{measured, of_side, of_side};
      const Eigen::Array3d squares = (2.0 * strain.array()).exp();
      now = deviator_Pa(law, strain, rule).array() / squares;
      Eigen::Vector3d sum = lasting * now;
      next = branches;
      for (std::size_t i = 0; i < terms.size(); ++i) {
        const BranchStep step(step_s, terms[i].tau_s);
        next[i] = step.decay * branches[i] + step.gain * (now - elastic);
        sum += terms[i].g * next[i];
      }
      Eigen::Vector3d pushed = sum.array() * squares;
      if (is_projected) pushed.array() -= pushed.mean();
      return pushed;
    };
    const auto free_Pa = [&](double of_side) {
      return stress_Pa(of_side)[2] +
             volume_stress_Pa(bulk_Pa, std::exp(measured + 2.0 * of_side), rule);
    };
    double low = -0.5 * measured - 0.5, high = -0.5 * measured + 0.5;
    constexpr int kHalvings = 60;
    for (int i = 0; i < kHalvings; ++i) {
      side = 0.5 * (low + high);
      (free_Pa(side) < 0.0 ? low : high) = side;
    }
    const Eigen::Vector3d found_Pa = stress_Pa(side);
    out.push_back((found_Pa[0] - found_Pa[2]) / history[n].value);
    branches = next;
    elastic = now;
  }
  return out;
}

}  // namespace viscard
