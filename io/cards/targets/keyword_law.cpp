// Conventions for the laws of models/hyperelastic/hyperelastic_law.h, foam_law.h and mullins_damage.h:
//   abaqus    U as in the header, mu_i and alpha_i of its Ogden form the same; D_1 = 2/K, 0 is
//             incompressible. Source: Abaqus Analysis User's Guide, Hyperelastic behavior of rubberlike
//             materials; *HYPERELASTIC. *HYPERFOAM has the same mu_i, alpha_i, nu_i: mu and alpha of each term,
//             then the nu of each, eight to a row (the guide's elastomeric foams; order as in CalculiX).
//             *VISCOELASTIC below MODULI=INSTANTANEOUS: rows g_i, k_i = 0, tau_i, the hereditary integral in the
//             reference configuration, pushed forward "(see Simo, 1987)" (Theory Guide 4.8.2).
//             *MULLINS EFFECT: r, m, beta as here (User's Guide, Mullins effect; order: CAE User's Guide, columns
//             of its table). Not run.
//   calculix  the same numbers in the same order; D = 0 or below 1e-10 is replaced by 0.1/mu (nu 0.475). A foam of
//             N = 1 has no stiffness (rubber.f tests kode < -15, and N = 1 is -15), so that one term is written as
//             two equal halves. Source: hyperelastics.f, hyperfoams.f, rubber.f of CalculiX 2.2x. Run by the tests
//             in CalculiX 2.20.
#include "io/cards/targets/keyword_law.h"

#include "io/cards/keyword_lines.h"
#include "io/cards/law_numbers.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

using enum HyperelasticForm;
using KeywordNumbers = std::vector<double>;

constexpr std::size_t kEightCells = 8;  // at most in a row

std::string rows_of_eight(const KeywordNumbers& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool is_last = i + 1 == numbers.size() || i % kEightCells == kEightCells - 1;
    text += number_of_20(numbers[i]) + (is_last ? "\n" : ", ");
  }
  return text;
}

std::string hyperelastic_block(const CardNumbers& law, bool is_calculix) {
  // calculix takes a smaller D for a missing one.
  constexpr double kLeast = 1e-10;
  require(!is_calculix || law.d() >= kLeast,
          "calculix replaces D = 2/K below 1e-10 by 0.1/mu, which is far softer; choose units with "
          "smaller numbers (--units mm-t-s) or a smaller --bulk-modulus");
  const bool ogden = is_ogden(law.form);
  std::string keyword = ogden                       ? fmt::format("OGDEN, N={}", law.moduli.size())
                        : law.form == kArrudaBoyce  ? "ARRUDA-BOYCE"
                        : law.form == kNeoHooke     ? "NEO HOOKE"
                        : law.form == kMooneyRivlin ? "MOONEY-RIVLIN"
                                                    : "YEOH";
  KeywordNumbers numbers = ogden ? pairs_of(law) : law.moduli;
  if (law.form == kArrudaBoyce) numbers.push_back(law.shapes[0]);
  numbers.push_back(law.d());
  // One D for each term of OGDEN and YEOH. The higher ones add the 4th and 6th power of J - 1:
  // abaqus leaves them out for 0; calculix would replace a 0, and with D_1^i they count for nothing.
  const std::size_t n_terms = ogden || law.form == kYeoh ? law.moduli.size() : 1;
  numbers.resize(numbers.size() + n_terms - 1, is_calculix ? 1e10 : 0.0);
  if (!law.branches.empty()) keyword += ", MODULI=INSTANTANEOUS";
  return "*HYPERELASTIC, " + keyword + "\n" + rows_of_eight(numbers);
}

std::string hyperfoam_block(std::vector<CardNumbers::FoamTerm> terms, bool is_calculix) {
  if (is_calculix && terms.size() == 1) {
    terms[0].mu /= 2.0;
    terms.push_back(terms[0]);
  }
  KeywordNumbers numbers;
  for (const CardNumbers::FoamTerm& term : terms)
    numbers.insert(numbers.end(), {term.mu, term.alpha});
  for (const CardNumbers::FoamTerm& term : terms) numbers.push_back(term.nu);
  return fmt::format("*HYPERFOAM, N={}\n", terms.size()) + rows_of_eight(numbers);
}

// Eight cells to a line, as Abaqus and CalculiX read them: blank ones are 0, those at the end are left out.
KeywordNumbers all_numbers(const KeywordBlock& block) {
  KeywordNumbers out;
  for (const CardLine& line : block.data) {
    out.resize((out.size() + kEightCells - 1) / kEightCells * kEightCells);
    auto row = cells(line.text, ',');
    while (!row.empty() && row.back().empty()) row.pop_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      out.push_back(cell_number_or_zero(row, i, line, "constant"));
  }
  return out;
}

// N= of a law of several orders.
std::size_t order_of(const KeywordBlock& block) {
  for (const std::string& parameter : block.parameters) {
    if (parameter.rfind("N=", 0) == 0)
      return static_cast<std::size_t>(
          cell_integer({parameter.substr(2)}, 0, block.line, "N of " + block.keyword));
  }
  return 1;
}

