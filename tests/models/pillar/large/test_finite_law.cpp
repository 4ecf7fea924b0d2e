#include "models/pillar/large/finite_law.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace viscard;

namespace {

// Every form of rubber, with parameters near those of Treloar's rubber, and St Venant-Kirchhoff.
std::vector<FiniteLaw> laws_at(double nu) {
  const auto law = [&](HyperelasticForm form, const std::vector<double>& moduli_MPa,
                       const std::vector<double>& shapes) {
    const auto vector = [](const std::vector<double>& v) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v)));
    };
    return finite_law({form, 1e6 * vector(moduli_MPa), vector(shapes)}, nu);
  };
  return {law(HyperelasticForm::kNeoHooke, {0.2}, {}),
          law(HyperelasticForm::kMooneyRivlin, {0.16, 0.03}, {}),
          law(HyperelasticForm::kYeoh, {0.17, -2e-3, 4e-5}, {}),
          law(HyperelasticForm::kOgden2, {0.3, 0.02}, {1.3, 5.0}),
          law(HyperelasticForm::kArrudaBoyce, {0.3}, {5.0}),
          law(HyperelasticForm::kGent, {0.3}, {80.0}),
          st_venant_kirchhoff(1e6, 0.3)};
}

GradientDerivatives whole(const FiniteLaw& law, const Gradient5& g) {
  GradientDerivatives w = shape_energy(law, g);
  if (!law.rubber) return w;
  const GradientDerivatives J = volume_derivatives(g);
  const double pressure_Pa = law.bulk_Pa * volume_change(g);
  w.stress += pressure_Pa * J.stress;
  w.tangent += pressure_Pa * J.tangent + law.bulk_Pa * J.stress * J.stress.transpose();
  return w;
}

const std::vector<Gradient5>& gradients() {
  static const std::vector<Gradient5> kGradients = {
      Gradient5{0.1, -0.2, 0.15, 0.3, -0.25},
      Gradient5{0.02, 0.0, 0.02, 0.0, 0.02},  // equal stretches
      Gradient5{0.1, 0.05, -0.1, -0.05, 0.1}, Gradient5{-0.3, 0.4, 0.5, -0.1, 0.2}};
  return kGradients;
}

}  // namespace

TEST_CASE("the tangent of a law at large strain is the derivative of its stress",
          "[pillar][gradient]") {
  for (const FiniteLaw& law : laws_at(0.45)) {
    for (const Gradient5& g : gradients()) {
      const GradientDerivatives at = whole(law, g);
      const auto worst = [&](double h) {
        double most = 0.0;
        for (int j = 0; j < 5; ++j) {
          const Gradient5 step = h * Gradient5::Unit(j);
          const Gradient5 slope =
              (whole(law, g + step).stress - whole(law, g - step).stress) / (2.0 * h);
          most = std::max(most, (slope - at.tangent.col(j)).lpNorm<Eigen::Infinity>());
        }
        return most / at.tangent.lpNorm<Eigen::Infinity>();
      };
      INFO((law.rubber ? name_of(law.rubber->form) : std::string("St Venant-Kirchhoff")));
      // Central differences: an error of second order until rounding.
      CHECK(worst(1e-5) < 1e-9);
      CHECK(worst(2e-3) / worst(1e-3) == Approx(4.0).margin(0.1));
      CHECK((at.tangent - at.tangent.transpose()).norm() <= 1e-12 * at.tangent.norm());
    }
  }
}

TEST_CASE("the derivatives of the volume are those of its change", "[pillar][gradient]") {
  for (const Gradient5& g : gradients()) {
    const GradientDerivatives J = volume_derivatives(g);
    for (int j = 0; j < 5; ++j) {
      const Gradient5 step = 1e-4 * Gradient5::Unit(j);
      CHECK(J.stress[j] ==
            Approx((volume_change(g + step) - volume_change(g - step)) / 2e-4).margin(1e-11));
      const Gradient5 slope =
          (volume_derivatives(g + step).stress - volume_derivatives(g - step).stress) / 2e-4;
      CHECK((J.tangent.col(j) - slope).norm() < 1e-11);
    }
  }
  CHECK(volume_change(Gradient5{1e-12, 0.0, 1e-12, 0.0, 1e-12}) == Approx(3e-12).epsilon(1e-10));
}

