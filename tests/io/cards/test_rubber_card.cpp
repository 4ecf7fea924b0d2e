// Cards of laws of rubber: text by each solver's convention, and CalculiX itself.
#include "io/cards/hyperelastic/rubber_card.h"
#include "tests/io/cards/rubber_cube.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

HyperelasticLaw law_of(HyperelasticForm form, std::vector<double> moduli_Pa,
                       std::vector<double> shapes) {
  return {
      form,
      Eigen::Map<Eigen::VectorXd>(moduli_Pa.data(), static_cast<Eigen::Index>(moduli_Pa.size())),
      Eigen::Map<Eigen::VectorXd>(shapes.data(), static_cast<Eigen::Index>(shapes.size()))};
}

std::string card_for(const HyperelasticLaw& law, const std::string& target,
                     std::optional<double> bulk_Pa = std::nullopt,
                     const std::string& units = "mm-t-s") {
  return rubber_card(
      law, {.target = target, .units = units, .bulk_Pa = bulk_Pa, .density_kg_m3 = 1100.0});
}

const HyperelasticLaw kOgden =
    law_of(HyperelasticForm::kOgden3, {3.45e5, 6.2e3, 4.2}, {1.9, -2.2, 8.5});

// The numbers of the data lines of a card, in order.
std::vector<double> numbers_in(const std::string& card) {
  std::istringstream lines(card);
  std::string line;
  std::vector<double> out;
  while (std::getline(lines, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    if (line.empty() || line.find_first_not_of(" +-.0123456789eE") != std::string::npos) continue;
    std::istringstream cells(line);
    for (double value = 0.0; cells >> value;) out.push_back(value);
  }
  return out;
}

// Nominal stress in tension of an incompressible body whose energy is written as a manual has it, by
// central differences: an error of some 1e-9 of the stress.
double tension(const std::function<double(double, double)>& energy, double stretch) {
  const auto at = [&](double x) { return energy(x, 1.0 / std::sqrt(x)); };
  const double step = 1e-5;
  return (at(stretch + step) - at(stretch - step)) / (2.0 * step);
}

double I1(double axial, double side) {
  return axial * axial + 2.0 * side * side;
}

double I2(double axial, double side) {
  return 1.0 / (axial * axial) + 2.0 / (side * side);
}

double power_sum(double axial, double side, double alpha) {
  return std::pow(axial, alpha) + 2.0 * std::pow(side, alpha) - 3.0;
}

// Arruda and Boyce (1993), eq. 24 of the five-term series.
double boyce(double mu, double limit, double invariant) {
  const double factors[] = {0.5, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0};
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) {
    sum +=
        factors[i] * (std::pow(invariant, i + 1) - std::pow(3.0, i + 1)) / std::pow(limit, 2 * i);
  }
  return mu * sum;
}

}  // namespace

