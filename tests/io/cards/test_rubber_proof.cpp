// viscard card --prove of cards of rubber: the closed form of a cube, and runs of CalculiX and SfePy.
#include "io/cards/proof/certificate.h"
#include "io/cards/proof/cube_stress.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/unit_system.h"
#include "tests/io/cards/rubber_rules.h"
#include "tests/io/cards/sfepy_cube.h"
#include "tests/io/cards/stand_in.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

namespace {

HyperelasticFile law_file(const Rubber& rubber) {
  HyperelasticFile file;
  file.law = rubber.law;
  file.terms = rubber.terms;
  return file;
}

// The proof of a card in the units mm-t-s, beside the law.
LawProof proof_of(const std::string& card, const Rubber& rubber, const std::string& target,
                  const char* solver, const std::string& elastic_only = "") {
  const HyperelasticFile file = law_file(rubber);
  const FoundSolver found = find_solver(solver_for(solver, solver == target ? target : ""), "");
  return prove_law_card(card, target, read_rubber_card(card, target, "mm-t-s"), &file, elastic_only,
                        found);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// Energy of a Mooney-Rivlin cube (C10, C01, K) at stretches s, b, b.
double mooney_energy(double C10, double C01, double K, double s, double b) {
  const double J = s * b * b, shape = std::pow(J, -1.0 / 3.0);
  const double a = s * shape, c = b * shape;
  return C10 * (a * a + 2.0 * c * c - 3.0) + C01 * (1.0 / (a * a) + 2.0 / (c * c) - 3.0) +
         0.5 * K * (J - 1.0) * (J - 1.0);
}

// Its least value over the stretch of the sides, by golden section.
double least_energy(double C10, double C01, double K, double s) {
  double low = 0.5 / std::sqrt(s), high = 1.5 / std::sqrt(s);
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 60; ++i) {
    const double one = high - ratio * (high - low), two = low + ratio * (high - low);
    (mooney_energy(C10, C01, K, s, one) < mooney_energy(C10, C01, K, s, two) ? high : low) =
        mooney_energy(C10, C01, K, s, one) < mooney_energy(C10, C01, K, s, two) ? two : one;
  }
  return mooney_energy(C10, C01, K, s, 0.5 * (low + high));
}

}  // namespace

TEST_CASE(
    "a certificate with the line ends of Windows is unchanged, and one with a word more is not",
    "[cards]") {
  const std::string text =
      certificate_text([](ResultVisitor& v) { show_end(v, "", true, [] {}, {}); });
  std::string of_windows;
  for (const char c : text) of_windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(is_certificate_unchanged(text));
  CHECK(is_certificate_unchanged(of_windows));
  CHECK_FALSE(is_certificate_unchanged(replaced(of_windows, "true", "false")));
}

TEST_CASE("rubber proofs: the stress of a cube is the slope of its least energy", "[io]") {
  const double C10 = 1.5e5, C01 = 2e4, step = 1e-4;
  const HyperelasticLaw law = rubber_of(HyperelasticForm::kMooneyRivlin, {C10, C01}, {}, {}).law;
  for (const double K : {1e6, 3.4e8}) {
    for (const double s : {0.7, 1.3, 2.0}) {
      CAPTURE(K, s);
      const double slope =
          (least_energy(C10, C01, K, s + step) - least_energy(C10, C01, K, s - step)) /
          (2.0 * step);
      CHECK(cube_stress_Pa(law, K, Deformation::kUniaxial, s, VolumeRule::kUnitVolume) ==
            Approx(slope).epsilon(1e-6));
    }
  }
}

TEST_CASE("rubber proofs: the stress of a cube tends to the incompressible one and to Hooke's law",
          "[io][reduction]") {
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    const double G = youngs_modulus_Pa(rubber.law) / 3.0;
    for (const auto deformation :
         {Deformation::kUniaxial, Deformation::kPlanar, Deformation::kEquibiaxial}) {
      CAPTURE(name_of(deformation));
      for (const auto rule : {VolumeRule::kUnitVolume, VolumeRule::kWholeOgden}) {
        const auto error = [&](double ratio) {
          return cube_stress_Pa(rubber.law, ratio * G, deformation, 1.8, rule) /
                     nominal_stress_Pa(rubber.law, deformation, 1.8) -
                 1.0;
        };
        CHECK(std::abs(error(1e3)) < 3e-3);
        CHECK(error(1e3) / error(2e3) == Approx(2.0).epsilon(5e-3));  // of first order in G/K
      }
    }
    // E = 9 K G/(3 K + G); of a strain of 1e-6 the next order is 1e-6 of it.
    const double K = 3.0 * G, strain = 1e-6;
    CHECK(cube_stress_Pa(rubber.law, K, Deformation::kUniaxial, 1.0 + strain,
                         VolumeRule::kUnitVolume) /
              strain ==
          Approx(9.0 * K * G / (3.0 * K + G)).epsilon(1e-5));
  }
}

