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
  const LoadHistory history{true,
                            {0.0, 0.5, 2.0, 4.0, 6.0, 10.0, 10.0, 15.0, 400.0},
                            {5.0, 5.0, 5.0, 6.5, 8.0, 8.0, 0.0, 0.0, 0.0}};
  const std::vector<double> strain = response(kSolid, history);
  const auto exact = [](double t, bool is_removed) {
    double value = 5.0 * creep(t);
    if (t > 2.0) value += 0.75 * summed_creep(t - 2.0);
    if (t > 6.0) value -= 0.75 * summed_creep(t - 6.0);
    if (is_removed) value -= 8.0 * creep(t - 10.0);
    return value;
  };
  for (std::size_t i = 0; i < strain.size(); ++i) {
    CAPTURE(history.time_s[i]);
    CHECK(strain[i] == Approx(exact(history.time_s[i], i >= 6)).epsilon(1e-13).margin(1e-14));
  }
}

TEST_CASE("a liquid flows under stress and keeps the flow", "[models]") {
  const LoadHistory history{true, {1.0, 4.0, 4.0, 9.0}, {2.0, 2.0, 0.0, 0.0}};
  const std::vector<double> strain = response(kLiquid, history);
  CHECK(strain[0] == Approx(1.0).epsilon(1e-14));
  CHECK(strain[1] == Approx(1.0 + 2.0 * 3.0 / 6.0).epsilon(1e-14));
  CHECK(strain[2] == Approx(1.0).epsilon(1e-14));
  CHECK(strain[3] == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("small steps of a compliant solid lose no digits", "[models][stability]") {
  // J_1 is 1e9 times J_g; at t = 1e-9 lambda its strain is that of J_g.
  const RetardationSpectrum spectrum{1e-9, {{1.0, 1.0}}, 0.0};
  const PronySeries series = relaxation_from_retardation(spectrum);
  const LoadHistory history{true, {0.0, 5e-10, 1e-9}, {1.0, 1.0, 1.0}};
  const std::vector<double> strain = response(series, history);
  CHECK(strain[1] == Approx(1e-9 - std::expm1(-5e-10)).epsilon(1e-12));
  CHECK(strain[2] == Approx(1e-9 - std::expm1(-1e-9)).epsilon(1e-12));
}

TEST_CASE("more corners do not change the response", "[models][identity]") {
  for (const bool is_stress : {false, true}) {
    const LoadHistory coarse{is_stress, {0.0, 1.0, 1.0, 3.0, 8.0}, {0.0, 2.0, 3.0, 3.0, -1.0}};
    const LoadHistory fine = with_corners_at(coarse, {7.9, -1.0, 0.25, 1.0, 2.0, 2.0, 12.0, 1e-9});
    CHECK(fine.time_s == std::vector<double>{0.0, 1e-9, 0.25, 1.0, 1.0, 2.0, 3.0, 7.9, 8.0, 12.0});
    CHECK(fine.value.back() == -1.0);
    const std::vector<double> a = response(kSolid, coarse), b = response(kSolid, fine);
    CHECK(b[3] == Approx(a[1]).epsilon(1e-13));
    CHECK(b[4] == Approx(a[2]).epsilon(1e-13));
    CHECK(b[6] == Approx(a[3]).epsilon(1e-13));
    CHECK(b[8] == Approx(a[4]).epsilon(1e-13));
  }
}

TEST_CASE("steps become ramps, jumps and holds with corners in log time", "[models]") {
  const LoadHistory history =
      history_of_steps(false, {{0.0, 0.1}, {100.0, 0.1}, {2.0, 0.0}, {50.0, 0.0}}, 0.1, 4);
  REQUIRE(history.time_s.size() == 1 + 1 + 4 + 4 + 4);
  CHECK(history.time_s[1] == 0.0);  // a jump
  CHECK(history.value[1] == 0.1);
  CHECK(history.time_s[2] == Approx(0.1));
  CHECK(history.time_s[3] == Approx(1.0));
  CHECK(history.time_s[5] == 100.0);
  CHECK(history.time_s[6] == 100.5);
  CHECK(history.value[6] == Approx(0.075));
  CHECK(history.time_s[9] == 102.0);
  CHECK(history.time_s[10] == Approx(102.1));
  CHECK(history.time_s.back() == 152.0);
  CHECK(history.value.back() == 0.0);
}

TEST_CASE("a time is outside the window if fast or old changes matter there", "[models]") {
  const LoadHistory step{false, {0.0, 0.05, 0.1, 1.0, 10.0, 10.1}, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
  CHECK(is_within_window(step, 0.1, 10.0) ==
        std::vector<bool>{false, false, true, true, true, false});
  // After the removal at 5 the short times count again; loading stays older than 10 after t = 10.
  const LoadHistory recovery{
      true, {0.0, 4.9, 5.0, 5.0, 5.05, 5.2, 9.9, 11.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
  CHECK(is_within_window(recovery, 0.1, 10.0) ==
        std::vector<bool>{false, true, true, false, false, true, true, false});
  // Cycles within t_min return to the same strain, and are still outside.
  LoadHistory cycles;
  for (int i = 0; i <= 40; ++i) {
    cycles.time_s.push_back(0.025 * i);
    cycles.value.push_back(i % 4 < 2 ? 0.0 : 1.0);
  }
  const std::vector<bool> is_inside = is_within_window(cycles, 0.1, 10.0);
  for (std::size_t i = 3; i < is_inside.size(); ++i) CHECK_FALSE(is_inside[i]);
  // A slow ramp changes little within t_min. Loading begins when it reaches a twentieth.
  const LoadHistory ramp{
      false, {0.0, 4.0, 14.0, 15.5, 16.5, 80.0}, {0.0, 0.05, 0.175, 0.19, 0.2, 1.0}};
  CHECK(is_within_window(ramp, 0.5, 12.0) ==
        std::vector<bool>{true, true, true, true, false, false});
  // Without a lower end of the window nothing is too fast.
  CHECK(is_within_window(step, 0.0, 10.0).front());
}

TEST_CASE("a history that is none is refused with the reason", "[models]") {
  CHECK_THROWS_WITH(response(kSolid, {}), Catch::Contains("at least one corner"));
  CHECK_THROWS_WITH(response(kSolid, {false, {1.0, 0.5}, {0.0, 0.0}}),
                    Catch::Contains("backwards from 1 s to 0.5 s"));
  CHECK_THROWS_WITH(response(kSolid, {false, {1.0, NAN}, {0.0, 0.0}}),
                    Catch::Contains("corner 2") && Catch::Contains("not finite"));
  CHECK_THROWS_AS(history_of_steps(false, {{-1.0, 1.0}}, 0.1, 5), std::invalid_argument);
}
