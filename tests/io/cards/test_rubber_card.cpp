// Cards of laws of rubber: text by each solver's convention, and CalculiX itself.
#include "io/cards/hyperelastic/rubber_card.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace viscard;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

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
  return rubber_card(law, {.target = target, .units = units, .bulk_Pa = bulk_Pa});
}

const HyperelasticLaw kOgden =
    law_of(HyperelasticForm::kOgden3, {3.45e5, 6.2e3, 4.2}, {1.9, -2.2, 8.5});

// A cube of edge 1 on rollers, stretched to `stretch` along z; sides as the deformation has them.
std::string cube_deck(const std::string& card, Deformation deformation, double stretch) {
  const bool is_equibiaxial = deformation == Deformation::kEquibiaxial;
  std::ostringstream deck;
  deck << "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
          "*NSET,NSET=TOP\n5,6,7,8\n*NSET,NSET=BASE\n1,2,3,4\n*NSET,NSET=LEFT\n1,4,5,8\n"
          "*NSET,NSET=RIGHT\n2,3,6,7\n*NSET,NSET=FRONT\n1,2,5,6\n*NSET,NSET=BACK\n3,4,7,8\n"
          "*ELEMENT,TYPE=C3D8,ELSET=CUBE\n1,1,2,3,4,5,6,7,8\n"
       << card
       << "*SOLID SECTION,ELSET=CUBE,MATERIAL=RUBBER\n"
          "*BOUNDARY\nBASE,3,3\nLEFT,1,1\nFRONT,2,2\n"
       << (deformation == Deformation::kPlanar ? "BACK,2,2\n" : "")
       << "*STEP,NLGEOM,INC=1000\n*STATIC,DIRECT\n0.02,1\n*BOUNDARY\nTOP,3,3," << stretch - 1.0
       << "\n";
  if (is_equibiaxial) deck << "RIGHT,1,1," << stretch - 1.0 << "\n";
  deck << "*NODE PRINT,NSET=TOP,FREQUENCY=1000\nRF\n*END STEP\n";
  return deck.str();
}

// Sum of the z forces of the last table in ccx's .dat file.
double force_in(const fs::path& file) {
  std::ifstream lines(file);
  std::string line;
  double sum = 0.0;
  while (std::getline(lines, line)) {
    if (line.find("forces") != std::string::npos) sum = 0.0;
    std::istringstream cells(line);
    double node = 0.0, x = 0.0, y = 0.0, z = 0.0;
    if (cells >> node >> x >> y >> z) sum += z;
  }
  return sum;
}

double run_in_calculix(const std::string& deck) {
  const fs::path folder =
      fs::temp_directory_path() / ("viscard_rubber_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "cube.inp") << deck;
  const std::string command =
      "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx cube > log 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  const double force = force_in(folder / "cube.dat");
  fs::remove_all(folder);
  return force;
}

}  // namespace

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
        "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, OGDEN, N=3\n"
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
  CHECK_THAT(card_for(law_of(HyperelasticForm::kArrudaBoyce, {2e5}, {3.0}), "febio"),
             Contains("<N>9</N>"));
}

TEST_CASE("rubber cards: what a solver cannot take is refused", "[io]") {
  const HyperelasticLaw gent = law_of(HyperelasticForm::kGent, {2.7e5}, {80.0});
  CHECK_THROWS_WITH(card_for(gent, "abaqus"), Contains("abaqus has no gent law"));
  CHECK_THROWS_WITH(card_for(gent, "febio"), Contains("febio has no gent law"));
  CHECK_NOTHROW(card_for(gent, "ansys"));
  CHECK_THROWS_WITH(card_for(kOgden, "calculix", 1e12, "SI"), Contains("below 1e-10"));
  CHECK_THROWS_WITH(card_for(kOgden, "comsol"), Contains("no card of rubber for 'comsol'"));
  CHECK_THROWS_WITH(card_for(kOgden, "febio", -1.0), Contains("the bulk modulus"));
}
