// The thesis' chapters 7 and 8 and appendix A.1 as scenes of data/seed, each beside a number of another origin.
#include "io/flow/scenes/answer_scene.h"
#include "io/scenes/scene_file.h"
#include "models/array/space/space_contact.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

using namespace viscard;

namespace {

struct SeedAnswer {
  SceneFile file;
  SceneAnswer answer;
};
SeedAnswer seed_answer(const std::string& name) {
  const std::string path = std::string(VISCARD_SOURCE_DIR) + "/data/seed/" + name;
  SeedAnswer seed{read_scene(path), {}};
  seed.answer = answer_scene(seed.file, path, {});
  return seed;
}

SceneResult seed_result(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no result " + name);
}

const std::vector<double>& values_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneMap& map : answer.maps) {
    if (map.name == name) return map.value;
  }
  throw std::runtime_error("no map " + name);
}

// k <depth - gap> of the round top at x, on a circle of 3650 um (paraboloid to second order, with the circle's next).
double mean_gap_force_N(double x_m) {
  const double radius_m = 3650e-6, R_m = 20e-6;
  double sum_m = 0.0, weight = 0.0;
  for (int i = 0; i < 400; ++i) {  // chords of the top
    const double u = -1.0 + (i + 0.5) / 200.0;
    const double chord = std::sqrt(1.0 - u * u), x = x_m + R_m * u;
    sum_m += chord * (10e-6 - (radius_m - std::sqrt(radius_m * radius_m - x * x)));
    weight += chord;
  }
  return 19.0468 * sum_m / weight;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

const SceneCurve& seed_curve(const SceneAnswer& answer, const std::string& name) {
  for (const SceneCurve& one : answer.curves) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no curve " + name);
}

double largest_near(const SceneCurve& spectrum, double middle_Hz) {
  double largest = 0.0;
  for (std::size_t i = 0; i < spectrum.x.size(); ++i) {
    if (std::abs(spectrum.x[i] - middle_Hz) < 10e3) largest = std::max(largest, spectrum.value[i]);
  }
  return largest;
}

}  // namespace

TEST_CASE("eight pillars under the thesis' profile bear their mean overlap",
          "[seed][scene][array]") {
  const SceneAnswer contact = seed_answer("array_cylinder.toml").answer;
  const std::vector<double>& force_N = values_of(contact, "pillar_force");
  REQUIRE(force_N.size() == 8);
  CHECK(force_N[4] == Approx(mean_gap_force_N(50e-6)).epsilon(1e-3));
  CHECK(force_N[5] == Approx(mean_gap_force_N(150e-6)).epsilon(1e-3));
  // The far side of this top lifts: it bears more than its mean overlap says.
  CHECK(force_N[6] > mean_gap_force_N(250e-6));
  CHECK(force_N[6] < 1.3 * mean_gap_force_N(250e-6));
  CHECK(force_N[7] == 0.0);
  CHECK(seed_result(contact, "contacts").value == 6.0);
  CHECK(std::any_of(contact.notes.begin(), contact.notes.end(), [](const std::string& note) {
    return note.find("buckle") != std::string::npos;
  }));
}

TEST_CASE("eight pillars that must follow the thesis' profile are pulled at the ends",
          "[seed][scene][array]") {
  const SceneAnswer answer = seed_answer("array_cylinder_prescribed.toml").answer;
  const std::vector<double>& force_N = values_of(answer, "pillar_force");
  for (int i = 0; i < 4; ++i) {
    const double expected_N = mean_gap_force_N((50.0 + 100.0 * i) * 1e-6);
    CHECK(force_N[static_cast<std::size_t>(4 + i)] == Approx(expected_N).epsilon(1e-3));
    CHECK(force_N[static_cast<std::size_t>(3 - i)] == Approx(expected_N).epsilon(1e-3));
  }
  CHECK(force_N[7] == Approx(-130.156e-6).epsilon(5e-3));
}

