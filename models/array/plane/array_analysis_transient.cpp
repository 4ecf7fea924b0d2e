#include "models/answer/scene_mistake.h"
#include "models/array/plane/array_analysis.h"
#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

const RowTransient& row_transient_drive(const ArrayScene& scene) {
  return std::get<RowTransient>(scene.drive);
}

void check_row_transient(const ArrayScene& scene) {
  const RowTransient& drive = row_transient_drive(scene);
  if (drive.history.size() < 2) {
    throw SceneMistake("analysis", "a transient analysis needs a history or a pulse");
  }
  validate_history(drive.history);
  check_outputs(drive.end_time_s, drive.outputs);
  for (const CoursePoint& point : drive.history) {
    check_pressure(scene, point.value, "analysis.history");
  }
}

constexpr int kFewestWaves = 24;  // modes of a loaded pillar
constexpr int kMostWaves = 240;

// Samples of the FFT per output, so that it reaches half as far again as the highest mode.
int oversampling_for(const ArrayTransfer& transfer, const RowTransient& drive) {
  const double highest_Hz = transfer.highest_rad_s() / (2.0 * std::numbers::pi);
  constexpr double kMost = 64.0;
  return static_cast<int>(
      std::clamp(std::ceil(3.0 * highest_Hz * drive.end_time_s / drive.outputs), 2.0, kMost));
}

// All outputs over time, with the first `shapes` modes of a loaded pillar. Pillars without a load
// are moved by the film alone and need fewer.
Eigen::MatrixXd values_with(const ArrayScene& scene, const ArrayModel& model, int shapes) {
  const RowTransient& drive = row_transient_drive(scene);
  ArrayTransfer transfer(model, scene.load, loaded_of(scene), scene.pillar,
                         {.of_loaded = shapes, .of_others = (shapes + 2) / 3});
  let_film_lose(scene, transfer);
  return response_in_time(transfer, drive.history, drive.end_time_s, drive.outputs,
                          oversampling_for(transfer, drive));
}

// Answers with all modes and with three subsets of them (set_left_out). There are three because the
// relevant modes have irregular distances.
struct WaveAnswers {
  Eigen::MatrixXd whole;
  std::vector<Eigen::MatrixXd> part;
};
constexpr std::array kSharesInUse = {0.25, 0.5, 2.0 / 3.0};

WaveAnswers wave_answers(const ArrayScene& scene, const ArrayModel& model) {
  const int shapes = model.pillar().shapes;
  WaveAnswers answers{.whole = values_with(scene, model, shapes)};
  for (const double share : kSharesInUse) {
    answers.part.push_back(
        values_with(scene, model, std::max(1, static_cast<int>(std::lround(share * shapes)))));
  }
  return answers;
}

std::vector<double> row_of(const Eigen::MatrixXd& values, Eigen::Index row) {
  const Eigen::RowVectorXd own = values.row(row);
  return {own.begin(), own.end()};
}

// One output as a curve, its spectrum and its peak and end. The curve is judged over a period of the
// lowest mode, the spectrum over half the distance between two modes of a rod.
void add_output(SceneCurve curve, double size, double lowest_Hz, const WaveAnswers& waves,
                Eigen::Index row, SceneAnswer& answer) {
  curve.value = row_of(waves.whole, row);
  std::vector<std::vector<double>> parts, part_spectra;
  for (const Eigen::MatrixXd& part : waves.part) {
    SceneCurve with_part = curve;
    with_part.value = row_of(part, row);
    part_spectra.push_back(spectrum_of(with_part).value);
    parts.push_back(std::move(with_part.value));
  }
  SceneCurve spectrum = spectrum_of(curve);
  set_left_out(kSharesInUse, parts, curve);
  set_left_out(kSharesInUse, part_spectra, spectrum);
  // The peak of a mode beyond those in use is missing from all subsets, and sampling may alias it
  // to any frequency. Its height is at most that of the peaks missing from a subset.
  spectrum.left_out.assign(spectrum.value.size(), largest_size(spectrum.left_out));
  curve.span = 1.0 / lowest_Hz;
  spectrum.span = lowest_Hz;
  curve.allowed.assign(curve.value.size(), size);
  spectrum.allowed.assign(spectrum.value.size(), size);
  // Without its sign, because the sign would change between two peaks of nearly the same size.
  const auto peak = std::max_element(curve.value.begin(), curve.value.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double peak_at_s = curve.x[static_cast<std::size_t>(peak - curve.value.begin())];
  answer.results.push_back({.name = curve.name + "_peak",
                            .value = std::abs(*peak),
                            .unit = curve.unit,
                            .scale = size,
                            .curve = curve.name,
                            .x = peak_at_s});
  answer.results.push_back({.name = curve.name + "_end",
                            .value = curve.value.back(),
                            .unit = curve.unit,
                            .scale = size,
                            .curve = curve.name,
                            .x = curve.x.back()});
  answer.curves.push_back(std::move(curve));
  answer.curves.push_back(std::move(spectrum));
}

// All outputs over time.
void add_outputs(const ArrayScene& scene, const WaveAnswers& waves, double lowest_Hz,
                 SceneAnswer& answer) {
  const RowTransient& drive = row_transient_drive(scene);
  const Eigen::MatrixXd& values = waves.whole;
  SceneCurve curve;
  for (int i = 0; i <= drive.outputs; ++i) curve.x.push_back(drive.end_time_s * i / drive.outputs);
  const Eigen::Index n = scene.geometry.count;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    curve.name = name_of(scene, row);
    curve.unit = row < n ? "m" : "V";
    if (!asks_for(scene, curve.name)) continue;
    const double size = row < n ? values.topRows(n).cwiseAbs().maxCoeff()
                                : values.bottomRows(values.rows() - n).cwiseAbs().maxCoeff();
    add_output(curve, size, lowest_Hz, waves, row, answer);
  }
}