TEST_CASE(
    "rubber cards: energies as the manuals write them, with the numbers of the card, give the "
    "law's stress",
    "[io]") {
  const double stretch = 1.7;
  const auto check = [&](const HyperelasticLaw& law, double precision,
                         const std::function<double(double, double)>& energy) {
    CAPTURE(name_of(law.form));
    const double stress_MPa = 1e-6 * nominal_stress_Pa(law, Deformation::kUniaxial, stretch);
    CHECK(tension(energy, stretch) == Approx(stress_MPa).epsilon(precision));
  };
  const HyperelasticLaw mooney = law_of(HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {});
  const HyperelasticLaw yeoh = law_of(HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {});
  const HyperelasticLaw chains = law_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2});
  SECTION("FrontISTR: C10 (I1 - 3) + C01 (I2 - 3)") {
    const auto c = numbers_in(card_for(mooney, "frontistr", 2e9));
    REQUIRE(c.size() == 4);
    check(mooney, 1e-8, [&](double a, double b) { return c[0] * I1(a, b) + c[1] * I2(a, b); });
    CHECK(c[2] == Approx(2.0 / 2000.0));
    CHECK(c[3] == Approx(1.1e-9));
    const auto n = numbers_in(card_for(chains, "frontistr"));
    REQUIRE(n.size() == 4);
    check(chains, 1e-8, [&](double a, double b) { return boyce(n[0], n[1], I1(a, b)); });
  }
  SECTION("LS-DYNA: sum C_pq, or mu_i/alpha_i; and the card states what ten columns cut off") {
    const auto c = numbers_in(card_for(yeoh, "lsdyna"));
    REQUIRE(c.size() == 10);
    check(yeoh, 1e-6, [&](double a, double b) {
      const double i = I1(a, b) - 3.0;
      return c[4] * i + c[7] * i * i + c[9] * i * i * i;
    });
    CHECK(c[2] == Approx((3.0 * 1000.0 - 2.0) / (6.0 * 1000.0 + 2.0)).epsilon(1e-7));
    const auto o = numbers_in(card_for(kOgden, "lsdyna"));
    REQUIRE(o.size() == 20);
    check(kOgden, 1e-6, [&](double a, double b) {
      double sum = 0.0;
      for (std::size_t i = 4; i < 12; ++i) {
        if (o[i] != 0.0) sum += o[i] / o[i + 8] * power_sum(a, b, o[i + 8]);
      }
      return sum;
    });
  }
  SECTION("LS-DYNA: what ten columns cut off") {
    const HyperelasticLaw law =
        law_of(HyperelasticForm::kOgden3, {3.4512345e5, 6.2345678e3, 4.2345678},
               {1.91234567, -2.2345678, 8.5123456});
    const std::string card = card_for(law, "lsdyna");
    const std::string words = "by at most ";
    REQUIRE(card.find(words) != std::string::npos);
    const double stated = std::stod(card.substr(card.find(words) + words.size()));
    double largest = 0.0;
    const auto numbers = numbers_in(card);
    for (int i = 0; i < 3; ++i) {
      const double mu_MPa = 2e-6 * law.moduli_Pa[i] / law.shapes[i];
      const auto at = static_cast<std::size_t>(4 + i);
      largest = std::max({largest, std::abs(numbers[at] / mu_MPa - 1.0),
                          std::abs(numbers[at + 8] / law.shapes[i] - 1.0)});
    }
    CHECK(largest > 1e-6);
    CHECK(stated == Approx(largest).epsilon(0.06));  // two digits
  }
  SECTION("OpenRadioss: LAW82 with 2 mu/alpha^2, LAW94, LAW92") {
    const auto o = numbers_in(card_for(mooney, "openradioss"));
    REQUIRE(o.size() == 9);  // density, N, nu, two mu, two alpha, two D
    check(mooney, 1e-8, [&](double a, double b) {
      return 2.0 * o[3] / (o[5] * o[5]) * power_sum(a, b, o[5]) +
             2.0 * o[4] / (o[6] * o[6]) * power_sum(a, b, o[6]);
    });
    const auto y = numbers_in(card_for(yeoh, "openradioss"));
    REQUIRE(y.size() == 7);
    check(yeoh, 1e-8, [&](double a, double b) {
      const double i = I1(a, b) - 3.0;
      return y[1] * i + y[2] * i * i + y[3] * i * i * i;
    });
    const auto n = numbers_in(card_for(chains, "openradioss"));
    REQUIRE(n.size() == 8);
    check(chains, 1e-8, [&](double a, double b) { return boyce(n[1], n[3], I1(a, b)); });
  }
}

TEST_CASE("rubber cards: CalculiX gives the nominal stress of the law in every deformation",
          "[io][golden]") {
  const std::vector<HyperelasticLaw> laws{
      law_of(HyperelasticForm::kNeoHooke, {2e5}, {}),
      law_of(HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {}),
      law_of(HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {}),
      law_of(HyperelasticForm::kOgden1, {3e5}, {2.9}),
      law_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.0}),
      kOgden,
      law_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2})};
  const double stretch = 1.8;
  for (const HyperelasticLaw& law : laws) {
    // Two bulk moduli; their answers are extrapolated to an incompressible body.
    const double shear_Pa = youngs_modulus_Pa(law) / 3.0;
    for (const auto deformation :
         {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
      CAPTURE(name_of(law.form), name_of(deformation));
      const auto force_N = [&](double ratio) {
        return run_in_calculix(
            cube_deck(card_for(law, "calculix", ratio * shear_Pa), deformation, stretch));
      };
      const double soft_N = force_N(4e3), hard_N = force_N(8e3);
      const double stress_MPa = 1e-6 * nominal_stress_Pa(law, deformation, stretch);
      CHECK(2.0 * hard_N - soft_N == Approx(stress_MPa).epsilon(2e-6));
      CHECK(soft_N == Approx(stress_MPa).epsilon(1e-3));
    }
  }
}

