// Cards for vibration: their text is read here without viscard's readers, and evaluated by the
// formulas of the solvers' manuals.
#include "io/cards/card.h"
#include "io/cards/card_values.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/frequency_band.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

constexpr double kPi = std::numbers::pi;

// G* by the textbook's sum of Maxwell elements, in Pa.
std::complex<double> shear_Pa(const Material& material, double f_Hz) {
  const double G0_Pa = material.E0_Pa / (2.0 * (1.0 + material.nu));
  std::complex<double> sum = 1.0;
  for (const MaterialTerm& term : material.terms) {
    sum -= term.g / (1.0 + std::complex<double>(0.0, 2.0 * kPi * f_Hz * term.tau_s));
  }
  return G0_Pa * sum;
}

Card card_of(const Material& material, const char* target, FrequencyBand band,
             const char* units = "mm-t-s") {
  return write_card(material, card_target(target),
                    {.units = units, .may_approximate = true, .band = band});
}

// The numbers of all lines that do not start with one of the signs, in rows.
std::vector<std::vector<double>> rows_of(const std::string& text, const std::string& signs) {
  std::vector<std::vector<double>> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || signs.find(line[0]) != std::string::npos) continue;
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream cells(line);
    rows.emplace_back();
    for (double value = 0.0; cells >> value;) rows.back().push_back(value);
  }
  return rows;
}

std::string findings_of(const std::string& text, const char* target, const Material& material) {
  std::string names;
  const CardCheck check = check_card(text, card_target(target), {}, &material);
  for (const CardFinding& finding : check.findings) {
    names += (names.empty() ? "" : "; ") + finding.name + ": " + finding.text;
  }
  CHECK(check.agrees == names.empty());
  return names;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

Material wide_material() {
  Material material = material_of_terms(9, 0.4);  // 1 ms to 0.6 s
  material.valid = {};
  return material;
}

}  // namespace

TEST_CASE("an Abaqus table gives the complex modulus by the formulas of its manual", "[cards]") {
  // Materials Guide, frequency domain viscoelasticity: G_s = G_inf (1 - Im(wg*)),
  // G_l = G_inf Re(wg*), f in cycles per time; K likewise.
  Material material = wide_material();
  for (MaterialTerm& term : material.terms) term.k = 0.3 * term.g;
  material.provenance.bulk_origin = "measured";
  for (const char* units : {"SI", "mm-t-s", "mm-kg-ms"}) {
    const Card card = card_of(material, "abaqus-table", {0.1, 2000.0}, units);
    const auto rows = rows_of(card.text, "*");
    const double E = rows.at(1).at(0), nu = rows.at(1).at(1);  // rows[0] is the density
    const double G_inf = E / (2.0 * (1.0 + nu)), K_inf = E / (3.0 * (1.0 - 2.0 * nu));
    const double to_Pa = from_card(1.0, unit_system(units).stress_exponent);
    const double to_Hz = from_card(1.0, -unit_system(units).time_exponent);
    const double K0_Pa = material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));
    REQUIRE(rows.size() == 2 + 88);  // 20 for each of 4.3 decades, and the last one
    for (std::size_t i = 2; i < rows.size(); ++i) {
      const std::vector<double>& row = rows[i];
      REQUIRE(row.size() == 5);
      const double f_Hz = row[4] * to_Hz;
      const auto exact = shear_Pa(material, f_Hz);
      CHECK(G_inf * (1.0 - row[1]) * to_Pa == Approx(exact.real()).epsilon(1e-12));
      CHECK(G_inf * row[0] * to_Pa == Approx(exact.imag()).epsilon(1e-10));
      std::complex<double> bulk = 1.0;
      for (const MaterialTerm& term : material.terms) {
        bulk -= term.k / (1.0 + std::complex<double>(0.0, 2.0 * kPi * f_Hz * term.tau_s));
      }
      CHECK(K_inf * (1.0 - row[3]) * to_Pa == Approx(K0_Pa * bulk.real()).epsilon(1e-12));
      CHECK(K_inf * row[2] * to_Pa == Approx(K0_Pa * bulk.imag()).epsilon(1e-10));
    }
    CHECK(rows[2][4] * to_Hz == Approx(0.1).epsilon(1e-12));
    CHECK(rows.back()[4] * to_Hz == Approx(2000.0).epsilon(1e-12));
  }
}

