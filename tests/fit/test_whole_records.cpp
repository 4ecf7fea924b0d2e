#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "models/material/hereditary.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// Force of a flat punch that cannot pull: contact ends where the stress would be negative, and the
// depth of the free surface is found by bisection so that its stress is zero.
class PressedSurface {
 public:
  explicit PressedSurface(const PronySeries& series) : stress_(series) {}
  double force(double dt_s, double punch_m) {
    HereditaryStress trial = stress_;
    if (trial.advance(dt_s, punch_m) >= 0.0) {
      stress_ = trial;
      return stress_.stress_Pa();
    }
    double low = punch_m, high = stress_.strain() + 1e-9;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      trial = stress_;
      (trial.advance(dt_s, middle) < 0.0 ? low : high) = middle;
    }
    stress_.advance(dt_s, high);
    return 0.0;
  }

 private:
  HereditaryStress stress_;
};

// The course of the punch between (time, depth) points; depth counts from the surface.
using Points = std::vector<std::pair<double, double>>;
double depth_at(const Points& points, double t) {
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].first < t) ++i;
  const auto [t0, d0] = points[i - 1];
  const auto [t1, d1] = points[i];
  return d0 + (d1 - d0) * std::clamp((t - t0) / (t1 - t0), 0.0, 1.0);
}

// Computed with a tenth of the step of the samples; the noise is relative to the largest force.
IndentationData record_of(const Points& points, double step_s, double relative_noise,
                          double surface_m = 0.0) {
  constexpr int kFine = 10;
  IndentationData data;
  PressedSurface surface(s2());
  const double end_s = points.back().first;
  for (int i = 0; i * step_s <= end_s; ++i) {
    double force = 0.0;
    for (int f = i == 0 ? kFine : 1; f <= kFine; ++f) {
      const double t = step_s * (i - 1 + static_cast<double>(f) / kFine);
      force = surface.force(step_s / kFine, std::max(-1.0, depth_at(points, t)));
    }
    data.time_s.push_back(i * step_s);
    data.force_N.push_back(force);
    data.depth_m.push_back(depth_at(points, i * step_s) + surface_m);
  }
  std::mt19937_64 dice(11);
  std::normal_distribution<double> normal;
  const double peak_N = *std::max_element(data.force_N.begin(), data.force_N.end());
  for (double& force : data.force_N) force += relative_noise * peak_N * normal(dice);
  return data;
}

std::size_t count_of(const FitResult& fit, const std::string& reason) {
  for (const LeftOutRows& left : fit.left_out) {
    if (left.reason == reason) return left.count;
  }
  return 0;
}

void check_truth(const FitResult& fit) {
  INFO("E0 " << fit.E0_Pa << " in " << fit.E0_interval_95.low << " to " << fit.E0_interval_95.high
             << ", E_inf " << fit.E_inf_Pa << " in " << fit.E_inf_interval_95.low << " to "
             << fit.E_inf_interval_95.high);
  CHECK(fit.E0_Pa == Approx(1.8).epsilon(5e-3));
  CHECK(fit.E_inf_Pa == Approx(1.6).epsilon(5e-3));
  CHECK_FALSE(has_flag(fit, "misfit"));
  CHECK(fit.is_trustworthy);
}

const Points kApproachHoldRetract{
    {0.0, -3e-5}, {1.3, 1e-4}, {40.0, 1e-4}, {41.3, -3e-5}, {60.0, -3e-5}};

}  // namespace

TEST_CASE("one row of depth zero does not end the record", "[fit]") {
  IndentationData data = indentation_of(s2(), even_times(60.0, 0.02), ramp_and_hold(1.0), 1e-3, 31);
  const FitResult whole = fit_indentation(data);
  data.depth_m[600] = 0.0;
  const FitResult fit = fit_indentation(data);
  CHECK(fit.n_samples == 3000);
  CHECK(fit.n_left_out == 1);
  CHECK(count_of(fit, "depth_spike") == 1);
  CHECK(fit.E0_Pa == Approx(whole.E0_Pa).epsilon(1e-3));
  CHECK(fit.is_trustworthy);
  CHECK_FALSE(has_flag(fit, "rows-left-out"));
}