TEST_CASE("rubber cards: each solver's convention", "[io]") {
  CHECK(card_for(kOgden, "abaqus") ==
        "*MATERIAL, NAME=RUBBER\n*DENSITY\n1.1e-09,\n*HYPERELASTIC, OGDEN, N=3\n"
        "0.345, 1.9, 0.0062, -2.2, 4.2e-06, 8.5, 0, 0\n0\n");
  CHECK_THAT(card_for(kOgden, "febio", 2e9, "SI"),
             Contains("type=\"Ogden\"") && Contains("<c1>690000</c1>") &&
                 Contains("<m2>-2.2</m2>") && Contains("<k>2000000000</k>"));
  // Ogden's own constants: 2 mu/alpha.
  CHECK_THAT(
      card_for(law_of(HyperelasticForm::kOgden2, {3e5, 4e4}, {2.0, -2.0}), "ansys"),
      Contains("TB,HYPER,1,1,2,OGDEN\nTBDATA,1,0.3\nTBDATA,2,2\nTBDATA,3,-0.04\nTBDATA,4,-2\n"
               "TBDATA,5,0\n"));
  CHECK_THAT(card_for(law_of(HyperelasticForm::kNeoHooke, {2e5}, {}), "ansys"),
             Contains("TB,HYPER,1,1,,NEO\nTBDATA,1,0.4\nTBDATA,2,0\n"));
  // 2e5/2, 2e5/20/9 and 2e5 11/1050/81 Pa: FEBio's own Arruda-Boyce has the factor i twice.
  CHECK_THAT(card_for(law_of(HyperelasticForm::kArrudaBoyce, {2e5}, {3.0}), "febio", 2e9, "SI"),
             Contains("type=\"uncoupled hyperelastic\"") &&
                 Contains("<W>100000*(I1-3)+1111.111111111111*(I1^2-9)+25.8671369782") &&
                 Contains("*(I1^3-27)+") && Contains("*(I1^4-81)+") && Contains("*(I1^5-243)</W>"));
  CHECK_THAT(card_for(law_of(HyperelasticForm::kGent, {2.7e5}, {80.0}), "febio"),
             Contains("type=\"Gent\"") && Contains("<G>0.27</G>") && Contains("<Jm>80</Jm>"));
}

TEST_CASE("rubber cards: what a solver cannot take is refused", "[io]") {
  const HyperelasticLaw gent = law_of(HyperelasticForm::kGent, {2.7e5}, {80.0});
  CHECK_THROWS_WITH(card_for(gent, "abaqus"), Contains("abaqus has no gent law"));
  CHECK_NOTHROW(card_for(gent, "ansys"));
  CHECK_THROWS_WITH(card_for(kOgden, "calculix", 1e12, "SI"), Contains("below 1e-10"));
  CHECK_THROWS_WITH(card_for(kOgden, "sofa"), Contains("no card of rubber for 'sofa'"));
  CHECK_THROWS_WITH(card_for(kOgden, "febio", -1.0), Contains("the bulk modulus"));
  CHECK_THROWS_WITH(card_for(kOgden, "frontistr"), Contains("frontistr has no ogden-3 law"));
  CHECK_THROWS_WITH(
      card_for(law_of(HyperelasticForm::kNeoHooke, {2e5}, {}), "frontistr", 3e12, "SI"),
      Contains("up to 1e-12 for 1/D"));
  CHECK_THROWS_WITH(card_for(law_of(HyperelasticForm::kArrudaBoyce, {2e5}, {3.0}), "lsdyna"),
                    Contains("lsdyna has no arruda-boyce law"));
  CHECK_THROWS_WITH(rubber_card(kOgden, {.target = "lsdyna"}), Contains("--density"));
  CHECK_THROWS_WITH(rubber_card(kOgden, {.target = "openradioss", .density_kg_m3 = -1.0}),
                    Contains("the density"));
}
