#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// Static response of a pillar on a piezoelectric film, with elasticity and potential solved
// together (eq. 20). Charges are in C; for the strip of plane motions, per metre of thickness.
// Relative errors that the solutions themselves show (solution_rest.h), of answers per unit force
// or voltage. The charge per force is also the displacement per volt.
struct PiezoRest {
  // Relative errors, pure numbers.
  double voltage = 0.0, charge = 0.0, capacitance = 0.0, displacement = 0.0;
};

// The answer of one pillar on a film.
struct PiezoAnswer {
  double voltage_V = 0.0;           // electrode open (no charge flows)
  double charge_C = 0.0;            // electrode shorted to ground: charge that flows onto it
  double capacitance_F = 0.0;       // mechanically free: charge per volt without load
  double dielectric_F = 0.0;        // its part by permittivity, if permittivity_change() has set it
  double top_displacement_m = 0.0;  // mean, electrode open
  double displacement_per_V_m = 0.0;  // actuator: mean top displacement per volt on the electrode
  PillarState open;                   // solution with the electrode open
  Eigen::VectorXd by_charge;          // for a unit entry of the electrode
  PiezoRest rest;                     // of one pillar with a film averaged in its plane
};

// The model must have electrodes with a radius. Throws std::invalid_argument otherwise.
PiezoAnswer piezo_static(const PillarModel& model, double pressure_Pa);

// The same from a factored matrix: `traction` is the force per unit pressure pulling along +z on
// the top, `electrode` the unknown of its potential.
PiezoAnswer piezo_answer(const StiffnessFactor& factor, const Eigen::VectorXd& traction,
                         int electrode, double scale_V, double pressure_Pa);

// How an answer changes with the permittivity at constant strain, in all directions alike, at once and
// to first order: dC/d(ln eps), and the relative change of the shorted electrode's charge per d(ln eps).
// The charge hardly changes, because the strain that makes it does not: only what the film's field
// acts back on it does.
struct PermittivityChange {
  double dielectric_F = 0.0;
  double charge_share = 0.0;  // a pure number
};
PermittivityChange permittivity_change(const PillarModel& model, const PiezoAnswer& answer);

// Solutions of one model: with the electrode open under a load, and for a unit entry of the
// electrode. `dual` is the dual solution of the voltage if that is not `charged`.
struct PiezoSolutions {
  Eigen::VectorXd open, charged, dual;
};
// Their errors; work is that of the unit load on the solution, N m, to which the errors are relative.
PiezoRest piezo_rest(const PillarModel& model, const PiezoSolutions& solutions, double work);

// Solution with a charge-free face instead of an electrode; potential_at_V() reads it.
PillarState piezo_sampled(const PillarModel& model, double pressure_Pa);
double potential_at_V(const PillarModel& model, const PillarState& state, double x, double z);
// The same in the element that contains the point.
double potential_in_V(const PillarModel& model, const PillarState& state,
                      const SectionElement& element, double x, double z);
// Mean potential over the disc (half-width in the plane) x <= radius of the film at height z.
double mean_potential_V(const PillarModel& model, const PillarState& state, double z,
                        double radius_m);

// The film's potential from the strain of an uncoupled body. It solves two smaller systems instead
// of one,
//   c S(u) = T(load),  then  div(eps grad phi) = div(e S(u)),
// with a relative error of about k^2 of the film (eq. E2). `elastic` has no electrodes, but its
// mesh contains the break at the electrode's edge; `electric` has the electrodes on the same mesh
// and provides only its potentials. Capacitance and charge are those of a clamped film.
// displacement_per_V_m stays 0. Throws std::invalid_argument unless the electric model has an
// electrode with a radius.
PiezoAnswer piezo_one_way(const PillarModel& elastic, const PillarModel& electric,
                          double pressure_Pa);

// The same from a motion of the elastic model's body that something else has found, such as one at
// large strain: voltage, charge and capacitance; errors and displacements stay 0.
PiezoAnswer piezo_from_motion(const PillarModel& elastic, const PillarModel& electric,
                              const Eigen::VectorXd& motion);
// Its potentials with the electrode open, or with a charge-free face: the unknowns of the electric model.
PillarState potential_from_motion(const PillarModel& elastic, const PillarModel& electric,
                                  const Eigen::VectorXd& motion);

// The same with a charge-free face. Returns the unknowns of the electric model, for
// potential_at_V().
PillarState piezo_one_way_sampled(const PillarModel& elastic, const PillarModel& electric,
                                  double pressure_Pa);

// A round electrode divided into four quadrants along x and y, under loads along x. The motion of
// the pillar, the field and the charge on the film's face then vary as cos(theta). Opposite halves
// read opposite values, so one quadrant on the +x side is enough: its charge is int D r dr, because
// int_0^(pi/2) cos(theta) = 1, and its mean voltage is 2/pi of the amplitude.
struct QuadrantAnswer {
  double charge_C = 0.0;  // all shorted: flows onto each of the two quadrants toward +x
  // Of the top along +x, with 1 V on the halves toward +x and -1 V on the others.
  double displacement_per_V_m = 0.0;
  double top_displacement_m = 0.0;  // mean, all shorted
  PillarState shorted;
  PillarState driven_per_V;  // without force, 1 and -1 V on the halves
  PiezoRest rest;            // of displacement and charge
};

// Solution under a force along x on the top, for a lateral model whose electrode has a radius. A
// potential of +-1 V on the two halves has the first harmonic 4/pi cos(theta); no other harmonic
// moves the pillar as a whole. Under the force, with all quadrants shorted, there are no other
// harmonics, so the gaps can be ignored. Throws std::invalid_argument for another model.
QuadrantAnswer piezo_quadrants(const PillarModel& lateral, double force_N);

// The same charge as a functional of a motion with all quadrants shorted: charge_C = row.dot(u)
// without the entry of the electrode itself. `stiffness` is that of the model.
Eigen::VectorXd quadrant_charge_row(const PillarModel& lateral, const SymmetricSparse& stiffness);

// Mean over one quadrant (in the plane: the half toward +x) of the potential of a charge-free face.
double quadrant_mean_V(const PillarModel& lateral, const PillarState& state, double z,
                       double radius_m);

}  // namespace viscard
