#include "models/array/plane/array_dynamics.h"

#include "models/array/plane/array_scene.h"
#include "models/pillar/time/inertial_stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// Modes of each pillar that are taken along, rising with the mesh, so that the change from mesh to
// mesh contains what the left-out ones would add. For a sweep: about twice those of the rod and of
// the shear beam below its end.
int modes_for(const ArrayScene& scene, const Discretisation& mesh) {
  constexpr int kLeast = 3;  // linear elements have few that are right
  const int count = std::max(kLeast, 8 + 5 * (mesh.degree - 3));
  if (scene.frequencies_Hz.empty()) return count;
  const double shear_m_s =
      std::sqrt(scene.pillar.E0_Pa / (2.0 * (1.0 + scene.pillar.nu)) / scene.pillar.rho_kg_m3);
  const double waves = 2.0 * scene.geometry.length_m * scene.frequencies_Hz.back() / shear_m_s;
  return count + static_cast<int>(std::ceil(4.0 * waves));
}

// The film follows at once: it lacks (f/f_film)^2 of its motion, f_film = c_s/(4 t) (eq. A2).
// Voltages are all the film's, of a top's displacement it has a share.
double film_error(const ArrayScene& scene, const ArrayTransfer& transfer, double frequency_Hz) {
  const double speed_m_s = std::sqrt(scene.film.stiffness_Pa(4, 4) / scene.film.rho_kg_m3);
  const double ratio = frequency_Hz * 4.0 * scene.geometry.film_thickness_m / speed_m_s;
  const bool asks_for_voltages =
      transfer.voltages() > 0 &&
      (scene.wanted.empty() ||
       std::any_of(scene.wanted.begin(), scene.wanted.end(),
                   [](const std::string& w) { return !w.starts_with("top_displacement"); }));
  return ratio * ratio * (asks_for_voltages ? 1.0 : transfer.film_share());
}

std::vector<int> loaded_of(const ArrayScene& scene) {
  std::vector<int> loaded;
  for (const int pillar : scene.loaded) loaded.push_back(pillar - 1);
  for (int i = 0; scene.loaded.empty() && i < scene.geometry.count; ++i) loaded.push_back(i);
  return loaded;
}

std::string name_of(const ArrayScene& scene, Eigen::Index output) {
  const int n = scene.geometry.count;
  const bool is_top = output < n;
  const char* stem = is_top                              ? "top_displacement_"
                     : scene.electrodes.is_equipotential ? "electrode_voltage_"
                                                         : "centre_voltage_";
  return stem + std::to_string((is_top ? output : output - n) + 1);
}

bool is_wanted(const ArrayScene& scene, const std::string& name) {
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(),
                     [&](const std::string& w) { return w == name || name.starts_with(w + "_"); });
}

void harmonic(const ArrayScene& scene, const ArrayTransfer& transfer, SceneAnswer& answer) {
  const std::vector<double>& f = scene.frequencies_Hz;
  Eigen::MatrixXcd value(transfer.outputs(), static_cast<Eigen::Index>(f.size()));
  Eigen::MatrixXd allowed(value.rows(), value.cols());
  for (std::size_t i = 0; i < f.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    Eigen::VectorXd slope;
    value.col(column) =
        scene.load_Pa * transfer.at(Complex(0.0, 2.0 * std::numbers::pi * f[i]), &slope);
    allowed.col(column) = std::abs(scene.load_Pa) * slope;
  }
  // Beside the pillar that moves most, as static voltages are: a neighbour's trace is judged so.
  const Eigen::Index n = scene.geometry.count;
  const auto largest_of = [&](Eigen::Index row) {
    return row < n ? allowed.topRows(n).colwise().maxCoeff()
                   : allowed.bottomRows(value.rows() - n).colwise().maxCoeff();
  };
  for (Eigen::Index row = 0; row < value.rows(); ++row) {
    const std::string name = name_of(scene, row);
    if (!is_wanted(scene, name)) continue;
    const Eigen::RowVectorXd size = largest_of(row);
    const char* unit = row < n ? "m" : "V";
    const auto add = [&](const char* part, const char* of, bool watched, auto&& number) {
      SceneCurve curve{name + part, of, f, {}, "frequency_Hz"};
      for (Eigen::Index i = 0; i < value.cols(); ++i) curve.value.push_back(number(value(row, i)));
      if (watched) curve.allowed.assign(size.begin(), size.end());
      curve.is_watched = watched;
      answer.curves.push_back(std::move(curve));
    };
    add("_real", unit, true, [](Complex y) { return y.real(); });
    add("_imaginary", unit, true, [](Complex y) { return y.imag(); });
    add("_magnitude", unit, true, [](Complex y) { return std::abs(y); });
    add("_phase", "rad", false, [](Complex y) { return std::arg(y); });
    answer.results.push_back({name + "_at_lowest", std::abs(value(row, 0)), unit, 0.0, size[0]});
    if (f.size() > 1) {
      answer.results.push_back({name + "_at_highest", std::abs(value(row, value.cols() - 1)), unit,
                                0.0, size[size.size() - 1]});
    }
  }
}

