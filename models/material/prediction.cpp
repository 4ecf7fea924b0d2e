#include "models/material/prediction.h"

#include "models/material/retardation_spectrum.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kUsualStrain = 0.01, kUsualStress_Pa = 1000.0;

// The times that the prediction covers unless the request states others: those of the window;
// without a window, the relaxation times and a decade beyond them on either side.
struct TimeSpan {
  double first_s = 0.01, last_s = 100.0;
};
TimeSpan usual_times(const Material& material) {
  TimeSpan span;
  const RelaxationTimes times = relaxation_times(material.terms);
  if (times.slowest_s > 0.0) span = {0.1 * times.fastest_s, 10.0 * times.slowest_s};
  if (material.valid.t_max_s > 0.0) span.last_s = material.valid.t_max_s;
  if (material.valid.t_min_s > 0.0) span.first_s = material.valid.t_min_s;
  if (!(span.first_s < span.last_s)) span.first_s = 1e-3 * span.last_s;
  return span;
}

std::vector<double> log_spaced(double from, double to, int count) {
  require_positive("the first value of the range", from);
  require(to > from, "the range runs from " + text_of(from) + " to " + text_of(to) +
                         "; it must end after it begins");
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0.0;
    values.push_back(i + 1 == count && count > 1 ? to : from * std::pow(to / from, share));
  }
  return values;
}

