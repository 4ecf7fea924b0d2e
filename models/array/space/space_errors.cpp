// Errors of an array in the plane that do not depend on the accuracy level.
#include "models/answer/scene_mistake.h"
#include "models/array/film/disc_charge.h"
#include "models/array/space/potential_spectrum.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_maps.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {

double neighbour_influence(double x, double thickness_over_diameter) {
  const double field = 1.4 * thickness_over_diameter * std::exp(-0.5 * std::numbers::pi * x);
  return std::min(1.0, field + 0.45 * std::exp(-0.9215 * x));
}

double rigid_foot_error(const SpaceScene& scene) {
  double stiffest_Pa = 0.0;
  for (const SpaceClass& one : classes_of(scene)) {
    stiffest_Pa = std::max(stiffest_Pa, one.material.E0_Pa);
  }
  constexpr double kPressed = 0.12, kSheared = 0.2;
  return (is_sheared(scene) ? kSheared : kPressed) * stiffest_Pa /
         elasticity_of(scene.film).young_Pa;
}

namespace {

// How far the film's potential per charge along one axis differs from that over all directions, which the charges are
// found with.
double direction_spread(const SpaceScene& scene) {
  constexpr int kDegree = 6;
  const LayeredFilm film = array_of(scene).film;
  const double largest_1_m = 8.0 / scene.film_thickness_m;
  const FilmWaves along(film, 0.0, largest_1_m, kDegree);
  const FilmWaves across(film, 0.5 * std::numbers::pi, largest_1_m, kDegree);
  double spread = 0.0;
  for (double k_1_m = largest_1_m / 64.0; k_1_m <= largest_1_m; k_1_m *= 2.0) {
    const double x = along.reading(k_1_m)[3], y = across.reading(k_1_m)[3];
    spread = std::max(spread, std::abs(x - y) / (x + y));
  }
  return spread;
}

// What charges on the quarters of the nearest pillars add to a voltage that is left out (eq. S19), over the pillar's own:
// the potential around the pillar, with that of its own charges, makes a neighbour's quarters gain charges, which act back.
double quarter_error(const SpaceScene& scene) {
  constexpr double kOfSpread = 0.1;  // change of a reading over that of the charge's potential
  constexpr double kMostNear = 8.0;  // nearest pillars
  const SpaceArray array = array_of(scene);
  const double error = kOfSpread * direction_spread(scene);
  if (array.pillars.size() < 2) return error;
  const double pitch_m = smallest_pitch_m(scene);
  const double a_m = array.electrode_radius_m;
  const SpaceAccuracy accuracy = space_accuracies(array)[1];
  const SpaceResponse response(array, accuracy);
  const MetalQuarters& quarters = *response.quarters();
  const QuarterRule rule = quarters.rule(accuracy.quarters.polynomials);
  const Eigen::MatrixXd from_points = quarters.amplitudes_from_points();
  const PointCharge charge(array.film, pitch_m + 2.01 * a_m, accuracy.potential.film_degree);
  const auto count = static_cast<Eigen::Index>(rule.points_m.size());
  double largest = 0.0;
  for (std::size_t c = 0; c < array.classes.size(); ++c) {
    const auto of_class = static_cast<int>(c);
    const Eigen::MatrixXd own = response.kernel(of_class, 0.0, 0.0).bottomRows<4>();
    for (const double angle : {0.0, 0.25 * std::numbers::pi, 0.5 * std::numbers::pi}) {
      const Eigen::Vector2d way(pitch_m * std::cos(angle), pitch_m * std::sin(angle));
      Eigen::MatrixXd potential(count, kTopLoads), back(count, count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Vector2d there = way + rule.points_m[static_cast<std::size_t>(i)];
        potential.row(i) = response.potential(of_class, there.x(), there.y()).transpose();
        for (Eigen::Index j = 0; j < count; ++j) {
          back(j, i) = charge.at((there - rule.points_m[static_cast<std::size_t>(j)]).norm());
        }
      }
      const Eigen::MatrixXd charges =
          from_points.transpose() * (quarters.induced() * (from_points * potential));
      const Eigen::MatrixXd added = rule.weights * (back * charges);
      for (Eigen::Index load = 0; load < kTopLoads; ++load) {
        largest = std::max(
            largest, added.col(load).cwiseAbs().maxCoeff() / own.col(load).cwiseAbs().maxCoeff());
      }
    }
  }
  return error + std::min(static_cast<double>(array.pillars.size()) - 1.0, kMostNear) * largest;
}

}  // namespace

