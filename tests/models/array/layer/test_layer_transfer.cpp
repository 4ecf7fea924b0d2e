// Waves on the face of a layer and on pillars, and what a rough surface loses through them. Numbers of another
// program (Fourier, p-elements in the film's thickness of degree 10 to 12) unless said.
#include "models/array/layer/layer_transfer.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

LayerWaves waves_of(double nu, bool is_plane_stress, double thickness_m = 120e-6) {
  LayeredFilm stack = test::film_of_the_thesis();
  stack.layers.push_back({isotropic_medium(1.8e6, nu, 965.0), thickness_m});
  stack.is_plane_stress = is_plane_stress;
  return LayerWaves(stack, true);
}

double k_of(double wavelength_um) {
  return 2.0 * std::numbers::pi / (1e-6 * wavelength_um);
}

TEST_CASE("a layer passes waves of pressure as an independent program finds", "[models]") {
  constexpr std::array<double, 8> kWavelengths_um = {1000, 500, 400, 300, 200, 150, 120, 100};
  struct Case {
    double nu;
    bool is_plane_stress;
    double long_waves_V_m;  // V/(p t)
    std::array<double, 8> share;
    double half_um, tenth_um;
  };
  for (const Case& one :
       {Case{0.33,
             false,
             0.188301,
             {0.94296, 0.81120, 0.71151, 0.51748, 0.20287, 0.06362, 0.01794, 0.00477},
             293.4,
             165.6},
        Case{0.33,
             true,
             0.224348,
             {0.93561, 0.76957, 0.65665, 0.45869, 0.17156, 0.05280, 0.01477, 0.00391},
             317.0,
             172.8},
        Case{0.49,
             false,
             0.188300,
             {0.92457, 0.83115, 0.75462, 0.57812, 0.23870, 0.07565, 0.02134, 0.00566},
             272.5,
             159.2}}) {
    CAPTURE(one.nu, one.is_plane_stress);
    const LayerWaves waves = waves_of(one.nu, one.is_plane_stress);
    const double longest = layer_transfer(waves, 0.0).reading_V_Pa;
    CHECK(std::abs(longest) / 25e-6 == Approx(one.long_waves_V_m).epsilon(1e-4));
    for (std::size_t i = 0; i < kWavelengths_um.size(); ++i) {
      const double share = layer_transfer(waves, k_of(kWavelengths_um[i])).reading_V_Pa / longest;
      CHECK(share == Approx(one.share[i]).margin(1e-4));
    }
    CHECK(1e6 * half_wavelength_m(waves) == Approx(one.half_um).epsilon(3e-4));
    const double tenth = layer_transfer(waves, k_of(one.tenth_um)).reading_V_Pa / longest;
    CHECK(tenth == Approx(0.1).margin(2e-4));
  }
  struct Thin {
    double thickness_m, half_um, at_200_um;
  };
  for (const Thin& one : {Thin{60e-6, 165.9, 0.65191}, Thin{30e-6, 114.5, 0.85884}}) {
    const LayerWaves waves = waves_of(0.33, false, one.thickness_m);
    CHECK(1e6 * half_wavelength_m(waves) == Approx(one.half_um).epsilon(5e-4));
    const double share = layer_transfer(waves, k_of(200)).reading_V_Pa;
    CHECK(share / layer_transfer(waves, 0.0).reading_V_Pa == Approx(one.at_200_um).margin(2e-5));
  }
}

TEST_CASE("a layer sinks under waves as an independent program finds", "[models]") {
  struct Case {
    double nu;
    std::array<std::pair<double, double>, 5> sinking_m_Pa;  // by wavelength in um
  };
  for (const Case& one : {Case{0.33,
                               {{{1e5, 4.5005e-11},
                                 {1000, 4.7109e-11},
                                 {400, 4.5260e-11},
                                 {200, 3.0776e-11},
                                 {100, 1.5757e-11}}}},
                          Case{0.49,
                               {{{1e5, 3.908e-12},
                                 {1000, 2.1031e-11},
                                 {400, 3.2864e-11},
                                 {200, 2.5890e-11},
                                 {100, 1.3437e-11}}}}}) {
    const LayerWaves waves = waves_of(one.nu, false);
    for (const auto& [wavelength_um, expected] : one.sinking_m_Pa) {
      CAPTURE(one.nu, wavelength_um);
      CHECK(layer_transfer(waves, k_of(wavelength_um)).sinking_m_Pa ==
            Approx(expected).epsilon(2e-4));
    }
  }
  // By height, mV per um: of long waves and at 200 um.
  const auto per_height = [](const LayerWaves& waves, double k_1_m) {
    const LayerTransfer at = layer_transfer(waves, k_1_m);
    return 1e-3 * std::abs(at.reading_V_Pa) / at.sinking_m_Pa;
  };
  const LayerWaves strain = waves_of(0.33, false), stress = waves_of(0.33, true);
  CHECK(per_height(strain, 0.0) == Approx(104.6).epsilon(1e-3));
  CHECK(per_height(strain, k_of(200)) == Approx(31.03).epsilon(1e-3));
  CHECK(per_height(stress, 0.0) == Approx(94.39).epsilon(1e-3));
  CHECK(per_height(stress, k_of(200)) == Approx(27.76).epsilon(1e-3));
  CHECK(per_height(waves_of(0.49, false), k_of(200)) == Approx(43.4).epsilon(2e-3));
}

TEST_CASE("a layer blurs a rough surface as an independent program finds", "[models]") {
  constexpr std::array<double, 6> kCorrelation_um = {40, 75, 100, 150, 300, 750};
  struct Case {
    double nu;
    bool is_plane_stress;
    std::array<double, 6> correlation, mV_um;
  };
  for (const Case& one : {Case{0.33,
                               true,
                               {0.857, 0.951, 0.976, 0.993, 0.999, 1.000},
                               {57.4, 72.9, 79.1, 85.7, 91.5, 93.8}},
                          Case{0.49,
                               false,
                               {0.564, 0.655, 0.694, 0.748, 0.843, 0.949},
                               {252, 341, 391, 471, 638, 895}}}) {
    const LayerWaves waves = waves_of(one.nu, one.is_plane_stress);
    for (std::size_t i = 0; i < kCorrelation_um.size(); ++i) {
      CAPTURE(one.nu, kCorrelation_um[i]);
      const LayerBlurring blurring = layer_blurring(waves, true, 1e-6 * kCorrelation_um[i], 20e-6);
      CHECK(blurring.correlation == Approx(one.correlation[i]).margin(2e-3));
      CHECK(1e-3 * blurring.voltage_V_m == Approx(one.mV_um[i]).epsilon(3e-3));
    }
  }
  // A surface that is far wider than the layer is thick is read as it is, in space too.
  LayeredFilm stack = test::film_of_the_thesis();
  stack.layers.push_back({isotropic_medium(1.8e6, 0.33, 965.0), 120e-6});
  const LayerBlurring wide = layer_blurring(LayerWaves(stack, false), false, 10e-3, 20e-6);
  CHECK(wide.correlation == Approx(1.0).margin(1e-5));
  CHECK(1e-3 * wide.voltage_V_m == Approx(104.6).epsilon(2e-3));
}

}  // namespace
}  // namespace viscard
