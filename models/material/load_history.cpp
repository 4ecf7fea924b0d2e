#include "models/material/load_history.h"

#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

namespace viscard {
namespace {

// The input between two corners.
double between(const LoadHistory& history, std::size_t left, double time_s) {
  const double from_s = history.time_s[left], to_s = history.time_s[left + 1];
  if (!(to_s > from_s)) return history.value[left + 1];
  const double share = (time_s - from_s) / (to_s - from_s);
  return (1.0 - share) * history.value[left] + share * history.value[left + 1];
}

double largest_input(const LoadHistory& history) {
  double largest = 0.0;
  for (const double value : history.value) largest = std::max(largest, std::abs(value));
  return largest;
}

// Time at which the input first exceeds the limit; infinite if it never does.
double begin_of_loading_s(const LoadHistory& history, double limit) {
  for (std::size_t i = 0; i < history.time_s.size(); ++i) {
    const double now = std::abs(history.value[i]);
    if (!(now > limit)) continue;
    const double before = i > 0 ? history.value[i - 1] : 0.0;
    if (i == 0 || !(history.time_s[i] > history.time_s[i - 1])) return history.time_s[i];
    const double signed_limit = history.value[i] > 0.0 ? limit : -limit;
    const double share = (signed_limit - before) / (history.value[i] - before);
    return history.time_s[i - 1] + share * (history.time_s[i] - history.time_s[i - 1]);
  }
  return INFINITY;
}

// Largest or smallest input of the corners not yet dropped, each corner pushed and popped once
// (monotonic queue).
class RunningExtreme {
 public:
  explicit RunningExtreme(double sign) : sign_(sign) {}
  void push(const std::vector<double>& value, std::size_t i) {
    while (!kept_.empty() && sign_ * value[kept_.back()] <= sign_ * value[i]) kept_.pop_back();
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
std::vector<double> trailing_range(const LoadHistory& history, double t_min_s) {
  constexpr double kRounding = 1e-9;  // a corner exactly t_min after a jump no longer sees it
  const double back_s = t_min_s * (1.0 - kRounding);
  if (!(t_min_s > 0.0)) return std::vector<double>(history.time_s.size(), 0.0);
  RunningExtreme high(1.0), low(-1.0);
  std::vector<double> range;
  std::size_t first = 0;  // first corner within the last t_min_s
  for (std::size_t i = 0; i < history.time_s.size(); ++i) {
    high.push(history.value, i);
    low.push(history.value, i);
    const double from_s = history.time_s[i] - back_s;
    while (history.time_s[first] < from_s) ++first;
    high.drop_before(first);
    low.drop_before(first);
    const double at_begin = first > 0 ? between(history, first - 1, from_s) : 0.0;
    range.push_back(std::max(history.value[high.index()], at_begin) -
                    std::min(history.value[low.index()], at_begin));
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
std::vector<double> advanced(Solid solid, const LoadHistory& history) {
  std::vector<double> out;
  out.reserve(history.time_s.size());
  double last_s = history.time_s.front();
  for (std::size_t i = 0; i < history.time_s.size(); ++i) {
    out.push_back(solid.advance(history.time_s[i] - last_s, history.value[i]));
    last_s = history.time_s[i];
  }
  return out;
}

}  // namespace

void validate(const LoadHistory& history) {
  require(!history.time_s.empty() && history.time_s.size() == history.value.size(),
          "a history needs at least one corner, and as many values as times");
  for (std::size_t i = 0; i < history.time_s.size(); ++i) {
    require(std::isfinite(history.time_s[i]) && std::isfinite(history.value[i]),
            "corner " + std::to_string(i + 1) + " of the history is not finite");
    require(i == 0 || history.time_s[i] >= history.time_s[i - 1],
            "the time of the history runs backwards from " +
                text_of(history.time_s[i > 0 ? i - 1 : 0]) + " s to " + text_of(history.time_s[i]) +
                " s");
  }
}

std::vector<double> response(const PronySeries& series, const LoadHistory& history) {
  validate(history);
  if (!history.is_stress) return advanced(HereditaryStress(series), history);
  return advanced(HereditaryStrain(retardation_from_relaxation(series)), history);
}

LoadHistory with_corners_at(const LoadHistory& history, std::vector<double> time_s) {
  validate(history);
  std::sort(time_s.begin(), time_s.end());
  LoadHistory out{history.is_stress, {}, {}};
  const auto add = [&](double t_s, double value) {
    out.time_s.push_back(t_s);
    out.value.push_back(value);
  };
  auto next = std::lower_bound(time_s.begin(), time_s.end(), history.time_s.front());
  for (std::size_t i = 0; i < history.time_s.size(); ++i) {
    for (; next != time_s.end() && *next < history.time_s[i]; ++next) {
      if (i > 0 && *next > out.time_s.back()) add(*next, between(history, i - 1, *next));
    }
    while (next != time_s.end() && *next == history.time_s[i]) ++next;
    add(history.time_s[i], history.value[i]);
  }
  for (; next != time_s.end(); ++next) {  // the input stays at its last value
    if (*next > out.time_s.back()) add(*next, history.value.back());
  }
  return out;
}

LoadHistory history_of_steps(bool is_stress, const std::vector<LoadStep>& steps, double first_s,
                             int points) {
  require_positive("the first time after a motion", first_s, "s");
  LoadHistory out{is_stress, {0.0}, {0.0}};
  for (const LoadStep& step : steps) {
    require_not_negative("the duration of a motion", step.duration_s, "s");
    const double begin_s = out.time_s.back(), from = out.value.back();
    const bool is_hold = from == step.target;
    const int count = step.duration_s > 0.0 ? std::max(1, points) : 1;
    const double first_share = std::min(0.5, first_s / std::max(first_s, step.duration_s));
    for (int k = 1; k <= count; ++k) {
      double share = static_cast<double>(k) / count;
      if (is_hold && count > 1) {
        share = std::pow(first_share, static_cast<double>(count - k) / (count - 1));
      }
      const bool is_last = k == count;
      out.time_s.push_back(begin_s + (is_last ? step.duration_s : share * step.duration_s));
      out.value.push_back(is_last || is_hold ? step.target : from + share * (step.target - from));
    }
  }
  return out;
}

std::vector<bool> is_within_window(const LoadHistory& history, double t_min_s, double t_max_s) {
  validate(history);
  constexpr double kShare = 0.05, kRounding = 1e-9;
  const double limit = kShare * largest_input(history);
  const double last_s = begin_of_loading_s(history, limit) + t_max_s * (1.0 + kRounding);
  const std::vector<double> range = trailing_range(history, t_min_s);
  std::vector<bool> is_inside;
  for (std::size_t i = 0; i < range.size(); ++i) {
    is_inside.push_back(!(range[i] > limit) && history.time_s[i] <= last_s);
  }
  return is_inside;
}

}  // namespace viscard
