#include "models/pillar/inertial_stepper.h"
#include "models/pillar/pillar_loads.h"
#include "models/pillar/scene_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// The pillar's first resonance, by the rod or by the cantilever (Euler-Bernoulli), with the
// instantaneous modulus. Source: Graff, Wave Motion in Elastic Solids (1975), ch. 2, 3. It only
// sets scales: how far the basis reaches and how long the first steps are.
double first_resonance_rad_s(const Scene& scene) {
  const double L_m = scene.geometry.length_m;
  const double speed_m_s = std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3);
  if (scene.direction == LoadDirection::kAxial) return 0.5 * std::numbers::pi * speed_m_s / L_m;
  const double gyration_m = scene.geometry.diameter_m / (scene.plane ? std::sqrt(12.0) : 4.0);
  return 3.516 * gyration_m * speed_m_s / (L_m * L_m);
}

void add_curve(const std::string& name, const std::string& unit, const std::vector<double>& time_s,
               const std::vector<double>& values, SceneAnswer& answer) {
  const double peak = *std::max_element(
      values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  answer.results.push_back({name + "_peak", peak, unit});
  answer.results.push_back({name + "_end", values.back(), unit, 0.0, std::abs(peak)});
  answer.curves.push_back({name, unit, time_s, values});
  const Spectrum spectrum = amplitude_spectrum(
      std::vector<double>(values.begin(), values.end() - 1), time_s[1] - time_s[0]);
  answer.curves.push_back(
      {name + "_spectrum", unit, spectrum.frequency_Hz, spectrum.amplitude, "frequency_Hz"});
}

}  // namespace

void check_transient(const Scene& scene) {
  if (scene.history.size() < 2) {
    throw std::invalid_argument("a transient analysis needs a history of at least two points");
  }
  if (!(scene.end_time_s > 0.0) || !std::isfinite(scene.end_time_s)) {
    throw std::invalid_argument("a transient analysis needs an end_time that is positive");
  }
  if (scene.outputs < 10 || scene.outputs > 200000) {
    throw std::invalid_argument("outputs: " + std::to_string(scene.outputs) +
                                "; it must lie between 10 and 200000");
  }
  validate(scene.history);
}

void run_transient_scene(const Scene& scene, SceneAnswer& answer) {
  const bool is_axial = scene.direction == LoadDirection::kAxial;
  const bool is_base = scene.load_place == LoadPlace::kBase;
  const Motion lateral = scene.plane ? Motion::kPlaneAntisymmetric : Motion::kLateral;
  const SceneBody body =
      body_of(scene, is_axial ? axial_motion(scene) : lateral, {.with_mass = true}, answer);
  const Eigen::VectorXd load =
      is_base
          ? Eigen::VectorXd(-unit_acceleration_force(*body.model))
          : Eigen::VectorXd((is_axial ? -1.0 : 1.0) * top_area_m2(*body.model) * body.system.load);
  // A mode's share of a displacement under a jump of load falls as (omega_1/omega)^2; what the
  // basis leaves of the higher ones is their static part.
  const double first_rad_s = first_resonance_rad_s(scene);
  const DynamicRange range{
      .lowest_rad_s = 2.0 * std::numbers::pi / scene.end_time_s,
      .highest_rad_s = first_rad_s * std::clamp(0.5 / scene.tolerance, 5.0, 60.0),
      .tolerance = 0.2 * scene.tolerance,
      .corner_rad_s = first_rad_s};
  const ReducedBody reduced = reduce_dynamic(body.system, {load}, range);
  TransientRequest request{.load = reduced.load(load), .end_s = scene.end_time_s};
  request.outputs = scene.outputs;
  request.tolerance = 0.1 * scene.tolerance;
  request.first_step_s = std::numbers::pi / (10.0 * first_rad_s);
  for (const HistoryPoint& point : scene.history) {
    request.corner_time_s.push_back(point.time_s);
    request.corner_value.push_back(point.value);
  }
  Eigen::MatrixXd observers(static_cast<Eigen::Index>(body.outputs.size()), reduced.basis.cols());
  for (std::size_t i = 0; i < body.outputs.size(); ++i) {
    observers.row(static_cast<Eigen::Index>(i)) = reduced.output(body.outputs[i].of).transpose();
  }
  const TransientResult run = run_transient(reduced.system, request, observers);
  answer.step_error =
      run.converged ? run.error_estimate + reduced.error : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < body.outputs.size(); ++i) {
    const Eigen::VectorXd row = run.values.row(static_cast<Eigen::Index>(i));
    const std::string name =
        is_base && i == 0 ? "top_displacement_from_base" : body.outputs[i].name;
    const std::vector<double> values(row.begin(), row.end());
    add_curve(name, body.outputs[i].unit, run.time_s, values, answer);
    if (i == 1 && scene.readout) {
      const ReadoutFilter filter = readout_of(scene, body, answer);
      add_curve("reading", "V", run.time_s, reading_of(filter, run.time_s, values), answer);
    }
  }
}

}  // namespace viscard
