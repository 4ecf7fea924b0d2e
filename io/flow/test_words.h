#pragma once

#include "io/flow/fit_request.h"
#include "models/hyperelastic/deformation.h"
#include "models/hyperelastic/foam_law.h"

#include <span>
#include <string>
#include <vector>

namespace viscard {

// The words of tests at large strain: "uniaxial" (or "tension"), "compression", "planar" ... and those of
// foams alone: "confined", "volumetric", "shear".
struct LargeStrainKind {
  const char* word;
  Deformation deformation;
  FoamTest foam_test;
  bool is_compression = false, is_foam_only = false;
};
std::span<const LargeStrainKind> large_strain_kinds();

// "relaxation", "creep" ..., and behind them those at large strain.
std::vector<std::string> kinds_of_tests(bool with_large_strain);

// The words of a command that may name tests of one material: "creep=b.csv". Kinds: relaxation,
// creep, dma or oscillation, indentation. Returns an empty list if no word names a kind: then all
// are plain files. A word is a plain file if a file of that name exists, or if it has no "=" or a
// folder before it ("./a=b.csv"). Throws std::invalid_argument for an unknown kind, for plain files
// beside tests, and for a test without a file. takes_large_strain: the command takes tests at large
// strain too, by themselves, so a word that is near to theirs proposes them.
std::vector<TestFile> tests_from_words(const std::vector<std::string>& words,
                                       bool takes_large_strain = true);

// The files, without their kinds.
std::vector<std::string> paths_of(const std::vector<TestFile>& tests);

}  // namespace viscard
