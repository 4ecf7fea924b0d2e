// Cards in the solvers beside CalculiX: SfePy by default, dolfinx with --slow, and stand-ins for those
// that Debian lacks (stand_in.py).
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/proof/card_proof.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"
#include "tests/io/cards/stand_in.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

std::optional<FoundSolver> found(const char* name, const char* target = nullptr) {
  try {  // "calculix" is a target too
    return find_solver(solver_for(name, target == nullptr ? name : target), "");
  } catch (const std::runtime_error& error) {
    WARN(error.what());
    return std::nullopt;
  }
}

// One to `most` terms over three decades that relax 5 to 80 %, any modulus between 10 kPa and 100 MPa.
Material random_material(std::mt19937& random, int most) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  Material material = reference_material();
  material.E0_Pa = std::pow(10.0, uniform(4.0, 8.0));
  material.nu = uniform(0.2, 0.499);
  const int terms = 1 + static_cast<int>(uniform(0.0, most));
  const double relaxed = uniform(0.05, 0.8), first_s = std::pow(10.0, uniform(-4.0, 2.0));
  std::vector<double> parts;
  double sum = 0.0;
  for (int i = 0; i < terms; ++i) sum += parts.emplace_back(uniform(0.2, 1.0));
  material.terms.clear();
  for (int i = 0; i < terms; ++i) {
    const double g = relaxed * parts[static_cast<std::size_t>(i)] / sum;
    const double decade = terms == 1 ? 0.0 : 3.0 * i / (terms - 1);
    material.terms.push_back({g, g, first_s * std::pow(10.0, decade)});
  }
  return material;
}

Material shifted(Material material, ShiftLaw law) {
  material.T_ref_C = 23.0;
  material.shift = TemperatureShift{
      .law = law, .T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6, .activation_J_mol = 5.2e4};
  return material;
}

CardProof proof_of_card(const Material& material, const CardTarget& target, const char* units,
                        const FoundSolver& solver, int steps_per_tau = 0) {
  const Card card = write_card(material, target, {.units = units, .may_approximate = true});
  const ReadCard read = read_card(card.text, target, "");
  return prove_card(card.text, read, with_bulk_rule(material, target.bulk), solver, steps_per_tau);
}

// The error at the coarsest step is that of backward Euler, and what remains is below 1e-5. The
// prediction is that of a constant Poisson ratio; at constant K less of E relaxes, and the error is
// 0.8 to 1 times as large at ratios from 0.2 on (the same rules in Python, 12 random materials).
void check_error(const StepError& error) {
  CAPTURE(error.at_step, error.remaining, error.resolved, *error.predicted);
  CHECK(error.at_step <= 1.01 * *error.predicted + error.resolved);
  CHECK(error.at_step >= 0.75 * *error.predicted - error.resolved);
  CHECK(error.remaining <= 1e-5);
}

// Random materials, each as a card of the next target and in other units.
void check_random(const char* solver_name, const std::vector<std::string>& targets, unsigned seed,
                  std::size_t count = 10) {
  const auto solver = found(solver_name);
  if (!solver) return;
  constexpr int kStepsPerTau = 60;
  static const char* kUnits[] = {"SI", "mm-t-s", "mm-kg-ms", "cgs"};
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const CardTarget& target = card_target(targets[i % targets.size()]);
    const int most = target.max_terms > 0 ? std::min(target.max_terms, 4) : 4;
    const Material material = random_material(random, most);
    CAPTURE(i, target.name, material.E0_Pa, material.nu, material.terms.size());
    const CardProof proof = proof_of_card(material, target, kUnits[i % 4], *solver, kStepsPerTau);
    CHECK(proof.holds());
    check_error(proof.relaxation);
    check_error(proof.creep);
  }
}

std::vector<std::string> readable_targets() {
  std::vector<std::string> out;
  for (const CardTarget& target : card_targets()) {
    if (states_material(target)) out.push_back(target.name);
  }
  return out;
}

}  // namespace

TEST_CASE("backward Euler's error is that of the closed decay of one branch", "[cards]") {
  // A jump at once (a ramp of one increment) and a hold: after n increments of x = dt/tau the branch
  // has decayed by (1 + x)^-(n + 1) of its ramp, where the exact one has (1 - e^-x)/x e^-nx.
  Material material = reference_material();
  material.terms = {{0.5, 0.5, 1.0}};
  const double x = 0.01;
  const ElementTest test{ElementTestKind::kRelaxation, 1.0, x, {{x, 1}, {1.0, 99}}};
  double worst = 0.0;
  for (int n = 0; n < 100; ++n) {
    const double exact = 0.5 + 0.5 * -std::expm1(-x) / x * std::exp(-n * x);
    worst = std::max(worst, std::abs((0.5 + 0.5 * std::pow(1.0 + x, -n - 1.0)) / exact - 1.0));
  }
  CHECK(backward_euler_error(material, test) == Approx(worst).epsilon(1e-9));
}

