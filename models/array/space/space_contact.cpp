#include "models/array/space/space_contact.h"

#include "models/array/contact/pull_off.h"
#include "models/array/space/foot_motion.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr std::array<TopFineness, kContactGrids> kGrids = {
    {{6, 16}, {12, 32}, {24, 64}, {48, 128}}};
// Of the stiffness of a pillar in a graded mesh, and one to compare with.
constexpr Discretisation kStiffnessMesh{.degree = 6, .layers = 4};
constexpr Discretisation kCoarserMesh{.degree = 5, .layers = 3};
// Neglected part of a foot's settling: that of its neighbours (1e-3), and that of the film's short
// waves (1e-2).
constexpr double kOfSettling = 0.02;

std::vector<TouchedPillar> touched_pillars(const SpaceScene& scene) {
  const std::vector<SpaceClass> classes = classes_of(scene);
  std::vector<TouchedPillar> pillars;
  pillars.reserve(scene.pillars.size());
  for (const SpacePillar& one : scene.pillars) {
    const double length_m = classes[static_cast<std::size_t>(one.of_class)].length_m;
    pillars.push_back({one.x_m, one.y_m, length_m - scene.length_m, one.of_class});
  }
  return pillars;
}

double disc_m2(double radius_m) {
  return std::numbers::pi * radius_m * radius_m;
}

// A pressure and two tilts with the force and the moments of a top. Tilting tractions point up, pressures
// down.
Eigen::Matrix<double, 1, kTopLoads> load_of(const TopPressure& top, double R_m) {
  Eigen::Matrix<double, 1, kTopLoads> load = Eigen::Matrix<double, 1, kTopLoads>::Zero();
  load[static_cast<int>(TopLoad::kPressure)] = top.force_N / disc_m2(R_m);
  const double of_moment = -1.0 / (0.25 * disc_m2(R_m) * R_m);
  load[static_cast<int>(TopLoad::kTiltX)] = of_moment * top.moment_x_Nm;
  load[static_cast<int>(TopLoad::kTiltY)] = of_moment * top.moment_y_Nm;
  return load;
}

}  // namespace

// Presses the shape of a scene on its array.
class Presser {
 public:
  explicit Presser(const SpaceScene& scene)
      : scene_(&scene), array_(array_of(scene)), pillars_(touched_pillars(scene)) {
    for (const PillarClass& one : array_.classes) {
      const FootForces foot = foot_forces(one.geometry, one.medium, kStiffnessMesh);
      const double R_m = 0.5 * one.geometry.diameter_m;
      const double area_m2 = disc_m2(R_m);
      // On a backing the film's motion under all feet is solved (FootMotion); its own on a rigid base
      // serves for the error.
      LayeredFilm held = array_.film;
      held.backing.reset();
      const double settling_m_Pa = foot_settling_m_Pa(held, foot);
      const double coarser_m_Pa = foot_forces(one.geometry, one.medium, kCoarserMesh).sinking_m_Pa;
      const double of_base_m_Pa = array_.film.backing ? 0.0 : settling_m_Pa;
      sinking_m_N_.push_back((foot.sinking_m_Pa + of_base_m_Pa) / area_m2);
      error_ = std::max(error_,
                        (std::abs(foot.sinking_m_Pa - coarser_m_Pa) + kOfSettling * settling_m_Pa) /
                            foot.sinking_m_Pa);
      settling_share_ = std::max(settling_share_, settling_m_Pa / foot.sinking_m_Pa);
      turning_rad_Nm_.push_back(foot.tilt_by_tilt_1_Pa / (0.25 * area_m2 * R_m));
      sideways_m_Pa_.push_back(std::abs(foot.sideways_by_tilt_m_Pa));
    }
    if (!array_.film.backing) return;
    base_.emplace(array_);
    on_base_.emplace(pillars_, scene.press->shape, [this](const std::vector<std::size_t>& pillars) {
      return base_->under(pillars);
    });
  }
  Presser(const Presser&) = delete;
  Presser& operator=(const Presser&) = delete;

