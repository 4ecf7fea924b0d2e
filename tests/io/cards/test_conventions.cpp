#include "io/basics/number_text.h"
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/card_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/target_table.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <type_traits>

using namespace viscard;
using namespace viscard::test;

namespace {

// A row without a writer or a reader does not compile, so no target can get those of another.
static_assert(!std::is_default_constructible_v<decltype(CardTarget::write)>);
static_assert(!std::is_default_constructible_v<decltype(CardTarget::read)>);
static_assert(!std::is_default_constructible_v<decltype(DeckWriter::files)>);

std::string write_made_up(const CardBody& body) {
  return "made-up card of " + body.name + "\n";
}

void read_made_up(const std::string& text, ReadCard& card) {
  if (text.find("made-up card") == std::string::npos) throw std::runtime_error("another card");
  card.numbers = numbers_from_material(reference_material(), card.understood, card.units);
}

}  // namespace

TEST_CASE("the table of targets has a row for each of them", "[cards]") {
  const std::string printed = target_table();
  INFO("viscard card --list --long");
  // A row for each target, and what is known of some without the program.
  CHECK(std::count(printed.begin(), printed.end(), '\n') ==
        static_cast<std::ptrdiff_t>(card_targets().size()) + 2);
  CHECK(printed.find("| febio | exact; 6 terms | assumed exact; stated refused (") !=
        std::string::npos);
  CHECK(printed.find("| mfront | exact | exact | refused |") != std::string::npos);
  CHECK(printed.find("| lsdyna006 | approximate, ") != std::string::npos);
}

TEST_CASE("a target is written and read by its own functions and never as another", "[cards]") {
  CardTarget made_up = card_target("json");
  made_up.name = "made-up";
  made_up.write = write_made_up;
  made_up.read = read_made_up;
  const Card card = write_card(reference_material(), made_up);
  CHECK(card.text == "made-up card of PDMS\n");
  CHECK(read_card(card.text, made_up, "").material.E0_Pa == Approx(1.88e6).epsilon(1e-12));
  CHECK_THROWS_WITH(card_target("made-up"), Catch::Contains("no card target 'made-up'"));
  CHECK_THROWS_WITH(card_deck("made-up"), Catch::Contains("no one-element model for made-up"));

  std::set<std::string> names, bodies;
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    CHECK(names.insert(target.name).second);
    Material material = reference_material();
    if (target.max_terms == 1) material.terms.resize(1);
    const UnitSystem& units = unit_system("SI");
    const CardNumbers numbers = numbers_from_material(material, target, units);
    const CardBody body{
        "PDMS", numbers, target, units, material, {}, card_frequencies_Hz(material, target, {})};
    CHECK(bodies.insert(target.write(body)).second);
  }
}