TEST_CASE("eight strips of chapter 8 bear and read what an independent program finds",
          "[seed][scene][array]") {
  for (const char* const name :
       {"array_strips.toml", "array_strips_stick.toml", "array_strips_prescribed.toml"}) {
    const SeedAnswer seed = seed_answer(name);
    REQUIRE(seed.file.printed.size() >= 6);
    for (const PrintedValue& one : seed.file.printed) {
      INFO(name << ", " << one.name);
      // 2e-4 where a top is touched everywhere, 2e-3 where the third one lifts.
      const double share = one.name.ends_with("_7") ? 2e-3 : 2e-4;
      const double unit = one.value.ends_with("mV") ? 1e-3 : 1.0;  // else N/m
      CHECK(seed_result(seed.answer, one.name).value ==
            Approx(unit * std::stod(one.value)).epsilon(share));
    }
  }
}

TEST_CASE("a layer that must follow the thesis' profile reads as finite elements find",
          "[seed][scene][layer]") {
  const SceneAnswer answer = seed_answer("layer_cylinder_prescribed.toml").answer;
  const SceneResult force = seed_result(answer, "contact_force");
  CHECK(std::abs(force.value - 40.471) < std::max(force.error_estimate, 2e-3 * 40.471));
  CHECK(seed_result(answer, "centre_voltage_1").value == Approx(-0.904513).epsilon(5e-3));
  CHECK(seed_result(answer, "centre_voltage_2").value == Approx(-0.872768).epsilon(5e-3));
}

TEST_CASE("pillars follow the thesis' rough profile without blurring it", "[seed][scene][array]") {
  const SeedAnswer seed = seed_answer("array_rough.toml");
  const auto& scene = std::get<SpaceScene>(seed.file.scene);
  std::vector<double> overlap_m;
  for (const SpacePillar& one : scene.pillars) {
    double sum_m = 0.0;
    int count = 0;
    for (int i = -10; i <= 10; ++i) {
      for (int j = -10; j <= 10; ++j) {
        if (i * i + j * j > 100) continue;
        sum_m -= height_m(scene.press->shape, one.x_m + 2e-6 * i, one.y_m + 2e-6 * j);
        ++count;
      }
    }
    overlap_m.push_back(sum_m / count);
  }
  const std::vector<double>& mean_V = values_of(seed.answer, "mean_voltage");
  CHECK(correlation(mean_V, overlap_m) < -0.999);  // pressed is negative
  CHECK(seed_result(seed.answer, "contacts").value == 8.0);
}

TEST_CASE("quarters read by areas and by nodes give the numbers of the seed files",
          "[seed][scene][array]") {
  const double top_N = std::numbers::pi * 20e-6 * 20e-6 * 1e3;
  const auto result = [](const std::string& file, const std::string& name) {
    return seed_result(seed_answer(file).answer, name).value;
  };
  CHECK(result("quadrants_normal_area.toml", "quadrant_1_voltage_1_1") ==
        Approx(-1.92665e-3).epsilon(1e-3));
  CHECK(result("quadrants_normal_area.toml", "sensed_normal_force_1_1") ==
        Approx(top_N).epsilon(1e-6));
  CHECK(result("quadrants_normal_nodes.toml", "sensed_normal_force_1_1") ==
        Approx(1.0517 * top_N).epsilon(1e-3));
  CHECK(result("quadrants_shear_area.toml", "quadrant_1_voltage_1_1") ==
        Approx(-7.78507e-3).epsilon(1e-3));
  CHECK(result("quadrants_shear_area.toml", "sensed_shear_x_force_1_1") ==
        Approx(top_N).epsilon(1e-6));
  // On a film as wide as the pillar the same foot reads several times as much.
  CHECK(result("figure_8_5.toml", "quadrant_voltage") == Approx(-32.60e-3).epsilon(1e-3));
  const SceneAnswer nodes = seed_answer("quadrants_shear_nodes.toml").answer;
  CHECK(seed_result(nodes, "sensed_normal_force_1_1").value ==
        Approx(-0.140 * top_N).margin(2e-3 * top_N));
  CHECK(seed_result(nodes, "sensed_shear_x_force_1_1").value ==
        Approx(0.870 * top_N).margin(2e-3 * top_N));
  CHECK(seed_result(nodes, "sensed_shear_y_force_1_1").value ==
        Approx(0.015 * top_N).margin(2e-3 * top_N));
}