// The first n numbers, as constants of the polynomial C_ij (I1 - 3)^i (I2 - 3)^j; those of REDUCED POLYNOMIAL are C_i0.
void take_polynomial(const KeywordBlock& block, KeywordNumbers constants, std::size_t n,
                     CardNumbers& law) {
  constants.resize(n);
  if (block.has("REDUCEDPOLYNOMIAL")) {
    constants.resize(std::max<std::size_t>(n, 3), 0.0);
    if (std::any_of(constants.begin() + 3, constants.end(), [](double c) { return c != 0.0; }))
      throw std::runtime_error(
          at_line(block.line, "a constant C_i0 above C30 is not 0, and viscard has no such law"));
    constants = {constants[0], 0.0, constants[1], 0.0, 0.0, constants[2]};
  }
  take_invariant_law(constants, law);
}

// The constants, then D.
void take_hyperelastic(const KeywordBlock& block, ReadCard& card) {
  const KeywordNumbers numbers = all_numbers(block);
  CardNumbers& law = card.numbers;
  const bool ogden = block.has("OGDEN"), is_reduced = block.has("REDUCEDPOLYNOMIAL"),
             is_polynomial = block.has("POLYNOMIAL"), is_yeoh = block.has("YEOH");
  const bool has_order = ogden || is_reduced || is_polynomial;
  const std::size_t order = has_order ? order_of(block) : is_yeoh ? 3 : 1;
  const std::size_t n = ogden                                            ? 2 * order
                        : is_polynomial                                  ? order * (order + 3) / 2
                        : is_reduced || is_yeoh || block.has("NEOHOOKE") ? order
                        : block.has("MOONEY-RIVLIN") || block.has("ARRUDA-BOYCE") ? 2
                                                                                  : 0;
  if (n == 0) {
    throw std::runtime_error(
        at_line(block.line,
                "only OGDEN, NEO HOOKE, MOONEY-RIVLIN, YEOH, ARRUDA-BOYCE, POLYNOMIAL and REDUCED "
                "POLYNOMIAL are read"));
  }
  require_count(numbers, n, block.keyword);
  if (ogden) {
    KeywordNumbers moduli, shapes;
    for (std::size_t i = 0; i < order; ++i) {
      moduli.push_back(numbers[2 * i]);
      shapes.push_back(numbers[2 * i + 1]);
    }
    take_ogden(moduli, shapes, law);
  } else if (is_reduced || is_polynomial) {
    take_polynomial(block, numbers, n, law);
  } else if (block.has("ARRUDA-BOYCE")) {
    take_law(kArrudaBoyce, {numbers[0]}, {numbers[1]}, law);
  } else {
    take_law(is_yeoh  ? kYeoh
             : n == 2 ? kMooneyRivlin
                      : kNeoHooke,
             {numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n)}, {}, law);
  }
  law.bulk = numbers.size() > n ? bulk_of_d(numbers[n]) : 0.0;
  // D_2 ... are beyond the laws; with D_1^i they count for nothing, or are 0.
  if (numbers.size() > n + order) {
    card.add("other-count",
             at_line(block.line,
                     fmt::format("{} numbers stand below {}, which takes {} constants and {} D",
                                 numbers.size(), block.keyword, n, order)));
  }
  for (std::size_t i = n + 1; i < numbers.size(); ++i) {
    constexpr double kNothing = 1e9;
    card.also_read += fmt::format(" {}", numbers[i]);
    if (numbers[i] == 0.0 || numbers[i] >= kNothing) continue;
    card.add(
        "higher-volume-terms",
        at_line(block.line, fmt::format("D_{} = {:g} is not read: viscard's laws have D_1 alone",
                                        i - n + 1, numbers[i])));
  }
}

void take_hyperfoam(const KeywordBlock& block, bool is_calculix, ReadCard& card) {
  const KeywordNumbers numbers = all_numbers(block);
  const std::size_t n = order_of(block);
  require_count(numbers, 2 * n, block.keyword);
  KeywordNumbers mu, alpha, nu;
  for (std::size_t i = 0; i < n; ++i) {
    mu.push_back(numbers[2 * i]);
    alpha.push_back(numbers[2 * i + 1]);
    nu.push_back(2 * n + i < numbers.size() ? numbers[2 * n + i] : 0.0);
  }
  take_foam_terms(mu, alpha, nu, card.numbers);
  if (is_calculix && n == 1) {
    card.add("calculix-one-term", at_line(block.line,
                                          "ccx gives *HYPERFOAM with N = 1 no stiffness; write N=2 "
                                          "with half of mu twice"));
  }
  if (numbers.size() <= 3 * n) return;
  add_other_count(block.line,
                  fmt::format("{} numbers stand below {}, which takes {}", numbers.size(),
                              block.keyword, 3 * n),
                  numbers, 3 * n, card);
}