TEST_CASE("Abaqus' Prony series in the frequency domain stands beside the long-term modulus",
          "[cards]") {
  const Material material = reference_material();
  const Card card = write_card(material, card_target("abaqus-frequency"), {.units = "SI"});
  const auto rows = rows_of(card.text, "*");
  REQUIRE(rows.size() == 4);
  CHECK(rows[1][0] == Approx(1.88e6 * (1.0 - 0.008206 - 0.01386)).epsilon(1e-14));
  CHECK_THAT(card.text, Contains("*ELASTIC, MODULI=LONG TERM") &&
                            Contains("*VISCOELASTIC, FREQUENCY=PRONY\n0.008206, 0.008206, 0.1945"));
  CHECK_THAT(
      findings_of(replaced(card.text, "LONG TERM", "INSTANTANEOUS"), "abaqus-frequency", material),
      Contains("instantaneous-in-frequency-domain"));
  CHECK_THAT(
      findings_of(replaced(card.text, "\n1838515.92", "\n1880000"), "abaqus-frequency", material),
      Contains("instantaneous-modulus-as-long-term"));
  CHECK_THROWS_WITH(findings_of(replaced(card.text, "FREQUENCY=PRONY", "TIME=PRONY"),
                                "abaqus-frequency", material),
                    Contains("only *VISCOELASTIC, FREQUENCY=PRONY"));
}

TEST_CASE("ANSYS and COMSOL tables give the complex modulus", "[cards]") {
  const Material material = wide_material();
  std::vector<double> f, E, eta;
  std::istringstream ansys(card_of(material, "ansys-table", {1.0, 100.0}).text);
  bool is_damping = false;
  for (std::string line; std::getline(ansys, line);) {
    if (line.rfind("TB,SDAMP,1,,1,STRU", 0) == 0) is_damping = true;
    const std::string last = line.substr(line.rfind(',') + 1);
    if (line.rfind("TBFIELD,FREQ,", 0) == 0 && !is_damping) f.push_back(std::stod(last));
    if (line.rfind("TBDATA,1,", 0) != 0) continue;
    (is_damping ? eta : E).push_back(std::stod(line.substr(9)));
    if (!is_damping) CHECK(std::stod(last) == 0.4);
  }
  REQUIRE(f.size() == 41);
  REQUIRE(E.size() == f.size());
  REQUIRE(eta.size() == f.size());
  for (std::size_t i = 0; i < f.size(); ++i) {
    const auto exact_MPa = 1e-6 * 2.0 * 1.4 * shear_Pa(material, f[i]);  // constant nu: E = 2.8 G
    CHECK(E[i] == Approx(exact_MPa.real()).epsilon(1e-12));
    CHECK(E[i] * eta[i] == Approx(exact_MPa.imag()).epsilon(1e-10));
  }
  const auto rows = rows_of(card_of(material, "comsol-table", {1.0, 100.0}, "mm-kg-ms").text, "%");
  REQUIRE(rows.size() == 41);
  for (const std::vector<double>& row : rows) {  // kHz and GPa
    const auto exact_GPa = 1e-9 * shear_Pa(material, 1e3 * row.at(0));
    CHECK(row.at(1) == Approx(exact_GPa.real()).epsilon(1e-12));
    CHECK(row.at(2) == Approx(exact_GPa.imag()).epsilon(1e-10));
  }
}

TEST_CASE("a table states the error of interpolation between its rows", "[cards]") {
  const Material material = wide_material();
  const auto rows = rows_of(card_of(material, "comsol-table", {1.0, 1000.0}, "SI").text, "%");
  double worst = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    for (int n = 1; n < 50; ++n) {
      const double part = n / 50.0,
                   f = std::pow(rows[i - 1][0], 1.0 - part) * std::pow(rows[i][0], part);
      const double linear = (f - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]);
      for (const double weight : {part, linear}) {
        const std::complex<double> between{rows[i - 1][1] + weight * (rows[i][1] - rows[i - 1][1]),
                                           rows[i - 1][2] + weight * (rows[i][2] - rows[i - 1][2])};
        const auto exact = shear_Pa(material, f);
        worst = std::max(worst, std::abs(between - exact) / std::abs(exact));
      }
    }
  }
  std::vector<double> f_Hz;
  for (const auto& row : rows) f_Hz.push_back(row[0]);
  CHECK(interpolation_error(material, f_Hz) == Approx(worst).epsilon(0.05));  // eight places each
  CHECK(worst < 1e-3);
}

TEST_CASE("cards without a whole material read back every number in every unit system", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    if (target.values == nullptr) continue;
    for (const UnitSystem& units : unit_systems()) {
      for (const int n : {0, 1, 2, 12}) {
        for (const double nu : {0.0, 0.3, 0.4999}) {
          if (n == 0 && target.name == "comsol-branches") continue;
          if (units.time_exponent != 0 && target.name == "physx") continue;
          CAPTURE(target.name, units.name, n, nu);
          const Material material = with_bulk_rule(material_of_terms(n, nu), target.bulk);
          const Card card = write_card(material, target, {.units = units.name});
          const CardCheck check = check_card(card.text, target, {}, &material);
          CHECK(check.findings.empty());
          CHECK(check.agrees);
          REQUIRE(check.E_difference);
          CHECK(*check.E_difference <= 1e-9);
          CHECK(card.text.find("CANNOT REPRESENT: ") < card.text.find("units: "));
        }
      }
    }
  }
  CHECK_THROWS_WITH(write_card(reference_material(), card_target("physx"), {.units = "mm-g-ms"}),
                    Contains("time in seconds"));
}

