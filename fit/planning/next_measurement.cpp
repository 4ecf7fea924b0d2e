#include "fit/planning/next_measurement.h"

#include "models/experiment/test_phases.h"
#include "models/maths/dense.h"
#include "models/maths/result_visitor.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Weights that are put on and taken off by hand, three times up and down.
constexpr double kCalibration_min = 10.0;
// A calliper on the punch, or a gauge on the layer.
constexpr double kGeometry_min = 2.0;

Material guess_of(const FittedRun& run) {
  return material_from_fit(run.fit, run.bench.specimen.contact.poisson_ratio, 0.0);
}

// Both measured independently: (A^-1 + B^-1)^-1 = A - A (A + B)^-1 A.
Eigen::MatrixXd pooled(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a - a * SymmetricFactor(a + b).solve(a);
}

// The fit together with one more touch.
PredictedFit after_touch(const FittedRun& run, const TestPlan& plan) {
  PredictedFit known = known_fit(run);
  const PredictedFit touch = predicted_fit(plan, run.bench, guess_of(run));
  known.covariance = pooled(known.covariance, touch.result.covariance);
  known.total_s = touch.total_s;
  return known;
}

double minutes_of(const Bench& bench, double run_s) {
  return (run_s + bench.performance.handling_s) / 60.0;
}

// A run of viscard calibrate --compliance.
double compliance_minutes(const FittedRun& run) {
  TestPlan plan = run.plan;
  plan.protocol = "compliance";
  plan.preload_N = 0.0;
  plan.compliance.force_N = 1.0;
  return minutes_of(run.bench,
                    planned_s(phases_from_plan(plan), 0, run.bench.performance.approach_s));
}

// Adds one possible measurement, judged by the quantity whose interval is now widest.
class Ways {
 public:
  Ways(const FittedRun& run, const std::vector<WantedQuantity>& wanted) : run_(run) {
    const PredictedFit known = known_fit(run);
    double widest = -1.0;
    for (const WantedQuantity& one : wanted) {
      const double half_width = errors_of(one, known).half_width_95();
      if (half_width / one.tolerance <= widest) continue;
      widest = half_width / one.tolerance;
      widest_ = one;
      before_ = half_width;
    }
  }

  void add(const std::string& what, const std::string& how, const PredictedFit& after,
           double minutes) {
    const double half_width = errors_of(widest_, after).half_width_95();
    if (!(half_width < before_) || !(minutes > 0.0)) return;
    ways_.push_back({what, how, widest_.name, before_, half_width, minutes});
  }

  // The same fit with one systematic uncertainty halved.
  void add_known(const std::string& what, const std::string& how, double minutes,
                 const std::function<void(Bench&)>& improve) {
    FittedRun better = run_;
    improve(better.bench);
    add(what, how, known_fit(better), minutes);
  }

  void add_touch(const std::string& what, const TestPlan& plan) {
    const PredictedFit after = after_touch(run_, plan);
    add(what, "viscard capture", after, minutes_of(run_.bench, after.total_s));
  }

  std::vector<NextMeasurement> best_first() && {
    std::stable_sort(ways_.begin(), ways_.end(),
                     [](const NextMeasurement& a, const NextMeasurement& b) {
                       return a.gain_per_minute() > b.gain_per_minute();
                     });
    return std::move(ways_);
  }

 private:
  const FittedRun& run_;
  WantedQuantity widest_;
  double before_ = 0.0;
  std::vector<NextMeasurement> ways_;
};

void add_touches(const FittedRun& run, Ways& ways) {
  ways.add_touch("another touch as this one", run.plan);
  if (run.plan.protocol != "ramp-hold") return;
  TestPlan longer = run.plan;
  longer.hold_s *= 4.0;
  ways.add_touch("another touch with a hold of " + text_of(longer.hold_s, 3) + " s", longer);
  TestPlan shorter = run.plan;
  shorter.hold_s *= 0.25;
  shorter.recovery_s *= 0.5;
  ways.add_touch("another touch with a hold of " + text_of(shorter.hold_s, 3) + " s", shorter);
  TestPlan recovered = run.plan;
  recovered.recovery_s = std::max(20.0, 3.0 * run.plan.recovery_s);
  ways.add_touch("another touch with a recovery of " + text_of(recovered.recovery_s, 3) + " s",
                 recovered);
}