TEST_CASE("rubber proofs: CalculiX proves cards of three materials, and finds a wrong number",
          "[io][golden]") {
  for (const Rubber& rubber : rubbers()) {
    for (const std::string when : {"instantaneous", "long-term"}) {
      CAPTURE(name_of(rubber.law.form), when);
      const LawProof proof =
          proof_of(card_of(rubber, "calculix", false, when), rubber, "calculix", "calculix", when);
      REQUIRE(proof.cubes.size() == 4);
      for (const CubeProof& cube : proof.cubes) {
        CAPTURE(cube.test.name, cube.error, cube.at_stretch);
        CHECK(cube.error < 3e-6);
        CHECK(cube.error > 0.0);
      }
      CHECK_FALSE(proof.hold.has_value());
      CHECK(proof.holds());
    }
  }
  const Rubber& yeoh = rubbers()[1];
  const std::string card = card_of(yeoh, "calculix", false, "instantaneous");
  const auto of = [&](const std::string& text) {
    return proof_of(text, yeoh, "calculix", "calculix", "instantaneous");
  };
  CHECK_FALSE(of(replaced(card, ", -0.0014,", ", -0.0015,")).agrees());
  // A card that is right for another moment of the relaxation.
  CHECK_FALSE(proof_of(card, yeoh, "calculix", "calculix", "long-term").agrees());
  CHECK_THROWS_WITH(proof_of(card, yeoh, "calculix", "calculix"),
                    Contains("has no terms of relaxation and the law has 2"));
}

TEST_CASE("rubber proofs: SfePy proves laws and memory of three materials, and finds wrong numbers",
          "[io]") {
  if (!has_sfepy()) return;
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    const LawProof proof = proof_of(card_of(rubber, "sfepy"), rubber, "sfepy", "sfepy");
    REQUIRE(proof.cubes.size() == 4);
    for (const CubeProof& cube : proof.cubes) {
      CAPTURE(cube.test.name, cube.error, cube.at_stretch);
      CHECK(cube.error < 1e-8);
    }
    REQUIRE(proof.hold.has_value());
    CHECK(proof.hold->error < 1e-6);
    CHECK(proof.hold->resolved < 2e-5);
    CHECK(proof.hold->terms.size() == rubber.terms.size());
    CHECK(proof.holds());
  }
  const Rubber& neo_hooke = rubbers()[0];
  const std::string card = card_of(neo_hooke, "sfepy");
  const LawProof late =
      proof_of(replaced(card, "TAU = [0.4]", "TAU = [0.401]"), neo_hooke, "sfepy", "sfepy");
  CHECK(late.cubes[0].agrees());
  CHECK_FALSE(late.hold->agrees());
  CHECK_FALSE(late.holds());
  // Another rule of the memory is none that is read.
  CHECK_THROWS_WITH(
      proof_of(replaced(card, "np.exp(-x[i])", "np.exp(-2 * x[i])"), neo_hooke, "sfepy", "sfepy"),
      Contains("the formula of the card is not that of"));
}

TEST_CASE("rubber proofs: SfePy runs the numbers of a card for Abaqus, and finds its wrong basis",
          "[io]") {
  if (!has_sfepy()) return;
  const Rubber& neo_hooke = rubbers()[0];
  const std::string card = rubber_card(neo_hooke.law, neo_hooke.terms,
                                       {.target = "abaqus", .units = "mm-t-s", .bulk_Pa = 3e8});
  const LawProof proof = proof_of(card, neo_hooke, "abaqus", "sfepy");
  CHECK(proof.holds());
  CHECK(proof.bulk_Pa == Approx(3e8));
  CHECK_FALSE(proof_of(replaced(card, ", MODULI=INSTANTANEOUS", ""), neo_hooke, "abaqus", "sfepy")
                  .agrees());
}

TEST_CASE("rubber proofs: a constant that no stress shows is reported as not exercised", "[io]") {
  Rubber mooney = rubber_of(HyperelasticForm::kMooneyRivlin, {1.5e5, 1e-3}, {}, {});
  const LawProof proof = proof_of(card_of(mooney, "calculix"), mooney, "calculix", "calculix");
  CHECK(proof.agrees());
  CHECK_FALSE(proof.holds());
  REQUIRE(proof.constants.size() == 3);
  CHECK(proof.constants[0].is_exercised);
  CHECK_FALSE(proof.constants[1].is_exercised);
  CHECK(proof.constants[2].name == "bulk modulus");
  CHECK(proof.constants[2].is_exercised);
  CHECK(proof.constants[2].seen_by == "confined");
  CHECK(proof.not_exercised() == "C01_Pa");
}

