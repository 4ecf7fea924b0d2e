#include "models/array/plane/array_modes.h"
#include "models/array/plane/array_scene.h"
#include "models/array/plane/array_transfer.h"
#include "models/array/plane/simulate_array.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/scene/pillar_scene.h"
#include "tests/models/array/plane/seed_array.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

using Complex = std::complex<double>;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

Material pdms(std::vector<MaterialTerm> terms = {}) {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.rho_kg_m3 = 965.0;
  material.terms = std::move(terms);
  return material;
}

ArrayScene row_in_time(const RowDrive& drive) {
  ArrayScene scene;
  scene.tolerance = 3e-2;  // a tap takes many modes
  scene.geometry.count = 3;
  scene.geometry.spacing_m = 20e-6;
  scene.pillar = pdms();
  scene.film = seed_pvdf();
  scene.drive = drive;
  scene.loaded = {2};
  return scene;
}

struct Row {
  explicit Row(const ArrayGeometry& geometry, int modes = 8)
      : model(geometry, {}, seed_media(), {.degree = 5, .layers = 2, .shaft_elements = 2},
              {.modes = modes}) {}
  ArrayModel model;
};

const SceneCurve& curve_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.curves.begin(), answer.curves.end(),
                                  [&](const SceneCurve& c) { return c.name == name; });
  if (found == answer.curves.end()) throw std::runtime_error("no curve " + name);
  return *found;
}

}  // namespace

TEST_CASE("a slow load on a row gives its static answer", "[array]") {
  const Row row({.count = 3, .spacing_m = 20e-6});
  const ArrayResponse still = array_response(row.model, ArrayLoad::kPressure);
  const ArrayTransfer transfer(row.model, ArrayLoad::kPressure, {1}, pdms());
  const Eigen::VectorXcd slow = transfer.at(Complex(0.0, kTwoPi * 1.0));
  for (int i = 0; i < 3; ++i) {
    // (1 Hz over 9e4 Hz)^2 is 1e-10.
    CHECK(slow[i].real() ==
          Approx(still.top_m(i, 1)).epsilon(1e-8).margin(1e-9 * std::abs(still.top_m(1, 1))));
    CHECK(slow[3 + i].real() == Approx(still.centre_V(i, 1)).margin(1e-8 * still.centre_V.norm()));
  }
}

TEST_CASE("a row resonates at its modes", "[array]") {
  const Row row({.count = 3, .spacing_m = 20e-6});
  const std::vector<ArrayMode> modes = array_modes(row.model, 1);
  const ArrayTransfer transfer(row.model, ArrayLoad::kShear, {0}, pdms());
  for (const ArrayMode& mode : modes) {
    if (!mode.is_lateral || mode.share[0] < 0.1) continue;
    const double at =
        std::abs(transfer.at(Complex(0.0, kTwoPi * mode.frequency_Hz * (1.0 + 1e-9)))[0]);
    const double beside = std::abs(transfer.at(Complex(0.0, kTwoPi * mode.frequency_Hz * 1.01))[0]);
    CHECK(at > 1e4 * beside);
  }
}

TEST_CASE("one pillar of a row vibrates as in the solver of one pillar", "[array]") {
  // A strip on a film: its frequency response away from resonance, elastic and relaxing.
  const std::vector<MaterialTerm> terms =
      GENERATE(std::vector<MaterialTerm>{}, std::vector<MaterialTerm>{{0.2, 0.2, 2e-6}});
  PillarScene one;
  one.tolerance = 1e-4;
  one.pillar = pdms(terms);
  one.plane = PlaneState::kStress;
  one.geometry.film = FilmGeometry{25e-6, 60e-6};
  one.film = isotropic_medium(2e9, 0.29, 1780.0);
  const std::vector<double> frequencies_Hz = {1e3, 5e4, 1.3e5, 2e5};
  one.drive = HarmonicDrive{.pressure_Pa = 1e3, .frequencies_Hz = frequencies_Hz};
  const SceneAnswer single = simulate_pillar(one);
  ArrayScene row;
  row.tolerance = 1e-3;
  row.geometry.count = 1;
  row.geometry.film_edge_m = 40e-6;
  row.pillar = one.pillar;
  row.film = *one.film;
  row.drive = RowHarmonic{frequencies_Hz};
  row.load_Pa = 1e3;
  const SceneAnswer array = simulate_array(row);
  for (const char* part : {"_real", "_imaginary"}) {
    const SceneCurve& mine = curve_of(array, std::string("top_displacement_1") + part);
    const SceneCurve& other = curve_of(single, std::string("top_displacement") + part);
    for (std::size_t i = 0; i < mine.value.size(); ++i) {
      CAPTURE(part, i);
      // Error in amplitude or in frequency: between resonances slopes are many times the amplitude.
      CHECK(mine.value[i] == Approx(other.value[i]).margin(row.tolerance * mine.allowed[i]));
    }
  }
}