TEST_CASE("CalculiX runs cards of random materials within their step error", "[cards]") {
  check_random("calculix", {"calculix"}, 1, 2);
}

TEST_CASE("CalculiX runs cards of ten random materials within their step error", "[cards][slow]") {
  check_random("calculix", {"calculix"}, 1);
}

TEST_CASE("SfePy runs the numbers of ten random cards within their step error", "[cards]") {
  check_random("sfepy", readable_targets(), 2);
}

TEST_CASE("dolfinx runs the numbers of ten random cards within their step error", "[cards][slow]") {
  check_random("dolfinx", readable_targets(), 3);
}

TEST_CASE("SfePy and dolfinx run ten random cards of every target", "[cards][slow]") {
  unsigned seed = 4;
  for (const std::string& target : readable_targets()) {
    check_random("sfepy", {target}, ++seed);
    check_random("dolfinx", {target}, ++seed);
  }
}

TEST_CASE("SfePy refuses a card with one wrong number, and one in the wrong units", "[cards]") {
  const auto solver = found("sfepy");
  if (!solver) return;
  const Material material = with_bulk_rule(reference_material(), BulkRule::kConstantBulk);
  Material wrong = material;
  wrong.terms[1].tau_s *= 1.02;
  const CardTarget& target = card_target("frontistr");
  const Card card = write_card(wrong, target, {.units = "mm-t-s"});
  const CardProof proof =
      prove_card(card.text, read_card(card.text, target, ""), material, *solver, 10);
  CHECK_FALSE(proof.agrees());
  CHECK(proof.exercises_all());
  const Card right = write_card(material, target, {.units = "mm-t-s", .is_reproducible = true});
  CHECK_FALSE(
      prove_card(right.text, read_card(right.text, target, "mm-kg-ms"), material, *solver, 10)
          .agrees());
}

TEST_CASE("a wrong Poisson's ratio of a nearly incompressible card is found with held sides",
          "[cards]") {
  const auto solver = found("sfepy");
  if (!solver) return;
  Material material = with_bulk_rule(material_of_terms(2, 0.4), BulkRule::kConstantPoisson);
  material.nu = 0.4995;
  const CardTarget& target = card_target("febio");
  const std::string right = write_card(material, target, {.units = "mm-t-s"}).text;
  const CardProof proof = prove_card(right, read_card(right, target, ""), material, *solver, 10);
  CAPTURE(proof.not_exercised());
  CHECK(proof.holds());
  REQUIRE(proof.confined);
  CHECK(proof.constants.at(1).name == "nu");
  CHECK(proof.constants.at(1).seen_by == "confined");
  std::string wrong = right;
  wrong.replace(wrong.find("<v>0.4995"), 9, "<v>0.3");
  const CardProof refused = prove_card(wrong, read_card(wrong, target, ""), material, *solver, 10);
  CHECK(refused.relaxation.vanishes_with_step());
  CHECK_FALSE(refused.agrees());
  CHECK(statement_of(solver->solver, "febio") != "");
}

TEST_CASE("models for FEBio, MTest and FrontISTR run and are read in the solvers' formats",
          "[cards]") {
  if (std::system("command -v python3 >/dev/null 2>&1") != 0) {
    WARN("python3 is not installed; the stand-ins are not run");
    return;
  }
  const ScratchFolder folder;
  (void)stand_in(folder.path(), "mfront");
  struct Row {
    const char *target, *program, *version;
  };
  for (const Row& row :
       {Row{"febio", "febio4", "4.9.0"}, Row{"febio-uncoupled", "febio4", "4.9.0"},
        Row{"mfront", "mtest", "5.2.0-stand-in"}, Row{"frontistr", "fistr1", "5.6.0"}}) {
    CAPTURE(row.target);
    const FoundSolver solver =
        find_solver(solver_for("", row.target), stand_in(folder.path(), row.program));
    CHECK(solver.version == row.version);
    Material material = material_of_terms(3, 0.45);
    const CardTarget& target = card_target(row.target);
    const CardProof proof = proof_of_card(material, target, "mm-t-s", solver);
    CAPTURE(proof.relaxation.remaining, proof.creep.remaining, proof.relaxation.resolved,
            proof.creep.resolved);
    CHECK(proof.holds());
    CHECK(proof.relaxation.remaining <= 1e-5);
    CHECK(proof.creep.remaining <= 1e-5);
    CHECK(proof.models.size() >= 2);
    Material wrong = material;
    wrong.terms[1].g *= 1.05;
    const Card card = write_card(wrong, target, {.units = "mm-t-s", .may_approximate = true});
    CHECK_FALSE(prove_card(card.text, read_card(card.text, target, ""),
                           with_bulk_rule(material, target.bulk), solver)
                    .agrees());
  }
}

