// From the voltages of an array back to the loads on its tops: what models/array/inverse needs to know of a scene.
#include "models/array/space/space_inverse.h"

#include "models/answer/scene_mistake.h"
#include "models/array/space/simulate_space.h"
#include "models/maths/neighbours.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kTolerance = 1e-4;                 // decides on charges of other electrodes
constexpr std::size_t kLevel = 2, kFinerLevel = 3;  // of space_accuracies(): 7e-5 and better

// What charges on all electrodes of a lattice of like pillars add to the voltage of one in its middle, by the offset from a
// loaded pillar (eq. S17). At the edge of an array electrodes are missing, which changes these charges.
class LatticeCharges {
 public:
  // Nothing where offsets do not repeat.
  static std::optional<LatticeCharges> of(const SpaceArray& array, double reach_m,
                                          std::size_t level) {
    LatticeCharges charges;
    charges.unit_m_ = kSameOffset * reach_m;
    const std::vector<SourcePoint> points = sources_of(array);
    const Neighbours near(points, reach_m);
    std::map<Key, SourcePoint> offsets;
    for (std::size_t i = 0; i < points.size(); ++i) {
      near.visit(points[i].x_m, points[i].y_m, [&](std::size_t j) {
        const double x_m = points[j].x_m - points[i].x_m, y_m = points[j].y_m - points[i].y_m;
        if (offsets.size() <= kMostOffsets)
          offsets.emplace(charges.key(x_m, y_m), SourcePoint{x_m, y_m, 0});
      });
      if (offsets.size() > kMostOffsets) return {};
    }
    charges.added_ = charges.added_on(array, offsets, level, false);
    // A quarter of the lattice, as from its corner.
    for (const auto& [key, value] : charges.added_on(array, offsets, level, true)) {
      charges.at_edge_V_Pa_ += std::abs((value - charges.added_.at(key))[0]);
    }
    return charges;
  }

  // V/Pa by kind of load.
  Eigen::RowVectorXd at(double x_m, double y_m) const {
    const auto found = added_.find(key(x_m, y_m));
    return found == added_.end() ? Eigen::RowVectorXd::Zero(kTopLoads).eval() : found->second;
  }
  // Sum over the offsets of what the missing electrodes change, per pressure.
  double at_edge_V_Pa() const { return at_edge_V_Pa_; }

 private:
  using Key = std::pair<long, long>;
  using Added = std::map<Key, Eigen::RowVectorXd>;
  static constexpr double kSameOffset = 1e-7;  // of the reach
  static constexpr std::size_t kMostOffsets = 500;

  Key key(double x_m, double y_m) const {
    return {std::lround(x_m / unit_m_), std::lround(y_m / unit_m_)};
  }
  Added added_on(SpaceArray array, const std::map<Key, SourcePoint>& offsets, std::size_t level,
                 bool is_corner) const {
    array.pillars = {{0.0, 0.0, 0}};
    for (const auto& [key, point] : offsets) {
      if (key == Key{0, 0} || (is_corner && (key.first < 0 || key.second < 0))) continue;
      array.pillars.push_back({point.x_m, point.y_m, 0});
    }
    Added added;
    if (array.pillars.size() < 2) return added;
    const SpaceResponse response(array, space_accuracies(array)[level]);
    const Eigen::MatrixXd rows = response.added_by_electrodes(0);
    for (std::size_t p = 0; p < array.pillars.size(); ++p) {
      const Key from = key(-array.pillars[p].x_m, -array.pillars[p].y_m);
      added[from] = rows.row(static_cast<Eigen::Index>(p));
    }
    return added;
  }

  double unit_m_ = 0.0, at_edge_V_Pa_ = 0.0;
  Added added_;
};

// The readings of one array per load at an offset.
class InverseKernel {
 public:
  InverseKernel(const SpaceScene& scene, std::size_t level, bool at_centre)
      : array_(array_of(scene)),
        is_in_quarters_(has_quarters(scene.electrode)),
        row_(is_in_quarters_ ? first_quarter(scene.electrode)
             : at_centre     ? 0
                             : whole_reading(scene.electrode)),
        response_(array_, without_coupling(space_accuracies(array_)[level])) {}

  Eigen::MatrixXd at(int of_class, double x_m, double y_m) const {
    auto all = response_.kernel(of_class, x_m, y_m);
    if (charges_) all.row(0) += charges_->at(x_m, y_m);
    return all.block(row_, 0, is_in_quarters_ ? 4 : 1, kFirstTilt);
  }
  double reach_m() const { return response_.reach_m(); }
  // Includes charges of other electrodes; false where they are left out.
  bool couple(std::size_t level) {
    if (array_.classes.size() == 1) charges_ = LatticeCharges::of(array_, reach_m(), level);
    return charges_.has_value();
  }
  double at_edge_V_Pa() const { return charges_ ? charges_->at_edge_V_Pa() : 0.0; }

 private:
  static constexpr Eigen::Index kFirstTilt = static_cast<Eigen::Index>(TopLoad::kTiltX);
  SpaceArray array_;
  bool is_in_quarters_;
  Eigen::Index row_;
  SpaceResponse response_;
  std::optional<LatticeCharges> charges_;
};

