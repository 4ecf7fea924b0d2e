// Cards of laws of rubber for MFront: the formula of their stress by a second implementation, and MTest
// itself where it is installed.
#include "io/cards/hyperelastic/rubber_card.h"
#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace viscard;

namespace {

struct PointLaw {
  HyperelasticForm form;
  std::vector<double> moduli_Pa, shapes;

  HyperelasticLaw law() const {
    const auto vector = [](const std::vector<double>& from) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
    };
    return {form, vector(moduli_Pa), vector(shapes)};
  }
};

const std::vector<PointLaw>& point_laws() {
  static const std::vector<PointLaw> kLaws{
      {HyperelasticForm::kNeoHooke, {2e5}, {}},
      {HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {}},
      {HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {}},
      {HyperelasticForm::kOgden1, {3e5}, {2.9}},
      {HyperelasticForm::kOgden3, {3.45e5, 6.2e3, 4.2}, {1.9, -2.2, 8.5}},
      {HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2}},
      {HyperelasticForm::kGent, {2.7e5}, {80.0}}};
  return kLaws;
}

std::string behaviour_of(const HyperelasticLaw& law, double bulk_Pa) {
  return rubber_card(law, {.target = "mfront", .units = "mm-t-s", .bulk_Pa = bulk_Pa});
}

class PointFolder {
 public:
  PointFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "viscard-point-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~PointFolder() { std::filesystem::remove_all(path_); }
  PointFolder(const PointFolder&) = delete;
  PointFolder& operator=(const PointFolder&) = delete;

  // The library of an MFront behaviour.
  void build(const std::string& card) const {
    std::ofstream(path_ / "card.mfront") << card;
    REQUIRE(std::system(("cd '" + path_.string() +
                         "' && mfront --obuild --interface=generic card.mfront >log 2>&1")
                            .c_str()) == 0);
  }
  // Nominal stress of that behaviour along z in MTest: Cauchy stress times both other stretches.
  double point_stress(Deformation deformation, double stretch, double bulk) const {
    std::ostringstream test;
    test << "@Behaviour<generic> 'src/libBehaviour.so' 'RUBBER';\n@Parameter 'K' " << bulk
         << ";\n@ExternalStateVariable 'Temperature' 293.15;\n";
    const auto impose = [&test](const std::string& component, double last, double first) {
      test << "@ImposedDeformationGradient '" << component << "' {0: " << first << ", 1: " << last
           << "};\n";
    };
    impose("FZZ", stretch, 1.0);
    if (deformation == Deformation::kPlanar) impose("FYY", 1.0, 1.0);
    if (deformation == Deformation::kEquibiaxial) impose("FXX", stretch, 1.0);
    for (const char* shear : {"FXY", "FYX", "FXZ", "FZX", "FYZ", "FZY"}) impose(shear, 0.0, 0.0);
    return nominal_stresses(test.str() + "@Times {0, 1 in 10};\n").back();
  }
  // Nominal stresses of 40 steps of a uniaxial ramp of half a second to 1.8, and at 1 s and 6 s of a hold.
  std::vector<double> held_stresses(double bulk) const {
    std::ostringstream test;
    test << "@Behaviour<generic> 'src/libBehaviour.so' 'RUBBER';\n@Parameter 'K' " << bulk
         << ";\n@ExternalStateVariable 'Temperature' 293.15;\n"
         << "@ImposedDeformationGradient 'FZZ' {0: 1, 0.5: 1.8, 6: 1.8};\n";
    for (const char* shear : {"FXY", "FYX", "FXZ", "FZX", "FYZ", "FZY"})
      test << "@ImposedDeformationGradient '" << shear << "' 0;\n";
    return nominal_stresses(test.str() + "@Times {0, 0.5 in 40, 1 in 1, 6 in 1};\n");
  }

