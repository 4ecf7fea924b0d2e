#pragma once

#include "io/cards/hyperelastic/rubber_rows.h"
#include "io/cards/read_card.h"

#include <string>
#include <vector>

namespace viscard {

// Numbers of a card of rubber in its own units, by viscard's definitions of the parameters.
struct RubberText {
  RubberNumbers numbers;  // moduli as they stand in the card: at once, or after all relaxation
  bool is_long_term = false;
  // Moduli and shares of terms that are shear moduli, not shares (LS-DYNA).
  bool has_absolute_terms = false;
  // Poisson's ratio in the place of the bulk modulus; 0 otherwise.
  double poisson = 0.0;
  bool has_poisson = false;
  // Every number states its unit, so that numbers are in SI (COMSOL).
  bool has_own_units = false;
  std::vector<CardFinding> findings;
  std::string units;      // the unit system that the card itself declares (OpenRadioss); ""
  std::string also_read;  // numbers that were compared, but belong to no law
};

// Parameters of a law: a reader fills numbers by its form. Throws std::runtime_error if `found` has fewer numbers.
void take_ogden(const std::vector<double>& moduli, const std::vector<double>& shapes,
                RubberNumbers& out);
// Neo-Hooke, Mooney-Rivlin or Yeoh of constants in the order C10, C01, C20, C11, C02, C30, C21, C12, C03; missing ones
// are 0. Throws std::runtime_error naming a constant that none of them has.
void take_invariant_law(const std::vector<double>& constants, RubberNumbers& out);

// A foam of these numbers; Throws std::runtime_error for other than 1 to 6 terms.
void take_foam_terms(const std::vector<double>& mu, const std::vector<double>& alpha,
                     const std::vector<double>& nu, RubberNumbers& out);

RubberText read_keyword_rubber(const std::string& text, bool is_calculix);
RubberText read_ansys_rubber(const std::string& text);
RubberText read_febio_rubber(const std::string& text);
RubberText read_lsdyna_rubber(const std::string& text);
RubberText read_openradioss_rubber(const std::string& text);
RubberText read_frontistr_rubber(const std::string& text);
RubberText read_sfepy_rubber(const std::string& text);
RubberText read_mfront_rubber(const std::string& text);
RubberText read_moose_rubber(const std::string& text);
RubberText read_comsol_rubber(const std::string& text);

}  // namespace viscard