// The lowest mode that the load excites, on a rigid base.
double lowest_rad_s(const ArrayScene& scene, const CondensedPillar& pillar) {
  const bool is_lateral = scene.load == ArrayLoad::kShear;
  for (std::size_t k = 0; k < pillar.mode_is_lateral.size(); ++k) {
    if (pillar.mode_is_lateral[k] == is_lateral) {
      return pillar.mode_rad_s[static_cast<Eigen::Index>(k)];
    }
  }
  return pillar.mode_rad_s[0];
}

// The modes in use and the size of elements for them.
struct WaveMesh {
  int waves = kFewestWaves;
  double highest_rad_s = 0.0;
};

SceneAnswer answer_with(const ArrayScene& scene, const Discretisation& mesh, WaveMesh& waves) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh,
                         {.waves = waves.waves, .load_port = port_of(scene.load)});
  answer.unknowns = model.unknowns();
  const ArrayTransfer statics(model, scene.load, loaded_of(scene), scene.pillar, {1, 1});
  // The ringing consists of the lowest modes; the error of the film is taken at the third of them.
  const Eigen::VectorXd& rad_s = model.pillar().mode_rad_s;
  const double ring_rad_s = rad_s[std::min<Eigen::Index>(2, rad_s.size() - 1)];
  answer.step_error = film_error(scene, statics, ring_rad_s / (2.0 * std::numbers::pi)) +
                      film_loss_error(scene, statics);
  add_outputs(scene, wave_answers(scene, model),
              lowest_rad_s(scene, model.pillar()) / (2.0 * std::numbers::pi), answer);
  waves.highest_rad_s = rad_s[rad_s.size() - 1];
  return answer;
}

// Largest error by left-out modes, relative to the size of its curve.
double left_out_of(const SceneAnswer& answer) {
  double largest = 0.0;
  for (const SceneCurve& curve : answer.curves) {
    const double size = curve.allowed.front();
    if (size > 0.0) largest = std::max(largest, largest_size(curve.left_out) / size);
  }
  return largest;
}

// Chooses by trials on a coarse mesh how many modes are needed so that the left-out ones cost half
// of the tolerance; their effect depends little on the mesh. All meshes then use this number, so
// the change from mesh to mesh is the error of the mesh alone.
WaveMesh waves_for(const ArrayScene& scene) {
  WaveMesh found;
  while (true) {
    const SceneAnswer trial =
        answer_with(scene, {.degree = 5, .layers = 1, .shaft_elements = 4}, found);
    const double excess = left_out_of(trial) / (0.5 * scene.tolerance);
    if (excess <= 1.0 || found.waves >= kMostWaves) return found;
    found.waves = std::min(
        kMostWaves, static_cast<int>(std::ceil(found.waves * std::clamp(excess, 1.25, 2.0))));
  }
}

// Elements of the shaft no longer than three quarters of the shortest wave of a rod.
SceneAnswer run_row_transient(const ArrayScene& scene, const Discretisation& mesh) {
  WaveMesh waves = waves_for(scene);
  const double wave_m = 2.0 * std::numbers::pi / waves.highest_rad_s *
                        std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3);
  Discretisation fine = mesh;
  fine.shaft_elements =
      std::max(mesh.shaft_elements,
               static_cast<int>(std::ceil(2.0 * scene.geometry.diameter_m / (0.75 * wave_m))));
  SceneAnswer answer = answer_with(scene, fine, waves);
  answer.discretisation = mesh;
  return answer;
}

}  // namespace

ArrayAnalysis array_transient_analysis() {
  return {.name = "transient",
          .drive = RowTransient{},
          .has_inertia = true,
          .relaxes = true,
          .check = check_row_transient,
          .result_names = names_in_time,
          .run = run_row_transient};
}

}  // namespace viscard
