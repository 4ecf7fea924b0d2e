#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

using test::film_of_the_thesis;
using test::pvdf_of_the_thesis;

constexpr double kThickness_m = 25e-6;
constexpr double kHalfPi = 0.5 * std::numbers::pi;

// A film without piezoelectricity, to compare with elastic closed forms.
LayeredFilm elastic_film(double E_Pa, double nu) {
  LayeredFilm film;
  film.layers = {{piezo_medium(isotropic_moduli_Pa(E_Pa, nu), PiezoMatrix::Zero(),
                               1e-10 * Eigen::Matrix3d::Identity(), 0.0),
                  kThickness_m}};
  return film;
}

// Compliance of a bonded layer over that of the half-space; models/README.md, eq. 10.
double bonded_layer(double x, double nu) {
  const double b = 3.0 - 4.0 * nu;
  return (b * std::sinh(2.0 * x) - 2.0 * x) /
         (b * std::cosh(2.0 * x) + 2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu);
}

TEST_CASE("a film under waves reads the converged values of collocation", "[models]") {
  // V/(t_z t) in V m/N of plane strain along the stretch, by Chebyshev collocation of u, w and phi; the
  // shear columns by p-elements of another program.
  struct Row {
    double angle, kt, x, y, z;
  };
  const std::vector<Row> rows = {
      {0.0, 0.5, 0.0674187, 0.0, 0.1806119},
      {0.0, 1.0, 0.0432131, 0.0, 0.1543898},
      {0.0, 2.0, -0.0115519, 0.0, 0.0902276},
      {0.0, 5.0, -0.0057336, 0.0, 0.009386},
      {0.0, 10.0, -0.000092494, 0.0, 0.000112875},
      {0.5 * kHalfPi, 1.0, 0.016287, -0.0443925, 0.1487697},
      {kHalfPi, 0.5, 0.005365, 0.0, 0.1751537},
      {kHalfPi, 1.0, -0.0106975, 0.0, 0.1431808},
      {kHalfPi, 2.0, -0.025986, 0.0, 0.0781175},
  };
  for (const Row& row : rows) {
    const FilmWaves film(film_of_the_thesis(), row.angle, 10.0 / kThickness_m, 10);
    const Eigen::Vector4d reading = film.reading(row.kt / kThickness_m) / kThickness_m;
    INFO("angle " << row.angle << ", k t " << row.kt);
    CHECK(reading[0] == Approx(row.x).margin(1e-7));
    CHECK(reading[1] == Approx(row.y).margin(1e-7));
    CHECK(reading[2] == Approx(row.z).margin(1e-7));
  }
}

TEST_CASE("an even pressure on a film reads the thickness voltage of a held plate", "[models]") {
  // V/(p t) = e33/(eps33 c33 + e33^2): laterally held, open plate, IEEE Std 176-1987.
  const Medium film = pvdf_of_the_thesis();
  const double e33 = film.piezo_C_m2(2, 2);
  const double expected =
      -e33 / (film.permittivity_F_m(2, 2) * film.stiffness_Pa(2, 2) + e33 * e33);
  const FilmWaves waves(film_of_the_thesis(), 0.3, 1.0 / kThickness_m, 6);
  CHECK(waves.reading(0.0)[2] / kThickness_m == Approx(expected).epsilon(1e-10));
}

