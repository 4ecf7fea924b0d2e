// Waves in the pillar, whole scenes: against d'Alembert's solution, statics, and the damping of the
// material.
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/modal_response.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kModulus_Pa = 1.8e6;
constexpr double kLength_m = 120e-6;
constexpr double kPressure_Pa = 1e3;
const double kSpeed_m_s = std::sqrt(kModulus_Pa / 965.0);

PillarScene rod_scene(double nu, double end_s) {
  PillarScene scene;
  scene.drive = TransientDrive{};
  scene.pillar.E0_Pa = kModulus_Pa;
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.tolerance = 1e-2;
  test::as<TransientDrive>(scene).end_time_s = end_s;
  test::as<TransientDrive>(scene).outputs = 400;
  return scene;
}

double largest(const std::vector<double>& values) {
  double out = 0.0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

// The free end of a rod under pressure f(t) from rest, F = int f: waves run down, turn at the foot
// and, with their sign, at the top: u = -(c/E) [F(t) - 2 F(t - T) + 2 F(t - 2T) - ...], T = 2 L/c.
// d'Alembert (1747); Graff, Wave Motion in Elastic Solids (1975), 2.2.
double free_end_m(const std::function<double(double)>& F, double time_s) {
  const double turn_s = 2.0 * kLength_m / kSpeed_m_s;
  double sum = F(time_s);
  double factor = -2.0;
  for (int k = 1; k * turn_s < time_s; ++k, factor = -factor)
    sum += factor * F(time_s - k * turn_s);
  return -kSpeed_m_s / kModulus_Pa * sum;
}

// Largest difference from d'Alembert, over the peak.
double wave_error(const SceneAnswer& answer, const std::function<double(double)>& F) {
  const SceneCurve& u = curve_of(answer, "top_displacement");
  double worst = 0.0;
  for (std::size_t i = 0; i < u.x.size(); ++i) {
    worst = std::max(worst, std::abs(u.value[i] - free_end_m(F, u.x[i])));
  }
  return worst / largest(u.value);
}

}  // namespace

TEST_CASE("a sudden pressure moves the rod's end in a wave of twice the static displacement",
          "[pillar]") {
  PillarScene scene = rod_scene(0.0, 3e-5);
  test::as<TransientDrive>(scene).history = {{0.0, kPressure_Pa}, {1.0, kPressure_Pa}};
  const SceneAnswer answer = simulate_pillar(scene);
  const auto F = [](double t) { return kPressure_Pa * t; };
  CHECK(wave_error(answer, F) <= scene.tolerance);
  CHECK(answer.largest_relative_error <= scene.tolerance);
  // Dynamic factor 2, first at half the period 4 L/c = 1.111396e-5 s.
  const double static_m = kPressure_Pa * kLength_m / kModulus_Pa;
  CHECK(value_of(answer, "top_displacement_peak") == Approx(-2.0 * static_m).epsilon(1e-2));
  const SceneCurve& u = curve_of(answer, "top_displacement");
  const auto at = static_cast<std::size_t>(std::lround(1.111396e-5 / (u.x[1] - u.x[0])));
  CHECK(std::abs(u.value[at]) <= 0.02 * 2.0 * static_m);  // back where it began
}

TEST_CASE("a pulse runs up and down the rod by d'Alembert's solution", "[pillar]") {
  const double duration_s = 3e-6;
  const double pi = std::numbers::pi;
  PillarScene scene = rod_scene(0.0, 4e-5);
  scene.tolerance = GENERATE(1e-2, 3e-3);
  for (int i = 0; i <= 256; ++i) {
    test::as<TransientDrive>(scene).history.push_back(
        {duration_s * i / 256, kPressure_Pa * std::sin(pi * i / 256)});
  }
  test::as<TransientDrive>(scene).history.back().value = 0.0;
  const SceneAnswer answer = simulate_pillar(scene);
  const auto F = [&](double t) {
    const double s = std::clamp(t / duration_s, 0.0, 1.0);
    return kPressure_Pa * duration_s / pi * (1.0 - std::cos(pi * s));
  };
  CAPTURE(scene.tolerance, answer.unknowns);
  CHECK(wave_error(answer, F) <= scene.tolerance);
}