void add_better_knowledge(const FittedRun& run, Ways& ways) {
  const Bench& bench = run.bench;
  const double frame_u = 0.5 * bench.rig.frame.stiffness_relative_u;
  ways.add_known("knowing the frame's stiffness to " + text_of(100.0 * frame_u, 2) +
                     " % instead of " + text_of(200.0 * frame_u, 2) + " %",
                 "viscard calibrate --compliance", compliance_minutes(run),
                 [&](Bench& better) { better.rig.frame.stiffness_relative_u = frame_u; });
  ways.add_known("a calibration of the load cell that is twice as good", "viscard calibrate",
                 kCalibration_min, [](Bench& better) {
                   LoadCellCalibration& cell = better.rig.calibration;
                   for (double* u : {&cell.volts_per_newton_u, &cell.common_u, &cell.shape_u,
                                     &cell.curvature_u, &cell.hysteresis}) {
                     *u *= 0.5;
                   }
                 });
  const PunchContact& contact = bench.specimen.contact;
  ways.add_known("measuring the layer's thickness to " +
                     text_of(0.5e3 * contact.layer_thickness_u_m, 2) + " mm",
                 "", kGeometry_min,
                 [](Bench& better) { better.specimen.contact.layer_thickness_u_m *= 0.5; });
  ways.add_known(
      "measuring the punch's diameter to " + text_of(1e3 * contact.punch_radius_u_m, 2) + " mm", "",
      kGeometry_min, [](Bench& better) { better.specimen.contact.punch_radius_u_m *= 0.5; });
}

// A new specimen: no information of the fit is kept, because specimens differ.
void add_thicker_layer(const FittedRun& run, Ways& ways) {
  if (!(run.bench.specimen.contact.layer_thickness_m > 0.0)) return;
  Bench thicker = run.bench;
  thicker.specimen.contact.layer_thickness_m *= 2.0;
  const PredictedFit fit = predicted_fit(run.plan, thicker, guess_of(run));
  ways.add("the same test on a new specimen, a layer of " +
               text_of(1e3 * thicker.specimen.contact.layer_thickness_m, 3) + " mm",
           "viscard capture", fit, minutes_of(thicker, fit.total_s));
}

std::string numbers_of(const NextMeasurement& one) {
  return one.quantity + " from +- " + text_of(100.0 * one.before, 2) + " % to +- " +
         text_of(100.0 * one.after, 2) + " % in " + text_of(one.minutes, 2) + " min";
}

}  // namespace

void show_keys(ResultVisitor& v, const NextMeasurement& next) {
  v("what", next.what, "what to do");
  v("how", next.how, "command for it; empty: none");
  v("quantity", next.quantity, "the wanted quantity that is widest against its tolerance");
  v("half_width_95", next.before, "of its interval now, relative, with systematic parts");
  v("half_width_95_after", next.after, "of its interval afterwards");
  v("minutes", next.minutes, "at the rig");
}

PredictedFit known_fit(const FittedRun& run) {
  if (run.fit.is_stiffness) {
    throw std::invalid_argument("the fit has no geometry, so it gives stiffnesses and no moduli");
  }
  PredictedFit known;
  known.result = run.fit;
  known.series = fitted_series(run.fit);
  known.covariance = run.fit.covariance;
  known.result.gain_drift_relative = 0.0;  // the covariance contains it, so gain_drift stays empty
  const std::vector<TestPhase> phases = phases_from_plan(run.plan);
  const double force_N =
      std::max(highest_force_N(phases), force_per_modulus_and_depth_m(run.bench.specimen.contact) *
                                            run.fit.E0_Pa * deepest_m(phases));
  known.systematic_parts = systematic_parts_on(run.bench, force_N, known.series);
  return known;
}

std::vector<NextMeasurement> next_measurements(const FittedRun& run,
                                               const std::vector<WantedQuantity>& wanted) {
  if (wanted.empty()) throw std::invalid_argument("no quantity is wanted");
  Ways ways(run, wanted);
  add_touches(run, ways);
  add_better_knowledge(run, ways);
  add_thicker_layer(run, ways);
  return std::move(ways).best_first();
}

std::string text_of_next(const std::vector<NextMeasurement>& measurements) {
  if (measurements.empty())
    return "nothing that could be measured next would narrow what is wanted";
  const NextMeasurement& first = measurements.front();
  std::string text = "most for a minute at the rig gives " + first.what +
                     (first.how.empty() ? "" : " (" + first.how + ")") + ": " + numbers_of(first);
  if (measurements.size() > 1) {
    text += "; then " + measurements[1].what + ": " + numbers_of(measurements[1]);
  }
  return text;
}

}  // namespace viscard
