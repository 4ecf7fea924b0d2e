#include "models/array/space/space_array.h"

#include "models/maths/near_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kCentre = 0;  // readings of the tables; or the electrode alone
constexpr std::size_t kMean = 1;
constexpr int kQuadrantPoints = 7;  // Gauss points along the radius and the angle of a quarter
constexpr int kFarPoints = 3;       // of a quarter beyond the reach of the near table
constexpr int kFarPolynomials = 4;  // the same of quarters of metal
constexpr int kMostPolynomials = 28;

double largest_diameter_m(const SpaceArray& array) {
  double largest_m = 0.0;
  for (const PillarClass& one : array.classes) {
    largest_m = std::max(largest_m, one.geometry.diameter_m);
  }
  return largest_m;
}

// Mapping of the readings of a pillar at a mirrored place under some of the loads: quarters change
// places, and loads along the axis change sign.
std::array<KernelMirror, 2> mirrors_of(Eigen::Index readings, const std::vector<TopLoad>& loads) {
  constexpr std::array<std::array<int, 4>, 2> kQuarters = {{{1, 0, 3, 2}, {3, 2, 1, 0}}};
  constexpr std::array<std::array<TopLoad, 2>, 2> kTurned = {
      {{TopLoad::kShearX, TopLoad::kTiltX}, {TopLoad::kShearY, TopLoad::kTiltY}}};
  std::array<KernelMirror, 2> mirrors;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (Eigen::Index r = 0; r < readings; ++r) {
      const Eigen::Index first = readings > 4 ? readings - 4 : readings;  // of the quarters
      mirrors[axis].reading.push_back(static_cast<int>(
          r < first ? r : first + kQuarters[axis].at(static_cast<std::size_t>(r - first))));
    }
    mirrors[axis].reading_sign = Eigen::VectorXd::Ones(readings);
    mirrors[axis].load_sign = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(loads.size()));
    for (std::size_t l = 0; l < loads.size(); ++l) {
      for (const TopLoad turned : kTurned[axis]) {
        if (loads[l] == turned) {
          mirrors[axis].load_sign[static_cast<Eigen::Index>(l)] = -1.0;
        }
      }
    }
  }
  return mirrors;
}

}  // namespace

std::vector<SourcePoint> sources_of(const SpaceArray& array) {
  std::vector<SourcePoint> points;
  points.reserve(array.pillars.size());
  for (const PlacedPillar& one : array.pillars) points.push_back({one.x_m, one.y_m, one.of_class});
  return points;
}

double array_diagonal_m(const SpaceArray& array) {
  double left_m = HUGE_VAL, right_m = -HUGE_VAL, low_m = HUGE_VAL, high_m = -HUGE_VAL;
  for (const PlacedPillar& one : array.pillars) {
    left_m = std::min(left_m, one.x_m);
    right_m = std::max(right_m, one.x_m);
    low_m = std::min(low_m, one.y_m);
    high_m = std::max(high_m, one.y_m);
  }
  return std::hypot(right_m - left_m, high_m - low_m);
}

std::vector<std::string> reading_names(SpaceElectrode electrode) {
  std::vector<std::string> names = {"electrode"};
  if (!is_metal(electrode)) names = {"centre", "mean"};
  if (has_quarters(electrode)) {
    for (int q = 1; q <= 4; ++q) names.push_back("quadrant_" + std::to_string(q));
  }
  return names;
}

std::vector<std::string> voltage_names(SpaceElectrode electrode) {
  std::vector<std::string> names = reading_names(electrode);
  for (std::string& name : names) name += "_voltage";
  return names;
}