TEST_CASE("an elastic film sinks like a bonded layer", "[models]") {
  for (const double nu : {0.0, 0.29, 0.45}) {
    const FilmWaves waves(elastic_film(2e9, nu), 0.7, 20.0 / kThickness_m, 10);
    for (const double kt : {0.1, 0.5, 1.0, 2.0, 5.0, 20.0}) {
      const double k_1_m = kt / kThickness_m;
      const double expected = half_space_compliance_m_Pa(2e9, nu, k_1_m) * bonded_layer(kt, nu);
      INFO("nu " << nu << ", k t " << kt);
      CHECK(waves.response(k_1_m)(2, 2) == Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("a film on a backing of its own material is a half-space", "[models]") {
  LayeredFilm film = elastic_film(2e9, 0.29);
  film.backing = Backing{2e9, 0.29};
  const FilmWaves waves(film, 0.0, 10.0 / kThickness_m, 10);
  for (const double kt : {0.01, 0.3, 1.0, 3.0}) {
    const double k_1_m = kt / kThickness_m;
    CHECK(waves.response(k_1_m)(2, 2) ==
          Approx(half_space_compliance_m_Pa(2e9, 0.29, k_1_m)).epsilon(1e-9));
  }
}

TEST_CASE("a film alone passes waves along its stretch as an independent program finds",
          "[models]") {
  // Share of the reading of long waves, p-elements of another program; half of it at 81.35 um.
  const FilmWaves waves(film_of_the_thesis(), 0.0, 10.0 / kThickness_m, 10);
  const double longest_V_Pa = waves.reading(0.0)[2];
  const std::pair<double, double> expected[] = {
      {1000, 0.99669}, {500, 0.98554}, {400, 0.97628}, {300, 0.95469}, {200, 0.88939},
      {150, 0.80350},  {120, 0.70979}, {100, 0.61727}, {81.35, 0.5},   {37.84, 0.1}};
  for (const auto& [wavelength_um, share] : expected) {
    CAPTURE(wavelength_um);
    const double k_1_m = 4.0 * kHalfPi / (1e-6 * wavelength_um);
    CHECK(waves.reading(k_1_m)[2] / longest_V_Pa == Approx(share).margin(6e-5));
  }
}

TEST_CASE("a film on soft rubber reads what plane finite elements read", "[models]") {
  LayeredFilm film = film_of_the_thesis(12.5e-12, 12.5e-12);
  film.backing = Backing{1.8e6, 0.49};
  const FilmWaves waves(film, 0.0, 10.0 / kThickness_m, 10);
  // FreeFEM, P2, coupled, on a half-space of finite depth; still converging in the last digits.
  CHECK(waves.reading(0.5 / kThickness_m)[2] / kThickness_m == Approx(0.179735).epsilon(5e-4));
  CHECK(waves.reading(1.0 / kThickness_m)[2] / kThickness_m == Approx(0.138746).epsilon(5e-4));
  // p-elements of another program.
  CHECK(waves.reading(0.5 / kThickness_m)[2] / kThickness_m == Approx(0.179684).margin(1e-6));
  CHECK(waves.reading(1.0 / kThickness_m)[2] / kThickness_m == Approx(0.138713).margin(1e-6));
}

TEST_CASE("what a film reads of a load is how a charge moves it", "[models]") {
  for (const FilmFace grounded : {FilmFace::kTop, FilmFace::kBottom}) {
    LayeredFilm film = film_of_the_thesis();
    film.grounded = grounded;
    film.layers.push_back({isotropic_medium(1.8e6, 0.33, 965.0), 40e-6});
    const FilmWaves waves(film, 0.4, 5.0 / kThickness_m, 9);
    const Eigen::Matrix4d response = waves.response(1.3 / kThickness_m);
    const Eigen::Vector4d reading = waves.reading(1.3 / kThickness_m);
    const double largest = response.row(3).head(3).cwiseAbs().maxCoeff();
    for (int i = 0; i < 3; ++i) {
      CHECK(response(3, i) == Approx(-response(i, 3)).margin(1e-9 * largest));
      CHECK(reading[i] == Approx(response(3, i)).margin(1e-9 * largest));
    }
    CHECK(reading[3] == Approx(response(3, 3)).epsilon(1e-9));
  }
}

TEST_CASE("a bulk layer on the film blurs short waves", "[models]") {
  LayeredFilm film = film_of_the_thesis();
  film.layers.push_back({isotropic_medium(1.8e6, 0.33, 965.0), 120e-6});
  const FilmWaves waves(film, 0.0, 2.0 * std::numbers::pi / 100e-6, 10);
  const double even = waves.reading(1e-3 / kThickness_m)[2];
  // Share of the reading of an even load that is left at a wavelength, plane strain along the stretch; w
  // per pressure at the surface. Computed with p-elements of degree 12, coupled.
  struct Row {
    double length_m, share, compliance_m_Pa;
  };
  for (const Row& row : {Row{1000e-6, 0.94296, 4.7109e-11}, Row{400e-6, 0.71151, 4.5260e-11},
                         Row{200e-6, 0.20287, 3.0776e-11}, Row{100e-6, 0.00477, 1.5757e-11}}) {
    const double k_1_m = 2.0 * std::numbers::pi / row.length_m;
    CHECK(waves.reading(k_1_m)[2] / even == Approx(row.share).margin(1e-5));
    CHECK(waves.response(k_1_m)(2, 2) == Approx(row.compliance_m_Pa).epsilon(1e-4));
  }
}

TEST_CASE("a film at extremes of thickness and wavelength stays finite and smooth",
          "[models][stability]") {
  for (const double t_m : {1e-9, 1e-3}) {
    LayeredFilm film = film_of_the_thesis();
    film.layers.front().thickness_m = t_m;
    const FilmWaves waves(film, 0.0, 40.0 / t_m, 10);
    // The answer depends on k t alone.
    CHECK(waves.reading(1.0 / t_m)[2] / t_m == Approx(0.1543898).margin(1e-7));
    CHECK(std::abs(waves.reading(40.0 / t_m)[2]) < 1e-12 * t_m);
    CHECK(waves.reading(1e-9 / t_m)[2] / t_m == Approx(0.188302488).margin(1e-8));
  }
}

TEST_CASE("a film that cannot be solved is refused", "[models]") {
  LayeredFilm film = film_of_the_thesis();
  film.layers.push_back({isotropic_medium(1e6, 0.5, 1000.0), 1e-4});
  CHECK_THROWS_WITH(validate(film), Catch::Contains("Poisson ratio below 0.5"));
  CHECK_THROWS_WITH(validate(LayeredFilm{}), Catch::Contains("at least one layer"));
  LayeredFilm thin = film_of_the_thesis();
  thin.layers.front().thickness_m = 0.0;
  CHECK_THROWS_WITH(validate(thin), Catch::Contains("thickness of a layer"));
  LayeredFilm passive = film_of_the_thesis();
  passive.layers.front().medium = isotropic_medium(2e9, 0.3, 1000.0);
  CHECK_THROWS_WITH(validate(passive), Catch::Contains("needs a permittivity"));
  LayeredFilm skew = film_of_the_thesis();
  skew.layers.front().medium.stiffness_Pa(0, 3) = 1e7;
  skew.layers.front().medium.stiffness_Pa(3, 0) = 1e7;
  CHECK_THROWS_WITH(validate(skew), Catch::Contains("twofold axis"));
}

}  // namespace
}  // namespace viscard