TEST_CASE("the shift of a card is proven at another temperature", "[cards]") {
  if (std::system("command -v python3 >/dev/null 2>&1") != 0) return;
  const ScratchFolder folder;
  const FoundSolver solver =
      find_solver(solver_for("", "frontistr"), stand_in(folder.path(), "fistr1"));
  const CardTarget& target = card_target("frontistr");
  for (const ShiftLaw law : {ShiftLaw::kWlf, ShiftLaw::kArrhenius}) {
    CAPTURE(law == ShiftLaw::kWlf);
    const Material material = shifted(material_of_terms(2, 0.45), law);
    const CardProof proof = proof_of_card(material, target, "mm-t-s", solver);
    CHECK(proof.holds());
    REQUIRE(proof.temperature);
    CHECK(proof.temperature->at_C == 33.0);
    CHECK(proof.temperature->error.remaining <= 1e-5);
    CHECK(proof.models.back().name.rfind("temperature/", 0) == 0);
    // At the reference temperature no answer depends on the shift.
    Material wrong = material;
    wrong.shift->C1 *= 1.02;
    wrong.shift->activation_J_mol *= 1.02;
    const Card card = write_card(wrong, target, {.units = "mm-t-s", .may_approximate = true});
    const CardProof refused = prove_card(card.text, read_card(card.text, target, ""),
                                         with_bulk_rule(material, target.bulk), solver);
    CHECK(refused.relaxation.vanishes_with_step());
    CHECK(refused.creep.vanishes_with_step());
    REQUIRE(refused.temperature);
    CHECK_FALSE(refused.temperature->error.vanishes_with_step());
    CHECK_FALSE(refused.agrees());
  }
}

TEST_CASE("a solver that stops early with status 0 proves nothing", "[cards]") {
  if (std::system("command -v python3 >/dev/null 2>&1") != 0) return;
  const ScratchFolder folder;
  const FoundSolver solver =
      find_solver(solver_for("", "frontistr"), stand_in(folder.path(), "fistr1"));
  const Material material = material_of_terms(2, 0.45);
  const CardTarget& target = card_target("frontistr");
  ::setenv("PYTHON_STAND_IN_STOPS_AFTER", "30", 1);
  CHECK_THROWS_WITH(proof_of_card(material, target, "SI", solver),
                    Contains("FrontISTR stopped at") && Contains("--deck"));
  // It says why: an increment that does not converge, also with the card of viscard.
  ::setenv("PYTHON_STAND_IN_SAYS", "     ### Fail to Converge  : at total_step=    1", 1);
  const CardProof proof = proof_of_card(material, target, "SI", solver);
  ::unsetenv("PYTHON_STAND_IN_STOPS_AFTER");
  ::unsetenv("PYTHON_STAND_IN_SAYS");
  REQUIRE(proof.divergence);
  CHECK_FALSE(proof.divergence->is_card_blamed);
  CHECK_FALSE(proof.holds());
}

TEST_CASE("solvers that Debian lacks run ten random cards where they are installed",
          "[cards][slow]") {
  for (const char* target_name : {"frontistr", "febio", "febio-uncoupled", "mfront"}) {
    const CardTarget& target = card_target(target_name);
    const auto solver = found("", target_name);
    if (!solver) continue;
    std::mt19937 random(11);
    static const char* kUnits[] = {"SI", "mm-t-s", "mm-kg-ms", "cgs"};
    for (std::size_t i = 0; i < 10; ++i) {
      Material material = random_material(random, 4);
      // Every third card has no shift, the others one of the two laws.
      if (target.takes_wlf && i % 3 != 0) {
        material = shifted(material, i % 3 == 1 ? ShiftLaw::kWlf : ShiftLaw::kArrhenius);
      }
      const CardProof proof = proof_of_card(material, target, kUnits[i % 4], *solver);
      CAPTURE(target_name, i, material.E0_Pa, material.nu, material.terms.size());
      REQUIRE(proof.temperature.has_value() == material.shift.has_value());
      if (proof.temperature) CHECK(proof.temperature->error.remaining <= 1e-5);
      CAPTURE(proof.relaxation.at_step, proof.relaxation.remaining, proof.relaxation.resolved);
      CAPTURE(proof.creep.at_step, proof.creep.remaining, proof.creep.resolved);
      CHECK(proof.holds());
      CHECK(proof.relaxation.remaining <= 1e-5);
      CHECK(proof.creep.remaining <= 1e-5);
    }
  }
}

TEST_CASE("solvers that are missing, or are another program, are named", "[cards]") {
  CHECK_THROWS_WITH(solver_for("", "abaqus"), Contains("--solver sfepy") && Contains("--deck"));
  CHECK_THROWS_WITH(solver_for("nastran", "abaqus"), Contains("calculix, febio"));
  CHECK_THROWS_WITH(solver_for("febio", "abaqus"), Contains("does not read cards for abaqus"));
  CHECK_THROWS_WITH(find_solver(solver_for("febio", "febio"), "/bin/true"),
                    Contains("does not answer as FEBio"));
  CHECK_THROWS_WITH(find_solver(solver_for("mtest", "mfront"), "/none/mtest"),
                    Contains("--solver-path"));
}