TEST_CASE("a peak is that of the motion, not of the outputs", "[pillar]") {
  // A ramp leaves the rod swinging; few outputs fall on no crest.
  PillarScene scene = rod_scene(0.0, 3e-5);
  const double ramp_s = 3e-6;
  test::as<TransientDrive>(scene).history = {
      {0.0, 0.0}, {ramp_s, kPressure_Pa}, {1.0, kPressure_Pa}};
  test::as<TransientDrive>(scene).outputs = GENERATE(11, 23, 60);
  const auto F = [&](double t) {
    return kPressure_Pa * (t < ramp_s ? 0.5 * t * t / ramp_s : t - 0.5 * ramp_s);
  };
  double crest_m = 0.0;
  for (int i = 0; i <= 100000; ++i) crest_m = std::min(crest_m, free_end_m(F, 3e-10 * i));
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneResult& peak = result_of(answer, "top_displacement_peak");
  CAPTURE(test::as<TransientDrive>(scene).outputs, crest_m);
  CHECK(std::abs(peak.value - crest_m) <= peak.error_estimate);
  CHECK(peak.error_estimate <= scene.tolerance * std::abs(crest_m));
  const SceneCurve& u = curve_of(answer, "top_displacement");
  CHECK(u.x.size() == static_cast<std::size_t>(test::as<TransientDrive>(scene).outputs) + 1);
  if (u.x.size() == 12) CHECK(largest(u.value) < 0.98 * std::abs(crest_m));
}

TEST_CASE("a slow load gives the static answer", "[pillar]") {
  // Over a hundred periods of the lowest mode; what still rings is T/(pi ramp) of the static value.
  PillarScene scene = rod_scene(0.33, 2.2e-3);
  test::as<TransientDrive>(scene).history = {
      {0.0, 0.0}, {1.1e-3, kPressure_Pa}, {2.2e-3, kPressure_Pa}};
  const double moving_m = value_of(simulate_pillar(scene), "top_displacement_end");
  const double static_m = -659.692e-9 * kPressure_Pa / 1e4;  // converged
  const double ringing = 1.1e-5 / (std::numbers::pi * 1.1e-3);
  CHECK(moving_m == Approx(static_m).epsilon(ringing + 1e-3));
}

TEST_CASE("slow motion of a viscoelastic pillar is its creep", "[pillar]") {
  PillarScene scene = rod_scene(0.33, 0.02);
  scene.pillar.terms = {{0.3, 0.3, 2e-3}, {0.2, 0.2, 1e-2}};
  test::as<TransientDrive>(scene).history = {
      {0.0, 0.0}, {2e-3, kPressure_Pa}, {0.02, kPressure_Pa}};
  const double moving_m = value_of(simulate_pillar(scene), "top_displacement_end");
  scene.drive = CreepDrive{test::as<TransientDrive>(scene).history};
  const double creeping_m = value_of(simulate_pillar(scene), "top_displacement_end");
  CHECK(std::abs(creeping_m) > 1.2 * 65.97e-9);  // it has crept by then
  CHECK(moving_m == Approx(creeping_m).epsilon(3e-3));
}

TEST_CASE("ringing decays by half the loss tangent and never grows", "[pillar]") {
  PillarScene scene = rod_scene(0.0, 2e-4);
  test::as<TransientDrive>(scene).outputs = 4000;
  const double g = 0.05;
  const double tau_s = 1.77e-6;  // near the resonance
  scene.pillar.terms = {{g, g, tau_s}};
  const double pi = std::numbers::pi;
  for (int i = 0; i <= 64; ++i) {
    test::as<TransientDrive>(scene).history.push_back(
        {1.1e-5 * i / 64, kPressure_Pa * std::sin(pi * i / 64)});
  }
  test::as<TransientDrive>(scene).history.back().value = 0.0;
  const SceneAnswer answer = simulate_pillar(scene);
  const SceneCurve& u = curve_of(answer, "top_displacement");
  std::vector<double> peaks;  // of each period
  const double period_s = 4.0 * kLength_m / kSpeed_m_s;
  for (int n = 1; n < 17; ++n) {
    double peak = 0.0;
    for (std::size_t i = 0; i < u.x.size(); ++i) {
      if (u.x[i] > n * period_s && u.x[i] < (n + 1) * period_s) {
        peak = std::max(peak, std::abs(u.value[i]));
      }
    }
    peaks.push_back(peak);
  }
  for (std::size_t n = 1; n < peaks.size(); ++n) CHECK(peaks[n] < peaks[n - 1]);
  const double omega = 2.0 * pi / period_s;
  const double x2 = omega * tau_s * omega * tau_s;
  const double loss = g * omega * tau_s / (1.0 + x2);
  const double storage = 1.0 - g / (1.0 + x2);
  const double decrement = std::log(peaks[4] / peaks[14]) / 10.0;
  CHECK(decrement == Approx(pi * loss / storage).epsilon(0.02));  // higher modes still fade
}