  std::vector<TopContact> classes_on(int grid) const {
    std::vector<TopContact> classes;
    for (std::size_t i = 0; i < array_.classes.size(); ++i) {
      const PillarClass& one = array_.classes[i];
      TopCompliance top =
          top_compliance(one.geometry, one.medium, kGrids.at(static_cast<std::size_t>(grid)));
      top.adjust(sinking_m_N_[i], turning_rad_Nm_[i]);
      classes.emplace_back(std::move(top));
    }
    return classes;
  }

  SpaceContact on(int grid) const { return pressed(classes_on(grid), *scene_->press); }

  SpaceContact pressed(const std::vector<TopContact>& classes, const ShapePress& press) const {
    const TopBond bond = scene_->feels_contact ? TopBond::kPushed : TopBond::kFollows;
    if (on_base_) {
      return contact_of(press.force_N > 0.0 ? on_base_->with_force(classes, press.force_N)
                                            : on_base_->to_depth(classes, press.depth_m));
    }
    if (press.work_of_adhesion_J_m2 > 0.0 && scene_->feels_contact) return held(classes, press);
    return contact_of(press.force_N > 0.0
                          ? press_with_force(pillars_, classes, press.shape, press.force_N, bond)
                          : press_to_depth(pillars_, classes, press.shape, press.depth_m, bond));
  }

  // With adhesion.
  SpaceContact held(const std::vector<TopContact>& classes, const ShapePress& press) const {
    std::vector<double> of_class_N;
    for (const SpaceClass& one : classes_of(*scene_)) {
      of_class_N.push_back(class_pull_off_N(one, press.work_of_adhesion_J_m2));
    }
    const std::vector<TopHold> holds = holds_of(pillars_, classes, press.shape, of_class_N);
    const std::vector<double> path_m = path_of(press);
    SpaceContact contact = contact_of(press_along(pillars_, classes, press.shape, holds, path_m));
    for (std::size_t i = 0; i < holds.size(); ++i) {
      const bool was_held = is_ever_held(holds[i], path_m);
      contact.release_m.push_back(was_held ? holds[i].released_m : std::nan(""));
      contact.pull_off_N.push_back(of_class_N[static_cast<std::size_t>(pillars_[i].of_class)]);
    }
    return contact;
  }

  SpaceContact contact_of(PressedArray pressed) const {
    SpaceContact contact;
    contact.pressed = std::move(pressed);
    set_loads(contact);
    contact.stiffness_error = error_;
    contact.settling_share = settling_share_;
    return contact;
  }

  RelaxingTops relaxing(const std::vector<TopContact>& classes,
                        const std::vector<std::size_t>& which) const {
    std::vector<TouchedPillar> some;
    for (const std::size_t pillar : which) some.push_back(pillars_[pillar]);
    return {some, classes, scene_->press->shape, scene_->pillar.terms.size()};
  }

 private:
  void set_loads(SpaceContact& contact) const {
    const std::vector<TopPressure>& tops = contact.pressed.tops;
    contact.loads_Pa = TopLoads::Zero(static_cast<Eigen::Index>(tops.size()), kTopLoads);
    contact.change_Pa = contact.loads_Pa;
    contact.force_change_N.assign(tops.size(), 0.0);
    contact.share_change.assign(tops.size(), 0.0);
    for (std::size_t i = 0; i < tops.size(); ++i) {
      const auto of_class = static_cast<std::size_t>(pillars_[i].of_class);
      auto load = contact.loads_Pa.row(static_cast<Eigen::Index>(i));
      load = load_of(tops[i], 0.5 * array_.classes[of_class].geometry.diameter_m);
      contact.sideways_m.push_back(sideways_m_Pa_[of_class] *
                                   std::hypot(load[static_cast<int>(TopLoad::kTiltX)],
                                              load[static_cast<int>(TopLoad::kTiltY)]));
    }
  }

  const SpaceScene* scene_;
  SpaceArray array_;
  std::vector<TouchedPillar> pillars_;
  std::optional<FootMotion> base_;              // of a film on a backing
  mutable std::optional<PressOnBase> on_base_;  // keeps what it has computed
  double error_ = 0.0;                          // relative, of the stiffness
  double settling_share_ = 0.0;
  std::vector<double> sinking_m_N_, turning_rad_Nm_, sideways_m_Pa_;  // by class
};