std::vector<SpaceAccuracy> space_accuracies(const SpaceArray& array) {
  std::vector<SpaceAccuracy> all;
  const double t_m = array.film.layers.front().thickness_m;
  const double radius_m = std::max(array.electrode_radius_m, 0.5 * largest_diameter_m(array));
  for (const auto& [degree, layers] :
       {std::pair{3, 1}, {4, 2}, {5, 3}, {6, 4}, {7, 4}, {8, 5}, {9, 5}}) {
    SpaceAccuracy one;
    one.foot.degree = degree;
    one.foot.layers = layers;
    one.foot.shaft_elements = 1;
    one.potential.film_degree = degree + 4;
    one.potential.largest_kt = 4.0 + 2.0 * degree;
    one.potential.harmonics = degree < 5 ? 2 : 3;
    // The face that carries the load reads short waves as 1/k, so the traction at the rim leaves
    // k^-1.7 (eq. S6).
    if (array.film.grounded == FilmFace::kBottom)
      one.potential.own_kt = 5.0 * std::pow(2.0, degree - 1);
    // Beyond this distance the field decays as exp(-0.92 x/t) (eq. A4).
    one.potential.reach_m = 2.0 * radius_m + (3.0 + 1.5 * degree) * t_m;
    one.coupling = {.harmonics = degree - 1,
                    .modes = degree < 4 ? 2 : (degree < 7 ? 3 : 4),
                    .largest_kt = one.potential.largest_kt,
                    .film_degree = one.potential.film_degree,
                    .beyond_nearest_m = (0.5 * degree) * t_m,
                    .far_m = one.potential.reach_m};
    // Of cells as wide as the film is thick at most, and of waves that are felt through the film.
    const double width = array.electrode_radius_m / t_m;
    one.quarters = {
        .cells = std::max(3 * degree, 3 * static_cast<int>(std::ceil(width))),
        .polynomials =
            std::min(kMostPolynomials, static_cast<int>((4 + 2 * degree) * std::max(1.0, width))),
        .film_degree = one.potential.film_degree};
    if (array.film.backing) {
      one.potential.far_m = array_diagonal_m(array) + 2.0 * array.electrode_radius_m;
    }
    all.push_back(one);
  }
  return all;
}

SpaceAccuracy without_coupling(SpaceAccuracy accuracy) {
  accuracy.coupling.harmonics = 0;
  return accuracy;
}

SpaceResponse::SpaceResponse(const SpaceArray& array, const SpaceAccuracy& accuracy)
    : array_(&array),
      reach_m_(accuracy.potential.reach_m - array.electrode_radius_m),
      is_wide_(accuracy.potential.far_m > 0.0) {
  std::vector<AxialReading> readings = {point_reading(), disc_mean(array.electrode_radius_m)};
  if (array.electrode == SpaceElectrode::kEquipotential) {
    charge_ = std::make_unique<DiscCharge>(array.film, array.electrode_radius_m,
                                           2 * (accuracy.potential.harmonics + 1),
                                           accuracy.foot.degree, accuracy.potential.film_degree);
    capacitance_F_ = charge_->capacitance_F();
    readings = {[&](double k_1_m) { return charge_->weight(k_1_m); }};
    if (accuracy.coupling.harmonics > 0 && array.pillars.size() > 1) {
      coupling_.emplace(array.film, *charge_, sources_of(array), accuracy.coupling);
    }
  }
  if (array.electrode == SpaceElectrode::kMetalQuadrants) {
    quarters_ = std::make_unique<MetalQuarters>(array.film, array.electrode_radius_m,
                                                array.electrode_gap_m, accuracy.quarters);
    capacitance_F_ = quarters_->capacitance_F();
    near_rule_ = quarters_->rule(accuracy.quarters.polynomials);
    far_rule_ = quarters_->rule(kFarPolynomials);
    readings = {point_reading()};
  } else if (has_quarters(array.electrode)) {
    near_rule_ = quarter_means(array.electrode_radius_m, kQuadrantPoints);
    far_rule_ = quarter_means(array.electrode_radius_m, kFarPoints);
  }
  std::optional<FilmTable> film;
  if (array.film.backing) {
    const PotentialAccuracy& potential = accuracy.potential;
    film.emplace(array.film, potential.largest_kt, potential.harmonics, potential.film_degree,
                 std::max(potential.reach_m, potential.far_m));
  }
  for (const PillarClass& one : array.classes) {
    add_class(one, accuracy, film ? &*film : nullptr, readings);
  }
}

