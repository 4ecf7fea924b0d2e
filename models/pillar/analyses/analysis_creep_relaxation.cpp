// Creep and relaxation: a history of pressure or shortening, without inertia.
#include "models/answer/scene_mistake.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/scene_body.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/model_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

double signed_peak_of(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

void add_quasi_static_curve(const std::string& name, const std::string& unit,
                            const std::vector<double>& time_s, const std::vector<double>& values,
                            SceneAnswer& answer) {
  const double peak = signed_peak_of(values);
  answer.results.push_back({name + "_end", values.back(), unit, 0.0, std::abs(peak)});
  answer.results.push_back({name + "_peak", peak, unit, 0.0});
  answer.curves.push_back({name, unit, time_s, values});
}

// Times after every corner of the load that resolve the decay of what is read.
std::vector<double> times_of_decay(const Course& history,
                                   const std::vector<BodyReading>& readings) {
  std::vector<double> after_s;
  for (const BodyReading& reading : readings) {
    for (const MaxwellTerm& term : reading.filter.step.terms) {
      for (const double share : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0}) {
        after_s.push_back(share * term.relaxation_time_s);
      }
    }
  }
  // The terms of one film stand close; the next corner begins its own.
  constexpr double kApart = 1.4;
  std::sort(after_s.begin(), after_s.end());
  std::vector<double> times_s;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double end_s =
        i + 1 < history.size() ? history[i + 1].time_s : std::numeric_limits<double>::infinity();
    double last_s = 0.0;
    for (const double one_s : after_s) {
      if (one_s < kApart * last_s || history[i].time_s + one_s >= end_s) continue;
      times_s.push_back(history[i].time_s + one_s);
      last_s = one_s;
    }
  }
  return times_s;
}

// Sum of |changes| of the history over its largest value.
double total_variation(const Course& points) {
  double last = 0.0, sum = 0.0;
  for (const CoursePoint& point : points) {
    sum += std::abs(point.value - last);
    last = point.value;
  }
  const double peak = largest_size(points);
  return peak > 0.0 ? sum / peak : 1.0;
}

void check_quasi_static(const PillarScene& scene) {
  const Course& points = history(scene);
  if (points.size() < 2) {
    throw SceneMistake("analysis.history",
                       "creep and relaxation need a history of at least two points, such as [[\"0 "
                       "s\", \"10 kPa\"], [\"10 s\", \"10 kPa\"]]");
  }
  validate_history(points);
  if (points.front().time_s != 0.0 || !(points.back().time_s > 0.0)) {
    throw SceneMistake("analysis.history", "a history starts at 0 s and ends later");
  }
  if (largest_size(points) == 0.0) {
    throw SceneMistake("analysis.history", "nothing happens: every value of the history is zero");
  }
}

SceneBody quasi_static_body(const PillarScene& scene, Control control, SceneAnswer& answer) {
  return body_of(scene, axial_motion(scene), {.rigid_top = control == Control::kDisplacement},
                 answer);
}

// The tolerance of the basis and of the steps, each.
double small_share(const PillarScene& scene) {
  return 0.03 * scene.tolerance;
}

QuasiStaticGoals goals_of(const PillarScene& scene, const SceneBody& body) {
  QuasiStaticGoals goals{.tolerance = small_share(scene)};
  for (std::size_t i = 1; i < body.outputs.size(); ++i) {
    goals.outputs.push_back(body.outputs[i].row);
  }
  return goals;
}

// Steps through the history, at one level if it is given.
HistoryResult stepped(const PillarScene& scene, const SceneBody& body, const ReducedBody& reduced,
                      const std::vector<BodyReading>& readings, Control control,
                      std::optional<int> level) {
  Course points = history(scene);
  const double unit = control == Control::kForce ? -top_area_m2(*body.model) : -1.0;
  for (CoursePoint& point : points) point.value *= unit;
  HistoryOptions options;
  options.tolerance = small_share(scene);
  options.only_level = level;
  for (const BodyOutput& output : body.outputs) {
    options.observers.push_back(reduced.load(output.row));
  }
  options.output_times_s = times_of_decay(history(scene), readings);
  if (scene.readout || !options.output_times_s.empty()) {
    options.first_steps = 32;  // a reading takes the voltage as linear between recorded times
  }
  return run_history(reduced.system, control, points, options);
}

