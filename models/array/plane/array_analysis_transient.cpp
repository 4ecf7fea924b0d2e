#include "models/array/plane/array_analysis.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <numbers>

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
  validate(drive.history);
  check_outputs(drive.end_time_s, drive.outputs);
  for (const HistoryPoint& point : drive.history) {
    check_pressure(scene, point.value, "analysis.history");
  }
}

// All outputs over time.
void add_outputs(const ArrayScene& scene, const ArrayTransfer& transfer, const Discretisation& mesh,
                 SceneAnswer& answer) {
  const RowTransient& drive = row_transient_drive(scene);
  const Eigen::MatrixXd values = response_in_time(transfer, drive.history, drive.end_time_s,
                                                  drive.outputs, std::max(1, mesh.degree - 2));
  std::vector<double> time_s;
  for (int i = 0; i <= drive.outputs; ++i) time_s.push_back(drive.end_time_s * i / drive.outputs);
  const Eigen::Index n = scene.geometry.count;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const std::string name = name_of(scene, row);
    if (!asks_for(scene, name)) continue;
    const double size = row < n ? values.topRows(n).cwiseAbs().maxCoeff()
                                : values.bottomRows(values.rows() - n).cwiseAbs().maxCoeff();
    const Eigen::RowVectorXd own = values.row(row);
    const std::vector<double> samples(own.begin(), own.end());
    const char* unit = row < n ? "m" : "V";
    // Without its sign, which would change between two peaks of nearly the same size.
    answer.results.push_back({name + "_peak", own.cwiseAbs().maxCoeff(), unit, 0.0, size});
    answer.results.push_back({name + "_end", own[own.size() - 1], unit, 0.0, size});
    answer.curves.push_back({.name = name, .unit = unit, .x = time_s, .value = samples});
    answer.curves.back().allowed.assign(samples.size(), size);
    answer.curves.push_back(spectrum_of(answer.curves.back()));
    answer.curves.back().allowed.assign(answer.curves.back().value.size(), size);
  }
}

SceneAnswer run_row_transient(const ArrayScene& scene, const Discretisation& mesh) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh,
                         modes_for(scene, mesh, 0.0));
  answer.unknowns = model.unknowns();
  const ArrayTransfer transfer(model, scene.load, loaded_of(scene), scene.pillar);
  // Ringing lasts in the lowest modes; the error of the film is that at the third of them.
  const Eigen::VectorXd& rad_s = model.pillar().mode_rad_s;
  const double ring_rad_s = rad_s[std::min<Eigen::Index>(2, rad_s.size() - 1)];
  answer.step_error = film_error(scene, transfer, ring_rad_s / (2.0 * std::numbers::pi));
  add_outputs(scene, transfer, mesh, answer);
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