void SpaceResponse::add_class(const PillarClass& one, const SpaceAccuracy& accuracy,
                              const FilmTable* film, const std::vector<AxialReading>& readings) {
  const PotentialAccuracy& potential = accuracy.potential;
  const double t_m = array_->film.layers.front().thickness_m;
  const double largest_k_1_m = std::max(potential.largest_kt, potential.own_kt) / t_m;
  feet_.push_back(foot_forces(one.geometry, one.medium, accuracy.foot, largest_k_1_m, film));
  const FootForces& foot = feet_.back();
  unknowns_ = std::max(unknowns_, foot.unknowns);
  PotentialSpectrum spectrum;
  if (film) {
    spectrum = graded_spectrum(*film, potential_reading(*film), foot, film->largest_k_1_m(),
                               std::min(kWavePhase / potential.reach_m, kWaveStep / t_m),
                               potential.own_kt > 0.0);
    spectrum.own = own_waves(array_->film, foot, potential);
  } else {
    spectrum = potential_spectrum(array_->film, foot, potential);
  }
  std::vector<Eigen::MatrixXd> induced;
  if (coupling_) {
    const double foot_m = *std::max_element(foot.radius_m.begin(), foot.radius_m.end());
    coupling_->add_kind(field_around(spectrum), foot_m);
  } else if (charge_) {
    induced = induced_amplitudes(spectrum, array_->film, *charge_, potential);
  } else if (quarters_) {
    const Eigen::MatrixXd amplitudes = disc_amplitudes(spectrum, *quarters_);
    own_.emplace_back(quarters_->readings() * amplitudes);
    induced = induced_amplitudes(spectrum, array_->film, *quarters_,
                                 quarters_->induced() * amplitudes, potential);
  }
  PotentialTable near(spectrum, induced, potential.reach_m, readings);
  if (film && potential.far_m > 0.0) {
    tables_.emplace_back(std::move(near), *film, potential_reading(*film), foot, readings);
  } else {
    tables_.emplace_back(std::move(near));
  }
}

Eigen::Matrix<double, Eigen::Dynamic, kTopLoads> SpaceResponse::kernel(int of_class, double x_m,
                                                                       double y_m) const {
  const WideTable& table = tables_[static_cast<std::size_t>(of_class)];
  Eigen::Matrix<double, Eigen::Dynamic, kTopLoads> kernel(
      static_cast<Eigen::Index>(reading_names(array_->electrode).size()), kTopLoads);
  const bool is_in_quarters = has_quarters(array_->electrode);
  if (is_in_quarters) kernel.bottomRows<4>() = quarters_at(of_class, x_m, y_m);
  if (quarters_) {
    kernel.row(0) = kernel.bottomRows<4>().colwise().mean();
    return kernel;
  }
  kernel.row(0) = table.at(x_m, y_m, kCentre).transpose();
  if (coupling_) kernel.row(0) += coupling_->by_own_charge(of_class, x_m, y_m);
  if (kernel.rows() > 1) kernel.row(1) = table.at(x_m, y_m, kMean).transpose();
  return kernel;
}

Eigen::Matrix<double, 4, kTopLoads> SpaceResponse::quarters_at(int of_class, double x_m,
                                                               double y_m) const {
  const auto c = static_cast<std::size_t>(of_class);
  const double distance_m = std::hypot(x_m, y_m);
  if (quarters_ && distance_m < array_->electrode_radius_m) return own_[c];
  const QuarterRule& rule = distance_m > reach_m_ ? far_rule_ : near_rule_;
  Eigen::Matrix<double, 4, kTopLoads> read = Eigen::Matrix<double, 4, kTopLoads>::Zero();
  for (std::size_t p = 0; p < rule.points_m.size(); ++p) {
    read +=
        rule.weights.col(static_cast<Eigen::Index>(p)) *
        tables_[c].at(x_m + rule.points_m[p].x(), y_m + rule.points_m[p].y(), kCentre).transpose();
  }
  return read;
}

