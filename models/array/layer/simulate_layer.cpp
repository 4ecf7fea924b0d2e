#include "models/array/layer/simulate_layer.h"

#include "models/answer/error_control.h"
#include "models/answer/scene_mistake.h"
#include "models/array/layer/layer_readings.h"
#include "models/array/layer/layer_transfer.h"
#include "models/array/layer/layer_window.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kShareOfConstant = 0.8;    // of the tolerance; the grids get the rest
constexpr double kFirstStepOfForce = 1e-3;  // over the indentation
constexpr int kProfilePoints = 61;
constexpr double kProfileReach = 0.75;  // half of the profile over the width of the window
constexpr const char* kPressureProfile = "pressure_profile";
constexpr const char* kVoltageProfile = "voltage_profile";
constexpr const char* kGapProfile = "gap_profile";

const char* area_name(const LayerScene& scene) {
  return scene.is_plane() ? "contact_width" : "contact_area";
}

// Cells with a neighbour that is not touched, which the edge of the contact crosses.
double rim_cells(const Eigen::MatrixXd& p_Pa) {
  double count = 0.0;
  const auto is_free = [&](Eigen::Index i, Eigen::Index j) {
    return i < 0 || j < 0 || i >= p_Pa.rows() || j >= p_Pa.cols() || p_Pa(i, j) == 0.0;
  };
  for (Eigen::Index j = 0; j < p_Pa.cols(); ++j) {
    for (Eigen::Index i = 0; i < p_Pa.rows(); ++i) {
      if (p_Pa(i, j) == 0.0) continue;
      const bool is_beside_y = p_Pa.cols() > 1 && (is_free(i, j - 1) || is_free(i, j + 1));
      count += is_free(i - 1, j) || is_free(i + 1, j) || is_beside_y ? 1.0 : 0.0;
    }
  }
  return count;
}

// The scene with its film, kernel and window, which all grids share.
class LayerSolver {
 public:
  explicit LayerSolver(const LayerScene& scene)
      : scene_(&scene),
        waves_(stack_of(scene), scene.is_plane()),
        window_(layer_window(scene, waves_)),
        readings_(scene),
        kernel_(waves_, scene.is_plane(), reach_m(), readings_.factors()) {}

  SceneAnswer on(const Discretisation& mesh) {
    LayerGrid grid = window_.grid;
    grid.count = cells_across(*scene_, mesh);
    const LayerContact contact(kernel_, press_of(*scene_), grid);
    Eigen::MatrixXd guess_Pa;
    if (last_) guess_Pa = pressure_on(*last_, grid, scene_->is_plane());
    LayerPressure pressed =
        scene_->press.force_N > 0.0 && window_.force_N > 0.0
            ? contact.with_force(scene_->press.force_N, window_.depth_m,
                                 kFirstStepOfForce * window_.indentation_m, guess_Pa)
            : contact.to_depth(window_.depth_m, guess_Pa);
    window_.depth_m = pressed.depth_m;
    SceneAnswer answer;
    answer.discretisation = mesh;
    answer.unknowns = static_cast<int>(pressed.pressure_Pa.size());
    answer.step_error = waves_.error();
    set_results(pressed, answer);
    set_profiles(pressed, answer);
    add_transfer(*scene_, waves_, answer);
    last_ = std::move(pressed);
    return answer;
  }

  // Relative error that no grid reduces.
  double constant_error() const { return waves_.error() + readings_.error(); }
  std::vector<std::string> notes() const;

 private:
  // From a cell to the farthest electrode or point of the profile.
  double reach_m() const {
    const LayerGrid& grid = window_.grid;
    double reach_m = (0.5 + kProfileReach) * grid.width_m;
    for (const auto& [x_m, y_m] : scene_->electrodes_m) {
      reach_m = std::max(reach_m, std::hypot(x_m - grid.x_m, y_m - grid.y_m) + 0.71 * grid.width_m +
                                      scene_->electrode_radius_m);
    }
    return std::max(reach_m, 1.5 * grid.width_m);
  }
  void set_results(const LayerPressure& pressed, SceneAnswer& answer) const;
  void set_profiles(const LayerPressure& pressed, SceneAnswer& answer) const;
  void add_gap(const LayerPressure& pressed, SceneAnswer& answer) const;

  const LayerScene* scene_;
  LayerWaves waves_;
  LayerWindow window_;
  LayerReadings readings_;
  LayerKernel kernel_;
  std::optional<LayerPressure> last_;
};

