#include "models/array/space/foot_motion.h"

#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

// Feet, film and waves for the motion under a foot; finer ones change it by 1e-6 of a pillar's shortening.
constexpr Discretisation kFootMesh{.degree = 5, .layers = 3};
constexpr int kFilmDegree = 9, kFilmHarmonics = 2;
constexpr double kFilmWaves = 12.0;  // largest k times the thickness

constexpr int kPressureLoad = static_cast<int>(TopLoad::kPressure);

// The work of a foot's traction under pressure on the film's displacement.
DirectionReading work_reading(const FilmTable& film, const FootForces& foot) {
  return [&film, &foot](double k_1_m) {
    const AxialTransform t = transform(foot.pressure, foot.radius_m, k_1_m);
    std::vector<Eigen::Vector4d> rows;
    for (const Eigen::Matrix4d& response : film.at(k_1_m)) {
      rows.emplace_back(t.tau_x * response.row(0) + t.t_z * response.row(2));
    }
    return rows;
  };
}

}  // namespace

FootMotion::FootMotion(const SpaceArray& array) : array_(&array) {
  const double t_m = array.film.layers.front().thickness_m;
  double widest_m = 0.0;
  for (const PillarClass& one : array.classes) {
    widest_m = std::max(widest_m, 0.5 * one.geometry.diameter_m);
  }
  const double reach_m = 2.0 * widest_m + 9.0 * t_m;
  const FilmTable film(array.film, kFilmWaves, kFilmHarmonics, kFilmDegree,
                       std::max(reach_m, array_diagonal_m(array)));
  for (const PillarClass& one : array.classes) {
    Foot foot;
    foot.forces = foot_forces(one.geometry, one.medium, kFootMesh, film.largest_k_1_m(), &film);
    const double R_m = 0.5 * one.geometry.diameter_m;
    foot.area_m2 = std::numbers::pi * R_m * R_m;
    foot.lever_m3 = 0.25 * foot.area_m2 * R_m;
    foot.turning_rad_Nm = own_turning_J_Pa2(film, foot.forces) / (foot.lever_m3 * foot.lever_m3);
    feet_.push_back(std::move(foot));
  }
  const double longest_1_m = std::min(kWavePhase / reach_m, kWaveStep / t_m);
  for (const Foot& moved : feet_) {
    const DirectionReading reading = work_reading(film, moved.forces);
    works_.emplace_back();
    for (const Foot& loaded : feet_) {
      const PotentialSpectrum spectrum =
          graded_spectrum(film, reading, loaded.forces, film.largest_k_1_m(), longest_1_m, false);
      works_.back().emplace_back(PotentialTable(spectrum, {}, reach_m), film, reading,
                                 loaded.forces);
    }
  }
}

// The mean over the directions of the work of a tilted foot's traction on its own displacement.
double FootMotion::own_turning_J_Pa2(const FilmTable& film, const FootForces& foot) const {
  double sum = 0.0;
  each_graded_wave(film.smallest_k_1_m(), film.largest_k_1_m(), 2.0 / foot.radius_m.back(),
                   [&](double k_1_m, double weight) {
                     const SidewaysTransform t = transform(foot.tilt, foot.radius_m, k_1_m);
                     film.each_direction(
                         k_1_m, [&](double angle, double share, const Eigen::Matrix4d& at) {
                           const Eigen::Vector3d wave(2.0 * t.along * std::cos(angle),
                                                      -2.0 * t.across * std::sin(angle),
                                                      2.0 * t.normal * std::cos(angle));
                           sum += weight * share * wave.dot(at.topLeftCorner<3, 3>() * wave);
                         });
                   });
  return sum;
}

double FootMotion::own_sinking_m_N(int of_class) const {
  const auto at = static_cast<std::size_t>(of_class);
  const double area_m2 = feet_[at].area_m2;
  return works_[at][at].at(0.0, 0.0)[kPressureLoad] / (area_m2 * area_m2);
}

