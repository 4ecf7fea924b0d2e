#include "models/array/plane/array_analysis.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

const RowHarmonic& row_harmonic_drive(const ArrayScene& scene) {
  return std::get<RowHarmonic>(scene.drive);
}

void check_row_harmonic(const ArrayScene& scene) {
  check_frequencies(row_harmonic_drive(scene).frequencies_Hz);
  check_load(scene);
}

// All outputs over the frequencies. The tolerance is relative to the pillar that moves most, as for
// static voltages; the small response of a neighbour is judged by the same value.
void add_outputs(const ArrayScene& scene, const ArrayTransfer& transfer, SceneAnswer& answer) {
  const std::vector<double>& f = row_harmonic_drive(scene).frequencies_Hz;
  const Eigen::Index n = scene.geometry.count;
  std::vector<Sweep> sweeps(static_cast<std::size_t>(transfer.outputs()));
  for (const double frequency_Hz : f) {
    Eigen::VectorXd slope;
    const Eigen::VectorXcd value =
        scene.load_Pa * transfer.at(Complex(0.0, 2.0 * std::numbers::pi * frequency_Hz), &slope);
    const Eigen::VectorXd allowed = std::abs(scene.load_Pa) * slope;
    for (Eigen::Index row = 0; row < value.size(); ++row) {
      Sweep& sweep = sweeps[static_cast<std::size_t>(row)];
      sweep.value.push_back(value[row]);
      sweep.allowed.push_back(
          (row < n ? allowed.head(n) : allowed.tail(allowed.size() - n)).maxCoeff());
    }
  }
  for (Eigen::Index row = 0; row < transfer.outputs(); ++row) {
    const std::string name = name_of(scene, row);
    if (!asks_for(scene, name)) continue;
    add_sweep(name, row < n ? "m" : "V", f, sweeps[static_cast<std::size_t>(row)], answer);
  }
}

SceneAnswer run_row_harmonic(const ArrayScene& scene, const Discretisation& mesh) {
  const double highest_Hz = row_harmonic_drive(scene).frequencies_Hz.back();
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh,
                         {.modes = modes_for(scene, mesh, highest_Hz)});
  answer.unknowns = model.unknowns();
  ArrayTransfer transfer(model, scene.load, loaded_of(scene), scene.pillar);
  let_film_lose(scene, transfer);
  answer.step_error = film_error(scene, transfer, highest_Hz) + film_loss_error(scene, transfer);
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
