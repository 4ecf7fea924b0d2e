#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/law_stability.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

Eigen::VectorXd numbers(std::initializer_list<double> values) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) out[i++] = value;
  return out;
}

// One law of each form, with moduli of some hundred kPa.
std::vector<HyperelasticLaw> some_laws() {
  return {{HyperelasticForm::kNeoHooke, numbers({2e5}), {}},
          {HyperelasticForm::kMooneyRivlin, numbers({1.5e5, 2e4}), {}},
          {HyperelasticForm::kYeoh, numbers({1.8e5, -1.4e3, 40.0}), {}},
          {HyperelasticForm::kOgden1, numbers({3e5}), numbers({2.9})},
          {HyperelasticForm::kOgden2, numbers({2e5, 1e4}), numbers({1.3, -2.0})},
          {HyperelasticForm::kOgden3, numbers({4e5, 3e3, 9.8e3}), numbers({1.3, 5.0, -2.0})},
          {HyperelasticForm::kArrudaBoyce, numbers({2.7e5}), numbers({5.2})},
          {HyperelasticForm::kGent, numbers({2.7e5}), numbers({80.0})}};
}

// The energy, written out from the formulas of the header for comparison.
double energy(const HyperelasticLaw& law, double a, double b, double c) {
  const double first = a * a + b * b + c * c, excess = first - 3.0;
  const double second = 1.0 / (a * a) + 1.0 / (b * b) + 1.0 / (c * c) - 3.0;
  const auto& m = law.moduli_Pa;
  double sum = 0.0;
  switch (law.form) {
    case HyperelasticForm::kNeoHooke:
      return m[0] * excess;
    case HyperelasticForm::kMooneyRivlin:
      return m[0] * excess + m[1] * second;
    case HyperelasticForm::kYeoh:
      return m[0] * excess + m[1] * excess * excess + m[2] * excess * excess * excess;
    case HyperelasticForm::kArrudaBoyce: {
      const double of_c[] = {0.5, 0.05, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0};
      for (int i = 1; i <= 5; ++i) {
        sum += m[0] * of_c[i - 1] * std::pow(law.shapes[0], 2 - 2 * i) *
               (std::pow(first, i) - std::pow(3.0, i));
      }
      return sum;
    }
    case HyperelasticForm::kGent:
      return -0.5 * m[0] * law.shapes[0] * std::log(1.0 - excess / law.shapes[0]);
    default:
      break;
  }
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double p = law.shapes[i];
    sum += 2.0 * m[i] / (p * p) * (std::pow(a, p) + std::pow(b, p) + std::pow(c, p) - 3.0);
  }
  return sum;
}

double energy_in(const HyperelasticLaw& law, Deformation deformation, double s) {
  switch (deformation) {
    case Deformation::kUniaxial:
      return energy(law, s, 1.0 / std::sqrt(s), 1.0 / std::sqrt(s));
    case Deformation::kPlanar:
      return energy(law, s, 1.0, 1.0 / s);
    case Deformation::kEquibiaxial:
      break;
  }
  return energy(law, s, s, 1.0 / (s * s));
}

}  // namespace