TEST_CASE("rubber proofs: CalculiX's volume law of Arruda and Boyce is its own", "[io]") {
  for (const double limit : {1.3, 1.8}) {
    CAPTURE(limit);
    const Rubber chains = rubber_of(HyperelasticForm::kArrudaBoyce, {3.5e5}, {limit}, {});
    const LawProof proof = proof_of(card_of(chains, "calculix"), chains, "calculix", "calculix");
    for (const CubeProof& cube : proof.cubes) {
      CAPTURE(cube.test.name, cube.error, cube.at_stretch);
      CHECK(cube.agrees());
    }
    CHECK(proof.holds());
  }
}

TEST_CASE("rubber proofs: a run of another solver than the card's says so", "[io]") {
  CHECK(statement_of_law(solver_for("calculix", "calculix"), "calculix") == "");
  CHECK(statement_of_law(solver_for("sfepy", ""), "sfepy") == "");
  CHECK_THAT(statement_of_law(solver_for("sfepy", ""), "febio"),
             Contains("by its own law") && Contains("not run in febio"));
}

TEST_CASE("rubber proofs: a confined cube shows the bulk modulus, with the slope of its energy",
          "[io]") {
  // W of Neo-Hooke at unit volume: C10 (J^(-2/3) (s^2 + 2) - 3) + K/2 (J - 1)^2 with J = s.
  const Rubber neo_hooke = rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {});
  const double K = 3e8, s = 1.04, h = 1e-6;
  const auto energy = [&](double t) {
    return 2e5 * (std::pow(t, -2.0 / 3.0) * (t * t + 2.0) - 3.0) + 0.5 * K * (t - 1.0) * (t - 1.0);
  };
  CHECK(confined_stress_Pa(neo_hooke.law, K, s, VolumeRule::kUnitVolume) ==
        Approx((energy(s + h) - energy(s - h)) / (2.0 * h)).epsilon(1e-7));
  const auto logarithmic = [&](double t) {
    return energy(t) - 0.5 * K * (t - 1.0) * (t - 1.0) +
           0.5 * K * (0.5 * (t * t - 1.0) - std::log(t));
  };
  CHECK(confined_stress_Pa(neo_hooke.law, K, s, VolumeRule::kLogarithmic) ==
        Approx((logarithmic(s + h) - logarithmic(s - h)) / (2.0 * h)).epsilon(1e-7));
}

TEST_CASE("rubber proofs: cubes go as far as the tests of the law did, and stay where it is stable",
          "[io]") {
  HyperelasticFile file = law_file(rubbers()[0]);
  file.measured[0] = HyperelasticFile::Range{0.6, 3.0};
  const auto tests = cube_tests(file.law, &file, 0.04);
  REQUIRE(tests.size() == 5);
  CHECK(tests.back().is_confined);
  CHECK(tests[0].top == 3.0);
  CHECK(tests[0].steps == 50);
  CHECK(tests[1].name == "compression");
  CHECK(tests[1].top == 0.6);
  CHECK(tests[2].top == 1.8);
  // Yeoh with a negative C20 alone softens until it is unstable.
  const auto soft = rubber_of(HyperelasticForm::kYeoh, {2e5, -4e4, 1.0}, {}, {}).law;
  for (const CubeTest& test : cube_tests(soft, nullptr, 0.04)) CHECK(test.top < 1.8);
}