double electrode_error(const SpaceScene& scene) {
  if (scene.electrode == SpaceElectrode::kMetalQuadrants) return quarter_error(scene);
  if (scene.electrode != SpaceElectrode::kEquipotential || scene.pillars.size() < 2) return 0.0;
  const SpaceArray array = array_of(scene);
  const PotentialAccuracy accuracy = space_accuracies(array)[1].potential;
  const DiscCharge charge(array.film, array.electrode_radius_m, 1, 4, accuracy.film_degree);
  return influence_of_all(array.film, charge, sources_of(array), accuracy);
}

ElectrodeCoupling electrode_coupling(const SpaceScene& scene) {
  constexpr double kNegligible = 0.1;  // of the tolerance
  constexpr double kUnsettled = 0.02;  // of the tolerance, where the charges are iterated
  constexpr double kLeast = 1e-8, kMost = 0.3;
  ElectrodeCoupling coupling;
  coupling.error = electrode_error(scene);
  if (scene.electrode != SpaceElectrode::kEquipotential) return coupling;
  const bool has_percent = has_crosstalk(scene) && asks_for_map(scene, kCrosstalk);
  const double tolerance = (has_percent ? kCrosstalkScale / 100.0 : 1.0) * scene.tolerance;
  if (!scene.feels_neighbours || coupling.error <= kNegligible * tolerance) return coupling;
  const double all = coupling.error;
  coupling.is_on = true;
  coupling.settled = std::clamp(kUnsettled * tolerance / all, kLeast, kMost);
  // Of many neighbours the bound is wide, because their loads and charges do not all add up.
  const double others = std::clamp(static_cast<double>(scene.pillars.size()) - 1.0, 1.0, 8.0);
  coupling.error = all * (coupling.settled + 2.0 * direction_spread(scene) / others);
  return coupling;
}

Eigen::VectorXd SpaceResponse::beyond_reach_V(const TopLoads& loads_Pa) const {
  constexpr int kDirections = 16;
  const auto readings = static_cast<Eigen::Index>(reading_names(array_->electrode).size());
  Eigen::VectorXd largest_V = Eigen::VectorXd::Zero(readings);
  if (is_wide_) return largest_V;
  std::vector<TopLoads> of_class(feet_.size(), TopLoads::Zero(1, kTopLoads));  // largest of each
  for (std::size_t i = 0; i < array_->pillars.size(); ++i) {
    const PlacedPillar& one = array_->pillars[i];
    TopLoads& most = of_class[static_cast<std::size_t>(one.of_class)];
    most = most.cwiseMax(loads_Pa.row(static_cast<Eigen::Index>(i)).cwiseAbs());
  }
  if (array_diagonal_m(*array_) <= reach_m_) return largest_V;
  for (std::size_t c = 0; c < of_class.size(); ++c) {
    if (of_class[c].isZero(0.0)) continue;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2.0 * std::numbers::pi * d / kDirections;
      const auto at =
          kernel(static_cast<int>(c), reach_m_ * std::cos(angle), reach_m_ * std::sin(angle));
      largest_V = largest_V.cwiseMax(at.cwiseAbs() * of_class[c].transpose());
    }
  }
  return largest_V;
}

namespace {

// Loads that no other one exceeds which lies at least as near to the film's edge, in order of rising distance and load.
struct EdgeLoad {
  double to_edge_m, share;  // of the largest load
};
std::vector<EdgeLoad> loads_at_edge(const std::vector<double>& to_edge_m,
                                    const TopLoads& loads_Pa) {
  const double largest_Pa = loads_Pa.size() > 0 ? loads_Pa.cwiseAbs().maxCoeff() : 0.0;
  std::vector<EdgeLoad> all;
  for (std::size_t i = 0; i < to_edge_m.size() && largest_Pa > 0.0; ++i) {
    const double load_Pa = loads_Pa.row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff();
    if (load_Pa > 0.0) all.push_back({to_edge_m[i], load_Pa / largest_Pa});
  }
  std::sort(all.begin(), all.end(), [](const EdgeLoad& a, const EdgeLoad& b) {
    return a.to_edge_m != b.to_edge_m ? a.to_edge_m < b.to_edge_m : a.share > b.share;
  });
  std::vector<EdgeLoad> leading;
  for (const EdgeLoad& one : all) {
    if (leading.empty() || one.share > leading.back().share) leading.push_back(one);
  }
  return leading;
}

}  // namespace

