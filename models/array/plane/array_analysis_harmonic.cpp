#include "models/array/plane/array_analysis.h"
#include "models/array/plane/array_in_time.h"
#include "models/array/plane/check_array.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

const RowHarmonic& row_harmonic_drive(const ArrayScene& scene) {
  return std::get<RowHarmonic>(scene.drive);
}

void check_row_harmonic(const ArrayScene& scene) {
  const std::vector<double>& f = row_harmonic_drive(scene).frequencies_Hz;
  if (f.empty()) throw SceneMistake("analysis", "a harmonic analysis needs frequencies");
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (!(f[i] > (i == 0 ? 0.0 : f[i - 1])) || !std::isfinite(f[i])) {
      throw SceneMistake("analysis.frequencies", "must be positive and ascend");
    }
  }
  check_load(scene);
}

// All outputs over the frequencies.
void add_outputs(const ArrayScene& scene, const ArrayTransfer& transfer, SceneAnswer& answer) {
  const std::vector<double>& f = row_harmonic_drive(scene).frequencies_Hz;
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

SceneAnswer run_row_harmonic(const ArrayScene& scene, const Discretisation& mesh) {
  const double highest_Hz = row_harmonic_drive(scene).frequencies_Hz.back();
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh,
                         modes_for(scene, mesh, highest_Hz));
  answer.unknowns = model.unknowns();
  const ArrayTransfer transfer(model, scene.load, loaded_of(scene), scene.pillar);
  answer.step_error = film_error(scene, transfer, highest_Hz);
  add_outputs(scene, transfer, answer);
  return answer;
}

}  // namespace

ArrayAnalysis array_harmonic_analysis() {
  return {.name = "harmonic",
          .drive = RowHarmonic{},
          .has_inertia = true,
          .relaxes = true,
          .check = check_row_harmonic,
          .result_names = names_in_time,
          .run = run_row_harmonic};
}

}  // namespace viscard
