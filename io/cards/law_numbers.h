#pragma once

#include "io/cards/card_numbers.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

struct CardLine;
struct ReadCard;

// Numbers of laws of rubber in a card, for writers and readers of the targets.

bool is_ogden(HyperelasticForm form);
// Ogden, and the laws that equal one of Ogden: Neo-Hooke and Mooney-Rivlin.
bool has_ogden_form(HyperelasticForm form);
// Moduli mu_i and exponents alpha_i of the Ogden energy that equals the law.
CardNumbers as_ogden(const CardNumbers& law);
// mu_1, alpha_1, mu_2, alpha_2 ...
std::vector<double> pairs_of(const CardNumbers& law);
// Ogden's own 2 mu_i/alpha_i.
std::vector<double> own_moduli(const CardNumbers& law);
double poisson_ratio_of(const CardNumbers& law);
// K of D = 2/K; 0: incompressible.
double bulk_of_d(double d);

// Readers fill the numbers by these. They throw std::runtime_error for a law that viscard has not.

void take_law(HyperelasticForm form, const std::vector<double>& moduli,
              const std::vector<double>& shapes, CardNumbers& out);
void take_ogden(const std::vector<double>& moduli, const std::vector<double>& shapes,
                CardNumbers& out);
// The same of Ogden's own constants 2 mu_i/alpha_i, up to the first 0.
void take_own_ogden(std::vector<double> constants, std::vector<double> shapes, CardNumbers& out);
// Neo-Hooke, Mooney-Rivlin or Yeoh of constants in the order C10, C01, C20, C11, C02, C30, C21, C12, C03; missing ones
// are 0.
void take_invariant_law(const std::vector<double>& constants, CardNumbers& out);
// A foam of 1 to 6 terms.
void take_foam_terms(const std::vector<double>& mu, const std::vector<double>& alpha,
                     const std::vector<double>& nu, CardNumbers& out);
void require_count(const std::vector<double>& numbers, std::size_t least, const std::string& what);

// The mistake "other-law" of a part that changes the stress and is not read.
void add_other_law(const CardLine& line, const std::string& text, ReadCard& card);
// The mistake "other-count"; the numbers behind `read` are noted as read.
void add_other_count(const CardLine& line, const std::string& text,
                     const std::vector<double>& numbers, std::size_t read, ReadCard& card);

}  // namespace viscard