TEST_CASE("one relaxing mode: closed form, Runge-Kutta and extremes", "[pillar][stability]") {
  SECTION("without relaxation a step makes 1 - cos") {
    RelaxingMode mode(3.0, {});
    for (int i = 0; i < 5; ++i) mode.advance(0.3, 1.0, 1.0);
    CHECK(mode.displacement() == Approx((1.0 - std::cos(4.5)) / 9.0).epsilon(1e-13));
  }
  SECTION("with one term it is the solution of its differential equation") {
    // u'' + 0.5 u + 0.5 d = f, d' = u' - d/0.7, f a ramp from 1 to 3 over 2 s.
    RelaxingMode mode(1.0, {{0.5, 0.5, 0.7}});
    mode.advance(0.5, 1.0, 1.5);
    mode.advance(1.5, 1.5, 3.0);
    double u = 0.0, v = 0.0, d = 0.0;
    const int n = 4000;
    const double h = 2.0 / n;
    for (int i = 0; i < n; ++i) {
      const auto rate = [](double a, double b, double c, double t) {
        return std::array{b, 1.0 + t - 0.5 * a - 0.5 * c, b - c / 0.7};
      };
      const double t = i * h;
      const auto k1 = rate(u, v, d, t);
      const auto k2 = rate(u + h / 2 * k1[0], v + h / 2 * k1[1], d + h / 2 * k1[2], t + h / 2);
      const auto k3 = rate(u + h / 2 * k2[0], v + h / 2 * k2[1], d + h / 2 * k2[2], t + h / 2);
      const auto k4 = rate(u + h * k3[0], v + h * k3[1], d + h * k3[2], t + h);
      u += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]);
      v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]);
      d += h / 6 * (k1[2] + 2 * k2[2] + 2 * k3[2] + k4[2]);
    }
    CHECK(mode.displacement() == Approx(u).epsilon(1e-10));  // of the Runge-Kutta steps
  }
  SECTION("thirty terms over twenty decades start and end where they must") {
    std::vector<MaterialTerm> terms;
    for (int i = 0; i < 30; ++i) {
      const double g = 0.9 / 30.0;
      terms.push_back({g, g, std::pow(10.0, -10.0 + 20.0 * i / 29.0)});
    }
    RelaxingMode mode(1e3, terms);
    REQUIRE(mode.roots_1_s().size() == 31);
    for (const auto& root : mode.roots_1_s()) CHECK(root.real() < 0.0);
    mode.advance(1e-9, 1.0, 1.0);
    CHECK(mode.displacement() == Approx(0.5e-18).epsilon(1e-3));  // f t^2/2: mass alone
    mode.advance(1e14, 1.0, 1.0);
    CHECK(mode.displacement() == Approx(1e-6 / 0.1).epsilon(1e-6));  // E_inf = 0.1
  }
}

// What refuses a scene, or nothing.
std::string refusal_of(const PillarScene& scene) {
  try {
    simulate_pillar(scene);
  } catch (const std::exception& refused) {
    return refused.what();
  }
  return {};
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + words.size()));
}

