// Time steps of a touch, and checks of its history.
#include "models/array/space/touch_steps.h"

#include "models/answer/scene_mistake.h"
#include "models/array/space/space_contact.h"
#include "models/material/load_history.h"
#include "models/maths/branch_step.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

namespace viscard {
namespace {

PronySeries relative_series(const std::vector<MaterialTerm>& terms) {
  PronySeries series{1.0, {}};
  for (const MaterialTerm& term : terms) {
    if (term.g == 0.0) continue;
    series.equilibrium_modulus_Pa -= term.g;
    series.terms.push_back({term.g, term.tau_s});
  }
  return series;
}

}  // namespace

FilmPort film_port(const SpaceScene& scene, double capacitance_F) {
  FilmPort port = bonded_port(scene.film, scene.film_loss);
  port.dielectric_F *= capacitance_F;
  port.capacitance_F = capacitance_F;
  return port;
}

namespace {

// Of a plate condenser as wide as the electrode, less than what the electrode has.
ReadoutFilter plate_filter(const SpaceScene& scene) {
  const double a_m = electrode_radius_m(scene);
  const double plate_F =
      scene.film.permittivity_F_m(2, 2) * std::numbers::pi * a_m * a_m / scene.film_thickness_m;
  return readout_filter(*scene.touch->readout, film_port(scene, plate_F));
}

double first_block_s(const SpaceScene& scene) {
  double fastest_s = scene.touch->readout ? plate_filter(scene).fastest_s() : HUGE_VAL;
  for (const MaterialTerm& term : scene.pillar.terms) fastest_s = std::min(fastest_s, term.tau_s);
  return std::max(0.25 * fastest_s, 1e-9 * scene.touch->history.back().time_s);
}

// Lengths of blocks, s.
struct Blocks {
  double first_s = 0.0, longest_s = HUGE_VAL;
};

void add_segment(const TouchSample& from, const TouchSample& to, const Blocks& blocks, int steps,
                 std::vector<TouchSample>& samples) {
  constexpr double kRounding = 1e-9;  // of sums of blocks: no block is left for it
  const double length_s = to.time_s - from.time_s;
  double start_s = 0.0;
  for (double end_s = std::min({blocks.first_s, blocks.longest_s, length_s}); start_s < length_s;) {
    for (int i = 1; i <= steps; ++i) {
      const double at_s = start_s + (end_s - start_s) * i / steps;
      const auto between = [&](double a, double b) { return a + (b - a) * at_s / length_s; };
      TouchSample sample = to;
      if (end_s < length_s || i < steps) {
        sample = {from.time_s + at_s, between(from.value, to.value), 0.0,
                  i % 2 == 1,         between(from.x_m, to.x_m),     between(from.y_m, to.y_m)};
      }
      samples.push_back(sample);
    }
    start_s = end_s;
    const double next_s = std::min(2.0 * end_s, end_s + blocks.longest_s);
    end_s = next_s < (1.0 - kRounding) * length_s ? next_s : length_s;
  }
}

// The points of a history with their places, the first after the jump with which it begins.
std::vector<TouchSample> corners_of(const SpaceTouch& touch) {
  std::vector<TouchSample> corners;
  for (std::size_t i = 0; i < touch.history.size(); ++i) {
    TouchSample corner{touch.history[i].time_s, touch.history[i].value};
    if (touch.is_path()) std::tie(corner.x_m, corner.y_m) = touch.place_m[i];
    corners.push_back(corner);
  }
  return corners;
}

double way_m(const TouchSample& from, const TouchSample& to) {
  return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
}

double smallest_top_m(const SpaceScene& scene) {
  double smallest_m = HUGE_VAL;
  for (const SpaceClass& one : classes_of(scene)) {
    smallest_m = std::min(smallest_m, one.diameter_m);
  }
  return smallest_m;
}

// Elastic pillars reach the same depth under the force int j(t - s) dF(s), where j is the relative
// creep compliance.
void set_elastic(const SpaceScene& scene, std::vector<TouchSample>& samples) {
  Course history;
  for (TouchSample& sample : samples) {
    sample.elastic = sample.value;
    history.push_back({sample.time_s, sample.value});
  }
  if (!scene.touch->is_creep) return;
  const std::vector<double> forces_N = response(relative_series(scene.pillar.terms), history, true);
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k].elastic = forces_N[k];
}

bool has_same_terms(const Material& a, const Material& b) {
  return std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(),
                    [](const MaterialTerm& x, const MaterialTerm& y) {
                      return x.g == y.g && x.tau_s == y.tau_s;
                    });
}

void check_materials(const SpaceScene& scene) {
  for (const SpaceClass& one : classes_of(scene)) {
    if (!has_constant_poisson_ratio(one.material)) {
      throw SceneMistake("materials.pillar",
                         "pillars under a shape relax with one modulus: give each term k = g, a "
                         "Poisson ratio that stays");
    }
    if (!has_same_terms(one.material, scene.pillar)) {
      throw SceneMistake("geometry.classes",
                         "pillars under a shape relax alike: the materials of all classes need the "
                         "same terms g and tau; their moduli may differ");
    }
  }
}

