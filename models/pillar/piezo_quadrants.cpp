#include "models/pillar/piezo_quadrants.h"

#include "models/pillar/pillar_loads.h"

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
  StiffnessFactor factor;
  lateral.factor(lateral.stiffness(), factor);
  Eigen::VectorXd source_by_charge;
  const Eigen::VectorXd by_charge = factor.solve(unit_charge, &source_by_charge);
  QuadrantAnswer answer;
  PillarState& state = answer.shorted;
  state.unknowns = factor.solve(force_N * push, &state.pressure_source);
  // As much charge as brings the amplitude of the potential back to zero.
  const double charge = -state.unknowns[electrode] / by_charge[electrode];
  state.unknowns += charge * by_charge;
  state.pressure_source += charge * source_by_charge;
  // The load of a charge Q is -Q scale (piezo_static.cpp), and what works on the amplitude is pi
  // int D r dr.
  const double scale_V = lateral.potential_scale_V();
  answer.charge_C = -charge / scale_V / std::numbers::pi;
  answer.top_displacement_m = push.dot(state.unknowns);
  answer.displacement_per_V_m =
      4.0 / std::numbers::pi * push.dot(by_charge) / (by_charge[electrode] * scale_V);
  return answer;
}

double quadrant_mean_V(const PillarModel& lateral, const PillarState& state, double z,
                       double radius_m) {
  const bool is_round = lateral.system().kinematics().x_power == 1;
  return (is_round ? 2.0 / std::numbers::pi : 1.0) * mean_potential_V(lateral, state, z, radius_m);
}

}  // namespace viscard
