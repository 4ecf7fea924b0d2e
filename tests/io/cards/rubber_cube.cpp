#include "tests/io/cards/rubber_cube.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace viscard {

namespace fs = std::filesystem;

namespace {

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

}  // namespace

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

}  // namespace viscard