void take_mullins(const KeywordBlock& block, ReadCard& card) {
  const bool is_direct = std::none_of(
      block.parameters.begin(), block.parameters.end(), [](const std::string& parameter) {
        return parameter == "USER" || parameter == "TESTDATAINPUT" ||
               parameter.rfind("DEPENDENCIES", 0) == 0;
      });
  if (!is_direct) {
    return add_other_law(block.line,
                         block.keyword +
                             " is given by test data, fields or a subroutine and is "
                             "not read; only r, m, beta are",
                         card);
  }
  const KeywordNumbers numbers = all_numbers(block);
  constexpr std::size_t kConstants = 3;
  require_count(numbers, 2, block.keyword);
  card.numbers.damage = {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0.0};
  if (numbers.size() <= kConstants) return;
  add_other_count(block.line,
                  fmt::format("{} numbers stand below {}, and {} are read: r, m, beta",
                              numbers.size(), block.keyword, kConstants),
                  numbers, kConstants, card);
}

void take_relaxation(const KeywordBlock& block, ReadCard& card) {
  if (!block.has("TIME=PRONY"))
    throw std::runtime_error(at_line(block.line, "only *VISCOELASTIC, TIME=PRONY can be read"));
  for (const CardLine& line : block.data) {
    read_prony_rows({line}, card);
    if (card.numbers.branches.back().bulk != 0.0)
      card.add("bulk-relaxes", at_line(line, "k_i is not 0: the bulk modulus would relax"));
  }
}

}  // namespace

LawKeywords keyword_laws() {
  return {"NEO HOOKE: C10",
          "MOONEY-RIVLIN: C10, C01",
          "YEOH: C10, C20, C30",
          "OGDEN: mu_i, alpha_i of sum 2 mu_i/alpha_i^2 (...)",
          "ARRUDA-BOYCE: mu, s_m",
          "",
          "HYPERFOAM: mu_i, alpha_i, nu_i of sum 2 mu_i/alpha_i^2 (...)"};
}

// Abaqus and ANSYS: their manuals; CalculiX: rubber.f, run by the tests; FrontISTR: Hyperelastic.f90.
std::string keyword_law_volume(const std::string& d) {
  return "(J - 1)^2/" + d + "; of Arruda-Boyce ((J^2 - 1)/2 - ln J)/" + d;
}

std::string write_keyword_law(const CardBody& body, bool is_calculix) {
  const CardNumbers& law = body.numbers;
  std::string text = keyword_head(body.name, law.density);
  if (!law.foam.empty()) return text + hyperfoam_block(law.foam, is_calculix);
  text += hyperelastic_block(law, is_calculix) + prony_block("TIME", law.branches);
  if (!law.damage) return text;
  return text + "*MULLINS EFFECT\n" +
         rows_of_eight({law.damage->r, law.damage->m, law.damage->beta});
}

void read_keyword_law(const std::string& text, bool is_calculix, ReadCard& card) {
  CardNumbers& law = card.numbers;
  bool has_law = false, is_at_once = false;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "**"), '*');
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "*HYPERELASTIC") {
      take_hyperelastic(block, card);
      has_law = true;
      is_at_once = block.has("MODULI=INSTANTANEOUS");
    } else if (block.keyword == "*HYPERFOAM") {
      take_hyperfoam(block, is_calculix, card);
      has_law = true;
    } else if (block.keyword == "*DENSITY") {
      law.density = density_in(block);
    } else if (block.keyword == "*MULLINS EFFECT" && is_calculix) {
      card.add(
          "ignored-damage",
          at_line(block.line, "ccx skips *MULLINS EFFECT with a warning: the law has no damage"));
    } else if (block.keyword == "*MULLINS EFFECT") {
      take_mullins(block, card);
    } else if (block.keyword == "*VISCOELASTIC" && is_calculix) {
      card.add("ignored-viscoelastic",
               at_line(block.line, "ccx ignores *VISCOELASTIC: the law is elastic"));
    } else if (block.keyword == "*VISCOELASTIC") {
      take_relaxation(block, card);
    }
  }
  require_in_card(has_law, "*HYPERELASTIC");
  if (!law.foam.empty() && !law.branches.empty())
    card.add("foam-with-terms",
             "terms of relaxation stand beside *HYPERFOAM, and viscard's foams have none");
  check_single_material(blocks, card);
  for (const KeywordBlock& block : blocks) {
    for (const char* other :
         {"*ELASTIC", "*PLASTIC", "*CREEP", "*HYSTERESIS", "*DAMPING", "*USER MATERIAL", "*VISCOUS",
          "*DAMAGE INITIATION", "*CONCRETE", "*RATE DEPENDENT"}) {
      if (block.keyword == other)
        add_other_law(block.line, block.keyword + " changes the stress and is not read", card);
    }
  }
  if (!is_at_once && !law.branches.empty()) card.understood.at = ModulusAt::kLongTerm;
  if (is_calculix && law.bulk == 0.0 && law.foam.empty())
    card.add("replaced-D", "ccx replaces D = 0 by 0.1/mu, a Poisson's ratio of 0.475");
}

}  // namespace viscard