// A pulse moves the end of a rod by modes n in the ratio 1/(2 n - 1) and presses on its foot by all modes alike; one that rises and falls in
// r each excites them by sinc^2(f r). Graff, Wave Motion in Elastic Solids (1975), 2.2. A pillar as thick as the wave is long disperses.
TEST_CASE("the pulses of chapter 7 excite the modes of a rod", "[seed][scene]") {
  struct Pulse {
    const char *file, *top, *foot;
    double first_Hz, second_Hz;
  };
  const Pulse pulse = GENERATE(
      Pulse{"figure_7_2.toml", "top_displacement", "potential_at_centre", 90927.0, 2.68e5},
      Pulse{"figure_7_19.toml", "top_displacement_4", "centre_voltage_4", 90321.0, 2.68e5});
  CAPTURE(pulse.file);
  const SceneAnswer answer = seed_answer(pulse.file).answer;
  const auto second_over_first = [&](const std::string& name) {
    const SceneCurve& spectrum = seed_curve(answer, name + "_spectrum");
    return largest_near(spectrum, pulse.second_Hz) / largest_near(spectrum, pulse.first_Hz);
  };
  const auto triangle = [](double f_Hz) {
    const double x = std::numbers::pi * f_Hz * 1.1e-6;
    return std::pow(std::sin(x) / x, 2);
  };
  const double excited = triangle(pulse.second_Hz) / triangle(pulse.first_Hz);
  CHECK(second_over_first(pulse.top) == Approx(excited / 3.0).epsilon(0.2));
  CHECK(second_over_first(pulse.foot) == Approx(excited).epsilon(0.2));
}

TEST_CASE("the sweeps of chapter 7 are flat below and peak at the axial modes of its tables",
          "[seed][scene]") {
  const SceneAnswer slow = seed_answer("figure_7_8.toml").answer;
  const double at_10_Hz = seed_result(slow, "potential_at_centre_at_lowest").value;
  const double at_300_Hz = seed_result(slow, "potential_at_centre_at_highest").value;
  CHECK(at_10_Hz < 0.1);  // the axis of the thesis
  const double turn = 2.0 * std::numbers::pi * 300.0 * 120e-6 / std::sqrt(1.8e6 / 965.0);
  CHECK(at_300_Hz / at_10_Hz - 1.0 == Approx(1.0 / std::cos(turn) - 1.0).epsilon(0.05));

  const SceneAnswer single = seed_answer("figure_7_10.toml").answer;
  CHECK(seed_result(single, "top_displacement_resonance_1").value == Approx(90927.0).epsilon(3e-3));
  CHECK(seed_result(single, "top_displacement_resonance_2").value == Approx(2.68e5).epsilon(1e-3));

  const SceneAnswer answer = seed_answer("figure_7_18.toml").answer;
  const SceneCurve& row = seed_curve(answer, "centre_voltage_4_magnitude");
  std::vector<double> peaks_Hz;
  for (std::size_t i = 1; i + 1 < row.x.size(); ++i) {
    if (row.value[i] > row.value[i - 1] && row.value[i] > row.value[i + 1])
      peaks_Hz.push_back(row.x[i]);
  }
  REQUIRE(peaks_Hz.size() == 2);  // none at the lateral modes of 18, 82 and 180 kHz
  CHECK(peaks_Hz[0] == Approx(90321.0).margin(2e3));
  CHECK(peaks_Hz[1] == Approx(2.68e5).margin(2e3));
}
