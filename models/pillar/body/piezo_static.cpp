#include "models/pillar/body/piezo_static.h"

#include "models/pillar/body/solution_rest.h"

#include <stdexcept>

namespace viscard {

PiezoRest piezo_rest(const PillarModel& model, const PiezoSolutions& s, double work) {
  const double open_potential = s.open[model.electrode_dof()];
  const double potential_per_charge = s.charged[model.electrode_dof()];
  const SolutionRest open(model, s.open);
  const SolutionRest charged(model, s.charged);
  const SolutionRest shorted(model, s.open - open_potential / potential_per_charge * s.charged);
  const SolutionRest dual = s.dual.size() > 0 ? SolutionRest(model, s.dual) : charged;
  return {.voltage = missing_share(open, dual, open_potential),
          .charge = missing_share(shorted, dual, open_potential),
          .capacitance = missing_share(charged, charged, potential_per_charge),
          .displacement = missing_share(open, open, work)};
}

PiezoAnswer piezo_answer(const StiffnessFactor& factor, const Eigen::VectorXd& traction,
                         int electrode, double scale_V, double pressure_Pa) {
  const double area = traction.sum();
  Eigen::VectorXd unit_charge = Eigen::VectorXd::Zero(traction.size());
  unit_charge[electrode] = 1.0;
  // Row of the electrode: (charge that leaves it) * scale, because phi = scale * unknown and the
  // electric part of the form is negative.
  PiezoAnswer answer;
  answer.open.unknowns = factor.solve(-pressure_Pa * traction, &answer.open.pressure_source);
  const Eigen::VectorXd by_charge = factor.solve(unit_charge);
  answer.voltage_V = answer.open.unknowns[electrode] * scale_V;
  answer.top_displacement_m = traction.dot(answer.open.unknowns) / area;
  // Work of a charge Q at potential V is -Q V in the coupled form, so the load of Q is -Q scale.
  const double V_per_C = -by_charge[electrode] * scale_V * scale_V;
  answer.capacitance_F = 1.0 / V_per_C;
  answer.charge_C = -answer.voltage_V / V_per_C;
  const double u_per_C = -traction.dot(by_charge) / area * scale_V;
  answer.displacement_per_V_m = u_per_C / V_per_C;
  answer.by_charge = by_charge;
  return answer;
}

PiezoAnswer piezo_static(const PillarModel& model, double pressure_Pa) {
  const int electrode = model.electrode_dof();
  if (electrode < 0) {
    throw std::invalid_argument("the film has no electrode; its voltage is undefined");
  }
  const Eigen::VectorXd traction = model.top_traction();
  PiezoAnswer answer =
      piezo_answer(model.factored(), traction, electrode, model.potential_scale_V(), pressure_Pa);
  if (model.nearby() != nullptr) return answer;  // its errors are those of the nearby pillar
  answer.rest = piezo_rest(model, {answer.open.unknowns, answer.by_charge, {}},
                           pressure_Pa * traction.dot(answer.open.unknowns));
  return answer;
}

PermittivityChange permittivity_change(const PillarModel& model, const PiezoAnswer& answer) {
  Medium dielectric;
  dielectric.permittivity_F_m = model.medium(kFilmRegion).permittivity_F_m;
  const SymmetricSparse form = model.system().form(model.system().kinematics().strain_and_field(),
                                                   {{}, material_form(dielectric, true, false)});
  const double scale_V = model.potential_scale_V();
  const Eigen::VectorXd by_charge = times(form, answer.by_charge);
  const double work = -by_charge.dot(answer.by_charge) * scale_V * scale_V;  // per C^2
  PermittivityChange change{.dielectric_F = work * answer.capacitance_F * answer.capacitance_F};
  if (answer.voltage_V == 0.0) return change;
  const double voltage = -scale_V * by_charge.dot(answer.open.unknowns) / answer.voltage_V;
  change.charge_share = voltage + change.dielectric_F / answer.capacitance_F;
  return change;
}

PillarState piezo_sampled(const PillarModel& model, double pressure_Pa) {
  return model.solve(-pressure_Pa * model.top_traction());
}

double potential_at_V(const PillarModel& model, const PillarState& state, double x, double z) {
  return potential_in_V(model, state, model.element_at(x, z, kFilmRegion), x, z);
}

double potential_in_V(const PillarModel& model, const PillarState& state,
                      const SectionElement& element, double x, double z) {
  const OperatorRow value = {{model.system().kinematics().potential_field, 0, 0, 0, 1.0}};
  return model.potential_scale_V() *
         model.system().rows_at({value}, state.unknowns, element, x, z)[0];
}

double mean_potential_V(const PillarModel& model, const PillarState& state, double z,
                        double radius_m) {
  const LineMesh& line = model.mesh().section.x();
  const bool is_axisymmetric = model.system().kinematics().x_power == 1;
  double sum_V = 0.0;
  double area = 0.0;
  for (int column = 0; column < line.element_count(); ++column) {
    const LineMesh::ElementRule rule = line.rule(column);
    for (Eigen::Index i = 0; i < rule.x.size() && rule.x[i] < radius_m; ++i) {
      const double weight = rule.weight[i] * (is_axisymmetric ? rule.x[i] : 1.0);
      sum_V += weight * potential_at_V(model, state, rule.x[i], z);
      area += weight;
    }
  }
  return sum_V / area;
}

}  // namespace viscard
