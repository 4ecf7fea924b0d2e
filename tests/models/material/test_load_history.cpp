#include "models/material/load_history.h"
#include "models/material/retardation_spectrum.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

using namespace viscard;

namespace {

// Standard linear solid: E_inf 1, E_1 2, tau 3, so J_g = 1/3, J_inf = 1, lambda = 9.
const PronySeries kSolid{1.0, {{2.0, 3.0}}};
// Maxwell liquid: modulus 2, viscosity 6.
const PronySeries kLiquid{0.0, {{2.0, 3.0}}};

double creep(double t) {
  return 1.0 / 3.0 + 2.0 / 3.0 * -std::expm1(-t / 9.0);
}
// int_0^t J
double summed_creep(double t) {
  return t - 2.0 / 3.0 * 9.0 * -std::expm1(-t / 9.0);
}

}  // namespace

TEST_CASE("strain after a step, a ramp and a removal of stress is the closed form", "[models]") {
  // Step to 5 at 0, ramp to 8 from 2 to 6, jump to 0 at 10.
  const Course history{{0.0, 5.0},  {0.5, 5.0},  {2.0, 5.0},  {4.0, 6.5},  {6.0, 8.0},
                       {10.0, 8.0}, {10.0, 0.0}, {15.0, 0.0}, {400.0, 0.0}};
  const std::vector<double> strain = response(kSolid, history, true);
  const auto exact = [](double t, bool is_removed) {
    double value = 5.0 * creep(t);
    if (t > 2.0) value += 0.75 * summed_creep(t - 2.0);
    if (t > 6.0) value -= 0.75 * summed_creep(t - 6.0);
    if (is_removed) value -= 8.0 * creep(t - 10.0);
    return value;
  };
  for (std::size_t i = 0; i < strain.size(); ++i) {
    CAPTURE(history[i].time_s);
    CHECK(strain[i] == Approx(exact(history[i].time_s, i >= 6)).epsilon(1e-13).margin(1e-14));
  }
}

