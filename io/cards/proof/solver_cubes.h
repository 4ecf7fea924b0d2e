#pragma once

#include "io/cards/proof/solver.h"
#include "models/hyperelastic/deformation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// A cube of edge 1 that is stretched from rest to `top` in equal steps of the stretch and of the time, then held.
struct CubeTest {
  std::string name;  // "uniaxial", "compression", "planar", "equibiaxial", "confined", "relaxation"
  Deformation deformation = Deformation::kUniaxial;
  double top = 1.0;
  int steps = 0;
  // Sides are held: shows the bulk modulus, which free sides of rubber hardly do. Of two elements, because
  // one would have no unknown.
  bool is_confined = false;
  double ramp = 1.0;          // in the card's unit of time
  std::vector<double> until;  // ends of the holds
  double stress = 0.0;        // about that of the top, in the card's unit: for tolerances

  double end() const { return until.empty() ? ramp : until.back(); }
};

// Rows that a solver printed, in the units of the card.
struct CubeRow {
  double at = 0.0;      // stretch; of a hold the time
  double stress = 0.0;  // nominal
  // Force that the iteration left on the free sides, relative to that of the stretch.
  double unbalanced = 0.0;
  // Of a hold: extrapolated from two bulk moduli instead of three.
  double coarser = 0.0;
};

// The model of CalculiX for one test.
std::vector<DeckFile> calculix_cube(const std::string& card, const CubeTest& test);
// Sums of the forces of all increments, at their stretches. ccx accepts an increment after two iterations, so that
// the first ones may be out of balance by some 1e-5.
std::vector<CubeRow> calculix_rows(const std::filesystem::path& folder, const CubeTest& test);

// The model of FEBio, and of MTest beside the behaviour card.mfront; both for stretches and holds.
std::vector<DeckFile> febio_cube(const std::string& card, const CubeTest& test);
std::vector<DeckFile> mtest_cube(const std::string& card, const CubeTest& test);
// FEBio: sums of the reactions Rz of the top, of the sign of the stretch (FEBio states none). MTest: Cauchy stresses
// times both other stretches.
std::vector<CubeRow> febio_rows(const std::filesystem::path& folder, const CubeTest& test);
std::vector<CubeRow> mtest_rows(const std::filesystem::path& folder, const CubeTest& test);

// The script of SfePy for all tests, beside the module card.py; with a hold too.
std::vector<DeckFile> sfepy_cubes(const std::string& card, const std::vector<CubeTest>& tests,
                                  const CubeTest* hold);
// Test `number`; that of the hold follows the others.
std::vector<CubeRow> sfepy_rows(const std::filesystem::path& folder, std::size_t number);

}  // namespace viscard
