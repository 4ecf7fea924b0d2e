#pragma once

#include <string>
#include <vector>

namespace viscard {

// Which modulus a test measured. Inside viscard a modulus is Young's; other kinds are converted where
// they are read.
enum class ModulusKind { kTension, kShear, kPlaneStrain, kIndentation, kBulk };

// Its word ("shear"), letter ("G", of G0_Pa) and conversion ("E = 2 (1 + nu) G").
struct ModulusKindText {
  const char* word;
  const char* letter;
  const char* conversion;
};
const ModulusKindText& text_of(ModulusKind kind);

// The words of all kinds.
const std::vector<std::string>& modulus_kind_words();
// Throws std::invalid_argument for another word, with the words that there are.
ModulusKind modulus_kind_from_word(const std::string& word);

// Young's modulus over a modulus of this kind, of an isotropic material (Timoshenko & Goodier, Theory
// of Elasticity, 1970, sec. 6): tension 1, shear 2 (1 + nu), plane strain and the reduced modulus of
// indentation 1 - nu^2, bulk 3 (1 - 2 nu). Throws std::invalid_argument for a Poisson ratio outside
// (-1, 0.5], and for 0.5 with a bulk modulus.
double young_over(ModulusKind kind, double nu);

}  // namespace viscard
