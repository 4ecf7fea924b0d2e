#include "models/pillar/body/nearby_pillar.h"

#include "models/pillar/body/stress_energy.h"

#include <cmath>
#include <numbers>

namespace viscard {

void NearbyPillar::solve() {
  model_.factor(model_.stiffness(), solutions_.factor);
  const Motion motion = model_.options().motion;
  if (motion != Motion::kTorsion && motion != Motion::kOvalling) {
    solutions_.add(unit_top_force(model_));
  }
  if (model_.electrode_dof() < 0) return;
  solutions_.add(Eigen::VectorXd::Unit(model_.system().size(), model_.electrode_dof()));
}

void NearbyPillar::find_modes(int count) {
  modes_ = lowest_modes(model_, count);
}

void NearbyPillar::find_modes(int count, const SymmetricSparse& stress) {
  SymmetricSparse stiffness = model_.stiffness();
  stiffness.coeffs() += stress.coeffs();
  modes_ = lowest_modes(model_, stiffness, count);
}

void NearbyPillar::find_buckling(const PillarModel& axial) {
  buckled_ = buckling(axial, model_).shape;
}

std::vector<PillarMode> modes_nearby(const PillarModel& model, std::vector<PillarMode> modes,
                                     int count) {
  if (static_cast<int>(modes.size()) != count) throw NotNearby("there are other modes");
  for (PillarMode& mode : modes) {
    const Eigen::VectorXd& x = mode.shape;
    const double mass = x.dot(model.mass_times(x));
    const double omega_1_s = std::sqrt(x.dot(model.stiffness_times(x, x)) / mass);
    mode.frequency_Hz = omega_1_s / (2.0 * std::numbers::pi);
    mode.shape /= std::sqrt(mass);
  }
  return modes;
}

double buckling_pressure_nearby_Pa(const PillarModel& axial, const PillarModel& lateral,
                                   const Eigen::VectorXd& shape) {
  const double stiffened = StressEnergy(axial).per_Pa(lateral, shape);
  return -shape.dot(lateral.stiffness_times(shape, shape)) / stiffened;
}

}  // namespace viscard