// Ascending, each value once.
std::vector<double> merged(std::vector<double> values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

class Predictor {
 public:
  Predictor(const Material& material, const PredictionRequest& request)
      : material_(material), request_(request), span_(usual_times(material)) {
    require(request.points >= 2 && request.points <= 100000,
            "the number of points is " + std::to_string(request.points) +
                "; it must lie between 2 and 100000");
    require_not_negative("the duration of the ramp", request.ramp_s, "s");
    out_.test = request.test;
    out_.argument = "time_s";
    out_.is_window_known = material.valid.t_max_s > 0.0;
    out_.t_min_s = material.valid.t_min_s;
    out_.t_max_s = material.valid.t_max_s;
  }

  TestPrediction run() {
    switch (request_.test) {
      case PredictedTest::kRelaxation:
        refuse(request_.stress_Pa, "a relaxation test holds a strain; give its strain");
        if (!request_.strain && request_.ramp_s == 0.0) {
          of_argument("modulus_Pa", relaxation_modulus);
        } else {
          of_history(held(request_.strain.value_or(kUsualStrain), false), false);
        }
        break;
      case PredictedTest::kCreep:
        refuse(request_.strain, "a creep test holds a stress; give its stress");
        if (!request_.stress_Pa && request_.ramp_s == 0.0) {
          of_argument("compliance_1_Pa", creep_compliance);
        } else {
          of_history(held(request_.stress_Pa.value_or(kUsualStress_Pa), false), true);
        }
        break;
      case PredictedTest::kRecovery:
        refuse(request_.strain, "recovery follows a creep test, which holds a stress");
        of_history(held(request_.stress_Pa.value_or(kUsualStress_Pa), true), true);
        break;
      case PredictedTest::kCycles:
        of_history(cycles(), request_.stress_Pa.has_value());
        break;
      case PredictedTest::kOscillation:
        of_frequency();
        break;
      case PredictedTest::kHistory:
        require(request_.history.has_value(), "a history has to be given");
        of_history(*request_.history, request_.is_stress_history);
        break;
    }
    if (!out_.is_window_known) out_.is_inside.assign(out_.at.size(), true);
    return out_;
  }

 private:
  using Curve = std::vector<double>;

  static void refuse(const std::optional<double>& given, const char* what) {
    require(!given.has_value(), what);
  }

  static Curve relaxation_modulus(const PronySeries& series, const std::vector<double>& time_s) {
    Curve out;
    for (const double t_s : time_s) out.push_back(relaxation_modulus_Pa(series, t_s));
    return out;
  }

  static Curve creep_compliance(const PronySeries& series, const std::vector<double>& time_s) {
    const RetardationSpectrum spectrum = retardation_from_relaxation(series);
    Curve out;
    for (const double t_s : time_s) out.push_back(creep_compliance_1_Pa(spectrum, t_s));
    return out;
  }

  void add(const std::string& name, const CurveOfSeries& curve) {
    out_.curves.push_back({name, banded_curve(material_, curve)});
  }

  // E(t) or J(t) after an ideal step.
  void of_argument(const char* name, Curve (*curve)(const PronySeries&, const Curve&)) {
    const double to_s = request_.to.value_or(request_.hold_s.value_or(span_.last_s));
    const double from_s =
        request_.from.value_or(span_.first_s < to_s ? span_.first_s : 1e-3 * to_s);
    out_.at = merged(log_spaced(from_s, to_s, request_.points), request_.also_at);
    require(out_.at.front() >= 0.0, "there is no response before the step at t = 0");
    add(name, [&](const PronySeries& series) { return curve(series, out_.at); });
    constexpr double kRounding = 1e-9;
    for (const double t_s : out_.at) {
      out_.is_inside.push_back(t_s >= out_.t_min_s * (1.0 - kRounding) &&
                               t_s <= out_.t_max_s * (1.0 + kRounding));
    }
  }

  Course held(double size, bool is_released) const {
    const double hold_s = request_.hold_s.value_or(request_.to.value_or(span_.last_s));
    require_positive("the duration of the hold", hold_s, "s");
    std::vector<LoadStep> steps{{request_.ramp_s, size}, {hold_s, size}};
    if (is_released) {
      const double recovery_s = request_.recovery_s.value_or(hold_s);
      require_positive("the duration of the recovery", recovery_s, "s");
      steps.push_back({request_.ramp_s, 0.0});
      steps.push_back({recovery_s, 0.0});
    }
    return course_of_steps(steps, first_after_motion(hold_s), request_.points);
  }

  double first_after_motion(double hold_s) const {
    return request_.from.value_or(std::min(span_.first_s, 1e-3 * hold_s));
  }

  Course cycles() const {
    require(!request_.strain || !request_.stress_Pa,
            "cycles are of a strain or of a stress, not of both");
    require_positive("the period of the cycles", request_.period_s, "s");
    require(request_.n_cycles >= 1 && request_.n_cycles <= 10000,
            "the number of cycles is " + std::to_string(request_.n_cycles) +
                "; it must lie between 1 and 10000");
    require(2.0 * request_.points * request_.n_cycles <= kMostCyclePoints,
            std::to_string(request_.n_cycles) + " cycles with " + std::to_string(request_.points) +
                " points of each motion are above the limit of " +
                std::to_string(kMostCyclePoints) + " points; use fewer points");
    const double size = request_.stress_Pa.value_or(request_.strain.value_or(kUsualStrain));
    std::vector<LoadStep> steps;
    for (int i = 0; i < request_.n_cycles; ++i) {
      steps.push_back({0.5 * request_.period_s, size});
      steps.push_back({0.5 * request_.period_s, 0.0});
    }
    return course_of_steps(steps, request_.period_s, request_.points);
  }

  void of_history(const Course& course, bool is_stress) {
    const Course input = with_corners_at(course, request_.also_at);
    for (const CoursePoint& corner : input) {
      out_.at.push_back(corner.time_s);
      out_.input.push_back(corner.value);
    }
    out_.input_name = is_stress ? "stress_Pa" : "strain";
    add(is_stress ? "strain" : "stress_Pa",
        [&](const PronySeries& series) { return response(series, input, is_stress); });
    out_.is_inside = is_within_window(input, out_.t_min_s, out_.t_max_s);
  }

  void of_frequency() {
    out_.argument = "frequency_Hz";
    const double from_Hz = request_.from.value_or(1.0 / (kTwoPi * span_.last_s));
    const double to_Hz = request_.to.value_or(1.0 / (kTwoPi * span_.first_s));
    out_.at = merged(log_spaced(from_Hz, to_Hz, request_.points), request_.also_at);
    require_positive("the lowest frequency", out_.at.front(), "Hz");
    const auto curve = [&](const auto& part) {
      return [this, part](const PronySeries& series) {
        Curve values;
        for (const double f_Hz : out_.at) {
          values.push_back(part(complex_modulus_Pa(series, kTwoPi * f_Hz)));
        }
        return values;
      };
    };
    add("storage_modulus_Pa", curve([](const ComplexModulus& m) { return m.storage_Pa; }));
    add("loss_modulus_Pa", curve([](const ComplexModulus& m) { return m.loss_Pa; }));
    add("tan_delta", curve([](const ComplexModulus& m) { return m.loss_Pa / m.storage_Pa; }));
    constexpr double kRounding = 1e-9;
    for (const double f_Hz : out_.at) {
      const double t_s = 1.0 / (kTwoPi * f_Hz);
      out_.is_inside.push_back(t_s >= out_.t_min_s * (1.0 - kRounding) &&
                               t_s <= out_.t_max_s * (1.0 + kRounding));
    }
  }

  const Material& material_;
  const PredictionRequest& request_;
  TimeSpan span_;
  TestPrediction out_;
};

}  // namespace

TestPrediction predict_test(const Material& material, const PredictionRequest& request) {
  validate(material);
  return Predictor(material, request).run();
}

}  // namespace viscard