TEST_CASE("hyperelastic: the nominal stress is the slope of the energy in every deformation",
          "[models]") {
  for (const HyperelasticLaw& law : some_laws()) {
    for (const auto deformation :
         {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
      for (const double s : {0.5, 0.9, 1.001, 1.5, 3.0}) {
        CAPTURE(name_of(law.form), name_of(deformation), s);
        const double step = 1e-5 * s;
        const double slope =
            (energy_in(law, deformation, s + step) - energy_in(law, deformation, s - step)) /
            (2.0 * step) / n_loaded_directions(deformation);
        CHECK(nominal_stress_Pa(law, deformation, s) == Approx(slope).epsilon(1e-6));
        const double tangent = (nominal_stress_Pa(law, deformation, s + step) -
                                nominal_stress_Pa(law, deformation, s - step)) /
                               (2.0 * step);
        CHECK(nominal_tangent_Pa(law, deformation, s) == Approx(tangent).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("hyperelastic: closed forms of Neo-Hooke and Mooney-Rivlin", "[models]") {
  const HyperelasticLaw soft = some_laws()[0], mooney = some_laws()[1];
  const double s = 2.0;
  // Treloar, The Physics of Rubber Elasticity (1975), eq. 4.9 and 5.12, with G = 2 C10.
  CHECK(nominal_stress_Pa(soft, Deformation::kUniaxial, s) == Approx(4e5 * (s - 1.0 / (s * s))));
  CHECK(nominal_stress_Pa(soft, Deformation::kPlanar, s) == Approx(4e5 * (s - std::pow(s, -3))));
  CHECK(nominal_stress_Pa(soft, Deformation::kEquibiaxial, s) ==
        Approx(4e5 * (s - std::pow(s, -5))));
  CHECK(nominal_stress_Pa(mooney, Deformation::kUniaxial, s) ==
        Approx(2.0 * (s - 1.0 / (s * s)) * (1.5e5 + 2e4 / s)));
}

TEST_CASE("hyperelastic: Ogden's own constants and conventions give Neo-Hooke and Mooney-Rivlin",
          "[models]") {
  // alpha = 2: C10 = mu/2. alpha = -2: C01 = mu/2.
  const HyperelasticLaw ogden{HyperelasticForm::kOgden2, numbers({3e5, 4e4}), numbers({2.0, -2.0})};
  for (const double s : {0.4, 1.3, 5.0}) {
    CHECK(nominal_stress_Pa(ogden, Deformation::kPlanar, s) ==
          Approx(nominal_stress_Pa(some_laws()[1], Deformation::kPlanar, s)).epsilon(1e-12));
  }
}

TEST_CASE("hyperelastic: Young's modulus at rest is the tangent at a stretch of 1", "[models]") {
  for (const HyperelasticLaw& law : some_laws()) {
    CAPTURE(name_of(law.form));
    const double E0_Pa = youngs_modulus_Pa(law);
    CHECK(nominal_tangent_Pa(law, Deformation::kUniaxial, 1.0) == Approx(E0_Pa).epsilon(1e-13));
    // An incompressible body: E/(1 - nu^2) = 4/3 E planar, E/(1 - nu) = 2 E equibiaxial.
    CHECK(nominal_tangent_Pa(law, Deformation::kPlanar, 1.0) ==
          Approx(4.0 / 3.0 * E0_Pa).epsilon(1e-13));
    CHECK(nominal_tangent_Pa(law, Deformation::kEquibiaxial, 1.0) ==
          Approx(2.0 * E0_Pa).epsilon(1e-13));
    // Small strains keep their digits.
    CHECK(nominal_stress_Pa(law, Deformation::kUniaxial, 1.0 + 1e-9) ==
          Approx(E0_Pa * ((1.0 + 1e-9) - 1.0)).epsilon(1e-8));
  }
}

TEST_CASE("hyperelastic: slopes by the shapes are those of differences", "[models]") {
  for (const HyperelasticLaw& law : some_laws()) {
    for (Eigen::Index k = 0; k < law.shapes.size(); ++k) {
      CAPTURE(name_of(law.form), k);
      const double step = 1e-5;
      Eigen::VectorXd up = law.shapes, down = law.shapes;
      up[k] += step;
      down[k] -= step;
      const auto at = [&](const Eigen::VectorXd& shapes) {
        return stress_columns(law.form, shapes, Deformation::kEquibiaxial, 1.8);
      };
      const Eigen::VectorXd slope = (at(up).values - at(down).values) / (2.0 * step);
      CHECK((at(law.shapes).shape_slopes.col(k) - slope).norm() <= 1e-8 * (1.0 + slope.norm()));
    }
  }
}

TEST_CASE("hyperelastic: an exponent of zero is the limit of small exponents", "[models]") {
  const HyperelasticLaw zero{HyperelasticForm::kOgden1, numbers({3e5}), numbers({0.0})};
  const HyperelasticLaw small{HyperelasticForm::kOgden1, numbers({3e5}), numbers({1e-7})};
  // W = mu (sum of squared logarithmic strains): uniaxial stress 3 mu ln s/s.
  CHECK(nominal_stress_Pa(zero, Deformation::kUniaxial, 2.0) ==
        Approx(3.0 * 3e5 * std::log(2.0) / 2.0).epsilon(1e-13));
  CHECK(nominal_stress_Pa(small, Deformation::kUniaxial, 2.0) ==
        Approx(nominal_stress_Pa(zero, Deformation::kUniaxial, 2.0)).epsilon(1e-6));
}

TEST_CASE("hyperelastic: stability ends where Drucker's postulate fails", "[models]") {
  for (const auto deformation :
       {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
    const StableRange neo = stable_range(some_laws()[0], deformation);
    CHECK((neo.low_is_open && neo.high_is_open));
    CHECK(neo.contains(100.0));
  }
  // C10 > 0 > C01: with e_3 = -(e_1 + e_2) and s_3 = 1/s^2 in equibiaxial tension the smaller
  // eigenvalue is that of unequal changes, 4 C10 s^2 + 4 C01/s^2, which is positive as long as
  // s^4 > -C01/C10; the other is 4 C10 (s^2 + 2/s^4) + 4 C01 (1/s^2 + 2 s^4).
  const HyperelasticLaw weak{HyperelasticForm::kMooneyRivlin, numbers({1e5, -1e3}), {}};
  const double end = stable_range(weak, Deformation::kEquibiaxial).high;
  CHECK(std::pow(end, 2) + 2.0 * std::pow(end, -4) ==
        Approx(0.01 * (std::pow(end, -2) + 2.0 * std::pow(end, 4))).epsilon(1e-10));
  // A law with a largest stretch ends there: I1 - 3 = J_m.
  const StableRange gent = stable_range(some_laws()[7], Deformation::kUniaxial);
  CHECK_FALSE(gent.high_is_open);
  CHECK(gent.high * gent.high + 2.0 / gent.high == Approx(83.0).epsilon(1e-10));
  CHECK(std::isnan(nominal_stress_Pa(some_laws()[7], Deformation::kUniaxial, 9.2)));
}

TEST_CASE("Ogden terms with positive moduli are stable at every stretch, however large alpha is",
          "[models]") {
  // W is a sum of convex functions of the logarithmic strains (Ogden, Non-linear Elastic Deformations
  // (1984), sect. 6.2.3), so that Drucker's postulate holds everywhere.
  const double alpha = GENERATE(-30.0, -12.0, 0.7, 12.0, 30.0, 40.0);
  const HyperelasticLaw law{HyperelasticForm::kOgden2, Eigen::Vector2d(1e5, 2e4),
                            Eigen::Vector2d(alpha, -0.5 * alpha)};
  for (const Deformation deformation :
       {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
    const StableRange range = stable_range(law, deformation);
    CAPTURE(alpha, static_cast<int>(deformation), range.low, range.high);
    CHECK(range.low_is_open);
    CHECK(range.high_is_open);
  }
}

TEST_CASE("hyperelastic: bad parameters are refused by name", "[models]") {
  HyperelasticLaw law = some_laws()[7];
  law.shapes[0] = -1.0;
  CHECK_THROWS_WITH(validate(law), Contains("J_m of gent is -1"));
  law.shapes = {};
  CHECK_THROWS_WITH(validate(law),
                    Contains("gent has 1 moduli and 1 shapes, but 1 and 0 are given"));
  law = some_laws()[2];
  law.moduli_Pa[0] = -1e5;
  CHECK_THROWS_WITH(validate(law), Contains("the modulus at rest of yeoh is -600000 Pa"));
  for (const HyperelasticLaw& good : some_laws()) CHECK_NOTHROW(validate(good));
}
