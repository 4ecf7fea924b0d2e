#include "models/hyperelastic/law_energy.h"
#include "models/hyperelastic/mullins_damage.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

Eigen::VectorXd row_of(std::initializer_list<double> values) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) out[i++] = value;
  return out;
}

// The reference numbers are in MPa, computed with numpy from the formulas of the headers, independently
// of this program.
HyperelasticLaw reference_yeoh() {
  return {HyperelasticForm::kYeoh, row_of({0.3e6, -0.01e6, 0.001e6}), {}};
}
HyperelasticLaw reference_ogden() {
  return {HyperelasticForm::kOgden2, row_of({0.5e6, 0.1e6}), row_of({1.5, 5.0})};
}
constexpr MullinsDamage kReference{1.6, 0.15e6, 0.1};
const std::vector<double> kPath{1.5, 2.0, 1.8, 1.5, 1.2, 1.6, 1.9, 2.5};

void check_path(const std::vector<double>& stress_Pa, const std::vector<double>& reference_MPa) {
  REQUIRE(stress_Pa.size() == reference_MPa.size());
  for (std::size_t i = 0; i < stress_Pa.size(); ++i) {
    CAPTURE(i);
    CHECK(1e-6 * stress_Pa[i] == Approx(reference_MPa[i]).epsilon(6e-9));  // nine printed digits
  }
}

double energy_at(const HyperelasticLaw& law, Deformation deformation, double s) {
  return energy_Pa(law, std::log(s) * strain_direction(deformation));
}

}  // namespace

TEST_CASE("mullins: stresses along a path are the reference numbers", "[models][mullins]") {
  const HyperelasticLaw yeoh = reference_yeoh();
  check_path(nominal_stress_Pa(yeoh, kReference, Deformation::kUniaxial, kPath),
             {0.610858796, 0.952, 0.426862392, 0.231644975, 0.113000392, 0.269391086, 0.629462654,
              1.2552111});
  check_path(nominal_stress_Pa(yeoh, kReference, Deformation::kPlanar, kPath),
             {0.692268947, 1.01320312, 0.452605274, 0.261433868, 0.138582502, 0.296917284,
              0.666745285, 1.31614303});
  check_path(nominal_stress_Pa(yeoh, kReference, Deformation::kEquibiaxial, kPath),
             {0.7517352, 1.08531958, 0.378477257, 0.281905038, 0.175476366, 0.304859415,
              0.568723942, 1.90067863});
  const HyperelasticLaw ogden = reference_ogden();
  check_path(nominal_stress_Pa(ogden, kReference, Deformation::kUniaxial, kPath),
             {0.68141383, 1.38107232, 0.478016028, 0.255989606, 0.115337966, 0.304465056,
              0.762729241, 2.48084723});
  check_path(nominal_stress_Pa(ogden, kReference, Deformation::kEquibiaxial, kPath),
             {0.886846897, 1.54112284, 0.480486996, 0.332567674, 0.182383187, 0.376305893,
              0.693754701, 2.59952421});
}

TEST_CASE("mullins: simple shear follows from the planar test", "[models][mullins]") {
  // With the stretch l of the shear, gamma = l - 1/l, the shear stress is P_planar l^2/(1 + l^2).
  std::vector<double> stretch;
  for (const double s : kPath) {
    const double gamma = s - 1.0;
    stretch.push_back(0.5 * gamma + std::sqrt(1.0 + 0.25 * gamma * gamma));
  }
  std::vector<double> shear_Pa =
      nominal_stress_Pa(reference_yeoh(), kReference, Deformation::kPlanar, stretch);
  for (std::size_t i = 0; i < shear_Pa.size(); ++i) {
    const double square = stretch[i] * stretch[i];
    shear_Pa[i] *= square / (1.0 + square);
  }
  check_path(shear_Pa, {0.2951875, 0.566, 0.293272144, 0.12678168, 0.0469439332, 0.163974082,
                        0.408178693, 0.8105625});
}

TEST_CASE("mullins: energies, the energy lost and the modulus at rest are the reference numbers",
          "[models][mullins]") {
  const HyperelasticLaw yeoh = reference_yeoh();
  const double top_Pa = energy_at(yeoh, Deformation::kUniaxial, 2.0);
  const double low_Pa = energy_at(yeoh, Deformation::kUniaxial, 1.2);
  CHECK(top_Pa == Approx(0.568e6).epsilon(1e-12));
  CHECK(low_Pa == Approx(0.0318874358519e6).epsilon(1e-11));
  CHECK(lost_energy_Pa(kReference, low_Pa, top_Pa) == Approx(0.262154298439e6).epsilon(1e-11));
  CHECK(lost_energy_Pa(kReference, 0.0, top_Pa) == Approx(0.282080664148e6).epsilon(1e-11));
  CHECK(softening_factor(kReference, 0.0, top_Pa) == Approx(0.375064140625).epsilon(1e-11));
  CHECK(softening_factor(kReference, top_Pa, top_Pa) == 1.0);
}