Eigen::MatrixXd SpaceResponse::added_by_electrodes(std::size_t pillar) const {
  return coupling_ ? coupling_->added_row(pillar) : Eigen::MatrixXd();
}

PotentialByLoad SpaceResponse::potential(int of_class, double x_m, double y_m) const {
  return tables_[static_cast<std::size_t>(of_class)].at(x_m, y_m, kCentre);
}

SpaceResponse::Sums SpaceResponse::sums_of(const std::vector<TopLoad>& loads,
                                           const std::vector<bool>& acts) const {
  std::vector<Eigen::Index> columns;
  for (const TopLoad load : loads) columns.push_back(static_cast<Eigen::Index>(load));
  const OffsetSums::Kernel of_loads = [this, columns](int of_class, double x_m,
                                                      double y_m) -> Eigen::MatrixXd {
    return kernel(of_class, x_m, y_m)(Eigen::all, columns);
  };
  if (coupling_) {
    return [loaded = sums_alone(loads, acts, of_loads),
            added = coupling_->sums_of(columns, acts)](const Eigen::MatrixXd& loads_Pa) {
      return (loaded(loads_Pa) + added(loads_Pa)).eval();
    };
  }
  return sums_alone(loads, acts, of_loads);
}

SpaceResponse::Sums SpaceResponse::sums_alone(const std::vector<TopLoad>& loads,
                                              const std::vector<bool>& acts,
                                              const OffsetSums::Kernel& of_loads) const {
  if (!is_wide_) {
    return [sums = NearSums(sources_of(*array_), acts, reach_m_, of_loads)](
               const Eigen::MatrixXd& loads_Pa) { return sums.apply(loads_Pa); };
  }
  const auto readings = static_cast<Eigen::Index>(reading_names(array_->electrode).size());
  return [sums = OffsetSums(sources_of(*array_), static_cast<int>(array_->classes.size()), of_loads,
                            mirrors_of(readings, loads))](const Eigen::MatrixXd& loads_Pa) {
    return sums.apply(loads_Pa);
  };
}

double SpaceResponse::voltage_at_V(double x_m, double y_m, const TopLoads& loads_Pa) const {
  double voltage_V = 0.0;
  for (std::size_t j = 0; j < array_->pillars.size(); ++j) {
    const PlacedPillar& one = array_->pillars[j];
    const auto load = loads_Pa.row(static_cast<Eigen::Index>(j));
    if (load.isZero(0.0)) continue;
    const WideTable& table = tables_[static_cast<std::size_t>(one.of_class)];
    voltage_V += load.dot(table.at(x_m - one.x_m, y_m - one.y_m, 0));
  }
  return voltage_V;
}

Eigen::MatrixXd SpaceResponse::voltages_V(const TopLoads& loads_Pa) const {
  std::vector<TopLoad> active;
  std::vector<int> columns;
  for (int load = 0; load < kTopLoads; ++load) {
    if (loads_Pa.col(load).isZero(0.0)) continue;
    active.push_back(static_cast<TopLoad>(load));
    columns.push_back(load);
  }
  const auto readings = static_cast<Eigen::Index>(reading_names(array_->electrode).size());
  if (active.empty()) return Eigen::MatrixXd::Zero(loads_Pa.rows(), readings);
  std::vector<bool> acts;
  for (Eigen::Index i = 0; i < loads_Pa.rows(); ++i) acts.push_back(!loads_Pa.row(i).isZero(0.0));
  return sums_of(active, acts)(loads_Pa(Eigen::all, columns));
}

}  // namespace viscard