void check_path(const SpaceScene& scene) {
  constexpr double kMostTops = 1e4;
  const SpaceTouch& touch = *scene.touch;
  if (touch.place_m.size() != touch.history.size()) {
    throw SceneMistake("shape.path", "needs a place for each time");
  }
  const std::vector<TouchSample> corners = corners_of(touch);
  double length_m = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const TouchSample& one = corners[i];
    const std::string key = "shape.path." + std::to_string(i + 1);
    if (!std::isfinite(one.time_s + one.value + one.x_m + one.y_m)) {
      throw SceneMistake(key, "has a value that is not a number");
    }
    if (touch.is_creep && one.value < 0.0) throw SceneMistake(key, "a shape does not pull");
    largest = std::max(largest, one.value);
    if (i == 0) continue;
    if (one.time_s < corners[i - 1].time_s) {
      throw SceneMistake(key + ".time", "is earlier than that of the entry before");
    }
    const double way = way_m(corners[i - 1], one);
    if (one.time_s == corners[i - 1].time_s && way > 0.0) {
      throw SceneMistake(key,
                         "is at the time of the entry before, but elsewhere; a shape takes "
                         "time to move (its depth or force may jump)");
    }
    length_m += way;
  }
  if (corners.size() < 2 || corners.front().time_s != 0.0 || !(corners.back().time_s > 0.0)) {
    throw SceneMistake("shape.path",
                       "needs at least two entries, the first at 0 s, the last later");
  }
  if (!(largest > 0.0)) {
    throw SceneMistake("shape.path", "nothing happens: no depth or force is above zero");
  }
  if (length_m > kMostTops * smallest_top_m(scene)) {
    throw SceneMistake("shape.path", "is " + text_of(length_m, 3) +
                                         " m long, more than 10000 widths of a top; shorten it");
  }
}

void check_history(const SpaceScene& scene) {
  if (scene.touch->is_path()) return check_path(scene);
  const Course& points = scene.touch->history;
  validate_history(points);
  if (points.size() < 2 || points.front().time_s != 0.0 || !(points.back().time_s > 0.0)) {
    throw SceneMistake("analysis.history",
                       "needs at least two points, the first at 0 s, the last later, such as [[\"0 "
                       "s\", \"0 um\"], [\"10 ms\", \"3 um\"], [\"1 s\", \"3 um\"]]");
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(largest, points[i].value);
    if (points[i].value >= 0.0) continue;
    throw SceneMistake("analysis.history." + std::to_string(i + 1), "a shape does not pull");
  }
  if (largest > 0.0) return;
  throw SceneMistake("analysis.history", "nothing happens: every value of the history is zero");
}

void check_readout(const SpaceScene& scene) {
  at_key("readout", [&] { validate(*scene.touch->readout); });
  if (scene.electrode == SpaceElectrode::kEquipotential) return;
  throw SceneMistake("readout",
                     "needs electrodes to be wired to; say electrode = { kind = \"equipotential\", "
                     "... } without quadrants");
}

// Where the columns of the array bear most.
void set_worst_place(SpaceScene& scene, const std::vector<TouchSample>& samples,
                     const std::function<void(double)>& press_as) {
  RigidShape& shape = scene.press->shape;
  const TouchSample* worst = &samples.front();
  double most_Pa = 0.0;
  for (const TouchSample& sample : samples) {
    if (!(sample.elastic > 0.0)) continue;
    std::tie(shape.x_m, shape.y_m) = std::pair(sample.x_m, sample.y_m);
    press_as(sample.elastic);
    const double pressure_Pa = foundation_press(scene).largest_Pa;
    if (!(pressure_Pa > most_Pa)) continue;
    most_Pa = pressure_Pa;
    worst = &sample;
  }
  std::tie(shape.x_m, shape.y_m) = std::pair(worst->x_m, worst->y_m);
}

}  // namespace

std::vector<TouchSample> touch_samples(const SpaceScene& scene, int steps) {
  const std::vector<TouchSample> corners = corners_of(*scene.touch);
  const double first_s = first_block_s(scene), top_m = smallest_top_m(scene);
  std::vector<TouchSample> samples = {corners.front()};
  if (corners.front().value > 0.0) {
    samples.front().value = 0.0;
    samples.push_back(corners.front());
  }
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length_s = corners[i].time_s - corners[i - 1].time_s;
    if (length_s == 0.0) {
      samples.push_back(corners[i]);
      continue;
    }
    const double moved_m = way_m(corners[i - 1], corners[i]);
    const double longest_s = moved_m > 0.0 ? length_s * top_m / moved_m : HUGE_VAL;
    add_segment(corners[i - 1], corners[i], {first_s, longest_s}, steps, samples);
  }
  set_elastic(scene, samples);
  return samples;
}