TEST_CASE("mullins: a closed path loses the stated energy and never gains any",
          "[models][mullins]") {
  const HyperelasticLaw ogden = reference_ogden();
  for (const auto deformation :
       {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
    std::vector<double> stretch;
    constexpr int kSteps = 4000;
    for (int i = 0; i <= kSteps; ++i) stretch.push_back(1.0 + 1.0 * i / kSteps);
    for (int i = kSteps - 1; i >= 0; --i) stretch.push_back(1.0 + 1.0 * i / kSteps);
    const std::vector<double> stress_Pa =
        nominal_stress_Pa(ogden, kReference, deformation, stretch);
    double work_Pa = 0.0;
    for (std::size_t i = 1; i < stretch.size(); ++i) {
      work_Pa += 0.5 * (stress_Pa[i] + stress_Pa[i - 1]) * (stretch[i] - stretch[i - 1]);
    }
    work_Pa *= n_loaded_directions(deformation);
    const double top_Pa = energy_at(ogden, deformation, 2.0);
    CAPTURE(name_of(deformation));
    CHECK(work_Pa == Approx(lost_energy_Pa(kReference, 0.0, top_Pa)).epsilon(1e-5));
    CHECK(work_Pa > 0.0);
  }
}

TEST_CASE("mullins: the slope jumps at the turning point by its closed form", "[models][mullins]") {
  const HyperelasticLaw yeoh = reference_yeoh();
  constexpr double kStep = 1e-6;
  const auto back = nominal_stress_Pa(yeoh, kReference, Deformation::kUniaxial, {2.0, 2.0 - kStep});
  CHECK(1e-6 * (back[0] - back[1]) / kStep == Approx(3.67271129).epsilon(1e-4));
  const auto on = nominal_stress_Pa(yeoh, kReference, Deformation::kUniaxial, {2.0, 2.0 + kStep});
  CHECK(1e-6 * (on[1] - on[0]) / kStep == Approx(0.582).epsilon(1e-5));
}

TEST_CASE("mullins: with a large r it is the law itself", "[models][mullins][reduction]") {
  const auto soft = nominal_stress_Pa(reference_ogden(), MullinsDamage{1e12, 0.15e6, 0.1},
                                      Deformation::kPlanar, kPath);
  for (std::size_t i = 0; i < kPath.size(); ++i) {
    CHECK(soft[i] == Approx(nominal_stress_Pa(reference_ogden(), Deformation::kPlanar, kPath[i]))
                         .epsilon(1e-11));
  }
}

TEST_CASE("mullins: the slope of the energy is the stress, of every law, and so are its shapes'",
          "[models][mullins]") {
  const std::vector<HyperelasticLaw> laws{
      {HyperelasticForm::kNeoHooke, row_of({2e5}), {}},
      {HyperelasticForm::kMooneyRivlin, row_of({1.5e5, 2e4}), {}},
      reference_yeoh(),
      {HyperelasticForm::kOgden1, row_of({3e5}), row_of({-2.0})},
      reference_ogden(),
      {HyperelasticForm::kOgden3, row_of({4e5, 3e3, 9.8e3}), row_of({1.3, 1e-6, -2.0})},
      {HyperelasticForm::kArrudaBoyce, row_of({2.7e5}), row_of({5.2})},
      {HyperelasticForm::kGent, row_of({2.7e5}), row_of({80.0})}};
  for (const HyperelasticLaw& law : laws) {
    for (const double s : {0.6, 1.001, 1.02, 1.9, 3.0}) {
      for (const auto deformation :
           {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
        CAPTURE(name_of(law.form), name_of(deformation), s);
        const double step = 1e-4 * s;
        // Fourth order in the step.
        const auto at = [&](double k) { return energy_at(law, deformation, s + k * step); };
        const double slope = (8.0 * (at(1) - at(-1)) - at(2) + at(-2)) / (12.0 * step) /
                             n_loaded_directions(deformation);
        CHECK(slope == Approx(nominal_stress_Pa(law, deformation, s)).epsilon(1e-7));
        const Eigen::Vector3d strain = std::log(s) * strain_direction(deformation);
        const EnergyColumns columns = energy_columns(law.form, law.shapes, strain);
        for (Eigen::Index k = 0; k < law.shapes.size(); ++k) {
          constexpr double kShape = 1e-4;
          Eigen::VectorXd up = law.shapes, down = law.shapes;
          up[k] += kShape;
          down[k] -= kShape;
          const Eigen::VectorXd change = (energy_columns(law.form, up, strain).values -
                                          energy_columns(law.form, down, strain).values) /
                                         (2.0 * kShape);
          const double scale = columns.values.cwiseAbs().maxCoeff();
          for (Eigen::Index j = 0; j < change.size(); ++j) {
            CHECK(columns.shape_slopes(j, k) ==
                  Approx(change[j]).epsilon(1e-5).margin(1e-8 * scale));
          }
        }
      }
    }
  }
}

TEST_CASE("mullins: constants out of range are refused by name", "[models][mullins]") {
  CHECK_NOTHROW(validate(MullinsDamage{1.1, 0.0, 0.2}));
  CHECK_THROWS_WITH(validate(MullinsDamage{1.0, 1e5, 0.0}), Contains("r of mullins-or is 1"));
  CHECK_THROWS_WITH(validate(MullinsDamage{1.5, -1.0, 0.0}), Contains("m of mullins-or"));
  CHECK_THROWS_WITH(validate(MullinsDamage{1.5, 1e5, -0.1}), Contains("beta of mullins-or"));
  CHECK_THROWS_WITH(validate(MullinsDamage{1.5, 0.0, 0.0}), Contains("both 0"));
}
