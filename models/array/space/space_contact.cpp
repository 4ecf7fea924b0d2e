#include "models/array/space/space_contact.h"

#include "models/array/contact/pull_off.h"
#include "models/array/contact/sticking_top.h"
#include "models/array/space/foot_motion.h"

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
      // Pushed toward +x, a top turns down on that side, where its tilt falls.
      sheared_.push_back(
          {foot.sideways_by_shear_m_Pa / area_m2, -foot.tilt_by_shear_1_Pa / area_m2});
      sideways_m_Pa_.push_back(foot.sideways_by_tilt_m_Pa);
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
      classes.emplace_back(std::move(top), sticking_on(i, grid));
    }
    return classes;
  }

  // Of a class of tops that sticks, else nothing.
  std::shared_ptr<const StickingTop> sticking_on(std::size_t of_class, int grid) const {
    if (scene_->press->friction != Friction::kStick) return nullptr;
    const PillarClass& one = array_.classes[of_class];
    StickingCompliance top =
        sticking_compliance(one.geometry, one.medium, kGrids.at(static_cast<std::size_t>(grid)));
    top.adjust({.sinking_m_N = sinking_m_N_[of_class],
                .sideways_m_N = sheared_[of_class].first,
                .turning_rad_N = sheared_[of_class].second,
                .turning_rad_Nm = turning_rad_Nm_[of_class]});
    return std::make_shared<const StickingTop>(std::move(top));
  }

  SpaceContact on(int grid, std::optional<double> near_m = {}) const {
    return pressed(classes_on(grid), *scene_->press, near_m);
  }

  // `near_m` as for press_with_force().
  SpaceContact pressed(const std::vector<TopContact>& classes, const ShapePress& press,
                       std::optional<double> near_m = {}) const {
    const TopBond bond = scene_->feels_contact ? TopBond::kPushed : TopBond::kFollows;
    if (on_base_) {
      return contact_of(press.force_N > 0.0 ? on_base_->with_force(classes, press.force_N)
                                            : on_base_->to_depth(classes, press.depth_m));
    }
    if (press.work_of_adhesion_J_m2 > 0.0 && scene_->feels_contact) return held(classes, press);
    return contact_of(
        press.force_N > 0.0
            ? press_with_force(pillars_, classes, press.shape, press.force_N, bond, near_m)
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

  // Their tops turn freely while they are dragged.
  SlidingTop dragged(std::size_t pillar) const {
    const auto of_class = static_cast<std::size_t>(pillars_[pillar].of_class);
    return {1.0 / sheared_[of_class].first, scene_->pillar.terms.size()};
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
      const double R_m = 0.5 * array_.classes[of_class].geometry.diameter_m;
      load = load_of(tops[i], R_m);
      contact.twist_Pa.push_back(2.0 * std::abs(tops[i].torque_Nm) / (disc_m2(R_m) * R_m));
      const double by_shear_m_Pa = sheared_[of_class].first * disc_m2(R_m);
      const auto way_m = [&](TopLoad shear, TopLoad tilt) {
        return by_shear_m_Pa * load[static_cast<int>(shear)] +
               sideways_m_Pa_[of_class] * load[static_cast<int>(tilt)];
      };
      contact.sideways_m.push_back(std::hypot(way_m(TopLoad::kShearX, TopLoad::kTiltX),
                                              way_m(TopLoad::kShearY, TopLoad::kTiltY)));
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
  std::vector<std::pair<double, double>> sheared_;                    // m/N and rad/N, by class
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
    // A twist about the axis of a top is not among its loads; its readings count as an error, those of a shear
    // that is as large at the rim.
    const auto at = static_cast<Eigen::Index>(i);
    for (const TopLoad shear : {TopLoad::kShearX, TopLoad::kShearY}) {
      double& change_Pa = fine.change_Pa(at, static_cast<int>(shear));
      change_Pa += std::copysign(fine.twist_Pa[i], change_Pa);
    }
  }
}

// Changes of the whole force and depth keep a share at cut tops only.
void keep_share(const SpaceContact& before, SpaceContact& fine) {
  bool is_cut = false;
  for (std::size_t i = 0; i < fine.pressed.tops.size(); ++i) {
    const double kept = kept_share(fine.pressed.tops[i]);
    if (kept == 0.0) continue;
    is_cut = is_cut || fine.pressed.tops[i].is_cut;
    const auto row = static_cast<Eigen::Index>(i);
    for (int load = 0; load < kTopLoads; ++load) {
      double& now_Pa = fine.change_Pa(row, load);
      const double kept_Pa = kept * before.change_Pa(row, load);
      if (std::abs(now_Pa) < std::abs(kept_Pa)) now_Pa = kept_Pa;
    }
    fine.force_change_N[i] = std::max(fine.force_change_N[i], kept * before.force_change_N[i]);
    fine.share_change[i] = std::max(fine.share_change[i], kept * before.share_change[i]);
  }
  if (!is_cut) return;
  fine.total_change_N = std::max(fine.total_change_N, 0.5 * before.total_change_N);
  fine.depth_change_m = std::max(fine.depth_change_m, 0.5 * before.depth_change_m);
}

// Tops that stick have three times as many unknowns; the last grid would take minutes.
int grids_of(const SpaceScene& scene) {
  return scene.press->friction == Friction::kStick ? kContactGrids - 1 : kContactGrids;
}

int known_grid(int grid) {
  return std::clamp(grid, 0, kContactGrids - 1);
}

}  // namespace

SpaceContact contact_on(const SpaceScene& scene, int grid) {
  return Presser(scene).on(std::clamp(grid, 0, grids_of(scene) - 1));
}

struct SpaceTops::Parts {
  std::shared_ptr<const Presser> presser;
  std::vector<TopContact> classes;
  ShapePress press;
  std::size_t pillars = 0;
};

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

std::vector<SlidingTop> SpaceTops::dragged(const std::vector<std::size_t>& pillars) const {
  std::vector<SlidingTop> tops;
  for (const std::size_t pillar : pillars) tops.push_back(parts_->presser->dragged(pillar));
  return tops;
}

SpaceContact SpaceTops::contact_of(const PressedArray& some,
                                   const std::vector<std::size_t>& pillars) const {
  PressedArray all = some;
  all.tops.assign(parts_->pillars, {});
  for (std::size_t i = 0; i < pillars.size(); ++i) all.tops[pillars[i]] = some.tops[i];
  return parts_->presser->contact_of(std::move(all));
}

SpaceContact contact_within(const SpaceScene& scene, double tolerance) {
  Presser presser(scene);
  SpaceContact contact = presser.on(0);
  for (int grid = 1; grid < grids_of(scene); ++grid) {
    SpaceContact finer = presser.on(grid, contact.pressed.depth_m);
    compare(contact, finer);
    keep_share(contact, finer);
    contact = std::move(finer);
    const double largest_Pa = contact.loads_Pa.cwiseAbs().maxCoeff();
    if (contact.change_Pa.cwiseAbs().maxCoeff() <= tolerance * largest_Pa) break;
  }
  return contact;
}

}  // namespace viscard
