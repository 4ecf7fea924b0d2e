#include "models/array/plane/row_contact.h"

#include "models/array/contact/pull_off.h"
#include "models/array/plane/array_analysis.h"
#include "models/array/plane/strip_top.h"
#include "models/maths/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Equal elements across a top, and the meshes of the film below.
constexpr std::array<int, kRowGrids> kElements = {20, 40, 80, 160};
constexpr std::array<Discretisation, kRowGrids> kFilmMeshes = {{{.degree = 4, .layers = 2},
                                                                {.degree = 5, .layers = 3},
                                                                {.degree = 6, .layers = 4},
                                                                {.degree = 7, .layers = 4}}};
constexpr int kPorts = kFirstModePort + 2 * kTopDegree;

Eigen::VectorXd stacked(const StripForces& forces) {
  Eigen::VectorXd all(forces.along.size() + forces.down.size());
  all << forces.along, forces.down;
  return all;
}

// The row on one grid: tops, and the film that moves under them.
class RowTops {
 public:
  RowTops(const ArrayScene& scene, int grid)
      : scene_(&scene),
        strip_(strip_compliance(scene.geometry, media_of(scene),
                                kElements.at(static_cast<std::size_t>(grid)))),
        amplitudes_(traction_amplitudes(strip_, kTopDegree)),
        under_Pa_(Eigen::MatrixXd::Zero(kPorts, scene.geometry.count)) {
    if (scene.feels_film) add_film(kFilmMeshes.at(static_cast<std::size_t>(grid)));
    height_m_ = Eigen::MatrixXd::NullaryExpr(
        strip_.nodes(), scene.geometry.count, [&](Eigen::Index j, Eigen::Index i) {
          const double at_m = place_m(scene.geometry, static_cast<int>(i)) + strip_.x_m[j];
          return height_m(scene.press->shape, at_m, 0.0);
        });
    if (scene.feels_contact && scene.press->work_of_adhesion_J_m2 > 0.0) set_holds();
  }