TEST_CASE("a law at rest has the linear moduli of its E0 and Poisson ratio",
          "[pillar][reduction]") {
  for (const double nu : {0.0, 0.33, 0.49, 0.4999}) {
    for (const FiniteLaw& law : laws_at(nu)) {
      if (!law.rubber) continue;
      const double E_Pa = 2.0 * law.shear_Pa * (1.0 + nu);
      const double lame_Pa = law.bulk_Pa - 2.0 / 3.0 * law.shear_Pa;
      const Tangent5 tangent = whole(law, Gradient5::Zero()).tangent;
      CHECK(tangent(0, 0) == Approx(lame_Pa + 2.0 * law.shear_Pa).epsilon(1e-11));
      CHECK(tangent(0, 2) == Approx(lame_Pa).epsilon(1e-11).margin(1e-10 * E_Pa));
      CHECK(tangent(1, 3) == Approx(law.shear_Pa).epsilon(1e-11));
      CHECK(whole(law, Gradient5::Zero()).stress.norm() < 1e-12 * E_Pa);
    }
  }
  // The tension that was measured is kept.
  const HyperelasticLaw rubber{
      HyperelasticForm::kNeoHooke, Eigen::VectorXd::Constant(1, 0.2e6), {}};
  const FiniteLaw law = finite_law(rubber, 0.3);
  CHECK(2.0 * law.shear_Pa * 1.3 == Approx(youngs_modulus_Pa(rubber)).epsilon(1e-12));
}

TEST_CASE("the stress turns with the body", "[pillar][identity]") {
  const double angle = 0.7;
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (const FiniteLaw& law : laws_at(0.4)) {
    for (const Gradient5& g : gradients()) {
      Eigen::Matrix2d F;
      F << 1.0 + g[0], g[1], g[3], 1.0 + g[4];
      const Eigen::Matrix2d turned = R * F;
      const Gradient5 h{turned(0, 0) - 1.0, turned(0, 1), g[2], turned(1, 0), turned(1, 1) - 1.0};
      const Gradient5 before = whole(law, g).stress, after = whole(law, h).stress;
      Eigen::Matrix2d P, Q;
      P << before[0], before[1], before[3], before[4];
      Q << after[0], after[1], after[3], after[4];
      CHECK((Q - R * P).norm() <= 1e-10 * P.norm() + 1e-9 * law.shear_Pa * g.norm());
      CHECK(after[2] == Approx(before[2]).epsilon(1e-9).margin(1e-10 * law.shear_Pa));
    }
  }
}

TEST_CASE("a body turned inside out and a strain beyond Gent's limit have no stress", "[pillar]") {
  const FiniteLaw law = finite_law({HyperelasticForm::kGent, Eigen::VectorXd::Constant(1, 1e5),
                                    Eigen::VectorXd::Constant(1, 2.0)},
                                   0.45);
  CHECK(shape_energy(law, Gradient5::Zero()).stress.allFinite());
  CHECK_FALSE(shape_energy(law, Gradient5{-0.4, 0.0, -0.4, 0.0, 1.8}).stress.allFinite());
  CHECK_FALSE(shape_energy(law, Gradient5{0.0, 0.0, 0.0, 0.0, -1.1}).stress.allFinite());
  CHECK_FALSE(shape_energy(law, Gradient5{0.0, 0.0, -1.1, 0.0, 0.0}).stress.allFinite());
  CHECK_THROWS_WITH(finite_law(*law.rubber, -0.1), Catch::Contains("from 0 to 0.5"));
  CHECK_THROWS_WITH(st_venant_kirchhoff(1e6, 0.5), Catch::Contains("between -1 and 0.5"));
}
