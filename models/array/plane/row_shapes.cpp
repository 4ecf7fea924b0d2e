#include "models/array/plane/row_shapes.h"

#include "models/array/plane/array_modes.h"

#include <algorithm>
#include <array>

namespace viscard {
namespace {

constexpr std::array kRowFamilies = {true, false};  // lateral comes first in an answer

const char* family_name(bool is_lateral) {
  return is_lateral ? "lateral" : "longitudinal";
}

RowShape shape_of(const ArrayMode& mode, int cluster, const Eigen::MatrixXd& on_outline) {
  RowShape shape{family_name(mode.is_lateral), cluster, mode.top, on_outline * mode.amplitude};
  double largest = 0.0;
  for (Eigen::Index place = 0; place + 1 < shape.outline.rows(); place += 2) {
    largest = std::max(largest, shape.outline.middleRows(place, 2).colwise().norm().maxCoeff());
  }
  if (largest > 0.0) shape.outline /= largest;
  return shape;
}

// A mode of one pillar as one of the row, in which only pillar i (0-based) moves.
RowShape moved_alone(const RowShape& one, int i, int count) {
  RowShape shape{one.family, one.cluster, Eigen::VectorXd::Zero(count),
                 Eigen::MatrixXd::Zero(one.outline.rows(), count)};
  shape.top[i] = one.top[0];
  shape.outline.col(i) = one.outline.col(0);
  return shape;
}

// Modes of a pillar on a rigid base.
std::vector<ArrayMode> fixed_base_modes(const ArrayModel& model) {
  const CondensedPillar& pillar = model.pillar();
  const Eigen::MatrixXd readings = pillar.fixed_base_compliance();
  const auto count = pillar.mode_rad_s.size();
  std::vector<ArrayMode> modes;
  for (Eigen::Index k = 0; k < count; ++k) {
    ArrayMode mode;
    mode.is_lateral = pillar.mode_is_lateral[static_cast<std::size_t>(k)];
    const ArrayLoad load = mode.is_lateral ? ArrayLoad::kShear : ArrayLoad::kPressure;
    const double top_m =
        metres_per_reading(load, model.geometry()) * readings(port_of(load), kFirstModePort + k);
    mode.amplitude = (top_m < 0.0 ? -1.0 : 1.0) * Eigen::VectorXd::Unit(count, k);
    mode.top = Eigen::VectorXd::Ones(1);
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace

RowShapes row_shapes(const ArrayScene& scene, const Discretisation& mesh) {
  const int clusters = std::get<RowModal>(scene.drive).modes;
  const bool is_row = scene.feels_film && scene.feels_neighbours;
  const ArrayModel model(is_row ? scene.geometry : lone(scene.geometry), scene.electrodes,
                         media_of(scene), mesh, {.modes = inertia_ports_for(clusters)});
  const int per_cluster = is_row ? scene.geometry.count : 1;
  const std::vector<ArrayMode> modes =
      scene.feels_film ? array_modes(model, clusters) : fixed_base_modes(model);
  RowShapes shapes{scene.geometry, is_row, model.pillar().outline_m, {}};
  for (const bool is_lateral : kRowFamilies) {
    int number = 0;
    for (const ArrayMode& mode : modes) {
      if (mode.is_lateral != is_lateral || number == clusters * per_cluster) continue;
      const int cluster = 1 + number++ / per_cluster;
      const RowShape shape = shape_of(mode, cluster, model.pillar().mode_on_outline);
      for (int i = 0; !is_row && i < scene.geometry.count; ++i) {
        shapes.modes.push_back(moved_alone(shape, i, scene.geometry.count));
      }
      if (is_row) shapes.modes.push_back(shape);
    }
  }
  return shapes;
}

}  // namespace viscard
