#include "models/material/material_bound.h"
#include "models/material/material_causes.h"
#include "models/material/series_band.h"
#include "models/material/systematic_parts.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

// E_inf = 1.4, E_1 = 0.6 MPa, correlated.
Material correlated_material() {
  Material material;
  material.E0_Pa = 2e6;
  material.nu = 0.49;
  material.terms = {{0.3, 0.3, 2.0}};
  MaterialUncertainty known;
  known.covariance_parameters = {"E_inf_Pa", "E_1_Pa", "ln_tau_1"};
  known.covariance.resize(3, 3);
  known.covariance << 4e8, -1e8, 30.0, -1e8, 9e8, -50.0, 30.0, -50.0, 1e-4;
  const double se_Pa = std::sqrt(4e8 + 9e8 - 2e8);
  known.E0_Pa_95 = {2e6 - kNormal95 * se_Pa, 2e6 + kNormal95 * se_Pa};
  known.E_inf_Pa_95 = {1.4e6 - kNormal95 * 2e4, 1.4e6 + kNormal95 * 2e4};
  known.terms = {{3e4, 1e-2, {}, {}, {}}};
  material.uncertainty = known;
  return material;
}

}  // namespace

TEST_CASE("at an end of the interval of E0 all else is at its conditional mean", "[models]") {
  const Material material = correlated_material();
  const double variance = 11e8;  // of E0, Pa^2
  const double change_Pa = kNormal95 * std::sqrt(variance);
  const Material upper = material_at_end(material, IntervalEnd::kUpper);
  const Material lower = material_at_end(material, IntervalEnd::kLower);
  CHECK(upper.E0_Pa == Approx(2e6 + change_Pa).epsilon(1e-12));
  CHECK(lower.E0_Pa == Approx(2e6 - change_Pa).epsilon(1e-12));
  // Covariances with E0 = E_inf + E_1: 4e8 - 1e8, -1e8 + 9e8, 30 - 50.
  const double E_1_Pa = 0.6e6 + 8e8 / variance * change_Pa;
  CHECK(upper.terms[0].g * upper.E0_Pa == Approx(E_1_Pa).epsilon(1e-12));
  CHECK(upper.terms[0].tau_s == Approx(2.0 * std::exp(-20.0 / variance * change_Pa)).epsilon(1e-9));
  CHECK_FALSE(upper.uncertainty);
}

TEST_CASE("a wider interval of E0 than its covariance implies widens the bound", "[models]") {
  Material material = correlated_material();
  const double half_Pa = 2.0 * (material.uncertainty->E0_Pa_95.high - 2e6);  // Student's t, say
  material.uncertainty->E0_Pa_95 = {2e6 - half_Pa, 2e6 + half_Pa};
  CHECK(material_at_end(material, IntervalEnd::kUpper).E0_Pa ==
        Approx(2e6 + half_Pa).epsilon(1e-12));
  // A part that scales all moduli adds in quadrature, and leaves g alone.
  material.uncertainty->systematic_relative = 0.5;
  const Material upper = material_at_end(material, IntervalEnd::kUpper);
  CHECK(upper.E0_Pa == Approx(2e6 + std::hypot(half_Pa, kNormal95 * 1e6)).epsilon(1e-12));
  CHECK(upper.terms[0].g == Approx(0.3).epsilon(0.01));
}

TEST_CASE("bounds need a covariance and a positive end", "[models]") {
  Material material = correlated_material();
  material.uncertainty->covariance_parameters.clear();
  CHECK_THROWS_AS(material_at_end(material, IntervalEnd::kLower), std::invalid_argument);
  material = correlated_material();
  material.uncertainty->systematic_relative = 0.6;
  CHECK_THROWS_AS(material_at_end(material, IntervalEnd::kLower), std::invalid_argument);
  CHECK(material_at_end(material, IntervalEnd::kUpper).E0_Pa > 4e6);
}

TEST_CASE("systematic parts move E_inf, terms and times together", "[models]") {
  const PronySeries series{1.4e6, {{0.6e6, 2.0}}};
  const SystematicPart part{"frame", 0.02, {0.05}, {-0.01}};
  const PronySeries after = moved(series, direction_of(series, part), 1e-3);
  const double E0_Pa = instantaneous_modulus_Pa(after);
  CHECK(E0_Pa / 2e6 - 1.0 == Approx(2e-5).epsilon(1e-9));
  CHECK(after.terms[0].modulus_Pa / E0_Pa / 0.3 - 1.0 == Approx(5e-5).epsilon(1e-3));
  CHECK(after.terms[0].relaxation_time_s / 2.0 - 1.0 == Approx(-1e-5).epsilon(1e-3));
  const std::vector<SystematicPart> parts{part, {"geometry", 0.03, {}, {}}};
  CHECK(systematic_u_of_E0(parts) == Approx(std::hypot(0.02, 0.03)));
  CHECK(systematic_u_of_g(parts, 0) == Approx(0.05));
  CHECK(systematic_u_of_tau(parts, 0) == Approx(0.01));
  CHECK(systematic_u_of_modulus(parts, 0) == Approx(std::hypot(0.07, 0.03)));
  // E_inf = E0 (1 - g): 0.02 - 0.3 0.05/0.7.
  CHECK(systematic_u_of_E_inf(parts, series) == Approx(std::hypot(0.02 - 0.3 * 0.05 / 0.7, 0.03)));
}

TEST_CASE("each systematic cause of a material is a cause of its own", "[models]") {
  Material material = correlated_material();
  material.uncertainty->systematic_relative = 0.05;
  CHECK(causes_of(material).causes.size() == 2);
  material.uncertainty->systematic_parts = {{"frame", 0.03, {0.03}, {0.0}},
                                            {"geometry", 0.04, {}, {}}};
  const MaterialCauses found = causes_of(material);
  REQUIRE(found.causes.size() == 3);
  CHECK(found.causes[1].name == "systematic part, frame");
  CHECK(found.causes[2].name == "systematic part, geometry");
  Eigen::VectorXd deviates = Eigen::VectorXd::Zero(5);
  deviates[3] = 1.0;
  const Material moved_one = material_at(material, found.causes, deviates);
  CHECK(moved_one.E0_Pa == Approx(2e6 * 1.03).epsilon(1e-9));
  CHECK(moved_one.terms[0].g == Approx(0.3 * 1.03).epsilon(1e-2));
}