  // The forces on all tops at a depth. The motion by neighbours is small, and is repeated until it stays.
  const std::vector<StripForces>& press(double depth_m) {
    constexpr int kMostPasses = 200;
    constexpr double kStays = 1e-12;
    double last = 0.0;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      press_each(depth_m);
      if (!model_ || !scene_->feels_neighbours) return forces_;
      const Eigen::MatrixXd under_Pa = motion_by_others();
      const double change = (under_Pa - under_Pa_).cwiseAbs().maxCoeff();
      under_Pa_ = under_Pa;
      const double size_m2 = scene_->geometry.diameter_m * motion_scale_m(depth_m);
      if (change <= kStays * size_m2 || (pass > 3 && change >= last)) {
        if (change > 1e-6 * size_m2) break;
        return forces_;
      }
      last = change;
    }
    throw std::runtime_error(
        "the pillars move each other through the film by more than they yield themselves; take a "
        "stiffer film or a larger spacing");
  }

  double force_N_m() const {
    double force = 0.0;
    for (const StripForces& one : forces_) force += one.down.sum();
    return force;
  }
  double first_touch_m() const { return height_m_.minCoeff(); }
  // One pillar alone sinks by this per force.
  double sinking_m2_N() const {
    const Eigen::Index n = strip_.nodes();
    const Eigen::VectorXd even = strip_.length_m / strip_.length_m.sum();
    return even.dot(strip_.motion_m2_N.bottomRightCorner(n, n) * even);
  }
  RowContact contact(double depth_m) const;

 private:
  void add_film(const Discretisation& mesh) {
    model_.reset(new ArrayModel(model_of(*scene_, mesh, {.top_degree = kTopDegree})));
    const int middle = (model_->geometry().count - 1) / 2;
    std::vector<int> ports;
    for (int port = 0; port < kPorts; ++port) ports.push_back(model_->pillar_port(middle, port));
    own_m2_Pa_ = model_->chain().compliance(ports)(ports, Eigen::all);
    const Eigen::MatrixXd held =
        model_->pillar().fixed_base_compliance().topLeftCorner(kPorts, kPorts);
    strip_.motion_m2_N += amplitudes_.transpose() * (own_m2_Pa_ - held) * amplitudes_;
  }

  // The largest of the depths and stretches that tops meet: motions are small against it, also at depth 0.
  double motion_scale_m(double depth_m) const {
    double scale_m = std::max(let_go_stretch_m_, depth_m - first_touch_m());
    for (const double at_m : scene_->press->before_m) scale_m = std::max(scale_m, std::abs(at_m));
    return std::max(scale_m, std::abs(depth_m));
  }

  // The force of a top that lies flat is linear in the depth.
  void set_holds() {
    const double limit_N_m = row_pull_off_N_m(*scene_, scene_->press->work_of_adhesion_J_m2);
    const auto flat_N_m = [&](const Eigen::VectorXd& overlap_m) {
      return strip_forces(strip_, {.overlap_m = overlap_m,
                                   .along_m = Eigen::VectorXd::Zero(strip_.nodes()),
                                   .friction = scene_->press->friction,
                                   .bond = TopBond::kFollows})
          .down.sum();
    };
    const double stiffness_Pa = flat_N_m(Eigen::VectorXd::Ones(strip_.nodes()));
    let_go_stretch_m_ = limit_N_m / stiffness_Pa;
    for (Eigen::Index i = 0; i < height_m_.cols(); ++i) {
      TopHold hold{.touched_m = height_m_.col(i).minCoeff()};
      if (height_m_.col(i).allFinite()) {
        hold.released_m = -(limit_N_m + flat_N_m(-height_m_.col(i))) / stiffness_Pa;
      }
      holds_.push_back(hold);
    }
  }

  TopBond bond_of(Eigen::Index pillar) const {
    if (!scene_->feels_contact) return TopBond::kFollows;
    const bool is_held = !holds_.empty() && is_held_after(holds_[static_cast<std::size_t>(pillar)],
                                                          path_of(*scene_->press));
    return is_held ? TopBond::kFollows : TopBond::kPushed;
  }

  void press_each(double depth_m) {
    const Eigen::Index n = strip_.nodes();
    forces_.clear();
    for (Eigen::Index i = 0; i < height_m_.cols(); ++i) {
      const Eigen::VectorXd moved_m = amplitudes_.transpose() * under_Pa_.col(i);
      forces_.push_back(strip_forces(
          strip_, {.overlap_m = (depth_m - height_m_.col(i).array()).matrix() - moved_m.tail(n),
                   .along_m = -moved_m.head(n),
                   .friction = scene_->press->friction,
                   .bond = bond_of(i)}));
    }
  }

  Eigen::VectorXd amplitudes_of(const StripForces& forces) const {
    return amplitudes_ * stacked(forces);
  }

  // Readings of each top's ports that its own loads do not cause, beside neighbours as in the middle.
  Eigen::MatrixXd motion_by_others() const {
    const int count = scene_->geometry.count;
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(model_->chain().port_count());
    Eigen::MatrixXd own(kPorts, count);
    for (int i = 0; i < count; ++i) {
      own.col(i) = amplitudes_of(forces_[static_cast<std::size_t>(i)]);
      for (int port = 0; port < kPorts; ++port) loads[model_->pillar_port(i, port)] = own(port, i);
    }
    const Eigen::VectorXd readings = model_->chain().readings(loads);
    Eigen::MatrixXd others = -own_m2_Pa_ * own;
    for (int i = 0; i < count; ++i) {
      for (int port = 0; port < kPorts; ++port)
        others(port, i) += readings[model_->pillar_port(i, port)];
    }
    return others;
  }

  const ArrayScene* scene_;
  StripCompliance strip_;       // on the film
  Eigen::MatrixXd amplitudes_;  // traction_amplitudes()
  Eigen::MatrixXd under_Pa_;    // readings of ports by the motion that neighbours cause, by pillar
  Eigen::MatrixXd height_m_;    // of the shape at depth 0: nodes x pillars
  std::unique_ptr<ArrayModel> model_;
  Eigen::MatrixXd own_m2_Pa_;  // readings of a pillar's ports under its own loads
  std::vector<StripForces> forces_;
  std::vector<TopHold> holds_;     // with adhesion
  double let_go_stretch_m_ = 0.0;  // of a flat top at its pull-off force
};

RowContact RowTops::contact(double depth_m) const {
  RowContact row;
  row.depth_m = depth_m;
  row.force_N_m = force_N_m();
  const auto count = static_cast<Eigen::Index>(forces_.size());
  const Eigen::Index n = strip_.nodes();
  const double width_m = strip_.length_m.sum();
  row.loads_Pa.resize(kPorts, count);
  row.sideways_m.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const StripForces& forces = forces_[static_cast<std::size_t>(i)];
    StripPressure top{.force_N_m = forces.down.sum(),
                      .moment_N = forces.down.dot(strip_.x_m),
                      .shear_N_m = forces.along.sum()};
    for (Eigen::Index j = 0; j < n; ++j) {
      if (forces.down[j] != 0.0) top.share += strip_.length_m[j] / width_m;
    }
    // The edge of the contact lies between two nodes.
    const bool is_partial = top.share > 0.0 && top.share < 1.0 - 1e-9;
    top.share_error = is_partial ? strip_.length_m.maxCoeff() / width_m : 0.0;
    row.contacts += top.share > 0.0 ? 1 : 0;
    row.loads_Pa.col(i) = amplitudes_of(forces);
    row.sideways_m[i] =
        strip_.length_m.dot(strip_.motion_m2_N.topRows(n) * stacked(forces)) / width_m;
    row.tops.push_back(top);
  }
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    if (is_ever_held(holds_[i], path_of(*scene_->press)))
      row.tops[i].release_m = holds_[i].released_m;
  }
  row.unknowns = static_cast<int>(2 * n) + (model_ ? model_->unknowns() : 0);
  return row;
}