 private:
  // Nominal stresses along z of all steps of an MTest file.
  std::vector<double> nominal_stresses(const std::string& test) const {
    std::ofstream(path_ / "point.mtest")
        << test << "@OutputFilePrecision 15;\n@OutputFile 'point.res';\n";
    REQUIRE(std::system(("cd '" + path_.string() + "' && mtest point.mtest >log 2>&1").c_str()) ==
            0);
    std::ifstream lines(path_ / "point.res");
    std::vector<double> out;
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream cells(line);
      std::vector<double> row;
      for (double value = 0.0; cells >> value;) row.push_back(value);
      REQUIRE(row.size() >= 16);  // time, nine of F, six stresses XX YY ZZ ...
      if (row[0] > 0.0) out.push_back(row[12] * row[1] * row[2]);
    }
    REQUIRE(!out.empty());
    return out;
  }

  std::filesystem::path path_;
};

// Values of "@Parameter real name = v;" or "@Parameter real name[Nt] = {v, v};".
std::vector<double> parameters(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("@Parameter real " + name), from = text.find('=', at);
  REQUIRE(at != std::string::npos);
  std::string cells = text.substr(from + 1, text.find(';', from) - from - 1);
  std::replace_if(
      cells.begin(), cells.end(), [](char c) { return c == '{' || c == '}' || c == ','; }, ' ');
  std::istringstream stream(cells);
  std::vector<double> out;
  for (double value = 0.0; stream >> value;) out.push_back(value);
  return out;
}

// Nominal stress in tension from the numbers of an MFront card by its formula of S, with the pressure of
// free sides in place of K: s = lambda (S_1 - S_2 lambda_2^2/lambda_1^2) at J = 1.
double mfront_tension(const std::string& card, double stretch) {
  const double c1 = stretch * stretch, c2 = 1.0 / stretch;
  double S1 = 0.0, S2 = 0.0;
  if (card.find("alpha[Nt]") != std::string::npos) {
    const auto mu = parameters(card, "mu[Nt]"), alpha = parameters(card, "alpha[Nt]");
    for (std::size_t i = 0; i < mu.size(); ++i) {
      S1 += 2.0 * mu[i] / alpha[i] * std::pow(c1, alpha[i] / 2.0 - 1.0);
      S2 += 2.0 * mu[i] / alpha[i] * std::pow(c2, alpha[i] / 2.0 - 1.0);
    }
  } else {
    const double x = c1 + 2.0 * c2 - 3.0;
    double W1 = 0.0, W2 = 0.0;
    if (card.find(" J_m ") != std::string::npos) {
      W1 = 0.5 * parameters(card, "mu")[0] / (1.0 - x / parameters(card, "J_m")[0]);
    } else if (card.find(" s_m ") != std::string::npos) {
      const double s2 = std::pow(parameters(card, "s_m")[0], 2);
      const double factors[] = {0.5, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0};
      for (int i = 1; i <= 5; ++i) {
        W1 += parameters(card, "mu")[0] * i * factors[i - 1] * std::pow((x + 3.0) / s2, i - 1);
      }
    } else {
      W1 = parameters(card, "C10")[0];
      if (card.find(" C01 ") != std::string::npos) W2 = parameters(card, "C01")[0];
      if (card.find(" C20 ") != std::string::npos) {
        W1 += 2.0 * parameters(card, "C20")[0] * x + 3.0 * parameters(card, "C30")[0] * x * x;
      }
    }
    S1 = 2.0 * (W1 + W2 * (c1 + 2.0 * c2 - c1));
    S2 = 2.0 * (W1 + W2 * (c1 + 2.0 * c2 - c2));
  }
  return stretch * (S1 - S2 * c2 / c1);
}

}  // namespace

TEST_CASE("rubber cards: MFront's numbers with the formula of its stress give the law's stress",
          "[io]") {
  const double stretch = 1.8;
  for (const PointLaw& point : point_laws()) {
    const HyperelasticLaw law = point.law();
    CAPTURE(name_of(law.form));
    const std::string card = behaviour_of(law, 2e9);
    CHECK(parameters(card, "K") == std::vector<double>{2000.0});
    CHECK(mfront_tension(card, stretch) ==
          Approx(1e-6 * nominal_stress_Pa(law, Deformation::kUniaxial, stretch)).epsilon(1e-12));
  }
}

