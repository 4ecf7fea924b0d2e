#include "models/answer/scene_mistake.h"
#include "models/maths/dense.h"
#include "models/maths/require.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/scene_body.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/modal_response.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/motion_peak.h"
#include "models/pillar/time/transient_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

const TransientDrive& transient_drive(const PillarScene& scene) {
  return std::get<TransientDrive>(scene.drive);
}

// The pillar's first resonance as a rod or as a cantilever (Euler-Bernoulli), with the
// instantaneous modulus. Source: Graff, Wave Motion in Elastic Solids (1975), ch. 2, 3. It only
// determines the reach of the basis and the length of the first steps.
double first_resonance_rad_s(const PillarScene& scene) {
  const double L_m = scene.geometry.length_m;
  const double speed_m_s = std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3);
  if (!is_lateral(scene)) return 0.5 * std::numbers::pi * speed_m_s / L_m;
  const double gyration_m = scene.geometry.diameter_m / (scene.plane ? std::sqrt(12.0) : 4.0);
  return 3.516 * gyration_m * speed_m_s / (L_m * L_m);
}

// Roughness of a load history: the sums of its jumps and of its changes of slope, relative to its
// peak.
struct Roughness {
  double jumps = 0.0;
  double kinks_1_s = 0.0;
};
Roughness roughness_of(const Course& history) {
  Roughness sum{std::abs(history.front().value), 0.0};
  double peak = sum.jumps, slope = 0.0;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const CoursePoint& from = history[i - 1];
    const CoursePoint& to = history[i];
    peak = std::max(peak, std::abs(to.value));
    const bool is_jump = to.time_s <= from.time_s;
    if (is_jump) sum.jumps += std::abs(to.value - from.value);
    if (is_jump) continue;
    const double next_slope = (to.value - from.value) / (to.time_s - from.time_s);
    sum.kinks_1_s += std::abs(next_slope - slope);
    slope = next_slope;
  }
  peak = std::max(peak, 1e-300);
  return {sum.jumps / peak, (sum.kinks_1_s + std::abs(slope)) / peak};
}

// Displacement that modes above a frequency add beyond their static share, over the static
// displacement under the peak: a jump excites a mode by (8/pi^2) (omega_1/omega)^2, a change of
// slope by 1/omega of that; modes lie 2 omega_1 apart. Source: the rod's own series, Graff, Wave
// Motion in Elastic Solids (1975), ch. 2.
double tail_beyond(double omega_rad_s, double first_rad_s, const Roughness& load) {
  const double ratio = first_rad_s / omega_rad_s;
  return 0.4 * load.jumps * ratio + 0.2 * load.kinks_1_s * ratio / omega_rad_s;
}

// The frequency above which the remaining modes add less than a share of the tolerance, for twice
// the static answer.
constexpr double kFarthest = 60.0;  // first resonances; meshes and bases end there
constexpr int kLargestBasis = 450;
double reach_rad_s(const PillarScene& scene, double first_rad_s) {
  const Roughness load = roughness_of(transient_drive(scene).history);
  double omega = 5.0 * first_rad_s;
  while (omega < kFarthest * first_rad_s &&
         tail_beyond(omega, first_rad_s, load) > 0.4 * scene.tolerance) {
    omega *= 1.1;
  }
  return omega;
}

// An output of a motion at the outputs and between them.
struct OutputCurve {
  std::string name, unit;
  std::vector<double> time_s;  // of the motion
  Eigen::VectorXd values, rates;
};

// A curve at `outputs` + 1 equal times, its spectrum, its peak and its end. The curve is judged over
// a period of the first resonance, the spectrum over half the distance between two modes of a rod.
void add_curve(const OutputCurve& of, const std::vector<double>& time_s,
               const std::vector<double>& values, double first_Hz, SceneAnswer& answer) {
  const MotionPeak peak = peak_of_motion(of.time_s, of.values, of.rates);
  answer.results.push_back({.name = of.name + "_peak",
                            .value = peak.value,
                            .unit = of.unit,
                            .curve = of.name,
                            .x = peak.time_s,
                            .left_out = peak.error});
  answer.results.push_back({.name = of.name + "_end",
                            .value = values.back(),
                            .unit = of.unit,
                            .scale = std::abs(peak.value),
                            .curve = of.name,
                            .x = time_s.back()});
  answer.curves.push_back({of.name, of.unit, time_s, values});
  answer.curves.back().span = 1.0 / first_Hz;
  answer.curves.push_back(spectrum_of(answer.curves.back()));
  answer.curves.back().span = first_Hz;
}

