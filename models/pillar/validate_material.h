#pragma once

#include "models/material/material.h"
#include "models/pillar/mesh/pillar_mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// One test of the pillar: the solver's result and the exact one.
struct ValidationCurve {
  std::vector<double> time_s;
  std::vector<double> solver;  // relaxation: stress in Pa; creep: shortening in m
  std::vector<double> exact;   // in the same unit
  double largest_relative_error = 0.0;
  double at_time_s = 0.0;              // time of the largest error
  double solver_error_estimate = 0.0;  // the solver's own estimate of its step error, relative
  int steps = 0;                       // time steps taken, all levels together
};

// Relaxation and creep beside the exact curves.
struct ValidationResult {
  ValidationCurve relaxation;  // shortening of strain * length held from t = 0
  ValidationCurve creep;       // pressure held from t = 0
  // Of the relaxation test, a pure number.
  double strain = 0.0;
  double pressure_Pa = 0.0;
  double diameter_m = 0.0, length_m = 0.0;
  std::string exact_method;  // a sentence for the report
  double tolerance = 0.0;
  bool passed = false;  // both errors at most the tolerance
  int unknowns = 0;
  std::vector<std::string> notes;  // remarks for the reader, plain sentences
};

// The pillar, its loads and its mesh.
struct ValidateOptions {
  PillarGeometry geometry;  // 40 um x 120 um on a fixed base
  Discretisation discretisation;
  // Of the relaxation test, a pure number.
  double strain = 0.01;
  double pressure_Pa = 1e4;
  double tolerance = 1e-6;
  double end_time_s = 0.0;  // 0: ten times the slowest relaxation or retardation time
  std::function<void(double)> progress;
};

// Runs the pillar in relaxation and in creep with the material through the time-stepping solver
// (load_history.h). It compares the results with the exact solution by the correspondence principle
// on the same elements, so the difference is the error of the time stepping alone.
//   Constant Poisson ratio (or nu = 0.5): E(t) and J(t) from the retardation spectrum, times the
//   elastic solution.
//   Otherwise: the common modes of shear and bulk stiffness (viscoelastic_exact.h).
// A rigid frictionless plate presses the top in both tests. Throws std::invalid_argument for a
// material or geometry that cannot be run.
ValidationResult validate_material(const Material& material, const ValidateOptions& options = {});

}  // namespace viscard