TEST_CASE("rows left out are counted by reason, warned of above 1 % and a defect above 20 %",
          "[fit]") {
  const auto with_gaps = [](int every) {
    RelaxationData data = relaxation_of(s2(), 400, 1000.0, 0.001, 1);
    for (std::size_t i = 10; i < data.value.size(); i += static_cast<std::size_t>(every)) {
      data.value[i] = std::numeric_limits<double>::quiet_NaN();
    }
    return fit_relaxation(data);
  };
  const FitResult few = with_gaps(200), some = with_gaps(20), many = with_gaps(3);
  for (const FitResult* fit : {&few, &some, &many}) {
    CHECK(fit->n_samples + fit->n_left_out == 400);
    CHECK(count_of(*fit, "not_a_number") == fit->n_left_out);
  }
  CHECK_FALSE(has_flag(few, "rows-left-out"));
  CHECK(has_flag(some, "rows-left-out"));
  CHECK(some.is_trustworthy);
  CHECK(has_flag(many, "rows-lost"));
  CHECK_FALSE(many.is_trustworthy);
}

TEST_CASE("approach, hold and retract are fitted as one record", "[fit]") {
  const double surface_m = GENERATE(0.0, 2e-4);
  const IndentationData data = record_of(kApproachHoldRetract, 0.02, 1e-3, surface_m);
  const FitResult fit = fit_indentation(data, {.n_terms = 2});
  CHECK(fit.n_samples == data.time_s.size());
  CHECK(fit.n_left_out == 0);
  CHECK(fit.n_contacts == 1);
  check_truth(fit);
  REQUIRE(fit.contact_position_m);
  CHECK(*fit.contact_position_m == Approx(surface_m).margin(2e-7));
}

TEST_CASE("readings out of contact allow a drift, and kNone still forbids it", "[fit]") {
  const IndentationData data = record_of(kApproachHoldRetract, 0.02, 1e-3);
  FitOptions options{.n_terms = 2};
  const FitResult fit = fit_indentation(data, options);
  CHECK(fit.drift);
  const auto note = std::find_if(fit.flags.begin(), fit.flags.end(), [](const MaterialFlag& flag) {
    return flag.name == "drift-fitted";
  });
  REQUIRE(note != fit.flags.end());
  CHECK(note->text.find("readings out of contact") != std::string::npos);
  CHECK(note->text.find("structure") == std::string::npos);
  options.drift = TableDrift::kNone;
  const FitResult none = fit_indentation(data, options);
  CHECK_FALSE(none.drift);
  CHECK_FALSE(has_flag(none, "drift-fitted"));
  check_truth(none);
}

TEST_CASE("contact that is lost and made again is found each time", "[fit]") {
  // Three cycles into the air, then two steps with holds, then a hold at half the depth.
  Points points{{0.0, -3e-5}};
  for (int cycle = 0; cycle < 3; ++cycle) {
    const double t = points.back().first;
    points.insert(points.end(), {{t + 1.5, 8e-5}, {t + 3.0, -3e-5}, {t + 3.4, -3e-5}});
  }
  const double t = points.back().first;
  points.insert(points.end(), {{t + 1.0, 5e-5},
                               {t + 20.0, 5e-5},
                               {t + 21.0, 1e-4},
                               {t + 60.0, 1e-4},
                               {t + 61.0, 5e-5},
                               {t + 100.0, 5e-5}});
  const IndentationData data = record_of(points, 0.01, 1e-3, 1e-4);
  const FitResult fit = fit_indentation(data);
  CHECK(fit.n_samples == data.time_s.size());
  CHECK(fit.n_contacts == 4);
  check_truth(fit);
  REQUIRE(fit.terms.size() == 2);
  CHECK(holds(fit.terms[1].tau_s_95, 40.0));
  // The order of the first contact, in which the slow term does not show, has no influence.
  const FitResult two = fit_indentation(data, {.n_terms = 2});
  CHECK(fit.rss == Approx(two.rss).epsilon(1e-6));
}