// Runs the motion at more times than the outputs: as many as are needed to know the peaks between
// them to a tenth of the tolerance, or as many as time allows.
TransientResult run_to_peaks(const ViscoelasticSystem& small, TransientRequest request,
                             const Eigen::MatrixXd& observers, double tolerance) {
  constexpr double kMostWork = 4e9;  // multiplications
  constexpr double kMostTimes = 1e6;
  const auto states =
      static_cast<double>(small.mass.rows()) * (2.0 + static_cast<double>(small.terms.size()));
  const double most =
      std::min(kMostTimes, kMostWork / (relaxes_alike(small) ? states : states * states));
  for (;;) {
    TransientResult run = run_transient(small, request, observers);
    double error = 0.0;
    for (Eigen::Index row = 0; row < observers.rows(); ++row) {
      const MotionPeak peak =
          peak_of_motion(run.motion.time_s, run.motion.values.row(row), run.motion.rates.row(row));
      if (peak.value != 0.0) error = std::max(error, peak.error / std::abs(peak.value));
    }
    int finer = 1;  // the error falls as the fourth power
    while (finer < 16 && error > 0.1 * tolerance * std::pow(finer, 4)) finer *= 2;
    while (finer > 1 && request.outputs * static_cast<double>(finer) > most) finer /= 2;
    if (finer == 1) return run;
    request.outputs *= finer;
  }
}

// Displacement under the largest load at rest or carried along, over the largest that was found.
double static_over_peak(const ReducedBody& reduced, const TransientRequest& request,
                        const Eigen::VectorXd& observer, const Eigen::VectorXd& found) {
  const ViscoelasticSystem body = without_rigid_motions(reduced.system);
  const Eigen::MatrixXd stiffness = dense(body.elastic) + dense(body.shear) + dense(body.bulk);
  const Eigen::Index size = stiffness.rows();
  const Eigen::VectorXd load = request.load.tail(size);
  const double moved = observer.tail(size).dot(SymmetricFactor(stiffness).solve(load));
  return std::abs(moved) * largest_size(request.history) /
         std::max(found.cwiseAbs().maxCoeff(), 1e-300);
}

// The share of the tolerance that waves too short for the meshes may take: more where ramps excite them.
double share_of_tail(const Roughness& load) {
  return load.jumps > 0.0 ? 0.5 : 0.9;
}

// The reach is chosen for a motion of the size of the one at rest. Up to this ratio of the two it suffices for ramps.
constexpr double kShortPulse = 2.0;

// Duration of a rectangle with the peak and the area of a load.
double lasting_s(const Course& history) {
  double area = 0.0;
  for (std::size_t i = 1; i < history.size(); ++i) {
    area += 0.5 * (std::abs(history[i].value) + std::abs(history[i - 1].value)) *
            (history[i].time_s - history[i - 1].time_s);
  }
  return area / std::max(largest_size(history), 1e-300);
}

// The least tolerance, from `least` on, at which the load is not refused: after a larger one the reach is shorter, so
// that a short pulse is refused again, until the reach ends at its least.
double proposed_tolerance(PillarScene scene, double least, double first_rad_s,
                          double static_share) {
  const Roughness load = roughness_of(transient_drive(scene).history);
  scene.tolerance = least;
  while (static_share * tail_beyond(reach_rad_s(scene, first_rad_s), first_rad_s, load) >
         0.9 * share_of_tail(load) * scene.tolerance) {
    scene.tolerance *= 1.25;
  }
  return scene.tolerance;
}