TEST_CASE("a step on a row rings with twice the static deflection", "[array]") {
  // Plane rod under a sudden load: dynamic factor 2 (Graff, Wave Motion in Elastic Solids, ch. 2).
  const Row row({.count = 1}, 14);
  const ArrayTransfer transfer(row.model, ArrayLoad::kPressure, {0}, pdms());
  const double still_m = transfer.at(Complex(1e-3, 0.0))[0].real();
  const Eigen::MatrixXd ringing =
      response_in_time(transfer, {{0.0, 1.0}, {1e-4, 1.0}}, 1e-4, 2000, 4);
  const double mean = ringing.row(0).mean();
  CHECK(mean == Approx(still_m).epsilon(0.05));  // of nine periods, not a whole number
  CHECK(ringing.row(0).minCoeff() / still_m == Approx(2.0).epsilon(0.05));
  // At rest at first, but for the modes left out: beyond the fifth they have 4 % (8/pi^2 sum
  // 1/n^2).
  CHECK(std::abs(ringing(0, 0)) < 0.1 * std::abs(still_m));
}

TEST_CASE("the numerical Laplace transform gives a damped oscillator's exact response", "[array]") {
  // After a ramp of one period of the first mode it does not ring (Den Hartog, Mechanical
  // Vibrations); only the higher modes do.
  const Row row({.count = 1}, 10);
  const ArrayTransfer transfer(row.model, ArrayLoad::kPressure, {0}, pdms());
  double first_Hz = 0.0;
  for (std::size_t k = 0; k < row.model.pillar().mode_is_lateral.size() && first_Hz == 0.0; ++k) {
    if (!row.model.pillar().mode_is_lateral[k]) {
      first_Hz = row.model.pillar().mode_rad_s[static_cast<Eigen::Index>(k)] / kTwoPi;
    }
  }
  const double ramp_s = 1.0 / first_Hz;
  const double end_s = 8.0 * ramp_s;
  const auto ringing = [&](double ramp) {
    const Eigen::MatrixXd y =
        response_in_time(transfer, {{0.0, 0.0}, {ramp, 1.0}, {end_s, 1.0}}, end_s, 800, 2);
    const Eigen::VectorXd rest = y.row(0).tail(400);
    return (rest.maxCoeff() - rest.minCoeff()) / std::abs(rest.mean());
  };
  CHECK(ringing(ramp_s) < 0.03);
  // Half a period longer: 2 |sin(pi f t_R)|/(pi f t_R) peak to peak of the first mode's share.
  CHECK(ringing(1.5 * ramp_s) == Approx(2.0 * 2.0 / (1.5 * kTwoPi / 2.0) * 0.5).epsilon(0.25));
}

TEST_CASE("only one pillar of a row is tapped and its neighbours answer", "[array]") {
  ArrayScene scene = row_in_time(RowTransient{
      .history = {{0.0, 0.0}, {5e-6, 1e3}, {1e-5, 0.0}}, .end_time_s = 5e-5, .outputs = 200});
  const SceneAnswer answer = simulate_array(scene);
  CHECK(answer.largest_relative_error <= scene.tolerance);
  const auto peak = [&](const char* name) {
    const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                    [&](const SceneResult& r) { return r.name == name; });
    REQUIRE(found != answer.results.end());
    return std::abs(found->value);
  };
  CHECK(peak("top_displacement_1_peak") < 1e-3 * peak("top_displacement_2_peak"));
  CHECK(peak("centre_voltage_1_peak") < 0.1 * peak("centre_voltage_2_peak"));
  CHECK(peak("centre_voltage_1_peak") == Approx(peak("centre_voltage_3_peak")).epsilon(1e-4));
  CHECK(curve_of(answer, "top_displacement_2_spectrum").x.size() > 50);
}

TEST_CASE("linear elements solve a tap too, with the few modes that they represent accurately",
          "[array]") {
  ArrayScene scene = row_in_time(RowTransient{
      .history = {{0.0, 0.0}, {5e-6, 1e3}, {1e-5, 0.0}}, .end_time_s = 5e-5, .outputs = 200});
  const auto peak_on = [&](const Discretisation& mesh) {
    const SceneAnswer answer = array_answer_on(scene, mesh);
    const auto found =
        std::find_if(answer.results.begin(), answer.results.end(),
                     [](const SceneResult& r) { return r.name == "top_displacement_2_peak"; });
    REQUIRE(found != answer.results.end());
    return std::abs(found->value);
  };
  // Linear elements of 5 um are a few per cent too stiff.
  const double linear =
      peak_on({.degree = 1, .layers = 1, .shaft_elements = 16, .longest_m = 5e-6});
  CHECK(linear == Approx(peak_on({.degree = 6, .layers = 3})).epsilon(0.1));
}
