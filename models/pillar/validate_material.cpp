#include "models/pillar/validate_material.h"

#include "models/material/retardation_spectrum.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/viscoelastic_exact.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace viscard {
namespace {

// Relaxation force per displacement and creep displacement per force, both exact.
struct ExactAnswer {
  std::function<double(double)> relaxation;
  std::function<double(double)> creep;
  std::string method;
};

ExactAnswer exact_answer(const Material& material, const ViscoelasticSystem& system) {
  if (material.nu == 0.5 || has_constant_poisson_ratio(material)) {
    // One factor for the whole body: E(t)/E_0 and E_0 J(t) times the elastic answer.
    ViscoelasticStepper elastic(system);
    elastic.advance(0.0, Control::kForce, 1.0);
    const double compliance_m_N = elastic.displacement();
    const PronySeries series = young_series(material);
    const RetardationSpectrum spectrum = retardation_from_relaxation(series);
    const double E0_Pa = instantaneous_modulus_Pa(series);
    return {[=](double t) { return relaxation_modulus_Pa(series, t) / E0_Pa / compliance_m_N; },
            [=](double t) { return creep_compliance_1_Pa(spectrum, t) * E0_Pa * compliance_m_N; },
            "constant Poisson ratio: E(t) and the retardation spectrum's J(t) times the elastic "
            "answer"};
  }
  const auto body = std::make_shared<ExactViscoelasticBody>(system);
  return {[body](double t) { return body->relaxation_force(t); },
          [body](double t) { return body->creep_displacement(t); },
          "shear and bulk relax differently: common modes of both stiffnesses, inverted from the "
          "Laplace domain"};
}

// End of the creep test. Creep is slower than relaxation, so it uses the slowest retardation time
// of G(t), and of K(t) if K relaxes.
double end_of_creep_s(const Material& material) {
  double slowest_s = relaxation_times(material.terms).slowest_s;
  for (auto share : {&MaterialTerm::g, &MaterialTerm::k}) {
    PronySeries series{1.0, {}};
    for (const MaterialTerm& term : material.terms) {
      series.equilibrium_modulus_Pa -= term.*share;
      series.terms.push_back({term.*share, term.tau_s});
    }
    for (const RetardationTerm& term : retardation_from_relaxation(series).terms) {
      slowest_s = std::max(slowest_s, term.retardation_time_s);
    }
  }
  return slowest_s > 0.0 ? 10.0 * slowest_s : 1.0;
}

ValidationCurve compare(const HistoryResult& run, const std::vector<double>& solver, double scale,
                        const std::function<double(double)>& exact) {
  ValidationCurve curve;
  curve.solver_error_estimate = run.error_estimate;
  curve.steps = run.steps;
  for (std::size_t i = 1; i < run.time_s.size(); ++i) {  // the first is the state before the jump
    const double time_s = run.time_s[i];
    curve.time_s.push_back(time_s);
    curve.solver.push_back(solver[i] * scale);
    curve.exact.push_back(exact(time_s) * scale);
    const double error = std::abs(curve.solver.back() / curve.exact.back() - 1.0);
    if (!(error <= curve.largest_relative_error)) {  // a NaN stays
      curve.largest_relative_error = error;
      curve.at_time_s = time_s;
    }
  }
  return curve;
}

}  // namespace

ValidationResult validate_material(const Material& material, const ValidateOptions& options) {
  if (!(options.tolerance > 0.0) || !(options.strain > 0.0) || !(options.pressure_Pa > 0.0)) {
    throw std::invalid_argument(
        "strain, pressure and tolerance of the validation must be positive");
  }
  const ViscoelasticPillar pillar(options.geometry, options.discretisation, material,
                                  TopCondition::kRigidPlate);
  const ViscoelasticSystem& system = pillar.system();
  const ExactAnswer exact = exact_answer(material, system);
  const double end_s = options.end_time_s > 0.0 ? options.end_time_s : end_of_creep_s(material);
  const Course step = {{0.0, 1.0}, {end_s, 1.0}};

  ValidationResult result;
  result.strain = options.strain;
  result.pressure_Pa = options.pressure_Pa;
  result.diameter_m = options.geometry.diameter_m;
  result.length_m = options.geometry.length_m;
  result.exact_method = exact.method;
  result.tolerance = options.tolerance;
  result.unknowns = pillar.model().system().size();

  HistoryOptions history;
  history.tolerance = 0.02 * options.tolerance;  // well below the tested one
  history.relative_floor = 0.0;                  // relative at every time
  const auto part = [&](double offset) {
    return [&, offset](double fraction) {
      if (options.progress) options.progress(offset + 0.5 * fraction);
    };
  };
  history.progress = part(0.0);
  const HistoryResult relaxation = run_history(system, Control::kDisplacement, step, history);
  const double shortening_m = options.strain * options.geometry.length_m;
  result.relaxation =
      compare(relaxation, relaxation.force, shortening_m / pillar.top_area_m2(), exact.relaxation);
  history.progress = part(0.5);
  const HistoryResult creep = run_history(system, Control::kForce, step, history);
  result.creep =
      compare(creep, creep.displacement, options.pressure_Pa * pillar.top_area_m2(), exact.creep);
  result.passed = result.relaxation.largest_relative_error <= options.tolerance &&
                  result.creep.largest_relative_error <= options.tolerance;
  for (const MaterialFlag& flag :
       material.flags) {  // the solver is right, perhaps not the material
    if (flag.term == 0) result.notes.push_back(flag.name + ": " + flag.text);
  }
  if (material.terms.empty()) {
    result.notes.push_back("The material has no relaxation terms; both tests are elastic.");
  }
  if (!creep.converged || !relaxation.converged) {
    result.notes.push_back("The step sizes did not settle to the accuracy aimed at.");
  }
  return result;
}

}  // namespace viscard