void run_quasi_static(const PillarScene& scene, Control control, SceneAnswer& answer) {
  const bool is_creep = control == Control::kForce;
  const SceneBody body = quasi_static_body(scene, control, answer);
  const NearbyPillar* nearby = nearby_of(scene, axial_motion(scene), scene.electrodes.has_value());
  const ReducedBody reduced = nearby == nullptr
                                  ? reduce_quasi_static(body.system, goals_of(scene, body))
                                  : restricted_to(body.system, nearby->reduced().basis);
  const std::vector<BodyReading> readings = readings_of(scene, body, answer);
  std::optional<int> level;
  if (nearby != nullptr) level = nearby->reduced().level;
  const HistoryResult run = stepped(scene, body, reduced, readings, control, level);
  if (!run.converged) {
    throw std::runtime_error("the time steps did not converge to the tolerance of " +
                             text_of(scene.tolerance) + "; ask for a larger one");
  }
  // A voltage at a given shortening is a quotient of two outputs.
  const bool is_quotient = !is_creep && body.outputs.size() > 1;
  answer.step_error = run.error_estimate + (is_quotient ? 2.0 : 1.0) * reduced.error;
  if (is_creep) {
    add_quasi_static_curve("top_displacement", "m", run.time_s, run.observed[0], answer);
  } else {
    std::vector<double> pressure_Pa = run.force;
    for (double& value : pressure_Pa) value *= -1.0 / top_area_m2(*body.model);
    add_quasi_static_curve("top_pressure", "Pa", run.time_s, pressure_Pa, answer);
  }
  for (const BodyReading& reading : readings) {
    add_quasi_static_curve(reading.name, reading.unit, run.time_s,
                           reading_of(reading.filter, run.time_s, run.observed[reading.output]),
                           answer);
    note_film_error(reading, answer);
  }
}

// The basis of this pillar serves its neighbours. It holds solutions and dual solutions so accurately that
// derivatives of the outputs are right; the steps are as long as in the pillar's own answer.
NearbyPillars quasi_static_nearby(const PillarScene& scene, const Discretisation& mesh,
                                  Control control) {
  constexpr double kOfSolutions = 1e-7, kAllowed = 1e-6;  // in the energy norm
  SceneAnswer scratch;
  scratch.discretisation = mesh;
  const SceneBody body = quasi_static_body(scene, control, scratch);
  QuasiStaticGoals goals = goals_of(scene, body);
  goals.of_solutions = kOfSolutions;
  const ReducedBody reduced = reduce_quasi_static(body.system, goals);
  NearbyPillars nearby;
  if (!(reduced.error_of_solutions <= kAllowed)) return nearby;
  const HistoryResult run =
      stepped(scene, body, reduced, readings_of(scene, body, scratch), control, {});
  nearby.push_back(
      std::make_unique<NearbyPillar>(scene.geometry, mesh, media_of(scene), body.model->options()));
  if (scene.readout || !scene.film_loss.is_lossless()) nearby.back()->solve();
  nearby.back()->keep_reduced({nearby_basis(body.system, reduced.basis, goals.outputs), run.level});
  return nearby;
}

// Estimate of leaving relaxation out, from the relative loss of modulus or compliance at the end of
// the history (eq. E3): the largest relative deviation from the elastic answer.
EffectEstimate relaxation_over_history(const PillarScene& scene, double lost_at_end) {
  const double share = lost_at_end * total_variation(history(scene));
  return {EffectRole::kOptional, share, "relaxed share at the end", share,
          "the modulus that is lost over the history"};
}

double creep_push_Pa(const PillarScene& scene) {
  double largest_Pa = 0.0;
  for (const CoursePoint& point : history(scene)) largest_Pa = std::max(largest_Pa, point.value);
  return largest_Pa;
}

EffectEstimate creep_relaxation(const PillarScene& scene, const EffectEstimate&) {
  const PronySeries series = largest_relaxation(scene.pillar);
  const double E0_Pa = instantaneous_modulus_Pa(series);
  const double J_1_Pa =
      creep_compliance_1_Pa(retardation_from_relaxation(series), history(scene).back().time_s);
  return relaxation_over_history(scene, J_1_Pa * E0_Pa - 1.0);
}

EffectEstimate relaxation_lost(const PillarScene& scene, const EffectEstimate&) {
  const PronySeries series = largest_relaxation(scene.pillar);
  const double E_Pa = relaxation_modulus_Pa(series, history(scene).back().time_s);
  return relaxation_over_history(scene, 1.0 - E_Pa / instantaneous_modulus_Pa(series));
}

}  // namespace

Analysis creep_analysis() {
  return {.name = "creep",
          .drive = CreepDrive{},
          .relaxes = true,
          .follows_creep = true,
          .history = HistoryOf::kPressure,
          .check = check_quasi_static,
          .result_names =
              [](const PillarScene& scene) {
                return moving_names(scene, "top_displacement", {"_end", "_peak"});
              },
          .run = [](const PillarScene& scene,
                    SceneAnswer& answer) { run_quasi_static(scene, Control::kForce, answer); },
          .push_Pa = creep_push_Pa,
          .solve_nearby =
              [](const PillarScene& scene, const Discretisation& mesh) {
                return quasi_static_nearby(scene, mesh, Control::kForce);
              },
          .relaxation = creep_relaxation};
}

Analysis relaxation_analysis() {
  return {
      .name = "relaxation",
      .drive = RelaxationDrive{},
      .relaxes = true,
      .history = HistoryOf::kShortening,
      .check = check_quasi_static,
      .result_names =
          [](const PillarScene& scene) {
            return moving_names(scene, "top_pressure", {"_end", "_peak"});
          },
      .run = [](const PillarScene& scene,
                SceneAnswer& answer) { run_quasi_static(scene, Control::kDisplacement, answer); },
      .solve_nearby =
          [](const PillarScene& scene, const Discretisation& mesh) {
            return quasi_static_nearby(scene, mesh, Control::kDisplacement);
          },
      .relaxation = relaxation_lost};
}

}  // namespace viscard