// A step of load at a tolerance it is refused for, then as the refusal says.
void check_advice(LoadDirection direction, double tolerance) {
  PillarScene scene = rod_scene(0.33, 1e-4);
  test::as<TransientDrive>(scene).direction = direction;
  test::as<TransientDrive>(scene).history = {{0.0, kPressure_Pa}, {1e-4, kPressure_Pa}};
  scene.tolerance = tolerance;
  const std::string refusal = refusal_of(scene);
  CAPTURE(tolerance, refusal);
  REQUIRE_THAT(refusal, Catch::Contains("the load jumps"));
  const double rise_s = number_after(refusal, "Let each jump take ");
  PillarScene slower = scene;
  test::as<TransientDrive>(slower).history = {
      {0.0, 0.0}, {rise_s, kPressure_Pa}, {1e-4, kPressure_Pa}};
  CHECK(simulate_pillar(slower).largest_relative_error <= tolerance);
  scene.tolerance = number_after(refusal, "ask for a tolerance of ");
  CHECK(simulate_pillar(scene).largest_relative_error <= scene.tolerance);
}

TEST_CASE("a jump too sharp for the tolerance is refused with a rise time and tolerance that work",
          "[pillar]") {
  check_advice(LoadDirection::kLateral, 3e-3);
  check_advice(LoadDirection::kLateral, 3e-4);
}

TEST_CASE("a ramp too steep for the tolerance is refused with a longer rise time that works",
          "[pillar]") {
  PillarScene scene = rod_scene(0.33, 1e-4);
  test::as<TransientDrive>(scene).direction = LoadDirection::kLateral;
  scene.tolerance = 1e-3;
  const double rise_s = 2e-7;
  test::as<TransientDrive>(scene).history = {
      {0.0, 0.0}, {rise_s, kPressure_Pa}, {1e-4, kPressure_Pa}};
  const std::string refusal = refusal_of(scene);
  CAPTURE(refusal);
  REQUIRE_THAT(refusal, Catch::Contains("changes its slope suddenly"));
  PillarScene slower = scene;
  test::as<TransientDrive>(slower).history[1].time_s =
      rise_s * number_after(refusal, "Stretch its ramps ");
  CHECK(simulate_pillar(slower).largest_relative_error <= scene.tolerance);
  scene.tolerance = number_after(refusal, "ask for a tolerance of ");
  CHECK(simulate_pillar(scene).largest_relative_error <= scene.tolerance);
}

// A tolerance of a few times the stated one shortens the reach as much as it allows more, so that it was refused again,
// and ramps as long as a step needs are too short for a pulse that moves the pillar less than at rest.
TEST_CASE("a pulse much shorter than a period can be solved as its refusal proposes", "[pillar]") {
  PillarScene scene = rod_scene(0.33, 1e-4);
  test::as<TransientDrive>(scene).direction = LoadDirection::kAxial;
  const auto triangle = [](double rise_s) {
    return Course{{0.0, 0.0}, {rise_s, kPressure_Pa}, {2.0 * rise_s, 0.0}};
  };
  const double step_s = 0.55e-6;  // twenty per period
  test::as<TransientDrive>(scene).history = {
      {0.0, kPressure_Pa}, {step_s, kPressure_Pa}, {step_s, 0.0}};
  const std::string jumps = refusal_of(scene);
  CAPTURE(jumps);
  CHECK_THAT(jumps, !Catch::Contains("ask for a tolerance"));  // it would be near 1
  test::as<TransientDrive>(scene).history = triangle(number_after(jumps, "Let each jump take "));
  CHECK(simulate_pillar(scene).largest_relative_error <= scene.tolerance);

  scene.tolerance = 2e-2;
  test::as<TransientDrive>(scene).history = triangle(step_s);
  const std::string ramps = refusal_of(scene);
  CAPTURE(ramps);
  PillarScene slower = scene;
  test::as<TransientDrive>(slower).history =
      triangle(step_s * number_after(ramps, "Stretch its ramps "));
  CHECK(simulate_pillar(slower).largest_relative_error <= slower.tolerance);
  scene.tolerance = number_after(ramps, "ask for a tolerance of ");
  CHECK(simulate_pillar(scene).largest_relative_error <= scene.tolerance);
}

TEST_CASE("a jump along the axis can be solved as its refusal proposes", "[pillar][slow]") {
  check_advice(LoadDirection::kAxial, 1e-3);
}