// Largest change of the own voltage between the two, over it; and the sum of those at the nearest pillars.
struct KernelChange {
  double own = 0.0, others = 0.0;
};
KernelChange change_between(const SpaceScene& scene, const InverseKernel& coarse,
                            const InverseKernel& fine) {
  constexpr int kAround = 8, kSteps = 3;  // directions, and distances within the reach
  KernelChange change;
  const auto loads = inverse_loads(scene);
  const double pitch_m = smallest_pitch_m(scene);
  for (int of_class = 0; of_class <= static_cast<int>(scene.others.size()); ++of_class) {
    const auto size_of = [&](double x_m, double y_m) {
      const Eigen::MatrixXd a = coarse.at(of_class, x_m, y_m), b = fine.at(of_class, x_m, y_m);
      return (a - b).leftCols(loads).cwiseAbs().maxCoeff();
    };
    const double own_V_Pa = fine.at(of_class, 0.0, 0.0).leftCols(loads).cwiseAbs().maxCoeff();
    change.own = std::max(change.own, size_of(0.0, 0.0) / own_V_Pa);
    double others = 0.0;
    for (int step = 1; step <= kSteps && scene.pillars.size() > 1; ++step) {
      for (int d = 0; d < kAround; ++d) {
        const double angle = 2.0 * std::numbers::pi * d / kAround, r_m = step * pitch_m;
        // A ring holds about 8 pillars per step.
        others += step * size_of(r_m * std::cos(angle), r_m * std::sin(angle)) / own_V_Pa;
      }
    }
    change.others = std::max(change.others, others);
  }
  return change;
}

// The array of a scene under a small load of each kind that is found.
SpaceScene without_loads(SpaceScene scene) {
  scene.press.reset();
  scene.touch.reset();
  scene.heat.reset();
  scene.noise.reset();
  scene.noise_readout.reset();
  scene.quadrants = {};
  scene.wanted.clear();
  scene.loaded.clear();
  scene.pressure_Pa = 1.0;
  scene.tolerance = kTolerance;
  scene.shear_x_Pa = scene.shear_y_Pa = inverse_loads(scene) > 1 ? 1.0 : 0.0;
  return scene;
}

void check_inverse(const SpaceScene& scene, const InverseOptions& options) {
  if (scene.backing && scene.feels_backing) {
    throw SceneMistake(
        "geometry.film.backing",
        "lets every electrode feel all pillars; pressures are found from voltages of "
        "films on a rigid base: say backing = \"rigid\"");
  }
  if (options.noise_V && !(*options.noise_V > 0.0 && std::isfinite(*options.noise_V))) {
    throw std::invalid_argument("noise must be positive: V rms of each electrode, such as 1e-5");
  }
  if (!(options.gain_spread >= 0.0 && options.gain_spread < 1.0)) {
    throw std::invalid_argument(
        "gain_spread must lie between 0 and 1: a standard deviation over the gain, such as 0.02");
  }
  if (!(options.shear_Pa >= 0.0 && std::isfinite(options.shear_Pa))) {
    throw std::invalid_argument("shear must not be negative");
  }
  if (options.shear_Pa > 0.0 && has_quarters(scene.electrode)) {
    throw std::invalid_argument("shear is found from quarters; it is stated for one electrode");
  }
  if (options.choice.weight && !(*options.choice.weight > 0.0)) {
    throw std::invalid_argument("weight must be positive");
  }
}

}  // namespace

Eigen::Index inverse_readings(const SpaceScene& scene) {
  return has_quarters(scene.electrode) ? 4 : 1;
}

Eigen::Index inverse_loads(const SpaceScene& scene) {
  return has_quarters(scene.electrode) ? 3 : 1;
}

LoadReader load_reader(const SpaceScene& whole, const VoltageFrames& examples,
                       const InverseOptions& options) {
  const SpaceScene scene = without_loads(whole);
  validate(scene);
  check_inverse(scene, options);
  const auto kernel = std::make_shared<InverseKernel>(scene, kFinerLevel, options.at_centre);
  InverseKernel coarse(scene, kLevel, options.at_centre);
  const ConstantErrors constant = constant_errors(scene);
  double of_charges = electrode_error(scene);
  if (constant.coupling.is_on && kernel->couple(kFinerLevel) && coarse.couple(kLevel)) {
    of_charges = constant.coupling.error;
  }
  ReadArray array;
  array.pillars = sources_of(array_of(scene));
  array.classes = static_cast<int>(scene.others.size()) + 1;
  array.readings = inverse_readings(scene);
  array.loads = inverse_loads(scene);
  array.reach_m = kernel->reach_m();
  array.kernel = [kernel](int of_class, double x_m, double y_m) {
    return kernel->at(of_class, x_m, y_m);
  };
  const auto readings = static_cast<std::size_t>(array.readings);
  const std::size_t places =
      static_cast<std::size_t>(scene.rows) * static_cast<std::size_t>(scene.columns);
  std::vector<std::size_t> place_of;
  array.works.assign(scene.pillars.size() * readings, 1);
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& one = scene.pillars[i];
    place_of.push_back(static_cast<std::size_t>(one.row - 1) *
                           static_cast<std::size_t>(scene.columns) +
                       static_cast<std::size_t>(one.column - 1));
    for (std::size_t r = 0; r < readings; ++r) {
      for (std::size_t f = 0; f < examples.count; ++f) {
        const double voltage_V = examples.voltages_V[(f * places + place_of.back()) * readings + r];
        if (std::isnan(voltage_V)) array.works[i * readings + r] = 0;
      }
    }
  }
  ReadingErrors errors;
  errors.noise_V = options.noise_V;
  errors.gain_spread = options.gain_spread;
  errors.disturbing_Pa = options.shear_Pa;
  const KernelChange change = change_between(scene, coarse, *kernel);
  errors.own_model = change.own + constant.foot + of_charges;
  errors.other_model = change.others + 2.0 * constant.foot * constant.neighbour +
                       kernel->at_edge_V_Pa() / std::abs(kernel->at(0, 0.0, 0.0)(0, 0));
  errors.pillar_model = constant.edge;
  return LoadReader(std::move(array), std::move(place_of), places, errors, options.choice,
                    examples);
}

}  // namespace viscard