TEST_CASE("a liquid flows under stress and keeps the flow", "[models]") {
  const Course history{{1.0, 2.0}, {4.0, 2.0}, {4.0, 0.0}, {9.0, 0.0}};
  const std::vector<double> strain = response(kLiquid, history, true);
  CHECK(strain[0] == Approx(1.0).epsilon(1e-14));
  CHECK(strain[1] == Approx(1.0 + 2.0 * 3.0 / 6.0).epsilon(1e-14));
  CHECK(strain[2] == Approx(1.0).epsilon(1e-14));
  CHECK(strain[3] == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("small steps of a compliant solid lose no digits", "[models][stability]") {
  // J_1 is 1e9 times J_g; at t = 1e-9 lambda its strain is that of J_g.
  const RetardationSpectrum spectrum{1e-9, {{1.0, 1.0}}, 0.0};
  const PronySeries series = relaxation_from_retardation(spectrum);
  const Course history{{0.0, 1.0}, {5e-10, 1.0}, {1e-9, 1.0}};
  const std::vector<double> strain = response(series, history, true);
  CHECK(strain[1] == Approx(1e-9 - std::expm1(-5e-10)).epsilon(1e-12));
  CHECK(strain[2] == Approx(1e-9 - std::expm1(-1e-9)).epsilon(1e-12));
}

TEST_CASE("a course is zero before its first point, and jumps where two points have one time",
          "[models]") {
  const Course course{{1.0, 4.0}, {3.0, 8.0}, {3.0, -2.0}, {5.0, 0.0}};
  CHECK(value_at(course, 0.5) == 0.0);
  CHECK(value_at(course, 1.0, /*after=*/false) == 0.0);
  CHECK(value_at(course, 1.0) == 4.0);
  CHECK(value_at(course, 2.0) == 6.0);
  CHECK(value_at(course, 3.0, /*after=*/false) == 8.0);
  CHECK(value_at(course, 3.0) == -2.0);
  CHECK(value_at(course, 4.0) == -1.0);
  CHECK(value_at(course, 9.0) == 0.0);
  CHECK(largest_size(course) == 8.0);
  CHECK(value_at(Course(), 1.0) == 0.0);
}

TEST_CASE("more corners do not change the response", "[models][identity]") {
  for (const bool is_stress : {false, true}) {
    const Course coarse{{0.0, 0.0}, {1.0, 2.0}, {1.0, 3.0}, {3.0, 3.0}, {8.0, -1.0}};
    const Course fine = with_corners_at(coarse, {7.9, -1.0, 0.25, 1.0, 2.0, 2.0, 12.0, 1e-9});
    std::vector<double> time_s;
    for (const CoursePoint& corner : fine) time_s.push_back(corner.time_s);
    CHECK(time_s == std::vector<double>{0.0, 1e-9, 0.25, 1.0, 1.0, 2.0, 3.0, 7.9, 8.0, 12.0});
    CHECK(fine.back().value == -1.0);
    const std::vector<double> a = response(kSolid, coarse, is_stress),
                              b = response(kSolid, fine, is_stress);
    CHECK(b[3] == Approx(a[1]).epsilon(1e-13));
    CHECK(b[4] == Approx(a[2]).epsilon(1e-13));
    CHECK(b[6] == Approx(a[3]).epsilon(1e-13));
    CHECK(b[8] == Approx(a[4]).epsilon(1e-13));
  }
}

TEST_CASE("steps become ramps, jumps and holds with corners in log time", "[models]") {
  const Course history =
      course_of_steps({{0.0, 0.1}, {100.0, 0.1}, {2.0, 0.0}, {50.0, 0.0}}, 0.1, 4);
  REQUIRE(history.size() == 1 + 1 + 4 + 4 + 4);
  CHECK(history[1].time_s == 0.0);  // a jump
  CHECK(history[1].value == 0.1);
  CHECK(history[2].time_s == Approx(0.1));
  CHECK(history[3].time_s == Approx(1.0));
  CHECK(history[5].time_s == 100.0);
  CHECK(history[6].time_s == 100.5);
  CHECK(history[6].value == Approx(0.075));
  CHECK(history[9].time_s == 102.0);
  CHECK(history[10].time_s == Approx(102.1));
  CHECK(history.back().time_s == 152.0);
  CHECK(history.back().value == 0.0);
}

TEST_CASE("a time is outside the window if fast or old changes matter there", "[models]") {
  const Course step{{0.0, 1.0}, {0.05, 1.0}, {0.1, 1.0}, {1.0, 1.0}, {10.0, 1.0}, {10.1, 1.0}};
  CHECK(is_within_window(step, 0.1, 10.0) ==
        std::vector<bool>{false, false, true, true, true, false});
  // After the removal at 5 the short times count again; loading stays older than 10 after t = 10.
  const Course recovery{{0.0, 1.0},  {4.9, 1.0}, {5.0, 1.0}, {5.0, 0.0},
                        {5.05, 0.0}, {5.2, 0.0}, {9.9, 0.0}, {11.0, 0.0}};
  CHECK(is_within_window(recovery, 0.1, 10.0) ==
        std::vector<bool>{false, true, true, false, false, true, true, false});
  // Cycles within t_min return to the same strain, and are still outside.
  Course cycles;
  for (int i = 0; i <= 40; ++i) cycles.push_back({0.025 * i, i % 4 < 2 ? 0.0 : 1.0});
  const std::vector<bool> is_inside = is_within_window(cycles, 0.1, 10.0);
  for (std::size_t i = 3; i < is_inside.size(); ++i) CHECK_FALSE(is_inside[i]);
  // A slow ramp changes little within t_min. Loading begins when it reaches a twentieth.
  const Course ramp{{0.0, 0.0}, {4.0, 0.05}, {14.0, 0.175}, {15.5, 0.19}, {16.5, 0.2}, {80.0, 1.0}};
  CHECK(is_within_window(ramp, 0.5, 12.0) ==
        std::vector<bool>{true, true, true, true, false, false});
  // Without a lower end of the window nothing is too fast.
  CHECK(is_within_window(step, 0.0, 10.0).front());
}

TEST_CASE("a history that is none is refused with the reason", "[models]") {
  CHECK_THROWS_WITH(response(kSolid, {}, false), Catch::Contains("at least one corner"));
  CHECK_THROWS_WITH(response(kSolid, {{1.0, 0.0}, {0.5, 0.0}}, false),
                    Catch::Contains("backwards from 1 s to 0.5 s"));
  CHECK_THROWS_WITH(response(kSolid, {{1.0, 0.0}, {NAN, 0.0}}, false),
                    Catch::Contains("corner 2") && Catch::Contains("not finite"));
  CHECK_THROWS_AS(course_of_steps({{-1.0, 1.0}}, 0.1, 5), std::invalid_argument);
}