TEST_CASE("a wrong number of a table or reduction is named", "[cards]") {
  const Material material = reference_material();
  const std::string abaqus = card_of(material, "abaqus-table", {0.1, 10.0}, "SI").text;
  CHECK(findings_of(abaqus, "abaqus-table", material).empty());
  CHECK_THAT(findings_of(replaced(abaqus, "\n1838515.92", "\n1880000"), "abaqus-table", material),
             Contains("one-number: E is 1.88e+06 where 1.83852e+06 is expected"));
  const std::string row = abaqus.substr(abaqus.rfind('\n', abaqus.size() - 2) + 1);
  CHECK_THAT(findings_of(replaced(abaqus, row, row + row), "abaqus-table", material),
             Contains("frequencies-not-ascending"));
  const std::string rayleigh = card_of(material, "rayleigh", {0.1, 10.0}, "SI").text;
  const auto number = [&](const std::string& text, const std::string& name) {
    const std::size_t at = text.find(name) + name.size();
    return text.substr(at, text.find_first_of("\n\"", at) - at);
  };
  const std::string eta = number(rayleigh, "\nloss_factor = ");
  CHECK_THAT(findings_of(replaced(rayleigh, "loss_factor = " + eta,
                                  "loss_factor = " + std::to_string(0.5 * std::stod(eta))),
                         "rayleigh", material),
             Contains("a damping ratio is half the loss factor"));
  CHECK_THAT(findings_of(replaced(rayleigh, "nu = 0.495\n", ""), "rayleigh", material),
             Contains("missing-number: nu is missing"));
  const std::string mujoco = card_of(material, "mujoco", {0.1, 10.0}, "SI").text;
  const std::string beta = number(mujoco, "damping=\"");
  CHECK_THAT(findings_of(replaced(mujoco, beta, std::to_string(2.0 * kPi * std::stod(beta))),
                         "mujoco", material),
             Contains("rad/s for Hz"));
  CHECK_THAT(findings_of(replaced(mujoco, "young", "yuong"), "mujoco", material),
             Contains("E is missing"));
  const std::string ansys = card_of(material, "ansys-table", {0.1, 10.0}, "SI").text;
  CHECK_THAT(
      findings_of(replaced(ansys, "SDAMP,1,,1,STRU", "SDAMP,2,,1,STRU"), "ansys-table", material),
      Contains("material-number-differs"));
  CHECK_THAT(findings_of(ansys.substr(0, ansys.find("\nTB,SDAMP")), "ansys-table", material),
             Contains("missing-damping"));
  // The numbers are right and the solver would not see them.
  const std::string physx = card_of(material, "physx", {0.1, 10.0}, "SI").text;
  CHECK(physx.rfind("#usda 1.0\n", 0) == 0);
  CHECK_THAT(
      findings_of(replaced(physx, "PhysxDeformableBodyMaterialAPI", "PhysxAPI"), "physx", material),
      Contains("missing-schema"));
  CHECK_THAT(findings_of(replaced(physx, "metersPerUnit = 1\n", "metersPerUnit = 0.01\n"), "physx",
                         material),
             Contains("stage-units"));
  const std::string branches = write_card(material, card_target("comsol-branches")).text;
  CHECK_THAT(branches, Contains("\n1 5159.62541806"));  // Pa, and no unit beside it
  CHECK_THAT(findings_of(replaced(branches, "\n2 ", "\n3 "), "comsol-branches", material),
             Contains("branch-number"));
}

TEST_CASE("a band outside the measured times is called extrapolated, one within covered",
          "[cards]") {
  const Material material = reference_material();  // 12.5 ms to 60 s: 0.00265 to 12.7 Hz
  CHECK_THAT(card_of(material, "rayleigh", {10.0, 1000.0}).text,
             Contains("band: 10 to 1000 Hz; EXTRAPOLATED: the measured times of 0.0125 to 60 s "
                      "cover 0.00265 to 12.7 Hz"));
  CHECK_THAT(card_of(material, "rayleigh", {0.1, 10.0}).text,
             Contains("band: 0.1 to 10 Hz, covered by the measured times"));
  CHECK_THAT(write_card(material, card_target("rayleigh")).text, Contains(", covered by"));
  CHECK_THROWS_WITH(card_of(material, "rayleigh", {10.0, 1.0}), Contains("the lower one first"));
  // A card of others, whose band nobody has stated.
  const CardCheck check =
      check_card("E = 1\n", card_target("rayleigh"), {.units = "SI"}, &material);
  REQUIRE(!check.findings.empty());
  CHECK(check.findings[0].name == "band-not-stated");
  CHECK_FALSE(check.agrees);
}
