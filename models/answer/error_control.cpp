#include "models/answer/error_control.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

// One number of an answer, the size that its error is relative to, and the place of the error.
struct Number {
  std::string name;
  double value = 0.0;
  double size = 0.0;
  double* error = nullptr;
  double unresolved = 0.0;  // relative to the value
  double left_out = 0.0;    // in the unit
};

// All numbers of an answer, and where those of each curve begin.
struct Numbers {
  std::vector<Number> all;
  std::vector<std::pair<const SceneCurve*, std::size_t>> curves;
  std::vector<std::pair<const SceneResult*, std::size_t>> read_off;  // results read off a curve
};

// Largest value at the points within `span` of each point; x ascends.
std::vector<double> largest_within(const std::vector<double>& x, double span,
                                   const std::vector<double>& value) {
  std::vector<double> largest(value.size());
  std::deque<std::size_t> falling;  // candidates, each larger than those behind it
  std::size_t next = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    for (; next < value.size() && x[next] <= x[i] + span; ++next) {
      while (!falling.empty() && value[falling.back()] <= value[next]) falling.pop_back();
      falling.push_back(next);
    }
    while (x[falling.front()] < x[i] - span) falling.pop_front();
    largest[i] = value[falling.front()];
  }
  return largest;
}

void add_curve(SceneCurve& curve, Numbers& numbers) {
  if (!curve.is_watched) return;
  numbers.curves.emplace_back(&curve, numbers.all.size());
  curve.error.assign(curve.value.size(), 0.0);
  const double peak = largest_size(curve.value);
  const std::vector<double> left_out = largest_within(curve.x, curve.span, curve.left_out);
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    const double size = curve.allowed.empty() ? peak : curve.allowed[i];
    numbers.all.push_back({curve.name, curve.value[i], size, &curve.error[i]});
    if (!left_out.empty()) numbers.all.back().left_out = left_out[i];
  }
}

void add_map(SceneMap& map, Numbers& numbers) {
  if (!map.is_watched) return;
  map.error.assign(map.value.size(), 0.0);
  const double size = size_of(map);
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    numbers.all.push_back({map.name, map.value[i], size, &map.error[i]});
  }
}

Numbers numbers_of(SceneAnswer& answer) {
  Numbers numbers;
  for (SceneResult& r : answer.results) {
    if (!r.is_wanted) continue;
    if (!r.curve.empty()) numbers.read_off.emplace_back(&r, numbers.all.size());
    numbers.all.push_back({r.name, r.value, std::max(std::abs(r.value), r.scale), &r.error_estimate,
                           r.unresolved, r.left_out});
  }
  for (SceneMode& m : answer.modes) {
    numbers.all.push_back(
        {m.family + " frequency", m.frequency_Hz, m.frequency_Hz, &m.error_estimate, m.unresolved});
    if (!m.damping_ratio) continue;
    numbers.all.push_back({m.family + " damping ratio", *m.damping_ratio, 1.0, &m.damping_error});
  }
  for (SceneCurve& curve : answer.curves) add_curve(curve, numbers);
  for (SceneMap& map : answer.maps) add_map(map, numbers);
  return numbers;
}

// Raises the change at each point of a curve to the largest one, relative to the size, within the
// curve's span.
void spread_over_curves(const Numbers& numbers, std::vector<double>& change) {
  for (const auto& [curve, first] : numbers.curves) {
    if (!(curve->span > 0.0)) continue;
    std::vector<double> relative(curve->x.size(), 0.0);
    for (std::size_t i = 0; i < relative.size(); ++i) {
      const double size = numbers.all[first + i].size;
      if (size > 0.0) relative[i] = change[first + i] / size;
    }
    relative = largest_within(curve->x, curve->span, relative);
    for (std::size_t i = 0; i < relative.size(); ++i) {
      change[first + i] = std::max(change[first + i], relative[i] * numbers.all[first + i].size);
    }
  }
}

// A result that is read off a curve has at least the error of the curve there.
void raise_to_curves(const Numbers& numbers) {
  for (const auto& [result, at] : numbers.read_off) {
    for (const auto& [curve, first] : numbers.curves) {
      if (curve->name != result->curve) continue;
      const auto found = std::lower_bound(curve->x.begin(), curve->x.end(), result->x);
      const auto i =
          static_cast<std::size_t>(std::min(found - curve->x.begin(), std::ssize(curve->x) - 1));
      *numbers.all[at].error = std::max(*numbers.all[at].error, curve->error[i]);
    }
  }
}

// Factor on the remaining share of the last change if the mesh gained no layer at the singular rim.
// Another layer leaves ratio^(2 lambda) = 0.07 (0.15 at an electrode's edge) of that part of the
// error; random scenes showed up to twice as much (tests/models/scene).
constexpr double kWithoutLayers = 2.5;

// The sum of the changes to come, if they form a geometric sequence that falls by less than half
// per mesh; at most ten times the last change.
double remaining(double change, double before) {
  if (!(change > 0.5 * before) || before == 0.0) return change;
  const double ratio = change / before;
  return change * (ratio < 10.0 / 11.0 ? ratio / (1.0 - ratio) : 10.0);
}

// Error over the change to a mesh that has a sixth of it or less.
constexpr double kMissed = 1.2;

// From this degree on the error of steps and bases no longer depends on the mesh.
constexpr int kNoLongerCoarse = 5;

// Estimates of all numbers from the changes since the mesh before; name of the worst.
class ChangeTracker {
 public:
  explicit ChangeTracker(const ErrorControl& control)
      : share_left_(control.share_left), is_measured_(control.is_last_measured) {}