TEST_CASE("rubber proofs: rows of SfePy carry what its iteration left on free sides", "[io]") {
  namespace folders = std::filesystem;
  std::string name = (folders::temp_directory_path() / "viscard-rows-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  std::ofstream(folders::path(name) / "result_0.txt") << "1.5 2.0e5 1e-12\n2.0 3.0e5 4e-4\n";
  std::ofstream(folders::path(name) / "result_1.txt") << "0.5 1.0e5 0.0 1.1e5\n";
  const auto stretched = sfepy_rows(name, 0), held = sfepy_rows(name, 1);
  folders::remove_all(name);
  REQUIRE(stretched.size() == 2);
  CHECK(stretched[0].unbalanced == 1e-12);
  CHECK(stretched[1].unbalanced == 4e-4);
  CHECK(stretched[1].stress == 3e5);
  REQUIRE(held.size() == 1);
  CHECK(held[0].unbalanced == 0.0);
  CHECK(held[0].coarser == 1.1e5);
}

TEST_CASE(
    "rubber proofs: a relaxing cube is the elastic one without terms, and tends to the "
    "incompressible one",
    "[io][reduction]") {
  Course history{{0.0, 1.0}};
  for (int i = 1; i <= 40; ++i) history.push_back({0.02 * i, 1.0 + 0.015 * i});
  for (const double end_s : {1.5, 4.0, 30.0}) history.push_back({end_s, 1.6});
  const HyperelasticLaw& law = rubbers()[2].law;
  const std::vector<RubberTerm> terms{{0.3, 0.4}, {0.2, 9.0}};
  const double G = youngs_modulus_Pa(law) / 3.0;
  const auto elastic =
      relaxing_stress_Pa(law, {}, 50.0 * G, history, VolumeRule::kLogSquared, false);
  for (std::size_t i = 0; i < elastic.size(); ++i)
    CHECK(elastic[i] == Approx(cube_stress_Pa(law, 50.0 * G, Deformation::kUniaxial,
                                              history[i + 1].value, VolumeRule::kLogSquared))
                            .epsilon(1e-10));
  const auto exact = nominal_stress_Pa(law, terms, Deformation::kUniaxial, history);
  for (const bool is_projected : {false, true}) {
    const auto error = [&](double ratio) {
      return relaxing_stress_Pa(law, terms, ratio * G, history, VolumeRule::kUnitVolume,
                                is_projected)
                     .back() /
                 exact[exact.size() - 1] -
             1.0;
    };
    CHECK(std::abs(error(1e4)) < 3e-4);
    CHECK(error(1e3) / error(2e3) == Approx(2.0).epsilon(2e-2));  // of first order in G/K
  }
}

TEST_CASE("rubber proofs: FEBio's and MTest's own runs of a card show every constant (stand-ins)",
          "[io]") {
  if (std::system("command -v python3 >/dev/null 2>&1") != 0) return;
  const ScratchFolder folder;
  (void)stand_in(folder.path(), "mfront");
  const auto proof_in = [&](const std::string& card, const Rubber& rubber,
                            const std::string& target) {
    const std::string program = stand_in(folder.path(), target == "febio" ? "febio4" : "mtest");
    HyperelasticFile file = law_file(rubber);
    file.bulk_Pa = read_rubber_card(card_of(rubber, target), target, "mm-t-s").bulk_Pa;
    const FoundSolver found = find_solver(solver_for("", target), program);
    return prove_law_card(card, target, read_rubber_card(card, target, "mm-t-s"), &file, "", found);
  };
  const std::vector<RubberTerm> two{{0.3, 0.4}, {0.2, 9.0}};
  const Rubber ogden = rubber_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.1}, two),
               yeoh = rubber_of(HyperelasticForm::kYeoh, {2e5, 3e4, 5e3}, {}, two),
               gent = rubber_of(HyperelasticForm::kGent, {2.7e5}, {20.0}, {}),
               chains = rubber_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {2.2}, {});
  struct Row {
    const char* target;
    const Rubber* rubber;
    const char *from, *to;  // an edit that must be found
  };
  for (const Row& row : {Row{"febio", &ogden, "<t2>9</t2>", "<t2>9.3</t2>"},
                         Row{"febio", &yeoh, "0.005*(I1-3)^3", "0.0052*(I1-3)^3"},
                         Row{"febio", &gent, "<Jm>20</Jm>", "<Jm>21</Jm>"},
                         Row{"febio", &chains, "<k>311.", "<k>331."},
                         Row{"mfront", &ogden, "alpha[Nt] = {1.3", "alpha[Nt] = {1.4"},
                         Row{"mfront", &yeoh, "g[Nv] = {0.3", "g[Nv] = {0.31"}}) {
    CAPTURE(row.target, name_of(row.rubber->law.form));
    const std::string card = card_of(*row.rubber, row.target);
    CAPTURE(card);
    const LawProof proof = proof_in(card, *row.rubber, row.target);
    for (const CubeProof& cube : proof.cubes) {
      CAPTURE(cube.test.name, cube.error, cube.resolved, cube.compared);
      CHECK(cube.agrees());
    }
    REQUIRE(proof.hold.has_value() == !row.rubber->terms.empty());
    if (proof.hold) {
      CAPTURE(proof.hold->error, proof.hold->resolved);
      CHECK(proof.hold->agrees());
      CHECK(proof.hold->resolved < 2e-3);
    }
    CHECK(proof.not_exercised() == "");
    CHECK(proof.holds());
    CHECK_FALSE(proof_in(replaced(card, row.from, row.to), *row.rubber, row.target).agrees());
  }
  // FEBio's Yeoh with C_i0 for i C_i0, which a run of the numbers by another law would not see.
  const std::string older =
      "<material id=\"1\" name=\"R\" type=\"Yeoh\">\n<c1>0.2</c1><c2>0.03</c2>"
      "<c3>0.005</c3><k>300</k>\n</material>\n";
  CHECK(runs_law_of(solver_for("febio", "febio"), "febio"));
  CHECK(runs_law_of(solver_for("mtest", "mfront"), "mfront"));
  CHECK_FALSE(runs_law_of(solver_for("sfepy", ""), "febio"));
  CHECK(statement_of_law(solver_for("febio", "febio"), "febio") == "");
  CHECK(read_rubber_card(older, "febio", "").findings.size() == 1);
}