double largest_value(const std::vector<TouchSample>& samples) {
  double largest = 0.0;
  for (const TouchSample& one : samples) largest = std::max(largest, one.elastic);
  return largest;
}

bool is_growing(const std::vector<TouchSample>& samples) {
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (samples[k].elastic < samples[k - 1].elastic * (1.0 - 1e-12)) return false;
  }
  return true;
}

double bound_on_elastic(const SpaceScene& scene, const std::vector<TouchSample>& samples) {
  std::vector<TouchSample> rising = samples;
  for (std::size_t k = 1; k < rising.size(); ++k) {
    rising[k].value = std::max(rising[k].value, rising[k - 1].value);
  }
  set_elastic(scene, rising);
  return rising.back().elastic;
}

RelaxationStep relaxation_step(const std::vector<MaterialTerm>& terms, double dt_s) {
  const PronySeries series = relative_series(terms);
  RelaxationStep step{series.equilibrium_modulus_Pa, {}, {}};
  for (const MaxwellTerm& term : series.terms) {
    const BranchStep own(dt_s, term.relaxation_time_s);
    step.kept.push_back(own.decay);
    step.gained.push_back(term.modulus_Pa * own.gain);
  }
  return step;
}

std::vector<TopLoads> relaxed(const std::vector<MaterialTerm>& terms,
                              const std::vector<TouchSample>& samples,
                              const std::vector<TopLoads>& elastic) {
  std::vector<TopLoads> branches, loads;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const RelaxationStep step =
        relaxation_step(terms, k == 0 ? 0.0 : samples[k].time_s - samples[k - 1].time_s);
    branches.resize(step.kept.size(), TopLoads::Zero(elastic.front().rows(), kTopLoads));
    TopLoads moved = elastic[k];
    if (k > 0) moved -= elastic[k - 1];
    TopLoads sum = step.equilibrium * elastic[k];
    for (std::size_t i = 0; i < branches.size(); ++i) {
      branches[i] = step.kept[i] * branches[i] + step.gained[i] * moved;
      sum += branches[i];
    }
    loads.push_back(std::move(sum));
  }
  return loads;
}

double change_of_reading(const SpaceScene& scene, const std::vector<TouchSample>& samples,
                         const std::vector<double>& force_N) {
  if (!scene.touch->readout) return 0.0;
  const ReadoutFilter filter = plate_filter(scene);
  std::vector<double> time_s, kept_s, kept_N;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    time_s.push_back(samples[k].time_s);
    if (samples[k].is_new) continue;
    kept_s.push_back(samples[k].time_s);
    kept_N.push_back(force_N[k]);
  }
  const std::vector<double> fine = reading_of(filter, time_s, force_N);
  const std::vector<double> coarse = reading_of(filter, kept_s, kept_N);
  double change = 0.0, largest = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    largest = std::max(largest, std::abs(fine[k]));
    if (!samples[k].is_new) change = std::max(change, std::abs(fine[k] - coarse[next++]));
  }
  return largest > 0.0 ? change / largest : 0.0;
}

void press_in_time(SpaceScene& scene, SpaceTouch touch) {
  scene.touch = std::move(touch);
  ShapePress& press = *scene.press;
  if (scene.touch->is_path() && press.friction == Friction::kStick) {
    press.friction = Friction::kCoulomb;
    press.friction_coefficient = HUGE_VAL;
  }
  check_history(scene);
  if (scene.touch->readout) at_key("readout", [&] { validate(*scene.touch->readout); });
  const std::vector<TouchSample> samples = touch_samples(scene, 2);
  const auto press_as = [&](double value) {
    press.depth_m = scene.touch->is_creep ? 0.0 : value;
    press.force_N = scene.touch->is_creep ? value : 0.0;
  };
  if (scene.touch->is_path()) set_worst_place(scene, samples, press_as);
  press_as(largest_value(samples));
}

void check_touch(const SpaceScene& scene) {
  if (!scene.touch) return;
  check_history(scene);
  check_materials(scene);
  if (scene.touch->readout) check_readout(scene);
}

double relaxed_share(const SpaceScene& scene) {
  const PronySeries series = relative_series(scene.pillar.terms);
  const Course& points = scene.touch->history;
  double way = std::abs(points.front().value), largest = way;
  for (std::size_t i = 1; i < points.size(); ++i) {
    way += std::abs(points[i].value - points[i - 1].value);
    largest = std::max(largest, points[i].value);
  }
  const double end_s = points.back().time_s;
  if (!scene.touch->is_creep) {
    return (1.0 - relaxation_modulus_Pa(series, end_s)) * way / largest;
  }
  return (response(series, {{0.0, 1.0}, {end_s, 1.0}}, true).back() - 1.0) * way / largest;
}

}  // namespace viscard
