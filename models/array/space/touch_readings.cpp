// Voltages and readings of single pillars in time.
#include "models/array/film/disc_charge.h"
#include "models/array/space/space_maps.h"
#include "models/array/space/touch_curves.h"
#include "models/array/space/touch_steps.h"
#include "models/maths/neighbours.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace viscard {
namespace {

// Readings of single pillars under loads in time: rows are times.
class Voltages {
 public:
  Voltages(const SpaceScene& scene, const SpaceResponse& response, const TouchCourse& course,
           const std::vector<TopLoads>& loads_Pa, bool is_size)
      : scene_(&scene),
        response_(&response),
        course_(&course),
        loads_Pa_(&loads_Pa),
        is_size_(is_size) {}

  // Kept: a pillar is asked for by all its neighbours.
  const Eigen::MatrixXd& of(std::size_t pillar) {
    const auto found = known_.find(pillar);
    return found != known_.end() ? found->second : known_[pillar] = computed(pillar);
  }

 private:
  Eigen::MatrixXd computed(std::size_t pillar) const {
    const SpacePillar& one = scene_->pillars[pillar];
    const auto readings = static_cast<Eigen::Index>(reading_names(scene_->electrode).size());
    Eigen::MatrixXd voltages =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(loads_Pa_->size()), readings);
    const Eigen::MatrixXd by_electrodes = response_->added_by_electrodes(pillar);
    for (std::size_t j = 0; j < course_->touched.size(); ++j) {
      const SpacePillar& other = scene_->pillars[course_->touched[j]];
      const double x_m = one.x_m - other.x_m, y_m = one.y_m - other.y_m;
      if (std::hypot(x_m, y_m) > response_->reach_m()) continue;
      Eigen::MatrixXd kernel = response_->kernel(other.of_class, x_m, y_m);
      if (by_electrodes.size() > 0) {
        kernel.row(0) += by_electrodes.row(static_cast<Eigen::Index>(course_->touched[j]));
      }
      if (is_size_) kernel = kernel.cwiseAbs().eval();
      for (std::size_t k = 0; k < loads_Pa_->size(); ++k) {
        voltages.row(static_cast<Eigen::Index>(k)) +=
            (kernel * (*loads_Pa_)[k].row(static_cast<Eigen::Index>(j)).transpose()).transpose();
      }
    }
    return voltages;
  }

  const SpaceScene* scene_;
  const SpaceResponse* response_;
  const TouchCourse* course_;
  const std::vector<TopLoads>* loads_Pa_;
  bool is_size_;
  std::map<std::size_t, Eigen::MatrixXd> known_;
};

// Mutual influence of electrodes near one of them, p12/p11 by distance (eq. S16).
class Influence {
 public:
  Influence(const SpaceScene& scene, const SpaceArray& array)
      : scene_(&scene),
        accuracy_(space_accuracies(array)[1].potential),
        film_(array.film),
        charge_(array.film, array.electrode_radius_m, 1, 4, accuracy_.film_degree),
        reach_m_(1.6 * smallest_pitch_m(scene)),
        near_(scene.pillars, reach_m_) {}

  // Calls found(other, p12/p11) for the neighbours that matter.
  template <typename Found>
  void visit(std::size_t pillar, const Found& found) {
    const SpacePillar& one = scene_->pillars[pillar];
    near_.visit(one.x_m, one.y_m, [&](std::size_t other) {
      if (other == pillar) return;
      const SpacePillar& there = scene_->pillars[other];
      found(other, at(std::hypot(there.x_m - one.x_m, there.y_m - one.y_m)));
    });
  }

 private:
  double at(double distance_m) {
    const long key = std::lround(distance_m / (1e-6 * reach_m_));
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = mutual_influence(film_, charge_, distance_m, accuracy_);
  }

  const SpaceScene* scene_;
  PotentialAccuracy accuracy_;
  LayeredFilm film_;
  DiscCharge charge_;
  double reach_m_;
  Neighbours near_;
  std::map<long, double> known_;
};

// What drives an electrode's circuit: its own open voltage, plus p12/p11 times those of its
// neighbours.
struct Driven {
  std::vector<double> open_V, mixed_V;
};

// All electrodes are wired alike. The reading of one contains the effect of its neighbours'
// charges, to first order in p12/p11 (eq. S16).
std::vector<double> reading_from(const Readout& readout, const FilmPort& film,
                                 const std::vector<double>& time_s, const Driven& driven) {
  const ReadoutFilter filter = readout_filter(readout, film);
  std::vector<double> source_V = driven.open_V;
  for (std::size_t k = 0; k < source_V.size(); ++k) source_V[k] -= driven.mixed_V[k];
  if (readout.kind == ReadoutKind::kVoltage) {
    const std::vector<double> read_V = reading_of(filter, time_s, driven.mixed_V);
    const std::vector<double> charge_V = film_charge_of(readout, film, time_s, read_V);
    for (std::size_t k = 0; k < source_V.size(); ++k) source_V[k] += charge_V[k];
  }
  return reading_of(filter, time_s, source_V);
}

// The samples that a run with half as many steps has too.
std::vector<double> without_new(const TouchCourse& course, const std::vector<double>& values) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!course.is_new[k]) kept.push_back(values[k]);
  }
  return kept;
}