RowContact contact_on(const ArrayScene& scene, int grid) {
  RowTops tops(scene, grid);
  const ShapePress& press = *scene.press;
  double depth_m = press.depth_m;
  if (press.force_N > 0.0) {
    const double low_m = tops.first_touch_m();
    require(std::isfinite(low_m), "there is no pillar under the shape");
    depth_of_force(
        [&](double at_m) {
          depth_m = at_m;
          tops.press(at_m);
          return tops.force_N_m();
        },
        {.low_m = low_m,
         .guess_m = low_m + press.force_N * tops.sinking_m2_N(),
         .force_N = press.force_N});
  } else {
    tops.press(depth_m);
  }
  return tops.contact(depth_m);
}

void compare(const RowContact& coarse, RowContact& fine) {
  fine.load_changes_Pa = fine.loads_Pa - coarse.loads_Pa;
  fine.force_change_N_m = std::abs(fine.force_N_m - coarse.force_N_m);
  fine.depth_change_m = std::abs(fine.depth_m - coarse.depth_m);
  fine.contact_change = std::abs(fine.contacts - coarse.contacts);
  fine.top_changes.clear();
  for (std::size_t i = 0; i < fine.tops.size(); ++i) {
    const StripPressure &a = coarse.tops[i], &b = fine.tops[i];
    fine.top_changes.push_back({.force_N_m = std::abs(b.force_N_m - a.force_N_m),
                                .moment_N = std::abs(b.moment_N - a.moment_N),
                                .shear_N_m = std::abs(b.shear_N_m - a.shear_N_m),
                                .share = std::abs(b.share - a.share) + b.share_error,
                                .release_m = std::abs(b.release_m - a.release_m)});
  }
}

// A chance agreement of two grids does not pass: the edge of a contact moves by elements, so that a change is at
// least half the one before (errors fall as the elements' size).
void keep_half(const RowContact& before, RowContact& fine) {
  if (before.load_changes_Pa.size() == 0) return;
  const Eigen::ArrayXXd half_Pa = 0.5 * before.load_changes_Pa.array();
  const Eigen::ArrayXXd now_Pa = fine.load_changes_Pa.array();
  fine.load_changes_Pa = (now_Pa.abs() >= half_Pa.abs()).select(now_Pa, half_Pa);
  for (std::size_t i = 0; i < fine.top_changes.size(); ++i) {
    StripPressure& now = fine.top_changes[i];
    const StripPressure& last = before.top_changes[i];
    now.force_N_m = std::max(now.force_N_m, 0.5 * last.force_N_m);
    now.moment_N = std::max(now.moment_N, 0.5 * last.moment_N);
    now.shear_N_m = std::max(now.shear_N_m, 0.5 * last.shear_N_m);
    now.share = std::max(now.share, 0.5 * last.share);
  }
  fine.force_change_N_m = std::max(fine.force_change_N_m, 0.5 * before.force_change_N_m);
  fine.depth_change_m = std::max(fine.depth_change_m, 0.5 * before.depth_change_m);
}

}  // namespace

double RowContact::largest_force_N_m() const {
  double largest = 0.0;
  for (const StripPressure& top : tops) largest = std::max(largest, std::abs(top.force_N_m));
  return largest;
}

RowContact row_contact_on(const ArrayScene& scene, int grid) {
  return contact_on(scene, std::clamp(grid, 0, kRowGrids - 1));
}

RowContact row_contact_within(const ArrayScene& scene, double tolerance) {
  RowContact contact = contact_on(scene, 0);
  for (int grid = 1; grid < kRowGrids; ++grid) {
    RowContact finer = contact_on(scene, grid);
    compare(contact, finer);
    keep_half(contact, finer);
    contact = std::move(finer);
    const double largest_Pa = contact.loads_Pa.cwiseAbs().maxCoeff();
    if (contact.load_changes_Pa.cwiseAbs().maxCoeff() <= tolerance * largest_Pa) break;
  }
  return contact;
}

}  // namespace viscard
