// The modules for SfePy and dolfinx are run on one element by the solvers themselves.
#include "io/basics/atomic_file.h"
#include "io/cards/card.h"
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

// Debian's modules are those of its own interpreter.
bool has_module(const std::string& name) {
  const bool found =
      std::system(("/usr/bin/python3 -c 'import " + name + "' >/dev/null 2>&1").c_str()) == 0;
  if (!found) WARN(name << " is not installed for /usr/bin/python3; it is not run");
  return found;
}

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "viscard-python-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The largest difference of the solver's answer from the exact one, over all steps.
double error_in(const char* target, const Material& material, ElementTestKind kind) {
  const Card card = write_card(material, card_target(target), {.units = "SI"});
  const DeckWriter& writer = card_deck(target);
  const Deck deck = one_element_deck(card, writer, unit_system("SI"), kind);
  const Folder folder;
  for (const DeckFile& file : deck.files) {
    std::ofstream(folder.path() / file.name) << file.text;
  }
  const std::string command = "cd " + folder.path().string() + " && /usr/bin/python3 " +
                              deck.files[0].name + " >answer.csv 2>errors.txt";
  REQUIRE(std::system(command.c_str()) == 0);
  ElementTestOptions options = writer.test;
  options.kind = kind;
  const ElementTest test = element_test(card.written, options);
  std::ifstream answer(folder.path() / "answer.csv");
  double worst = 0.0, time = 0.0, response = 0.0;
  int rows = 0;
  char comma = 0;
  for (; answer >> time >> comma >> response; ++rows) {
    worst = std::max(worst, std::abs(response / exact_response(card.written, test, time) - 1.0));
  }
  int steps = 0;
  for (const TimeBlock& block : test.blocks) steps += block.increments;
  CHECK(rows == steps);
  return worst;
}

// Random shares and times over five decades; bulk relaxation of its own.
Material random_material(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Material material = reference_material();
  material.nu = 0.05 + 0.44 * uniform(random);
  material.terms.clear();
  const int n = 1 + static_cast<int>(3.99 * uniform(random));
  for (int i = 0; i < n; ++i) {
    material.terms.push_back({0.9 / n * uniform(random), 0.9 / n * uniform(random),
                              std::pow(10.0, -2.0 + 3.0 * uniform(random))});
  }
  material.provenance.bulk_origin = "measured";
  return material;
}

// Exact for strain that is linear in a step; in creep it is not, so there the step counts.
constexpr double kExact = 1e-10;
constexpr double kOfTheStep = 3e-3;

}  // namespace

TEST_CASE("SfePy returns the exact relaxation of its card, and creep to the step", "[cards]") {
  if (!has_module("sfepy")) return;
  CHECK(error_in("sfepy", reference_material(), ElementTestKind::kRelaxation) <= kExact);
  CHECK(error_in("sfepy", reference_material(), ElementTestKind::kCreep) <= 1e-5);
}

TEST_CASE("SfePy holds ten random cards", "[cards][slow]") {
  if (!has_module("sfepy")) return;
  std::mt19937 random(17);
  for (int i = 0; i < 10; ++i) {
    Material material = random_material(random);
    CAPTURE(i, material.terms.size(), material.nu);
    CHECK(error_in("sfepy", material, ElementTestKind::kCreep) <= kOfTheStep);
    // The sides are free: with k = g the strain in them is linear in each step too.
    for (MaterialTerm& term : material.terms) term.k = term.g;
    CHECK(error_in("sfepy", material, ElementTestKind::kRelaxation) <= kExact);
  }
}

TEST_CASE("dolfinx holds its card and ten random ones", "[cards][slow]") {
  if (!has_module("dolfinx")) return;
  CHECK(error_in("dolfinx", reference_material(), ElementTestKind::kRelaxation) <= kExact);
  CHECK(error_in("dolfinx", reference_material(), ElementTestKind::kCreep) <= 1e-5);
  std::mt19937 random(17);
  for (int i = 0; i < 10; ++i) {
    Material material = random_material(random);
    CAPTURE(i, material.terms.size(), material.nu);
    CHECK(error_in("dolfinx", material, ElementTestKind::kCreep) <= kOfTheStep);
    for (MaterialTerm& term : material.terms) term.k = term.g;
    CHECK(error_in("dolfinx", material, ElementTestKind::kRelaxation) <= kExact);
  }
}

TEST_CASE("the numbers of a Python card are those of the material", "[cards]") {
  const std::string text =
      write_card(reference_material(), card_target("sfepy"), {.units = "mm-t-s"}).text;
  for (const char* line :
       {"\nE0 = 1.88\n", "\nnu = 0.495\n", "\nrho = 9.65e-10\n", "\ng = [0.008206, 0.01386]\n",
        "\nk = [0.008206, 0.01386]\n", "\ntau = [0.1945, 2.403]\n"}) {
    CHECK_THAT(text, Catch::Contains(line));
  }
}