// Formula (2) of finite_viscoelasticity.h with what stands in the behaviour.
TEST_CASE("rubber cards: MFront's terms with the recursion of its H give the law's stress",
          "[io]") {
  using namespace viscard::test;
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    const std::string card = card_of(rubber, "mfront");
    Written law;
    if (card.find("alpha[Nt]") != std::string::npos) {
      law.energy = ogden_energy(parameters(card, "mu[Nt]"), parameters(card, "alpha[Nt]"),
                                [](double mu, double alpha) { return 2.0 * mu / (alpha * alpha); });
    } else {
      std::vector<double> c = parameters(card, "C10");
      if (card.find(" C20 ") != std::string::npos) {
        c.push_back(parameters(card, "C20")[0]);
        c.push_back(parameters(card, "C30")[0]);
      }
      law.energy = [c](double a, double b) {
        const double x = a * a + 2.0 * b * b - 3.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * std::pow(x, double(i + 1));
        return sum;
      };
    }
    law.g = parameters(card, "g[Nv]");
    law.tau = parameters(card, "tau[Nv]");
    Recursion rule{1.0, [](double x) { return (1.0 - std::exp(-x)) / x; }};
    for (const double g : law.g) rule.share -= g;
    const auto expected_MPa = fitted_MPa(rubber);
    for (std::size_t i = 0; i < rule_times_s().size(); ++i)
      CHECK(recursive_stress(law, rule, rule_times_s()[i]) ==
            Approx(expected_MPa[i]).epsilon(2e-6));
  }
}

TEST_CASE("rubber cards: MTest relaxes the law with its terms where it is installed",
          "[io][slow]") {
  using namespace viscard::test;
  if (std::system("command -v mtest >/dev/null && command -v mfront >/dev/null") != 0) {
    WARN("mtest and mfront are not installed; they are not run");
    return;
  }
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    const PointFolder folder;
    folder.build(card_of(rubber, "mfront"));
    const double bulk_MPa = 4e-3 * youngs_modulus_Pa(rubber.law) / 3.0;
    const auto soft_MPa = folder.held_stresses(bulk_MPa),
               hard_MPa = folder.held_stresses(2.0 * bulk_MPa);
    Course history{{0.0, 1.0}};
    for (int i = 1; i <= 42; ++i) {
      history.push_back({i <= 40   ? 0.5 * i / 40
                         : i == 41 ? 1.0
                                   : 6.0,
                         1.0 + 0.8 * std::min(i, 40) / 40.0});
    }
    const auto exact_Pa =
        nominal_stress_Pa(rubber.law, rubber.terms, Deformation::kUniaxial, history);
    REQUIRE(soft_MPa.size() == 42);
    for (const std::size_t step :
         {std::size_t{20}, std::size_t{40}, std::size_t{41}, std::size_t{42}})
      CHECK(2.0 * hard_MPa[step - 1] - soft_MPa[step - 1] ==
            Approx(1e-6 * exact_Pa[step]).epsilon(5e-6));
  }
}

// Where TFEL is installed: builds the behaviour and drives one point of it by MTest, with K and 2 K.
TEST_CASE("rubber cards: MTest gives the nominal stress of every law where it is installed",
          "[io][slow]") {
  if (std::system("command -v mtest >/dev/null && command -v mfront >/dev/null") != 0) {
    WARN("mtest and mfront are not installed; they are not run");
    return;
  }
  const double stretch = 1.8, ratio = 4e3;
  for (const PointLaw& point : point_laws()) {
    const HyperelasticLaw law = point.law();
    CAPTURE(name_of(law.form));
    const PointFolder folder;
    const double shear_Pa = youngs_modulus_Pa(law) / 3.0;
    folder.build(behaviour_of(law, ratio * shear_Pa));
    for (const auto deformation :
         {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
      CAPTURE(name_of(deformation));
      const double soft_MPa = folder.point_stress(deformation, stretch, 1e-6 * ratio * shear_Pa),
                   hard_MPa = folder.point_stress(deformation, stretch, 2e-6 * ratio * shear_Pa);
      const double exact_MPa = 1e-6 * nominal_stress_Pa(law, deformation, stretch);
      CHECK(2.0 * hard_MPa - soft_MPa == Approx(exact_MPa).epsilon(2e-6));
    }
  }
}
