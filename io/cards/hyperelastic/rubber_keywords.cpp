// Conventions of the solvers for the laws of models/hyperelastic/hyperelastic_law.h:
//   abaqus    U as in the header, mu_i and alpha_i of its Ogden form the same; D_1 = 2/K, 0 is
//             incompressible. Source: Abaqus Analysis User's Guide, Hyperelastic behavior of rubberlike
//             materials; *HYPERELASTIC.
//   calculix  the same numbers in the same order; D = 0 or below 1e-10 is replaced by 0.1/mu (nu 0.475).
//             Source: hyperelastics.f, rubber.f of CalculiX 2.2x. Run by the tests in CalculiX 2.20.
//   ansys     Ogden's own mu_i/alpha_i; NEO takes the shear modulus 2 C10; d = 2/K, 0 is incompressible.
//             Source: Mechanical APDL Structural Analysis Guide, TB,HYPER (OGDEN and NEO with examples);
//             order of BOYCE, GENT and YEOH: Material Reference 4.6.
// Damage by the first loading (models/hyperelastic/mullins_damage.h) of abaqus: *MULLINS EFFECT below the law,
//   with r, m, beta as here. Source: Analysis User's Guide, Mullins effect; order: CAE User's Guide, Mullins
//   effect, columns of its table. Not run. ansys has it as TB,CDM,,,3,PSE2, whose order no public text states.
// febio: rubber_febio.cpp; frontistr, lsdyna and openradioss: rubber_rows.cpp; comsol, moose and sfepy: rubber_models.cpp;
// mfront: rubber_mfront.cpp;
// terms of relaxation: rubber_terms.cpp.
#include "io/cards/hyperelastic/rubber_rows.h"
#include "io/cards/hyperelastic/rubber_terms.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <algorithm>

namespace viscard {
namespace {

using KeywordForm = HyperelasticForm;
using Numbers = std::vector<double>;

std::string row(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_of_20(number);
  return text + "\n";
}

// Rows of at most eight numbers.
std::string rows_of_eight(const Numbers& numbers) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t first = 0; first < numbers.size(); first += kMost) {
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(kMost, numbers.size() - first);
    text += row({from, from + static_cast<std::ptrdiff_t>(count)});
  }
  return text;
}

}  // namespace

std::string keyword_rubber(const RubberNumbers& law, bool is_calculix,
                           const std::string& material) {
  if (!law.foam.empty()) return keyword_foam(law, is_calculix, material);
  // calculix takes a smaller D for a missing one.
  constexpr double kLeast = 1e-10;
  require(!is_calculix || law.d() >= kLeast,
          "calculix replaces D = 2/K below 1e-10 by 0.1/mu, which is far softer; choose units with "
          "smaller numbers (--units mm-t-s) or a smaller --bulk-modulus");
  std::string keyword;
  Numbers numbers = law.moduli;
  if (is_ogden(law.form)) {
    keyword = fmt::format("OGDEN, N={}", law.moduli.size());
    numbers = pairs_of(law);
  } else if (law.form == KeywordForm::kArrudaBoyce) {
    keyword = "ARRUDA-BOYCE";
    numbers.push_back(law.shapes[0]);
  } else {
    keyword = law.form == KeywordForm::kNeoHooke       ? "NEO HOOKE"
              : law.form == KeywordForm::kMooneyRivlin ? "MOONEY-RIVLIN"
                                                       : "YEOH";
  }
  numbers.push_back(law.d());
  // One D for each term of OGDEN and YEOH. The higher ones add the 4th and 6th power of J - 1:
  // abaqus leaves them out for 0; calculix would replace a 0, and with D_1^i they count for nothing.
  const std::size_t n_terms =
      is_ogden(law.form) || law.form == KeywordForm::kYeoh ? law.moduli.size() : 1;
  for (std::size_t i = 1; i < n_terms; ++i) numbers.push_back(is_calculix ? 1e10 : 0.0);
  if (!law.terms.empty()) keyword += ", MODULI=INSTANTANEOUS";
  std::string text = "*MATERIAL, NAME=" + material + "\n";
  if (law.density > 0.0) text += "*DENSITY\n" + number_of_20(law.density) + ",\n";
  text += "*HYPERELASTIC, " + keyword + "\n" + rows_of_eight(numbers) + abaqus_terms(law);
  if (law.damage) {
    text += "*MULLINS EFFECT\n" + row({law.damage->r, law.damage->m, law.damage->beta});
  }
  return text;
}

std::string ansys_rubber(const RubberNumbers& law) {
  std::string option;
  Numbers numbers = law.moduli;
  std::size_t n_terms = 1;
  if (is_ogden(law.form)) {
    option = "OGDEN";
    n_terms = law.moduli.size();
    numbers = pairs_of(law);
    for (std::size_t i = 0; i < n_terms; ++i) numbers[2 * i] *= 2.0 / law.shapes[i];
  } else if (law.form == KeywordForm::kNeoHooke) {
    option = "NEO";
    numbers[0] *= 2.0;
  } else if (law.form == KeywordForm::kMooneyRivlin) {
    option = "MOONEY";
    n_terms = 2;
  } else if (law.form == KeywordForm::kYeoh) {
    option = "YEOH";
    n_terms = 3;
  } else {
    option = law.form == KeywordForm::kGent ? "GENT" : "BOYCE";
    numbers.push_back(law.shapes[0]);
  }
  numbers.push_back(law.d());
  const bool has_number = option == "OGDEN" || option == "MOONEY" || option == "YEOH";
  std::string text = law.density > 0.0 ? "MP,DENS,1," + number_of_20(law.density) + "\n" : "";
  text += fmt::format("TB,HYPER,1,1,{},{}\n", has_number ? std::to_string(n_terms) : "", option);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += fmt::format("TBDATA,{},{}\n", i + 1, number_of_20(numbers[i]));
  }
  return text + ansys_terms(law);
}

}  // namespace viscard
