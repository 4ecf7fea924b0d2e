// Conventions of the solvers for the foam of models/hyperelastic/foam_law.h (Ogden-Storakers):
//   abaqus       *HYPERFOAM: the same mu_i, alpha_i, nu_i; mu and alpha of each term, then the nu of each, eight
//                to a row. Source: Abaqus Analysis User's Guide, Hyperelastic behavior in elastomeric foams;
//                order as CalculiX reads the same keyword (hyperfoams.f).
//   calculix     the same. N = 1 has no stiffness (rubber.f tests kode < -15, and N = 1 is -15), so that one
//                term is written as two equal halves. Source: hyperfoams.f, rubber.f. One cube ran in 2.20: seven
//                digits of the law in all tests.
//   lsdyna       177, *MAT_HILL_FOAM: C_i = 2 mu_i/alpha_i, B_i = alpha_i, N = beta = nu/(1 - 2 nu) of all terms
//                together; K is the bulk modulus for contacts and the time step. Source: mat_177.cfg and
//                convertmats.cxx of OpenRadioss, fields as in PyDYNA. Not run.
//   openradioss  LAW62: the same mu_i, alpha_i, nu_i; if one nu_i is not 0, the nu of the first line is dropped.
//                Source: LAW62.cfg, sigeps62.F. Not run.
// FEBio's "Ogden unconstrained" equals it for nu = 0 only; the order of ANSYS's FOAM is public, its energy not.
#include "io/cards/column_fields.h"
#include "io/cards/hyperelastic/rubber_rows.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/leading_number.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using FoamTerms = std::vector<RubberNumbers::FoamTerm>;
using FoamCells = std::vector<double>;

// `width` columns each, `most` to a line.
std::string column_rows(const FoamCells& numbers, int width, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += real(numbers[i], width);
    if (i % most == most - 1 || i + 1 == numbers.size()) text += "\n";
  }
  return text;
}

FoamCells cells_of(const FoamTerms& terms, double (*number)(const RubberNumbers::FoamTerm&)) {
  FoamCells out;
  for (const RubberNumbers::FoamTerm& term : terms) out.push_back(number(term));
  return out;
}

FoamCells moduli_of(const FoamTerms& terms) {
  return cells_of(terms, [](const RubberNumbers::FoamTerm& term) { return term.mu; });
}
FoamCells exponents_of(const FoamTerms& terms) {
  return cells_of(terms, [](const RubberNumbers::FoamTerm& term) { return term.alpha; });
}
FoamCells ratios_of(const FoamTerms& terms) {
  return cells_of(terms, [](const RubberNumbers::FoamTerm& term) { return term.nu; });
}

// Largest relative change of a number in ten columns.
double loss_in_ten(const FoamCells& numbers) {
  constexpr int kTen = 10;
  double loss = 0.0;
  for (const double number : numbers) {
    if (number == 0.0) continue;
    loss = std::max(loss, std::abs(leading_number(real(number, kTen)) / number - 1.0));
  }
  return loss;
}

}  // namespace

std::string keyword_foam(const RubberNumbers& foam, bool is_calculix, const std::string& material) {
  FoamTerms terms = foam.foam;
  if (is_calculix && terms.size() == 1) {
    terms[0].mu /= 2.0;
    terms.push_back(terms[0]);
  }
  FoamCells numbers;
  for (const RubberNumbers::FoamTerm& term : terms) {
    numbers.push_back(term.mu);
    numbers.push_back(term.alpha);
  }
  for (const RubberNumbers::FoamTerm& term : terms) numbers.push_back(term.nu);
  std::string text = "*MATERIAL, NAME=" + material + "\n";
  if (foam.density > 0.0) text += "*DENSITY\n" + number_of_20(foam.density) + ",\n";
  text += fmt::format("*HYPERFOAM, N={}\n", terms.size());
  constexpr std::size_t kEight = 8;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool is_last = i + 1 == numbers.size() || i % kEight == kEight - 1;
    text += number_of_20(numbers[i]) + (is_last ? "\n" : ", ");
  }
  return text;
}

std::string lsdyna_foam(const RubberNumbers& foam, const std::string& material) {
  constexpr int kTen = 10;
  constexpr std::size_t kEight = 8;
  const double beta = foam.foam[0].beta();
  for (const RubberNumbers::FoamTerm& term : foam.foam) {
    require(term.nu == foam.foam[0].nu,
            "lsdyna takes one N = nu/(1 - 2 nu) for all terms, and the foam has a nu of each; fit "
            "hyperfoam-1, or write the card for abaqus, calculix or openradioss");
  }
  FoamCells factors(kEight, 0.0), exponents(kEight, 0.0);
  for (std::size_t i = 0; i < foam.foam.size(); ++i) {
    factors[i] = 2.0 * foam.foam[i].mu / foam.foam[i].alpha;
    exponents[i] = foam.foam[i].alpha;
  }
  const FoamCells head{foam.density, foam.bulk, beta};
  const double loss = std::max({loss_in_ten(head), loss_in_ten(factors), loss_in_ten(exponents)});
  return fmt::format(
             "$ numbers: rounded to ten columns, by at most {:.1e}\n$ MU = 0: the solver's own "
             "damping\n*MAT_HILL_FOAM_TITLE\n{}\n$      MID        RO         K         N        "
             "MU      LCID   FITTYPE      LCSR\n",
             loss, material) +
         right("1", kTen) + real(head[0], kTen) + real(head[1], kTen) + real(head[2], kTen) +
         real(0.0, kTen) + right("0", kTen) + right("0", kTen) + right("0", kTen) +
         "\n$       C1 to C8\n" + column_rows(factors, kTen, kEight) + "$       B1 to B8\n" +
         column_rows(exponents, kTen, kEight) + "$        R         M\n" +
         column_rows({0.0, 0.0}, kTen, kEight);
}

std::string openradioss_foam(const RubberNumbers& foam, const std::string& material) {
  constexpr int kColumn = 20, kWhole = 10;
  constexpr std::size_t kFive = 5;
  return radioss_unit_block(foam) + "/MAT/LAW62/1/1\n" + material + "\n#              RHO_I\n" +
         real(foam.density, kColumn) +
         "\n#                 nu         N         M              mu_max\n" + real(0.0, kColumn) +
         right(std::to_string(foam.foam.size()), kWhole) + right("0", kWhole) + real(0.0, kColumn) +
         "\n# mu\n" + column_rows(moduli_of(foam.foam), kColumn, kFive) + "# alpha\n" +
         column_rows(exponents_of(foam.foam), kColumn, kFive) + "# nu\n" +
         column_rows(ratios_of(foam.foam), kColumn, kFive);
}

}  // namespace viscard
