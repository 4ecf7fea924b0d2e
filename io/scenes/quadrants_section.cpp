#include "io/scenes/quadrants_section.h"

#include "io/scenes/pillar_positions.h"
#include "io/scenes/scene_words.h"

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Rows of the file in the order of the pillars.
Eigen::MatrixXd measured_V(const std::filesystem::path& path, const SpaceScene& scene) {
  const auto count = static_cast<Eigen::Index>(scene.pillars.size());
  Eigen::MatrixXd voltages_V = Eigen::MatrixXd::Constant(count, 4, NAN);
  for (const QuadrantVoltages& one : read_quadrant_voltages(path)) {
    const std::string name =
        "[" + std::to_string(one.row) + ", " + std::to_string(one.column) + "]";
    const auto index = index_of(scene, {one.row, one.column});
    if (!index) {
      throw std::runtime_error(path.string() + ": there is no pillar " + name + " in the scene");
    }
    const auto at = static_cast<Eigen::Index>(*index);
    if (!std::isnan(voltages_V(at, 0))) {
      throw std::runtime_error(path.string() + ": gives the voltages of pillar " + name + " twice");
    }
    for (Eigen::Index q = 0; q < 4; ++q)
      voltages_V(at, q) = one.voltage_V.at(static_cast<std::size_t>(q));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!std::isnan(voltages_V(i, 0))) continue;
    const SpacePillar& one = scene.pillars[static_cast<std::size_t>(i)];
    throw std::runtime_error(path.string() + ": has no voltages of pillar [" +
                             std::to_string(one.row) + ", " + std::to_string(one.column) +
                             "]; give all pillars, or name those without in geometry.dead");
  }
  return voltages_V;
}

}  // namespace

void show_quadrants(FieldVisitor& v, RawQuadrants& raw) {
  v.text({"voltages", "readings.csv"}, raw.voltages);
  v.text({"neighbours", "deconvolved"}, raw.neighbours);
  v.text({"averages", "area"}, raw.averages);
  v.integer("circles", 1, 1000, raw.circles);
  v.integer("on_circle", 4, 10000, raw.on_circle);
  v.quantity({.key = "noise", .unit = "V", .range = Range::kPositive}, raw.noise_V);
}

SpaceElectrode electrode_from(const std::string& kind, bool in_quarters) {
  const auto electrode = choice<SpaceElectrode>(
      "geometry.electrode.kind", kind,
      {{"sampled", SpaceElectrode::kSampled}, {"equipotential", SpaceElectrode::kEquipotential}});
  if (!in_quarters) return electrode;
  if (electrode == SpaceElectrode::kEquipotential) {
    throw SceneMistake("geometry.electrode.kind",
                       "quadrants of an array in the plane are read on a charge-free face; say "
                       "kind = \"sampled\", or leave quadrants out");
  }
  return SpaceElectrode::kQuadrants;
}

void fill_quadrants(const RawQuadrants& raw, const std::filesystem::path& folder,
                    SpaceScene& scene) {
  QuadrantSensing& sensing = scene.quadrants;
  sensing.by_neighbours = choice<bool>("quadrants.neighbours", raw.neighbours,
                                       {{"deconvolved", true}, {"ignored", false}});
  if (choice<bool>("quadrants.averages", raw.averages, {{"area", false}, {"nodes", true}})) {
    sensing.nodes = NodeMeans{static_cast<int>(raw.circles), static_cast<int>(raw.on_circle)};
  }
  sensing.noise_V = raw.noise_V;
  if (!raw.voltages.empty())
    sensing.measured_V =
        measured_V(named_file("quadrants.voltages", folder, raw.voltages, FileKind::kTable), scene);
}

}  // namespace viscard
