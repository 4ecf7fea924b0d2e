#include "models/material/load_history.h"

#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/branch_step.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

namespace viscard {
namespace {

void require_course(const Course& input) {
  require(!input.empty(), "a history needs at least one corner");
  for (std::size_t i = 0; i < input.size(); ++i) {
    require(std::isfinite(input[i].time_s) && std::isfinite(input[i].value),
            "corner " + std::to_string(i + 1) + " of the history is not finite");
    require(i == 0 || input[i].time_s >= input[i - 1].time_s,
            "the time of the history runs backwards from " +
                text_of(input[i > 0 ? i - 1 : 0].time_s) + " s to " + text_of(input[i].time_s) +
                " s");
  }
}

// Time at which the input first exceeds the limit; infinite if it never does.
double begin_of_loading_s(const Course& input, double limit) {
  for (std::size_t i = 0; i < input.size(); ++i) {
    const CoursePoint& now = input[i];
    if (!(std::abs(now.value) > limit)) continue;
    if (i == 0 || !(now.time_s > input[i - 1].time_s)) return now.time_s;
    const CoursePoint& before = input[i - 1];
    const double signed_limit = now.value > 0.0 ? limit : -limit;
    const double share = (signed_limit - before.value) / (now.value - before.value);
    return before.time_s + share * (now.time_s - before.time_s);
  }
  return INFINITY;
}

// Largest or smallest input of the corners not yet dropped, each corner pushed and popped once
// (monotonic queue).
class RunningExtreme {
 public:
  explicit RunningExtreme(double sign) : sign_(sign) {}
  void push(const Course& input, std::size_t i) {
    while (!kept_.empty() && sign_ * input[kept_.back()].value <= sign_ * input[i].value) {
      kept_.pop_back();
    }
    kept_.push_back(i);
  }
  void drop_before(std::size_t first) {
    while (!kept_.empty() && kept_.front() < first) kept_.pop_front();
  }
  std::size_t index() const { return kept_.front(); }

 private:
  double sign_;
  std::deque<std::size_t> kept_;
};

// At each corner, the range of the input over the t_min_s before it.
std::vector<double> trailing_range(const Course& input, double t_min_s) {
  constexpr double kRounding = 1e-9;  // a corner exactly t_min after a jump no longer sees it
  const double back_s = t_min_s * (1.0 - kRounding);
  if (!(t_min_s > 0.0)) return std::vector<double>(input.size(), 0.0);
  RunningExtreme high(1.0), low(-1.0);
  std::vector<double> range;
  std::size_t first = 0;  // first corner within the last t_min_s
  for (std::size_t i = 0; i < input.size(); ++i) {
    high.push(input, i);
    low.push(input, i);
    const double from_s = input[i].time_s - back_s;
    while (input[first].time_s < from_s) ++first;
    high.drop_before(first);
    low.drop_before(first);
    const double at_begin = first > 0 ? value_between(input[first - 1], input[first], from_s) : 0.0;
    range.push_back(std::max(input[high.index()].value, at_begin) -
                    std::min(input[low.index()].value, at_begin));
  }
  return range;
}

// Strain from stress, the counterpart of HereditaryStress, for stress linear in each step (eq. 33).
// e_j is the strain of one Kelvin-Voigt element of the row. Under a stress of one sign every term
// has that sign, so nothing cancels for x from 0 to infinity.
class HereditaryStrain {
 public:
  explicit HereditaryStrain(RetardationSpectrum spectrum)
      : spectrum_(std::move(spectrum)), element_(spectrum_.terms.size(), 0.0) {}

  double advance(double dt_s, double stress_Pa) {
    const double increment_Pa = stress_Pa - stress_Pa_;
    for (std::size_t j = 0; j < element_.size(); ++j) {
      const RetardationTerm& term = spectrum_.terms[j];
      const double x = dt_s / term.retardation_time_s;
      element_[j] =
          std::exp(-x) * element_[j] +
          term.compliance_1_Pa * (-std::expm1(-x) * stress_Pa_ + x * phi2(x) * increment_Pa);
    }
    flow_ += spectrum_.fluidity_1_Pa_s * dt_s * 0.5 * (stress_Pa_ + stress_Pa);
    stress_Pa_ = stress_Pa;
    double strain = spectrum_.instantaneous_compliance_1_Pa * stress_Pa_ + flow_;
    for (const double one : element_) strain += one;
    return strain;
  }

 private:
  RetardationSpectrum spectrum_;
  std::vector<double> element_;
  double stress_Pa_ = 0.0, flow_ = 0.0;
};

// `advance` of HereditaryStress or HereditaryStrain over all corners.
template <typename Solid>
std::vector<double> advanced(Solid solid, const Course& input) {
  std::vector<double> out;
  out.reserve(input.size());
  double last_s = input.front().time_s;
  for (const CoursePoint& corner : input) {
    out.push_back(solid.advance(corner.time_s - last_s, corner.value));
    last_s = corner.time_s;
  }
  return out;
}

}  // namespace

std::vector<double> response(const PronySeries& series, const Course& input, bool is_stress) {
  require_course(input);
  if (!is_stress) return advanced(HereditaryStress(series), input);
  return advanced(HereditaryStrain(retardation_from_relaxation(series)), input);
}

Course with_corners_at(const Course& input, std::vector<double> time_s) {
  require_course(input);
  std::sort(time_s.begin(), time_s.end());
  Course out;
  auto next = std::lower_bound(time_s.begin(), time_s.end(), input.front().time_s);
  for (const CoursePoint& corner : input) {
    for (; next != time_s.end() && *next < corner.time_s; ++next) {
      if (*next > out.back().time_s) out.push_back({*next, value_at(input, *next)});
    }
    while (next != time_s.end() && *next == corner.time_s) ++next;
    out.push_back(corner);
  }
  for (; next != time_s.end(); ++next) {  // the input stays at its last value
    if (*next > out.back().time_s) out.push_back({*next, input.back().value});
  }
  return out;
}

Course course_of_steps(const std::vector<LoadStep>& steps, double first_s, int points) {
  require_positive("the first time after a motion", first_s, "s");
  Course out{{0.0, 0.0}};
  for (const LoadStep& step : steps) {
    require_not_negative("the duration of a motion", step.duration_s, "s");
    const auto [begin_s, from] = out.back();
    const bool is_hold = from == step.target;
    const int count = step.duration_s > 0.0 ? std::max(1, points) : 1;
    const double first_share = std::min(0.5, first_s / std::max(first_s, step.duration_s));
    for (int k = 1; k <= count; ++k) {
      double share = static_cast<double>(k) / count;
      if (is_hold && count > 1) {
        share = std::pow(first_share, static_cast<double>(count - k) / (count - 1));
      }
      const bool is_last = k == count;
      out.push_back({begin_s + (is_last ? step.duration_s : share * step.duration_s),
                     is_last || is_hold ? step.target : from + share * (step.target - from)});
    }
  }
  return out;
}

std::vector<bool> is_within_window(const Course& input, double t_min_s, double t_max_s) {
  require_course(input);
  constexpr double kShare = 0.05, kRounding = 1e-9;
  const double limit = kShare * largest_size(input);
  const double last_s = begin_of_loading_s(input, limit) + t_max_s * (1.0 + kRounding);
  const std::vector<double> range = trailing_range(input, t_min_s);
  std::vector<bool> is_inside;
  for (std::size_t i = 0; i < range.size(); ++i) {
    is_inside.push_back(!(range[i] > limit) && input[i].time_s <= last_s);
  }
  return is_inside;
}

}  // namespace viscard