void LayerSolver::set_results(const LayerPressure& pressed, SceneAnswer& answer) const {
  const auto add = [&](const std::string& name, double value, const std::string& unit) {
    if (asks_for(*scene_, name)) answer.results.push_back({name, value, unit});
  };
  add("contact_force", pressed.force_N, scene_->is_plane() ? "N/m" : "N");
  if (asks_for(*scene_, area_name(*scene_))) {
    const double cell_m = pressed.grid.cell_m();
    const double of_rim = scene_->is_plane() ? cell_m : 0.25 * cell_m * cell_m;
    const double change = last_ ? std::abs(pressed.contact_m2 - last_->contact_m2) : 0.0;
    answer.results.push_back({area_name(*scene_), pressed.contact_m2,
                              scene_->is_plane() ? "m" : "m2",
                              change + of_rim * rim_cells(pressed.pressure_Pa), 0.0, false});
  }
  // Its error is relative to the indentation, because the point `at` may touch late or never.
  if (asks_for(*scene_, "depth")) {
    answer.results.push_back({"depth", pressed.depth_m, "m", 0.0, window_.indentation_m});
  }
  add("largest_pressure", std::max(pressed.pressure_Pa.maxCoeff(), 0.0), "Pa");
  readings_.add(pressed, kernel_, constant_error(), answer);
}

void LayerSolver::set_profiles(const LayerPressure& pressed, SceneAnswer& answer) const {
  // Not watched: it jumps at the edge of the contact.
  SceneCurve pressure{.name = kPressureProfile, .unit = "Pa", .x_name = "x_m", .is_watched = false};
  SceneCurve voltage{.name = kVoltageProfile, .unit = "V", .x_name = "x_m"};
  const LayerGrid& grid = pressed.grid;
  const Eigen::Index middle = pressed.pressure_Pa.cols() / 2;
  const bool has_voltage = asks_for(*scene_, kVoltageProfile);
  for (int i = 0; i < kProfilePoints; ++i) {
    const double share = 2.0 * i / (kProfilePoints - 1) - 1.0;
    const double x_m = grid.x_m + share * kProfileReach * grid.width_m;
    const Eigen::Index cell = grid.cell_at(grid.x_m, x_m);
    pressure.x.push_back(x_m);
    pressure.value.push_back(cell < 0 ? 0.0 : pressed.pressure_Pa(cell, middle));
    if (!has_voltage) continue;
    voltage.x.push_back(x_m);
    voltage.value.push_back(potential_V(pressed, kernel_, x_m, grid.y_m, LayerReadings::kPoint));
  }
  if (asks_for(*scene_, kPressureProfile)) answer.curves.push_back(std::move(pressure));
  if (has_voltage) answer.curves.push_back(std::move(voltage));
  if (asks_for(*scene_, kGapProfile)) add_gap(pressed, answer);
}

// Gap between the face and the shape along x, within the grid and under the shape.
void LayerSolver::add_gap(const LayerPressure& pressed, SceneAnswer& answer) const {
  const LayerGrid& grid = pressed.grid;
  const Eigen::Index middle = pressed.pressure_Pa.cols() / 2;
  const GridConvolution sums(kernel_.sinking_m_Pa(grid.count, grid.cell_m()));
  const Eigen::VectorXd sinking_m = sums.apply(pressed.pressure_Pa).col(middle);
  SceneCurve gap{.name = kGapProfile, .unit = "m", .x_name = "x_m", .is_watched = false};
  for (int i = 0; i < kProfilePoints; ++i) {
    const double x_m =
        grid.x_m + (static_cast<double>(i) / (kProfilePoints - 1) - 0.5) * grid.width_m;
    if (scene_->width_m > 0.0 && std::abs(x_m) >= 0.5 * scene_->width_m) continue;
    const Eigen::Index cell = grid.cell_at(grid.x_m, x_m);
    const double height = height_m(scene_->press.shape, grid.place_m(grid.x_m, cell),
                                   scene_->is_plane() ? 0.0 : grid.place_m(grid.y_m, middle));
    if (!std::isfinite(height)) continue;
    gap.x.push_back(x_m);
    const bool touches = pressed.pressure_Pa(cell, middle) != 0.0;
    gap.value.push_back(touches ? 0.0 : height - pressed.depth_m + sinking_m[cell]);
  }
  answer.curves.push_back(std::move(gap));
}

// The steepest rise of the shape over the touched cells, and whether they reach the shape's end.
std::pair<double, bool> steepest_rise(const LayerScene& scene, const LayerPressure& pressed) {
  const LayerGrid& grid = pressed.grid;
  double steepest = 0.0;
  bool is_at_end = false;
  for (Eigen::Index j = 0; j < pressed.pressure_Pa.cols(); ++j) {
    const double y_m = scene.is_plane() ? 0.0 : grid.place_m(grid.y_m, j);
    for (Eigen::Index i = 0; i < pressed.pressure_Pa.rows(); ++i) {
      if (pressed.pressure_Pa(i, j) == 0.0) continue;
      const double x_m = grid.place_m(grid.x_m, i);
      const double rise_m = height_m(scene.press.shape, x_m + 0.5 * grid.cell_m(), y_m) -
                            height_m(scene.press.shape, x_m - 0.5 * grid.cell_m(), y_m);
      if (std::isfinite(rise_m)) steepest = std::max(steepest, std::abs(rise_m) / grid.cell_m());
      is_at_end = is_at_end || !std::isfinite(rise_m);
    }
  }
  return {steepest, is_at_end};
}