std::vector<double> film_edge_errors(const SpaceScene& scene, const TopLoads& loads_Pa) {
  const FilmExtent film = film_extent(scene);
  const std::vector<SpaceClass> classes = classes_of(scene);
  std::vector<double> to_edge_m;
  for (const SpacePillar& one : scene.pillars) {
    const double radius_m = 0.5 * classes[static_cast<std::size_t>(one.of_class)].diameter_m;
    to_edge_m.push_back(std::min({one.x_m - film.left_m, film.right_m - one.x_m,
                                  one.y_m - film.low_m, film.high_m - one.y_m}) -
                        radius_m);
  }
  const std::vector<EdgeLoad> loads = loads_at_edge(to_edge_m, loads_Pa);
  std::vector<double> errors;
  for (const double own_m : to_edge_m) {
    double error = 0.0;
    for (const EdgeLoad& load : loads) {
      const double way = (own_m + load.to_edge_m) / scene.film_thickness_m;
      error = std::max(error, load.share * (way < 2.0 ? 2.0 : std::exp(-0.9215 * way)));
    }
    errors.push_back(error);
  }
  return errors;
}

// At its edge the endless film carries stress that a free edge cannot bear. Relieving it changes
// the voltages by at most about the reading of the endless film there, with a factor taken from
// finite films (eq. S12).
BackingEffect backing_effect(const SpaceScene& scene, const TopLoads& loads_Pa) {
  constexpr double kOfEdge = 1.0;
  BackingEffect effect;
  SpaceArray array = array_of(scene);
  const FilmExtent film = film_extent(scene);
  SpaceAccuracy accuracy = without_coupling(space_accuracies(array)[1]);
  accuracy.potential.far_m = std::hypot(film.right_m - film.left_m, film.high_m - film.low_m);
  const SpaceResponse response(array, accuracy);
  const Eigen::VectorXd voltages_V = response.voltages_V(loads_Pa).col(0);
  Eigen::Index largest = 0;
  const double largest_V = voltages_V.cwiseAbs().maxCoeff(&largest);
  if (!(largest_V > 0.0)) return effect;
  const double x_m = 0.5 * (film.left_m + film.right_m), y_m = 0.5 * (film.low_m + film.high_m);
  for (const double x : {film.left_m, x_m, film.right_m}) {
    for (const double y : {film.low_m, y_m, film.high_m}) {
      if (x == x_m && y == y_m) continue;
      effect.edge = std::max(effect.edge, std::abs(response.voltage_at_V(x, y, loads_Pa)));
    }
  }
  // A sheared pillar has no voltage of its own: the least that the tolerance refers to (space_maps.h).
  effect.edge *= kOfEdge / std::max(largest_V, least_voltage_V(response, loads_Pa, 0));
  array.film.backing.reset();
  const Eigen::VectorXd rigid_V = SpaceResponse(array, without_coupling(space_accuracies(array)[1]))
                                      .voltages_V(loads_Pa)
                                      .col(0);
  effect.pillar = static_cast<std::size_t>(largest);
  effect.voltage_V = voltages_V[largest];
  effect.rigid_V = rigid_V[largest];
  return effect;
}

void check_edge(const SpaceScene& scene, const BackingEffect& effect, double other_errors,
                double most) {
  if (effect.edge + other_errors <= most) return;
  throw SceneMistake("geometry.film.edge",
                     "the film is solved without its edge, " + micrometres(scene.film_edge_m, 4) +
                         " from the outer pillars, but on this backing it is stretched as far as "
                         "that. That leaves a relative error of about " +
                         text_of(effect.edge + other_errors, 2) + ", too much for a tolerance of " +
                         text_of(scene.tolerance, 2) +
                         "; ask for a larger one, for a wider film, or for a stiffer backing");
}

void add_stretching_note(const SpaceScene& scene, const BackingEffect& effect,
                         SceneAnswer& answer) {
  constexpr double kStretchingFrom = 0.1;  // of the voltage on a rigid base
  const double change_V = effect.voltage_V - effect.rigid_V;
  if (!(std::abs(change_V) > kStretchingFrom * std::abs(effect.rigid_V))) return;
  const SpacePillar& one = scene.pillars[effect.pillar];
  answer.notes.push_back(
      "stretching: pillar " + name_of({one.row, one.column}) + " reads " +
      text_of(effect.voltage_V, 4) + " V, on a rigid base " + text_of(effect.rigid_V, 4) + " V (" +
      text_of(100.0 * change_V / std::abs(effect.rigid_V), 3) +
      " %): on this backing the film reads how it is stretched by all pillars, not the pressure on "
      "one; take a stiffer backing");
}