  // Sets the errors of `answer` and its largest relative one.
  void compare(SceneAnswer& answer) {
    const Numbers parts = numbers_of(answer);
    const std::vector<Number>& numbers = parts.all;
    const bool comparable = last_.size() == numbers.size();
    std::vector<double> change(numbers.size(), 0.0);
    // A higher degree alone does not show the error that only more layers reduce.
    const bool gained_layer = answer.discretisation.layers > last_layers_;
    const double left = share_left_ * (gained_layer ? 1.0 : kWithoutLayers);
    last_layers_ = answer.discretisation.layers;
    answer.largest_relative_error = comparable ? 0.0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; comparable && i < numbers.size(); ++i) {
      change[i] = (is_measured_ ? kMissed : 1.0) * std::abs(numbers[i].value - last_[i]);
    }
    spread_over_curves(parts, change);
    const std::vector<double> seen = change;
    compared_twice_ = comparable && last_estimate_.size() == change.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (compared_twice_) {
        // A change within the step errors of both answers gives no information on the mesh.
        const bool is_noise = change[i] <= 2.0 * answer.step_error * numbers[i].size;
        const double left_over = is_noise ? change[i] : remaining(change[i], last_estimate_[i]);
        change[i] = std::max(left_over, left * last_floor_[i]);
      }
      const double unresolved = numbers[i].unresolved * std::abs(numbers[i].value);
      const double on_mesh = is_measured_ && comparable ? change[i] + last_unresolved_[i]
                                                        : std::max(change[i], unresolved);
      *numbers[i].error = on_mesh + numbers[i].left_out + answer.step_error * numbers[i].size;
    }
    raise_to_curves(parts);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double error = *numbers[i].error;
      if (comparable && !(error <= answer.largest_relative_error * numbers[i].size)) {
        answer.largest_relative_error = error / numbers[i].size;
        worst_ = numbers[i].name;
        worst_left_out_ = numbers[i].left_out / numbers[i].size;
      }
    }
    if (!comparable) change.clear();
    remember(seen, change, gained_layer ? left : 0.0);
    last_.clear();
    last_unresolved_.clear();
    for (const Number& number : numbers) {
      last_.push_back(number.value);
      last_unresolved_.push_back(number.unresolved * std::abs(number.value));
    }
  }
  bool compared_twice() const { return compared_twice_; }
  const std::string& worst() const { return worst_; }
  // That part of its relative error which no mesh reduces.
  double worst_left_out() const { return worst_left_out_; }

 private:
  // A layer may chance to change nothing, so that the change before counts as well, but not those of
  // meshes before that, which may have been too coarse to mean anything. A change without a new layer
  // (left = 0) does not contain the error at the rim: the whole estimate remains.
  void remember(const std::vector<double>& seen, const std::vector<double>& estimate, double left) {
    const std::vector<double>& now = left > 0.0 && !estimate.empty() ? seen : estimate;
    last_floor_ = now;
    for (std::size_t i = 0; compared_twice_ && i < now.size(); ++i) {
      last_floor_[i] = std::max(now[i], left * last_change_[i]);
    }
    last_change_ = now;
    last_estimate_ = estimate;
  }

  double share_left_;
  bool is_measured_;                     // by a finer mesh: the change, and what that one lacks
  std::vector<double> last_unresolved_;  // in the unit
  std::vector<double> last_;             // numbers
  std::vector<double> last_change_;      // of the numbers, or the estimate without a new layer
  std::vector<double> last_estimate_;    // of their errors
  std::vector<double> last_floor_;       // of which a share remains at least
  std::string worst_;
  double worst_left_out_ = 0.0;
  int last_layers_ = 0;
  bool compared_twice_ = false;
};

}  // namespace

SceneAnswer answer_within(const ErrorControl& control, const MeshAnswer& answer_on) {
  ChangeTracker tracker(control);
  SceneAnswer answer;
  double done = 0.0;
  for (const Discretisation& mesh : control.meshes) {
    if (control.progress) {
      control.progress(
          done++ / static_cast<double>(control.meshes.size()),
          "degree " + std::to_string(mesh.degree) + ", " + std::to_string(mesh.layers) + " layers");
    }
    try {
      answer = answer_on(mesh);
      tracker.compare(answer);
    } catch (const MeshTooCoarse&) {
      if (&mesh == &control.meshes.back()) throw;
    }
    const bool is_judged =
        tracker.compared_twice() || (control.is_last_measured && &mesh == &control.meshes.back());
    if (is_judged && answer.largest_relative_error <= control.tolerance) {
      return answer;
    }
    const bool stays = mesh.degree >= kNoLongerCoarse && !control.step_error_falls;
    if (stays && answer.step_error > control.tolerance) break;
  }
  if (answer.step_error > control.tolerance) {
    throw std::runtime_error(
        "what finer meshes do not reduce (time steps, the reduced basis, sums over "
        "distant pillars) leaves a relative error of about " +
        text_of(answer.step_error, 2) + "; ask for a larger tolerance, or for fewer results");
  }
  const double left_out = tracker.worst_left_out();
  const bool is_of_mesh = left_out < 0.5 * answer.largest_relative_error;
  throw std::runtime_error(
      "the finest mesh (degree " + std::to_string(answer.discretisation.degree) +
      ") leaves a relative error of about " + text_of(answer.largest_relative_error, 2) +
      " in the " + tracker.worst() +
      (is_of_mesh ? "" : ", of which no finer mesh reduces about " + text_of(left_out, 2)) +
      "; ask for a larger tolerance, or for fewer results");
}

}  // namespace viscard