void transient(const ArrayScene& scene, const ArrayTransfer& transfer, const Discretisation& mesh,
               SceneAnswer& answer) {
  const Eigen::MatrixXd values = response_in_time(transfer, scene.history, scene.end_time_s,
                                                  scene.outputs, std::max(1, mesh.degree - 2));
  std::vector<double> time_s;
  for (int i = 0; i <= scene.outputs; ++i) time_s.push_back(scene.end_time_s * i / scene.outputs);
  const Eigen::Index n = scene.geometry.count;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const std::string name = name_of(scene, row);
    if (!is_wanted(scene, name)) continue;
    const double size = row < n ? values.topRows(n).cwiseAbs().maxCoeff()
                                : values.bottomRows(values.rows() - n).cwiseAbs().maxCoeff();
    const Eigen::RowVectorXd own = values.row(row);
    const std::vector<double> samples(own.begin(), own.end());
    const char* unit = row < n ? "m" : "V";
    // Without its sign, which would change where two peaks are nearly the same.
    answer.results.push_back({name + "_peak", own.cwiseAbs().maxCoeff(), unit, 0.0, size});
    answer.results.push_back({name + "_end", own[own.size() - 1], unit, 0.0, size});
    answer.curves.push_back({.name = name, .unit = unit, .x = time_s, .value = samples});
    answer.curves.back().allowed.assign(samples.size(), size);
    const Spectrum spectrum = amplitude_spectrum(
        std::vector<double>(samples.begin(), samples.end() - 1), time_s[1] - time_s[0]);
    answer.curves.push_back({.name = name + "_spectrum",
                             .unit = unit,
                             .x = spectrum.frequency_Hz,
                             .value = spectrum.amplitude,
                             .x_name = "frequency_Hz"});
    answer.curves.back().allowed.assign(spectrum.amplitude.size(), size);
  }
}

}  // namespace

SceneAnswer array_dynamics_on(const ArrayScene& scene, const Discretisation& mesh) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh,
                         modes_for(scene, mesh));
  answer.unknowns = model.unknowns();
  const ArrayTransfer transfer(model, scene.load, loaded_of(scene), scene.pillar);
  if (scene.analysis == ArrayAnalysis::kHarmonic) {
    answer.step_error = film_error(scene, transfer, scene.frequencies_Hz.back());
    harmonic(scene, transfer, answer);
  } else {
    // Ringing lasts in the lowest modes; the film follows the third of them this well.
    const Eigen::VectorXd& rad_s = model.pillar().mode_rad_s;
    const double ring_rad_s = rad_s[std::min<Eigen::Index>(2, rad_s.size() - 1)];
    answer.step_error = film_error(scene, transfer, ring_rad_s / (2.0 * std::numbers::pi));
    transient(scene, transfer, mesh, answer);
  }
  return answer;
}

}  // namespace viscard