// A jump excites waves of every length with amplitudes in proportion to the length; a change of
// slope with amplitudes in proportion to its square. The answer may therefore contain waves that
// are too short for the meshes here. They become negligible if jumps are replaced by ramps and
// ramps are made longer, until their contribution is about a third of the tolerance, or if the
// tolerance is raised accordingly. Mesh and basis use the rest of the tolerance.
void refuse_sudden_load(const PillarScene& scene, double first_rad_s, double reach, double tail,
                        double static_share) {
  const Course& history = transient_drive(scene).history;
  const Roughness load = roughness_of(history);
  const bool has_jumps = load.jumps > 0.0;
  if (tail <= share_of_tail(load) * scene.tolerance) return;
  double rise_s = 1.1 * load.jumps * first_rad_s * static_share / (scene.tolerance * reach * reach);
  // A pulse as short is refused with ramps, too, until it moves the pillar about as far as at rest.
  if (static_share > kShortPulse) rise_s = std::max(rise_s, static_share * lasting_s(history));
  const double wave_m =
      2.0 * std::numbers::pi * std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / reach;
  const std::string cause = has_jumps ? "the load jumps, which excites waves of all lengths; those "
                                      : "the load changes its slope suddenly; waves ";
  const std::string cure =
      has_jumps ? "Let each jump take " + text_of(rise_s, 2) + " s or longer"
                : "Stretch its ramps " + text_of(2.8 * tail / scene.tolerance, 2) + " times";
  constexpr double kLargestProposed = 0.5;  // beyond it an answer says nothing
  const double tolerance = proposed_tolerance(scene, 2.8 * tail, first_rad_s, static_share);
  const std::string or_else =
      tolerance < kLargestProposed
          ? ", or ask for a tolerance of " + text_of(tolerance, 2) + " or larger"
          : "";
  throw SceneMistake(history.size() > 2 ? "analysis.history" : "analysis",
                     cause + "shorter than " + text_of(1e6 * wave_m, 2) +
                         " um, too short for the meshes here, carry " + text_of(tail, 2) +
                         " of the answer, too much for the tolerance. " + cure + or_else);
}

void check_transient(const PillarScene& scene) {
  require(transient_drive(scene).history.size() >= 2,
          "a transient analysis needs a history of at least two points");
  check_outputs(transient_drive(scene).end_time_s, transient_drive(scene).outputs);
  validate_history(transient_drive(scene).history);
  check_sideways_in_time(scene);
}

// The times of the outputs among those of the run.
std::vector<double> at_outputs(const std::vector<double>& all, int outputs) {
  const std::size_t every = (all.size() - 1) / static_cast<std::size_t>(outputs);
  std::vector<double> kept;
  for (std::size_t i = 0; i < all.size(); i += every) kept.push_back(all[i]);
  return kept;
}

void add_curves(const PillarScene& scene, const SceneBody& body, const TransientResult& run,
                double first_Hz, SceneAnswer& answer) {
  const int outputs = transient_drive(scene).outputs;
  const std::vector<double> time_s = at_outputs(run.time_s, outputs);
  const auto add = [&](const BodyReading& reading) {
    const auto row = static_cast<Eigen::Index>(reading.output);
    const ReadoutFilter& filter = reading.filter;
    OutputCurve curve{reading.name, reading.unit, run.motion.time_s, run.motion.values.row(row),
                      run.motion.rates.row(row)};
    std::vector<double> falling;
    const std::vector<double> motion(curve.values.begin(), curve.values.end());
    const std::vector<double> read = reading_of(filter, curve.time_s, motion, &falling);
    curve.values = Eigen::VectorXd::Map(read.data(), std::ssize(read));
    curve.rates = filter.gain * curve.rates -
                  Eigen::VectorXd::Map(falling.data(), std::ssize(falling));  // eq. 23b
    const Eigen::VectorXd at_run = run.values.row(row);
    const std::vector<double> at_times =
        reading_of(filter, run.time_s, std::vector<double>(at_run.begin(), at_run.end()));
    add_curve(curve, time_s, at_outputs(at_times, outputs), first_Hz, answer);
    note_film_error(reading, answer);
  };
  const bool is_from_base = load_place(scene) == LoadPlace::kBase;
  add({0, is_from_base ? "top_displacement_from_base" : body.outputs[0].name,
       body.outputs[0].unit});
  for (const BodyReading& reading : readings_of(scene, body, answer)) add(reading);
}

