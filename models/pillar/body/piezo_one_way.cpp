#include "models/pillar/body/piezo_static.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// The linear system of the potentials alone, and its right-hand side from strain.
class FilmPotential {
 public:
  explicit FilmPotential(const PillarModel& electric) : electric_(electric) {
    Eigen::MatrixXd form =
        material_form(electric.medium(kFilmRegion), true, electric.is_plane_stress());
    form.topLeftCorner(6, 6).setZero();
    form_ = electric.system().form(electric.system().kinematics().strain_and_field(), {{}, form});
    number_potentials();
    factor_.factor(potential_block());
  }

  // Forces of a potential on the elastic body, in the numbering of the electric model.
  Eigen::VectorXd forces_of(const Eigen::VectorXd& potential) const {
    return times(form_, potential);
  }
  // Unknowns of the electric model for the strain of `u`, with the electrode open.
  Eigen::VectorXd from_strain(const Eigen::VectorXd& u) const {
    return expanded(factor_.solve(times(form_, u)(dof_)));
  }
  // For a unit charge row on the electrode, in the sign of piezo_static().
  Eigen::VectorXd from_electrode() const {
    Eigen::VectorXd charge = Eigen::VectorXd::Zero(form_.rows());
    charge[electric_.electrode_dof()] = 1.0;
    return -expanded(factor_.solve(charge(dof_)));
  }

 private:
  void number_potentials() {
    const DofMap& dofs = electric_.system().dofs();
    const int phi = electric_.system().kinematics().potential_field;
    place_.assign(static_cast<std::size_t>(dofs.count()), -1);
    for (int node = 0; node < electric_.system().section().node_count(); ++node) {
      const int dof = dofs.dof(phi, node);
      if (dof < 0 || place_[static_cast<std::size_t>(dof)] >= 0) continue;
      place_[static_cast<std::size_t>(dof)] = static_cast<int>(dof_.size());
      dof_.push_back(dof);
    }
  }
  // The electric block of the form is negative definite, so its negative is factored.
  SymmetricSparse potential_block() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < form_.outerSize(); ++column) {
      const int j = place_[static_cast<std::size_t>(column)];
      if (j < 0) continue;
      for (SymmetricSparse::InnerIterator it(form_, column); it; ++it) {
        const int i = place_[static_cast<std::size_t>(it.row())];
        if (i >= 0) entries.emplace_back(std::max(i, j), std::min(i, j), -it.value());
      }
    }
    const auto n = static_cast<Eigen::Index>(dof_.size());
    SymmetricSparse block(n, n);
    block.setFromTriplets(entries.begin(), entries.end());
    return block;
  }
  Eigen::VectorXd expanded(const Eigen::VectorXd& part) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(form_.rows());
    all(dof_) = part;
    return all;
  }

  const PillarModel& electric_;
  SymmetricSparse form_;
  std::vector<int> dof_;    // dof of each potential
  std::vector<int> place_;  // index of the potential of each dof; -1 for displacements
  StiffnessFactor factor_;
};

// Displacements of one model in the numbering of another on the same mesh, potentials zero.
Eigen::VectorXd renumbered(const PillarModel& from, const PillarModel& to,
                           const Eigen::VectorXd& u) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(to.system().size());
  const int fields = std::min(from.system().kinematics().field_count,
                              to.system().kinematics().field_count);  // the potential is the last
  for (int field = 0; field < fields; ++field) {
    for (int node = 0; node < to.system().section().node_count(); ++node) {
      const int target = to.system().dofs().dof(field, node);
      const int source = from.system().dofs().dof(field, node);
      if (target >= 0 && source >= 0) all[target] = u[source];
    }
  }
  return all;
}

void require_same_mesh(const PillarModel& elastic, const PillarModel& electric) {
  if (elastic.system().section().node_count() != electric.system().section().node_count()) {
    throw std::invalid_argument("the elastic and the electric model need the same mesh");
  }
}

void require_electrode(const PillarModel& electric) {
  if (electric.electrode_dof() < 0) {
    throw std::invalid_argument("the film has no electrode; its voltage is undefined");
  }
}

// Voltage, charge and capacitance of a film whose elastic body moves by u, in the numbering of the
// electric model.
PiezoAnswer answer_of(const FilmPotential& film, const PillarModel& electric,
                      const Eigen::VectorXd& u) {
  const int electrode = electric.electrode_dof();
  const double scale_V = electric.potential_scale_V();
  PiezoAnswer answer;
  answer.open.unknowns = u + film.from_strain(u);
  answer.by_charge = film.from_electrode();
  answer.voltage_V = answer.open.unknowns[electrode] * scale_V;
  const double V_per_C = -answer.by_charge[electrode] * scale_V * scale_V;
  answer.capacitance_F = 1.0 / V_per_C;
  answer.charge_C = -answer.voltage_V / V_per_C;
  return answer;
}

}  // namespace

PillarState potential_from_motion(const PillarModel& elastic, const PillarModel& electric,
                                  const Eigen::VectorXd& motion) {
  require_same_mesh(elastic, electric);
  const Eigen::VectorXd u = renumbered(elastic, electric, motion);
  const Eigen::VectorXd both = u + FilmPotential(electric).from_strain(u);
  return {both, both};
}

PiezoAnswer piezo_from_motion(const PillarModel& elastic, const PillarModel& electric,
                              const Eigen::VectorXd& motion) {
  require_same_mesh(elastic, electric);
  require_electrode(electric);
  return answer_of(FilmPotential(electric), electric, renumbered(elastic, electric, motion));
}

PiezoAnswer piezo_one_way(const PillarModel& elastic, const PillarModel& electric,
                          double pressure_Pa) {
  require_same_mesh(elastic, electric);
  require_electrode(electric);
  const Eigen::VectorXd force = -pressure_Pa * elastic.top_traction();
  StiffnessFactor factor;
  elastic.factor(elastic.stiffness(), factor);
  PillarState state;
  state.unknowns = factor.solve(force, &state.pressure_source);
  const FilmPotential film(electric);
  const PiezoAnswer by_film =
      answer_of(film, electric, renumbered(elastic, electric, state.unknowns));
  const Eigen::VectorXd by_charge =
      factor.solve(renumbered(electric, elastic, film.forces_of(by_film.by_charge)));
  const Eigen::VectorXd dual = by_film.by_charge + renumbered(elastic, electric, by_charge);
  PiezoAnswer answer = by_film;
  answer.by_charge.resize(0);
  answer.rest = piezo_rest(electric, {by_film.open.unknowns, by_film.by_charge, dual},
                           force.dot(state.unknowns));
  answer.top_displacement_m = elastic.mean_top_displacement_m(state);
  answer.open = state;
  return answer;
}

PillarState piezo_one_way_sampled(const PillarModel& elastic, const PillarModel& electric,
                                  double pressure_Pa) {
  const PillarState state = elastic.solve(-pressure_Pa * elastic.top_traction());
  return potential_from_motion(elastic, electric, state.unknowns);
}

}  // namespace viscard