namespace {

void compare(const SpaceContact& coarse, SpaceContact& fine) {
  fine.change_Pa = fine.loads_Pa - coarse.loads_Pa;
  fine.total_change_N = std::abs(fine.pressed.force_N - coarse.pressed.force_N);
  fine.depth_change_m = std::abs(fine.pressed.depth_m - coarse.pressed.depth_m);
  fine.contact_change = std::abs(fine.pressed.contacts - coarse.pressed.contacts);
  for (std::size_t i = 0; i < fine.pressed.tops.size(); ++i) {
    const TopPressure& a = coarse.pressed.tops[i];
    const TopPressure& b = fine.pressed.tops[i];
    fine.force_change_N[i] = std::abs(b.force_N - a.force_N);
    fine.share_change[i] = std::abs(b.share - a.share) + b.share_error;
  }
}

}  // namespace

double SpaceContact::largest_force_N() const {
  double largest_N = 0.0;
  for (const TopPressure& top : pressed.tops)
    largest_N = std::max(largest_N, std::abs(top.force_N));
  return largest_N;
}

SpaceContact contact_on(const SpaceScene& scene, int grid) {
  return Presser(scene).on(std::clamp(grid, 0, kContactGrids - 1));
}

struct SpaceTops::Parts {
  std::shared_ptr<const Presser> presser;
  std::vector<TopContact> classes;
  ShapePress press;
  std::size_t pillars = 0;
};

namespace {

int known_grid(int grid) {
  return std::clamp(grid, 0, kContactGrids - 1);
}

}  // namespace

SpaceTops::SpaceTops(const SpaceScene& scene, int grid) {
  const auto presser = std::make_shared<const Presser>(scene);
  parts_ = std::make_shared<const Parts>(
      Parts{presser, presser->classes_on(known_grid(grid)), *scene.press, scene.pillars.size()});
}

SpaceTops SpaceTops::on_grid(int grid) const {
  return SpaceTops(std::make_shared<const Parts>(
      Parts{parts_->presser, parts_->presser->classes_on(known_grid(grid)), parts_->press,
            parts_->pillars}));
}

SpaceContact SpaceTops::at_rest() const {
  return parts_->presser->pressed(parts_->classes, parts_->press);
}

SpaceContact SpaceTops::at_depth(double depth_m) const {
  return parts_->presser->pressed(parts_->classes,
                                  {.shape = parts_->press.shape, .depth_m = depth_m});
}

RelaxingTops SpaceTops::relaxing(const std::vector<std::size_t>& pillars) const {
  return parts_->presser->relaxing(parts_->classes, pillars);
}

SpaceContact SpaceTops::contact_of(const PressedArray& some,
                                   const std::vector<std::size_t>& pillars) const {
  PressedArray all = some;
  all.tops.assign(parts_->pillars, {});
  for (std::size_t i = 0; i < pillars.size(); ++i) all.tops[pillars[i]] = some.tops[i];
  return parts_->presser->contact_of(std::move(all));
}

TopLoads loads_of_tops(const SpaceScene& scene, const std::vector<TopPressure>& tops,
                       const std::vector<std::size_t>& pillars) {
  TopLoads loads(static_cast<Eigen::Index>(tops.size()), kTopLoads);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const double d_m = class_of(scene, scene.pillars[pillars[i]]).diameter_m;
    loads.row(static_cast<Eigen::Index>(i)) = load_of(tops[i], 0.5 * d_m);
  }
  return loads;
}

SpaceContact contact_within(const SpaceScene& scene, double tolerance) {
  Presser presser(scene);
  SpaceContact contact = presser.on(0);
  for (int grid = 1; grid < kContactGrids; ++grid) {
    SpaceContact finer = presser.on(grid);
    compare(contact, finer);
    contact = std::move(finer);
    const double largest_Pa = contact.loads_Pa.cwiseAbs().maxCoeff();
    if (contact.change_Pa.cwiseAbs().maxCoeff() <= tolerance * largest_Pa) break;
  }
  return contact;
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
  return work_m3_Pa / disc_m2(R_m);
}

}  // namespace viscard