namespace {

// The largest reading that a pressed pillar causes from the smallest pitch on, over its own: a bound like eq. A4,
// but on this film and for the pillars as they are.
double largest_influence(const SpaceScene& scene) {
  constexpr int kDistances = 24, kDirections = 4;  // of a quarter turn
  const SpaceArray array = array_of(scene);
  const SpaceResponse response(array, without_coupling(space_accuracies(array)[1]));
  const double pitch_m = smallest_pitch_m(scene);
  const double step_m = std::max(response.reach_m() - pitch_m, 0.0) / kDistances;
  double largest = 0.0;
  for (std::size_t c = 0; c < array.classes.size(); ++c) {
    const auto reading = [&](double x_m, double y_m) {
      return response.kernel(static_cast<int>(c), x_m, y_m)
          .col(static_cast<int>(TopLoad::kPressure))
          .cwiseAbs()
          .eval();
    };
    const Eigen::VectorXd own = reading(0.0, 0.0);
    for (int i = 0; i <= kDistances; ++i) {
      for (int d = 0; d <= kDirections; ++d) {
        const double angle = 0.5 * std::numbers::pi * d / kDirections;
        const double r_m = pitch_m + i * step_m;
        largest = std::max(
            largest,
            reading(r_m * std::cos(angle), r_m * std::sin(angle)).cwiseQuotient(own).maxCoeff());
      }
    }
  }
  return largest;
}

}  // namespace

void set_edge_errors(const SpaceScene& scene, const TopLoads& loads_Pa, ConstantErrors& errors) {
  errors.edge = film_edge_errors(scene, loads_Pa);
  errors.largest_edge = *std::max_element(errors.edge.begin(), errors.edge.end());
}

ConstantErrors constant_errors(const SpaceScene& scene) {
  ConstantErrors errors;
  errors.foot = rigid_foot_error(scene);
  errors.coupling = electrode_coupling(scene);
  errors.electrodes = errors.coupling.error;
  errors.neighbour = neighbour_influence(smallest_gap_m(scene) / scene.film_thickness_m,
                                         scene.film_thickness_m / scene.diameter_m);
  // Where that bound alone takes a large part of the tolerance, it is replaced by the reading itself.
  constexpr double kLargePart = 0.2;
  const double of_crosstalk = 200.0 * errors.foot * errors.neighbour / kCrosstalkScale;
  if (has_crosstalk(scene) && of_crosstalk > kLargePart * scene.tolerance)
    errors.neighbour = std::min(errors.neighbour, largest_influence(scene));
  errors.edge.assign(scene.pillars.size(), 0.0);
  const bool has_loads = !scene.press && scene.quadrants.measured_V.size() == 0;
  if (has_loads) set_edge_errors(scene, loads_of(scene), errors);
  return errors;
}

// A small error of a foot's traction acts on the neighbours like a load, as a fraction of its field there.
double common_error_of(const SceneMap& map, const ConstantErrors& errors) {
  if (map.unit != "%") return (errors.foot + errors.electrodes) * size_of(map);
  return 100.0 * errors.electrodes + 200.0 * errors.foot * errors.neighbour;
}

double edge_size_of(const SceneMap& map) {
  return map.unit != "%" ? size_of(map) : 100.0;
}

double largest_constant_error(const SpaceScene& scene, const ConstantErrors& errors) {
  SceneMap voltage{.name = "", .unit = "V", .scale = 1.0};
  const double of_voltages = common_error_of(voltage, errors) + errors.largest_edge;
  if (!has_crosstalk(scene) || !asks_for_map(scene, kCrosstalk)) return of_voltages;
  const SceneMap crosstalk{.name = kCrosstalk, .unit = "%", .scale = kCrosstalkScale};
  return std::max(of_voltages, (common_error_of(crosstalk, errors) +
                                errors.largest_edge * edge_size_of(crosstalk)) /
                                   kCrosstalkScale);
}

void refuse_constant(const SpaceScene& scene, double error, const ConstantErrors& parts) {
  const std::string size = " of about " + text_of(error, 2) + ", too much for a tolerance of " +
                           text_of(scene.tolerance, 2) + "; ask for a larger one, or for a ";
  if (parts.electrodes > std::max(parts.largest_edge, parts.foot)) {
    throw SceneMistake(
        "geometry.electrode.radius",
        "the electrodes lie so close that the charges of all influence each other, which "
        "leaves a relative error" +
            size + "smaller radius");
  }
  if (parts.largest_edge > parts.foot) {
    throw SceneMistake(
        "geometry.film.edge",
        "the film is solved without its edge, which lies " + micrometres(scene.film_edge_m, 4) +
            " from the outer pillars. That leaves a relative error" + size + "wider film");
  }
  throw SceneMistake("materials",
                     "the pillars are solved on a rigid base. On this film that leaves a relative "
                     "error" +
                         size + "stiffer film");
}

}  // namespace viscard