// A tilting traction t_z = x/R has the moment -lever in int p x dA, and turns the top up toward +x.
Eigen::MatrixXd FootMotion::kernel(int of_class, double x_m, double y_m) const {
  const auto from = static_cast<std::size_t>(of_class);
  const Foot& loaded = feet_[from];
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(feet_.size()), 3);
  for (std::size_t to = 0; to < feet_.size(); ++to) {
    const Foot& moved = feet_[to];
    auto block = motion.middleRows<3>(3 * static_cast<Eigen::Index>(to));
    const PotentialByLoad there = works_[to][from].at(x_m, y_m);
    const PotentialByLoad back = works_[from][to].at(-x_m, -y_m);  // reciprocity
    block(0, 0) = there[kPressureLoad] / (moved.area_m2 * loaded.area_m2);
    constexpr std::array<TopLoad, 2> kTilts = {TopLoad::kTiltX, TopLoad::kTiltY};
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const auto tilt = static_cast<int>(kTilts[static_cast<std::size_t>(axis)]);
      block(0, 1 + axis) = -there[tilt] / (moved.area_m2 * loaded.lever_m3);
      block(1 + axis, 0) = -back[tilt] / (moved.lever_m3 * loaded.area_m2);
      // The turning of neighbours by a moment is less than (R/pitch)^2 of their sinking over R.
      if (x_m == 0.0 && y_m == 0.0 && to == from) {
        block(1 + axis, 1 + axis) = moved.turning_rad_Nm;
      }
    }
  }
  return motion;
}

YieldingBase FootMotion::under(const std::vector<std::size_t>& pillars) const {
  std::vector<SourcePoint> points;
  for (const std::size_t at : pillars) {
    const PlacedPillar& one = array_->pillars[at];
    points.push_back({one.x_m, one.y_m, one.of_class});
  }
  const int classes = static_cast<int>(feet_.size());
  std::array<KernelMirror, 2> mirrors;
  for (int axis = 0; axis < 2; ++axis) {
    KernelMirror& mirror = mirrors[static_cast<std::size_t>(axis)];
    Eigen::Vector3d sign = Eigen::Vector3d::Ones();
    sign[1 + axis] = -1.0;
    mirror.load_sign = sign;
    mirror.reading_sign = sign.replicate(classes, 1);
    for (int r = 0; r < 3 * classes; ++r) mirror.reading.push_back(r);
  }
  auto sums = std::make_shared<const OffsetSums>(
      points, classes,
      [this](int of_class, double x_m, double y_m) { return kernel(of_class, x_m, y_m); }, mirrors);
  return [sums, points](const BaseForces& forces) {
    const Eigen::MatrixXd by_class = sums->apply(forces);
    BaseMotions motions(forces.rows(), 3);
    for (Eigen::Index i = 0; i < motions.rows(); ++i) {
      const int kind = points[static_cast<std::size_t>(i)].kind;
      motions.row(i) = by_class.row(i).segment<3>(3 * kind);
    }
    return motions;
  };
}

double foot_settling_m_Pa(const LayeredFilm& film, const FootForces& foot) {
  constexpr int kAngles = 3;  // 0, 45 and 90 degrees: harmonics 0, 2 and 4 of the angle
  constexpr double kLargestkR = 16.0;
  constexpr int kPanels = 8, kPoints = 5, kDegree = 6;
  const double R_m = foot.radius_m.back();
  const QuadratureRule rule = gauss_legendre(kPoints);
  const double step_1_m = kLargestkR / R_m / kPanels;
  double work_m3_Pa = 0.0;  // twice the work of 1 Pa, by Parseval
  for (int j = 0; j < kAngles; ++j) {
    const double share = j == 1 ? 0.5 : 0.25;  // trapezium over a quarter turn
    const FilmWaves waves(film, 0.25 * std::numbers::pi * j, kLargestkR / R_m, kDegree);
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const double k_1_m = (panel + rule.points[q]) * step_1_m;
        const AxialTransform t = transform(foot.pressure, foot.radius_m, k_1_m);
        const Eigen::Vector4d load(t.tau_x, 0.0, t.t_z, 0.0);
        work_m3_Pa += share * rule.weights[q] * step_1_m * k_1_m / (2.0 * std::numbers::pi) *
                      load.dot(waves.response(k_1_m) * load);
      }
    }
  }
  return work_m3_Pa / (std::numbers::pi * R_m * R_m);
}

}  // namespace viscard