TEST_CASE("rows in tension are left out and counted", "[fit]") {
  IndentationData data = record_of(kApproachHoldRetract, 0.02, 1e-3);
  std::size_t n_pulled = 0;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < 41.05 || data.time_s[i] > 41.3) continue;
    data.force_N[i] -= 0.3 * 1.8e-4;
    ++n_pulled;
  }
  const FitResult fit = fit_indentation(data, {.n_terms = 2});
  CHECK(count_of(fit, "adhesion") + count_of(fit, "spike") >= n_pulled - 2);
  CHECK(fit.n_samples + fit.n_left_out == data.time_s.size());
  CHECK(fit.E0_Pa == Approx(1.8).epsilon(0.01));
}

TEST_CASE("the unloading of a sphere is left out, counted, and a defect if it is much", "[fit]") {
  const Points long_retract{{0.0, -3e-5}, {1.3, 1e-4}, {40.0, 1e-4}, {60.0, -3e-5}};
  for (const auto& [points, is_much] :
       {std::pair{kApproachHoldRetract, true}, std::pair{long_retract, true},
        std::pair{Points{{0.0, -3e-5}, {1.3, 1e-4}, {40.0, 1e-4}, {41.3, -3e-5}}, false}}) {
    IndentationData data = record_of(points, 0.02, 1e-3);
    data.contact = PunchContact{.punch_radius_m = 1e-3, .shape = TipShape::kSphere};
    const FitResult fit = fit_indentation(data, {.n_terms = 1});
    CHECK(count_of(fit, "unloading") == fit.n_left_out);
    CHECK(fit.n_samples + fit.n_left_out == data.time_s.size());
    CHECK(has_flag(fit, "rows-lost") == is_much);
    CHECK(has_flag(fit, "rows-left-out") != is_much);
  }
}

TEST_CASE("holds between several ramps do not count as ramp", "[fit]") {
  const Points levels{{0.0, 0.0}, {1.0, 5e-5}, {100.0, 5e-5}, {101.0, 1e-4}, {200.0, 1e-4}};
  const FitResult fit = fit_indentation(record_of(levels, 0.1, 1e-3));
  CHECK_FALSE(has_flag(fit, "tau-below-ramp"));  // the times are 0.8 and 40 s
  CHECK(fit.fastest_s == Approx(2.0).epsilon(0.1));
}

TEST_CASE("an earlier touch in a table, or in the rows before it, counts as history", "[fit]") {
  // From so far that the punch goes back by less than a fifth of its way.
  const Points touched{{0.0, -3e-4}, {0.5, 4e-5}, {1.9, 4e-5}, {2.0, -2e-5},
                       {3.0, -2e-5}, {4.0, 1e-4}, {60.0, 1e-4}};
  IndentationData data = record_of(touched, 0.02, 1e-6);
  const bool stands_before = GENERATE(false, true);
  if (stands_before) {
    constexpr std::ptrdiff_t kBefore = 120;  // 2.4 s
    const auto divide = [](std::vector<double>& from, std::vector<double>& to) {
      to.assign(from.begin(), from.begin() + kBefore);
      from.erase(from.begin(), from.begin() + kBefore);
    };
    divide(data.time_s, data.before.time_s);
    divide(data.force_N, data.before.force_N);
    divide(data.depth_m, data.before.depth_m);
  }
  const FitResult fit = fit_indentation(data, {.n_terms = 2});
  CAPTURE(stands_before, fit.E0_Pa, fit.E_inf_Pa);
  CHECK((count_of(fit, "earlier_touch") > 0) == !stands_before);
  CHECK_FALSE(has_flag(fit, "rows-left-out"));
  CHECK(fit.n_contacts == 1);
  REQUIRE(fit.terms.size() == 2);
  CHECK(fit.terms[0].g == Approx(0.12 / 1.8).margin(1e-4));
  CHECK(fit.terms[1].g == Approx(0.08 / 1.8).margin(1e-4));
  CHECK(fit.E0_Pa == Approx(1.8).epsilon(2e-4));
  // Forgotten, the touch makes g too small.
  data.before = {};
  if (!stands_before) return;
  const FitResult forgotten = fit_indentation(data, {.n_terms = 2});
  REQUIRE(forgotten.terms.size() == 2);
  CHECK(forgotten.terms[0].g < fit.terms[0].g - 5e-4);
}
