#include "models/pillar/body/nearby_pillar.h"

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

std::vector<PillarMode> modes_nearby(const PillarModel& model, int count) {
  std::vector<PillarMode> modes = model.nearby()->modes();
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

void PillarModel::require_nearby(const DofMap& dofs) const {
  const PillarModel& other = nearby_->model();
  const bool has_same_elements =
      mesh_.section.elements() == other.mesh_.section.elements() && dofs == other.system().dofs();
  if (!has_same_elements) throw NotNearby("the mesh has other elements");
  for (std::size_t i = 0; i < media_.size(); ++i) {
    if (condenses_pressure(media_[i]) != condenses_pressure(other.media_[i])) {
      throw NotNearby("pressures are condensed in one of two materials alone");
    }
    const bool is_incompressible = std::isinf(media_[i].bulk_Pa);
    if (is_incompressible != std::isinf(other.media_[i].bulk_Pa) ||
        (is_incompressible && !(geometry_ == other.geometry_))) {
      throw NotNearby("an incompressible pillar has other lengths");
    }
  }
}

}  // namespace viscard