void run_transient_analysis(const PillarScene& scene, SceneAnswer& answer) {
  const TransientDrive& drive = transient_drive(scene);
  const bool is_axial = !is_lateral(scene);
  const bool is_base = load_place(scene) == LoadPlace::kBase;
  const double first_rad_s = first_resonance_rad_s(scene);
  const double reach = reach_rad_s(scene, first_rad_s);
  // Elements as long as the shortest wave in reach, so that a rising degree resolves it.
  if (!scene.discretisation) {
    answer.discretisation.longest_m =
        2.0 * std::numbers::pi * std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / reach;
  }
  const SceneBody body = body_of(scene, is_axial ? axial_motion(scene) : lateral_motion(scene),
                                 {.with_mass = true}, answer);
  const Eigen::VectorXd load =
      is_base
          ? Eigen::VectorXd(-unit_acceleration_force(*body.model))
          : Eigen::VectorXd((is_axial ? -1.0 : 1.0) * top_area_m2(*body.model) * body.system.load);
  const Roughness roughness = roughness_of(drive.history);
  // A film's voltage follows the stress at the pillar's foot, where a basis errs up to a hundred times
  // as much as in energy.
  const double share_of_basis = body.outputs.size() > 1 ? 0.002 : 0.2;
  const DynamicRange range{
      .lowest_rad_s = 2.0 * std::numbers::pi / drive.end_time_s,
      .highest_rad_s = reach,
      .tolerance = share_of_basis * scene.tolerance,
      .corner_rad_s = first_rad_s,
      .second_corner_rad_s = roughness.jumps == 0.0 ? roughness.kinks_1_s : 0.0,
      .largest_basis = kLargestBasis};
  const ReducedBody reduced = reduce_dynamic(body.system, {load}, range);
  TransientRequest request{
      .load = reduced.load(load), .history = drive.history, .end_s = drive.end_time_s};
  request.outputs = drive.outputs;
  request.tolerance = 0.1 * scene.tolerance;
  request.first_step_s = std::numbers::pi / (10.0 * first_rad_s);
  Eigen::MatrixXd observers(static_cast<Eigen::Index>(body.outputs.size()), reduced.basis.cols());
  for (std::size_t i = 0; i < body.outputs.size(); ++i) {
    observers.row(static_cast<Eigen::Index>(i)) = reduced.load(body.outputs[i].row).transpose();
  }
  const TransientResult run = run_to_peaks(reduced.system, request, observers, scene.tolerance);
  const double static_share =
      static_over_peak(reduced, request, observers.row(0).transpose(), run.values.row(0));
  const double tail = static_share * tail_beyond(reach, first_rad_s, roughness);
  refuse_sudden_load(scene, first_rad_s, reach, tail, static_share);
  answer.step_error = run.converged ? run.error_estimate + reduced.error + tail
                                    : std::numeric_limits<double>::infinity();
  add_curves(scene, body, run, first_rad_s / (2.0 * std::numbers::pi), answer);
}

std::vector<std::string> transient_names(const PillarScene& scene) {
  const bool is_base = load_place(scene) == LoadPlace::kBase;
  return moving_names(scene, is_base ? "top_displacement_from_base" : "top_displacement",
                      {"_peak", "_end", "_spectrum"});
}

EffectEstimate transient_geometric_stiffness(const PillarScene&, const EffectEstimate& usual) {
  if (usual.value <= 1.0) return usual;
  return {EffectRole::kOutside, 1.0, "p/p_cr", usual.value,
          "the straight pillar buckles sideways if the load lasts longer than an oscillation"};
}

}  // namespace

Analysis transient_analysis() {
  return {.name = "transient",
          .drive = TransientDrive{},
          .has_inertia = true,
          .relaxes = true,
          .history = HistoryOf::kPressure,
          .free_bottom = FreeBottom::kMoves,
          .check = check_transient,
          .result_names = transient_names,
          .run = run_transient_analysis,
          .geometric_stiffness = transient_geometric_stiffness};
}

}  // namespace viscard