TEST_CASE("the four choices of every target are the published ones", "[cards]") {
  struct Row {
    const char* target;
    ModulusAt at;
    BranchNumber branch;
    TimeNumber time;
    BulkRule bulk;
    int max_terms;
  };
  using enum ModulusAt;
  using enum BranchNumber;
  using enum TimeNumber;
  using enum BulkRule;
  const std::vector<Row> rows{
      {"abaqus", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"ansys", kInstantaneous, kRelative, kTau, kOwnNumbers, 100},
      {"lsdyna", kLongTerm, kAbsoluteShear, kBeta, kConstantBulk, 17},
      {"lsdyna006", kLongTerm, kAbsoluteShear, kBeta, kConstantBulk, 1},
      {"febio", kInstantaneous, kRelative, kTau, kConstantPoisson, 6},
      {"febio-uncoupled", kInstantaneous, kRelative, kTau, kConstantBulk, 6},
      {"mfront", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"calculix", kInstantaneous, kAbsoluteYoung, kNortonA, kConstantBulk, 0},
      {"openradioss", kLongTerm, kAbsoluteShear, kBeta, kConstantBulk, 5},
      {"comsol", kLongTerm, kAbsoluteShear, kTau, kConstantBulk, 0},
      {"moose", kInstantaneous, kAbsoluteYoung, kTau, kConstantPoisson, 0},
      {"frontistr", kInstantaneous, kRelative, kTau, kConstantBulk, 0},
      {"json", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"csv", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"abaqus-frequency", kLongTerm, kRelative, kTau, kOwnNumbers, 0},
      {"abaqus-table", kLongTerm, kRelative, kTau, kOwnNumbers, 0},
      {"ansys-table", kInstantaneous, kRelative, kTau, kConstantPoisson, 0},
      {"comsol-table", kInstantaneous, kRelative, kTau, kConstantBulk, 0},
      {"comsol-branches", kLongTerm, kAbsoluteShear, kTau, kConstantBulk, 0},
      {"rayleigh", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"sofa", kLongTerm, kAbsoluteShear, kTau, kConstantBulk, 2},
      {"mujoco", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"physx", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"dolfinx", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
      {"sfepy", kInstantaneous, kRelative, kTau, kOwnNumbers, 0},
  };
  REQUIRE(rows.size() == card_targets().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CardTarget& target = card_targets()[i];
    CAPTURE(target.name);
    CHECK(target.name == rows[i].target);
    CHECK(target.at == rows[i].at);
    CHECK(target.branch == rows[i].branch);
    CHECK(target.time == rows[i].time);
    CHECK(target.bulk == rows[i].bulk);
    CHECK(target.max_terms == rows[i].max_terms);
  }
}

TEST_CASE("unit systems turn the reference numbers into the published ones", "[cards]") {
  struct Row {
    const char* system;
    double E0, rho, tau, beta;
  };
  const std::vector<Row> rows{{"SI", 1.88e6, 965.0, 0.1945, 5.141388175},
                              {"mm-t-s", 1.88, 9.65e-10, 0.1945, 5.141388175},
                              {"mm-kg-ms", 1.88e-3, 9.65e-7, 194.5, 5.141388175e-3},
                              {"mm-g-ms", 1.88, 9.65e-4, 194.5, 5.141388175e-3},
                              {"um-kg-s", 1.88, 9.65e-16, 0.1945, 5.141388175},
                              {"cgs", 1.88e7, 0.965, 0.1945, 5.141388175}};
  REQUIRE(rows.size() == unit_systems().size());
  for (const Row& row : rows) {
    const UnitSystem& units = unit_system(row.system);
    CAPTURE(row.system);
    const CardNumbers abaqus =
        numbers_from_material(reference_material(), card_target("abaqus"), units);
    CHECK(abaqus.young == row.E0);  // powers of ten divide exactly to the nearest double
    CHECK(abaqus.density == row.rho);
    CHECK(abaqus.branches[0].time == row.tau);
    const CardNumbers lsdyna =
        numbers_from_material(reference_material(), card_target("lsdyna"), units);
    CHECK(lsdyna.branches[0].time == Approx(row.beta).epsilon(1e-9));  // ten published digits
  }
}

TEST_CASE("unit systems are consistent: stress is mass over length and time squared", "[cards]") {
  const auto mass_exponent = [](const UnitSystem& units) {
    return units.density_exponent + 3 * units.length_exponent;
  };
  for (const UnitSystem& units : unit_systems()) {
    CAPTURE(units.name);
    CHECK(units.stress_exponent ==
          mass_exponent(units) - units.length_exponent - 2 * units.time_exponent);
  }
}

TEST_CASE("absolute branches and Norton coefficients are the published ones", "[cards]") {
  const UnitSystem& units = unit_system("mm-t-s");
  const Material material = reference_material();
  const CardNumbers lsdyna = numbers_from_material(material, card_target("lsdyna"), units);
  CHECK(lsdyna.bulk == Approx(62.6666667).epsilon(1e-9));
  CHECK(lsdyna.equilibrium == Approx(0.6148882676).epsilon(1e-10));
  CHECK(lsdyna.branches[0].shear == Approx(0.00515962542).epsilon(1e-9));
  CHECK(lsdyna.branches[1].shear == Approx(0.00871464883).epsilon(1e-9));
  const CardNumbers calculix = numbers_from_material(material, card_target("calculix"), units);
  CHECK(calculix.equilibrium == Approx(1.83851592).epsilon(1e-12));
  CHECK(calculix.branches[0].shear == Approx(0.01542728).epsilon(1e-12));
  CHECK(calculix.branches[0].time == Approx(332.155131314).epsilon(1e-11));
  CHECK(calculix.branches[1].time == Approx(15.9175082365).epsilon(1e-11));
  const Card mfront = write_card(material, card_target("mfront"), {.units = "mm-t-s"});
  const CardNumbers gallery =
      read_card(mfront.companions.at(0).text, card_target("mfront"), "").numbers;
  CHECK(gallery.bulk == Approx(61.283864).epsilon(1e-12));
  CHECK(gallery.branches[0].bulk == Approx(0.5142426666666667).epsilon(1e-12));
}

TEST_CASE("numbers fit fixed columns with as many digits as there is room for", "[cards]") {
  CHECK(nearest_number(0.6148882675585284, 10) == ".614888268");
  CHECK(nearest_number(9.65e-10, 10) == "9.65E-10");
  CHECK(nearest_number(62.666666666666664, 10) == "62.6666667");
  CHECK(nearest_number(5.141388174807198, 10) == "5.14138817");
  CHECK(nearest_number(8.714648829431e-6, 10) == "8.71465E-6");
  CHECK(nearest_number(1.88e6, 10) == "1.88E6");
  CHECK(nearest_number(0.0, 10) == "0.0");
  for (const double value : {1.0 / 3.0, 1.0 / 3.0e7, 2.0e13 / 3.0, -1.0 / 7.0, 1e-300 / 3.0}) {
    CAPTURE(value);
    CHECK(nearest_number(value, 10).size() <= 10);
    CHECK(std::stod(nearest_number(value, 10)) == Approx(value).epsilon(2e-4));  // "3.33E-301"
  }
  CHECK(number_within(0.000005159625418060201, 20).size() <= 20);
  CHECK(std::stod(number_within(5.159625418060201e-06, 20)) ==
        Approx(5.159625418060201e-06).epsilon(1e-14));
}