std::vector<std::string> LayerSolver::notes() const {
  std::vector<std::string> notes;
  if (last_->force_N == 0.0) {
    notes.emplace_back("the shape does not touch the layer; lower it, or move it with shape.at");
    return notes;
  }
  constexpr double kLargestStrain = 0.05, kSteepest = 0.2;
  const double strain = last_->pressure_Pa.maxCoeff() / scene_->pillar.E0_Pa;
  if (strain > kLargestStrain) {
    notes.push_back("large strain: the largest pressure is " + text_of(100.0 * strain, 3) +
                    " % of the layer's modulus; the answer is that of small strains");
  }
  const auto [steepest, is_at_end] = steepest_rise(*scene_, *last_);
  if (steepest > kSteepest) {
    notes.push_back("steep shape: its surface rises by " + text_of(steepest, 2) +
                    " where it touches; the face is taken to be nearly level");
  }
  const HeightTable& table = scene_->press.shape.table;
  if (is_at_end && scene_->press.shape.kind == ShapeKind::kTable && !table.is_random) {
    notes.emplace_back("the contact reaches the end of the table of heights, where the shape ends");
  }
  return notes;
}

}  // namespace

int cells_across(const LayerScene& scene, const Discretisation& mesh) {
  return (scene.is_plane() ? 32 : 4) << mesh.degree;
}

std::vector<Discretisation> layer_meshes(const LayerScene& scene) {
  std::vector<Discretisation> meshes;
  const int finest = scene.is_plane() ? 9 : 7;
  for (int degree = 3; degree <= finest; ++degree) {
    meshes.push_back({.degree = degree, .layers = degree - 2});
  }
  return meshes;
}

std::vector<std::string> result_names(const LayerScene& scene) {
  std::vector<std::string> names = voltage_names(scene.electrode);
  for (const char* const name : {"contact_force", area_name(scene), "depth", "largest_pressure",
                                 kPressureProfile, kVoltageProfile, kGapProfile}) {
    names.emplace_back(name);
  }
  const std::vector<std::string> of_waves = transfer_names(scene);
  names.insert(names.end(), of_waves.begin(), of_waves.end());
  return names;
}

SceneAnswer layer_answer_on(const LayerScene& scene, const Discretisation& mesh) {
  return LayerSolver(scene).on(mesh);
}

SceneAnswer simulate_layer(const LayerScene& scene) {
  validate(scene);
  LayerSolver solver(scene);
  if (solver.constant_error() > kShareOfConstant * scene.tolerance) {
    throw SceneMistake("tolerance",
                       "is " + text_of(scene.tolerance, 2) +
                           ", but the pressure is solved as if the layer sank alike in all "
                           "directions and the electrodes stood under the film alone, which leaves "
                           "a relative error of about " +
                           text_of(solver.constant_error(), 2) +
                           "; ask for a larger tolerance, or take a softer layer");
  }
  SceneAnswer answer = answer_within({scene.tolerance, layer_meshes(scene), scene.progress},
                                     [&](const Discretisation& mesh) { return solver.on(mesh); });
  answer.notes = solver.notes();
  return answer;
}

double layer_strain(const LayerScene& scene) {
  const ShapePress& press = scene.press;
  const double H_m = scene.thickness_m;
  const double R_m = press.shape.radius_m;
  double depth_m = press.depth_m;
  if (press.force_N > 0.0) {
    const double E_Pa = contact_modulus_Pa(scene);
    if (R_m > 0.0 && scene.is_plane()) {
      depth_m = 4.0 * press.force_N / (std::numbers::pi * E_Pa);
    } else if (R_m > 0.0) {
      depth_m = std::cbrt(std::pow(0.75 * press.force_N / E_Pa, 2.0) / R_m);
    } else {
      const double side_m = scene.width_m > 0.0 ? scene.width_m : H_m;
      const double area = scene.is_plane() ? side_m : side_m * side_m;
      depth_m = press.force_N / area * H_m / bonded_modulus_Pa(scene);
    }
  }
  const double half_m = R_m > 0.0 ? std::sqrt(R_m * depth_m) : H_m;
  return depth_m / std::min(H_m, half_m);
}

}  // namespace viscard
