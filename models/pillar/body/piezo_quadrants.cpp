#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/solution_rest.h"

#include <numbers>
#include <stdexcept>

namespace viscard {

QuadrantAnswer piezo_quadrants(const PillarModel& lateral, double force_N) {
  const int electrode = lateral.electrode_dof();
  if (electrode < 0 || lateral.options().motion != Motion::kLateral) {
    throw std::invalid_argument("quadrants need a round electrode and a sideways motion");
  }
  const Eigen::VectorXd push = unit_top_force(lateral);
  Eigen::VectorXd unit_charge = Eigen::VectorXd::Zero(push.size());
  unit_charge[electrode] = 1.0;
  const StiffnessFactor factor = lateral.factored();
  Eigen::VectorXd source_by_charge;
  const Eigen::VectorXd by_charge = factor.solve(unit_charge, &source_by_charge);
  QuadrantAnswer answer;
  PillarState& state = answer.shorted;
  state.unknowns = factor.solve(force_N * push, &state.pressure_source);
  // The charge that brings the amplitude of the potential back to zero.
  const double open_potential = state.unknowns[electrode];
  const double charge = -open_potential / by_charge[electrode];
  state.unknowns += charge * by_charge;
  state.pressure_source += charge * source_by_charge;
  // The load of a charge Q is -Q scale (piezo_static.cpp), and the charge conjugate to the
  // amplitude is pi int D r dr.
  const double scale_V = lateral.potential_scale_V();
  answer.charge_C = -charge / scale_V / std::numbers::pi;
  answer.top_displacement_m = push.dot(state.unknowns);
  const double per_V = 4.0 / std::numbers::pi / (by_charge[electrode] * scale_V);
  answer.driven_per_V = {per_V * by_charge, per_V * source_by_charge};
  answer.displacement_per_V_m = push.dot(answer.driven_per_V.unknowns);
  if (lateral.nearby() != nullptr) return answer;  // its errors are those of the nearby pillar
  const SolutionRest shorted(lateral, state.unknowns);
  answer.rest.displacement = missing_share(shorted, shorted, force_N * answer.top_displacement_m);
  answer.rest.charge = missing_share(shorted, SolutionRest(lateral, by_charge), open_potential);
  return answer;
}

Eigen::VectorXd quadrant_charge_row(const PillarModel& lateral, const SymmetricSparse& stiffness) {
  const int electrode = lateral.electrode_dof();
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(stiffness.rows());
  unit[electrode] = 1.0;
  Eigen::VectorXd row = times(stiffness, unit);
  row[electrode] = 0.0;
  return -row / (lateral.potential_scale_V() * std::numbers::pi);
}

double quadrant_mean_V(const PillarModel& lateral, const PillarState& state, double z,
                       double radius_m) {
  const bool is_round = lateral.system().kinematics().x_power == 1;
  return (is_round ? 2.0 / std::numbers::pi : 1.0) * mean_potential_V(lateral, state, z, radius_m);
}

}  // namespace viscard