// Error from the change between half and full number of steps; between samples the voltage is taken
// as linear.
void set_reading(const SpaceScene& scene, const TouchCourse& course, const FilmPort& film,
                 const Driven& driven, PillarCurve& curve) {
  const Readout& readout = *scene.touch->readout;
  curve.value = reading_from(readout, film, course.time_s, driven);
  // A charge amplifier holds the film at 0 V, where it loses nothing.
  const double lost = readout.kind == ReadoutKind::kCharge
                          ? 0.0
                          : bonded_error(scene.film, scene.film_loss, 1.0 / course.time_s.back());
  const double film_error = lost * largest_size(curve.value);
  const std::vector<double> coarse_V =
      reading_from(readout, film, without_new(course, course.time_s),
                   {without_new(course, driven.open_V), without_new(course, driven.mixed_V)});
  const std::vector<double> fine_V = without_new(course, curve.value);
  std::size_t next = 0;  // kept samples up to here
  for (std::size_t k = 0; k < curve.value.size(); ++k) {
    if (!course.is_new[k]) ++next;
    double change_V = std::abs(fine_V[next - 1] - coarse_V[next - 1]);
    if (course.is_new[k]) change_V = std::max(change_V, std::abs(fine_V[next] - coarse_V[next]));
    curve.step_change.push_back(change_V + film_error);
  }
}

}  // namespace

std::string place_ending(const SpacePillar& one) {
  return "_" + std::to_string(one.row) + "_" + std::to_string(one.column);
}

std::vector<std::size_t> followed_pillars(const SpaceScene& scene, const TouchCourse& course) {
  constexpr std::size_t kSmallArray = 100;
  std::vector<std::size_t> pillars;
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const std::string ending = place_ending(scene.pillars[i]);
    if (std::any_of(scene.wanted.begin(), scene.wanted.end(), [&](const std::string& name) {
          return name.ends_with(ending) &&
                 std::isdigit(static_cast<unsigned char>(name[name.size() - ending.size() - 1])) ==
                     0;
        })) {
      pillars.push_back(i);
    }
  }
  if (pillars.empty() && scene.touch->is_path() && scene.pillars.size() <= kSmallArray) {
    pillars.resize(scene.pillars.size());
    std::iota(pillars.begin(), pillars.end(), std::size_t{0});
  }
  if (!pillars.empty()) return pillars;
  const std::vector<TopPressure>& tops = course.shown.pressed.tops;
  const auto most = std::max_element(tops.begin(), tops.end(), [](const auto& a, const auto& b) {
    return std::abs(a.force_N) < std::abs(b.force_N) * (1.0 - 1e-9);  // of equal ones the first
  });
  return {static_cast<std::size_t>(most - tops.begin())};
}

std::vector<PillarCurve> curves_of(const SpaceScene& scene, const SpaceResponse& response,
                                   const TouchCourse& course, const std::vector<TopLoads>& loads_Pa,
                                   bool is_size) {
  Voltages voltages(scene, response, course, loads_Pa, is_size);
  const std::vector<std::string> names = voltage_names(scene.electrode);
  const bool is_read = scene.touch->readout && asks_for_map(scene, kTouchReading);
  std::optional<Influence> influence;
  if (is_read) influence.emplace(scene, array_of(scene));
  std::vector<PillarCurve> curves;
  for (const std::size_t pillar : followed_pillars(scene, course)) {
    const Eigen::MatrixXd own_V = voltages.of(pillar);
    const auto column = [](const Eigen::MatrixXd& all, Eigen::Index c) {
      return std::vector<double>(all.col(c).begin(), all.col(c).end());
    };
    for (std::size_t r = 0; r < names.size(); ++r) {
      if (!asks_for_map(scene, names[r])) continue;
      curves.push_back({names[r], pillar, column(own_V, static_cast<Eigen::Index>(r)), {}});
    }
    if (!is_read) continue;
    Eigen::VectorXd mixed_V = Eigen::VectorXd::Zero(own_V.rows());
    influence->visit(pillar, [&](std::size_t other, double share) {
      if (scene.feels_neighbours) mixed_V += share * voltages.of(other).col(0);
    });
    const FilmPort film = film_port(scene, response.capacitance_F());
    PillarCurve reading{kTouchReading, pillar, {}, {}};
    if (is_size) {
      // A high-pass passes at most twice the largest value.
      const double largest_V = (own_V.col(0) + mixed_V).maxCoeff();
      const double gain = readout_filter(*scene.touch->readout, film).gain;
      reading.value.assign(course.time_s.size(), 2.0 * gain * largest_V);
    } else {
      set_reading(scene, course, film, {column(own_V, 0), {mixed_V.begin(), mixed_V.end()}},
                  reading);
    }
    curves.push_back(std::move(reading));
  }
  return curves;
}

std::vector<double> influence_of_neighbours(const SpaceScene& scene,
                                            const std::vector<std::size_t>& pillars) {
  std::vector<double> sums;
  Influence influence(scene, array_of(scene));
  for (const std::size_t pillar : pillars) {
    double& sum = sums.emplace_back(0.0);
    influence.visit(pillar, [&](std::size_t, double share) { sum += share; });
  }
  return sums;
}

}  // namespace viscard
