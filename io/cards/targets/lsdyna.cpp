// LS-DYNA 076 and 006. Sources: Keyword User's Manual R13, vol. I (one-element model, not run) and II
// (*MAT_076, remarks; README.md: no WLF). OpenRadioss and PyDYNA readers agree on fields.
// Laws of rubber, not run (fields as in PyDYNA):
//   077_H  C10, C01, C11, C20, C02, C30; Poisson's ratio instead of K
//   077_O  Ogden's own 2 mu/alpha, eight of each; Poisson's ratio instead of K
//   terms  the law after all relaxation, rows G_i = g_i G_0, BETA_i = 1/tau_i. They act on the strain, not on the
//          law's own stress, so they are right at small strain only. No public text with that strain was found.
//   127    Arruda-Boyce, takes a whole number of links only, so that it is refused
//   177    *MAT_HILL_FOAM: C_i = 2 mu_i/alpha_i, B_i = alpha_i, N = beta = nu/(1 - 2 nu) of all terms together; K is
//          the bulk modulus for contacts and the time step (mat_177.cfg, convertmats.cxx of OpenRadioss)
// Ten columns round numbers; these cards state by how much.
#include "io/basics/number_text.h"
#include "io/cards/card_lines.h"
#include "io/cards/column_fields.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/law_numbers.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "models/maths/leading_number.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Nine of the ten columns, so that neighbours do not touch, if that costs at most 1e-7 of the number.
std::string field(double value) {
  const std::string nine = nearest_number(value, 9);
  const bool is_near = std::abs(leading_number(nine) - value) <= 1e-7 * std::abs(value);
  return right(is_near ? nine : nearest_number(value, 10), 10);
}

// MID, RO, BULK. LS-DYNA refuses a density of 0 (not given); a blank field shows the omission.
std::string first_fields(const CardNumbers& numbers) {
  return right("1", 10) + (numbers.density > 0.0 ? field(numbers.density) : right("", 10)) +
         field(numbers.bulk);
}

// G(t) = sum G_i exp(-beta_i t), so the equilibrium modulus is a row with beta = 0. Card 2 (a fit
// by LS-DYNA itself) is empty but must be there. KI is blank: the bulk modulus is constant.
std::string write_076(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = "*MAT_GENERAL_VISCOELASTIC_TITLE\n" + body.name + "\n";
  if (numbers.shift) {
    out +=
        "$ Arrhenius shift (manual, not run: compare one warm run): time is multiplied by\n"
        "$ exp(-A (1/T - 1/TREF)), A = E_a/R, T in K\n";
  }
  out += "$      MID        RO      BULK       PCF        EF      TREF         A         B\n" +
         first_fields(numbers);
  if (numbers.shift) {
    out += right("", 20) + field(numbers.shift->T_ref_C - kAbsoluteZero_C) +
           field(numbers.shift->activation_J_mol / kGasConstant_J_mol_K) + field(0.0);
  }
  out +=
      "\n$     LCID        NT    BSTART     TRAMP     LCIDK       NTK   BSTARTK    TRAMPK\n\n"
      "$       GI     BETAI        KI    BETAKI\n";
  out += field(numbers.equilibrium) + field(0.0) + "\n";
  for (const CardBranch& branch : numbers.branches) {
    out += field(branch.shear) + field(branch.time) + "\n";
  }
  return out;
}

// G(t) = GI + (G0 - GI) exp(-BETA t); GI is the long-term modulus, unlike in 076.
std::string write_006(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const CardBranch branch = numbers.branches.empty() ? CardBranch{} : numbers.branches[0];
  return "*MAT_VISCOELASTIC_TITLE\n" + body.name +
         "\n$      MID        RO      BULK        G0        GI      BETA\n" +
         first_fields(numbers) + field(numbers.equilibrium + branch.shear) +
         field(numbers.equilibrium) + field(branch.time) + "\n";
}

// The lines below the first keyword that starts with one of the names, up to the next keyword.
struct KeywordCards {
  std::string keyword;
  std::vector<CardLine> lines;
  std::size_t width = 10;

  std::vector<std::string> row(std::size_t at) const { return columns(lines[at].text, width); }
  // Blank fields are 0.
  std::vector<double> numbers(std::size_t at) const {
    if (at >= lines.size()) throw std::runtime_error("the card ends before its last row");
    std::vector<double> out(8, 0.0);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = cell_number_or_zero(row(at), i, lines[at], "number");
    return out;
  }
};

KeywordCards material_cards(const std::string& text, const std::vector<std::string>& names,
                            const std::string& wanted, ReadCard& card) {
  KeywordCards cards;
  bool inside = false, wants_title = false;
  int materials = 0;
  const std::vector<CardLine> all = card_lines(text, "$");
  for (const CardLine& line : all) {
    const std::string word = upper(trimmed(line.text));
    if (!word.empty() && word[0] == '*') {
      const bool begins = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return word.rfind(name, 0) == 0;
      });
      inside = begins && ++materials == 1;
      if (begins && !inside) card.add_second_material(line);
      wants_title = inside && word.find("_TITLE") != std::string::npos;
      if (inside) cards.width = dyna_width(all, line);
      if (inside) cards.keyword = word;
    } else if (inside && wants_title) {
      card.name = trimmed(line.text);
      wants_title = false;
    } else if (inside) {
      cards.lines.push_back(line);
    }
  }
  require_in_card(!cards.lines.empty(), wanted);
  const CardLine& first = cards.lines.front();
  const auto row = cards.row(0);
  for (const CardFinding& finding : material_number_findings(row.empty() ? "" : row[0], first))
    card.findings.push_back(finding);
  card.numbers.density = cell_number_or_zero(row, 1, first, "RO");
  return cards;
}

KeywordCards viscoelastic_cards(const std::string& text, const std::string& long_name,
                                const std::string& short_name, ReadCard& card) {
  const KeywordCards cards = material_cards(text, {long_name, short_name},
                                            long_name + " (or " + short_name + ") with data", card);
  card.numbers.bulk = cell_number(cards.row(0), 2, cards.lines.front(), "BULK");
  return cards;
}

// A row of moduli where card 2 belongs has a decimal point in its first field; LCID is an integer.
bool is_row_of_moduli(const CardLine& line, std::size_t width) {
  const std::vector<std::string> row = columns(line.text, width);
  return !row.empty() && row[0].find_first_of(".eE") != std::string::npos;
}

// Card 2, or its absence. Returns the index of the first row of moduli.
std::size_t read_card_2(const KeywordCards& cards, ReadCard& card) {
  if (cards.lines.size() < 2) return 1;
  const CardLine& line = cards.lines[1];
  if (is_row_of_moduli(line, cards.width)) {
    card.add("missing-blank-card",
             at_line(line,
                     "card 2 (LCID ...) is missing, an empty line; LS-DYNA takes this row for it "
                     "and all rows shift"));
    return 1;
  }
  if (cell_number_or_zero(cards.row(1), 0, line, "LCID") != 0.0) {
    card.add("fit-by-solver",
             at_line(line, "LCID is set, so LS-DYNA fits a curve and ignores the rows"));
  }
  return 2;
}

void read_076_shift(const KeywordCards& cards, ReadCard& card) {
  const CardLine& line = cards.lines.front();
  const auto row = cards.row(0);
  const double A = cell_number_or_zero(row, 6, line, "A");
  if (cell_number_or_zero(row, 7, line, "B") != 0.0) {
    card.add("shift-not-read", at_line(line, "B is set: a WLF shift, whose sign of A is unknown"));
  } else if (A != 0.0) {
    card.numbers.shift =
        TemperatureShift{.law = ShiftLaw::kArrhenius,
                         .T_ref_C = cell_number_or_zero(row, 5, line, "TREF") + kAbsoluteZero_C,
                         .activation_J_mol = A * kGasConstant_J_mol_K};
  }
}

void read_076(const std::string& text, ReadCard& card) {
  const KeywordCards cards =
      viscoelastic_cards(text, "*MAT_GENERAL_VISCOELASTIC", "*MAT_076", card);
  read_076_shift(cards, card);
  bool has_equilibrium = false;
  for (std::size_t next = read_card_2(cards, card); next < cards.lines.size(); ++next) {
    const CardLine& line = cards.lines[next];
    if (trimmed(line.text).empty()) continue;
    const auto fields = cards.row(next);
    const double shear = cell_number_or_zero(fields, 0, line, "GI");
    const double beta = cell_number_or_zero(fields, 1, line, "BETAI");
    if (cell_number_or_zero(fields, 2, line, "KI") != 0.0) {
      card.add(
          "bulk-rows",
          at_line(line, "KI is set; whether BULK adds to it is not documented, so it is not read"),
          false);
    }
    if (beta == 0.0) {
      has_equilibrium = true;
      card.numbers.equilibrium += shear;
    } else {
      card.numbers.branches.push_back({shear, 0.0, beta});
    }
  }
  if (has_equilibrium) return;
  card.add("missing-equilibrium-row",
           "no row has BETA = 0: the material flows like a liquid; add the row G_inf, 0");
}

void read_006(const std::string& text, ReadCard& card) {
  const KeywordCards cards = viscoelastic_cards(text, "*MAT_VISCOELASTIC", "*MAT_006", card);
  const CardLine& line = cards.lines.front();
  const auto row = cards.row(0);
  const double instantaneous = cell_number(row, 3, line, "G0");
  card.numbers.equilibrium = cell_number(row, 4, line, "GI");
  const double beta = cell_number_or_zero(row, 5, line, "BETA");
  if (!(instantaneous >= card.numbers.equilibrium)) {
    card.add("g0-below-gi", at_line(line, "G0 (instantaneous) is below GI (long-term): swapped?"));
  }
  if (beta != 0.0) {
    card.numbers.branches.push_back({instantaneous - card.numbers.equilibrium, 0.0, beta});
  }
}

// Laws of rubber.

// Rows of ten columns, and the largest relative change of a number in them.
struct RoundedRows {
  double loss = 0.0;

  std::string row(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) {
      const std::string ten = real(number, 10);
      if (number != 0.0) loss = std::max(loss, std::abs(leading_number(ten) / number - 1.0));
      text += ten;
    }
    return text + "\n";
  }
  std::string statement() const {
    return fmt::format("$ numbers: rounded to ten columns, by at most {:.1e}\n", loss);
  }
};

std::string write_177(const CardBody& body) {
  const auto& foam = body.numbers.foam;
  for (const CardNumbers::FoamTerm& term : foam) {
    require(term.nu == foam[0].nu,
            "lsdyna takes one N = nu/(1 - 2 nu) for all terms, and the foam has a nu of each; fit "
            "hyperfoam-1, or write the card for abaqus, calculix or openradioss");
  }
  std::vector<double> factors(8, 0.0), exponents(8, 0.0);
  for (std::size_t i = 0; i < foam.size(); ++i) {
    factors[i] = 2.0 * foam[i].mu / foam[i].alpha;
    exponents[i] = foam[i].alpha;
  }
  RoundedRows rows;
  std::string first = rows.row({body.numbers.density, body.numbers.bulk, foam[0].beta(), 0.0});
  first.pop_back();  // the line goes on with LCID
  const std::string text = right("1", 10) + first + right("0", 10) + right("0", 10) +
                           right("0", 10) + "\n$       C1 to C8\n" + rows.row(factors) +
                           "$       B1 to B8\n" + rows.row(exponents) + "$        R         M\n" +
                           rows.row({0.0, 0.0});
  return rows.statement() + "$ MU = 0: the solver's own damping\n*MAT_HILL_FOAM_TITLE\n" +
         body.name +
         "\n$      MID        RO         K         N        MU      LCID   FITTYPE      LCSR\n" +
         text;
}

std::string write_lsdyna_law(const CardBody& body) {
  if (!body.numbers.foam.empty()) return write_177(body);
  CardNumbers law = body.numbers;
  const double share = law.long_term_share(), shear = law.shear;
  for (double& modulus : law.moduli) modulus *= share;
  law.shear *= share;
  const bool ogden = is_ogden(law.form);
  RoundedRows rows;
  std::string first = rows.row({law.density, poisson_ratio_of(law)});
  first.pop_back();  // the line goes on with N
  std::string text =
      "$      MID        RO        PR         N\n" + right("1", 10) + first + right("0", 10) + "\n";
  if (ogden) {
    std::vector<double> mu = own_moduli(law), alpha = law.shapes;
    mu.resize(8, 0.0);
    alpha.resize(8, 0.0);
    text += "$     MU1 to MU8\n" + rows.row(mu) + "$ ALPHA1 to ALPHA8\n" + rows.row(alpha);
  } else {
    const bool is_yeoh = law.form == HyperelasticForm::kYeoh;
    const double C01 = law.form == HyperelasticForm::kMooneyRivlin ? law.moduli[1] : 0.0;
    text += "$      C10       C01       C11       C20       C02       C30\n" +
            rows.row({law.moduli[0], C01, 0.0, is_yeoh ? law.moduli[1] : 0.0, 0.0,
                      is_yeoh ? law.moduli[2] : 0.0});
  }
  if (!law.branches.empty()) text += "$       GI     BETAI\n";
  for (const CardBranch& branch : law.branches)
    text += rows.row({branch.shear * shear, 1.0 / branch.time});
  return rows.statement() +
         fmt::format("*MAT_{}_RUBBER_TITLE\n{}\n", ogden ? "OGDEN" : "HYPERELASTIC", body.name) +
         text;
}

// MID RO K N MU LCID FITTYPE LCSR / C1 to C8 / B1 to B8 / R M.
void read_177(const KeywordCards& cards, ReadCard& card) {
  const auto head = cards.numbers(0);
  card.numbers.bulk = head[2];
  const double nu = head[3] / (1.0 + 2.0 * head[3]);
  card.also_read = std::to_string(head[4]);  // damping
  if (head[5] != 0.0)
    throw std::runtime_error("LCID is not 0: LS-DYNA fits the constants, and the card has none");
  const auto factors = cards.numbers(1), exponents = cards.numbers(2);
  std::vector<double> mu, alpha;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i] == 0.0 || exponents[i] == 0.0) break;
    mu.push_back(factors[i] * exponents[i] / 2.0);
    alpha.push_back(exponents[i]);
  }
  take_foam_terms(mu, alpha, std::vector<double>(mu.size(), nu), card.numbers);
  if (cards.lines.size() > 3 && cards.numbers(3)[0] != 0.0)
    add_other_law(cards.lines[3], "R is not 0: a foam with damage, which is not read", card);
}

void read_lsdyna_law(const std::string& text, ReadCard& card) {
  const KeywordCards cards =
      material_cards(text,
                     {"*MAT_OGDEN_RUBBER", "*MAT_077_O", "*MAT_HYPERELASTIC_RUBBER", "*MAT_077_H",
                      "*MAT_HILL_FOAM", "*MAT_177"},
                     "*MAT_OGDEN_RUBBER or *MAT_HYPERELASTIC_RUBBER", card);
  const auto has = [&](const char* word) { return cards.keyword.find(word) != std::string::npos; };
  if (has("HILL_FOAM") || has("177")) return read_177(cards, card);
  CardNumbers& law = card.numbers;
  const auto head = cards.numbers(0), first = cards.numbers(1);
  law.poisson = head[2];
  card.understood.elastic = ElasticForm::kPoissonOnly;
  if (head[3] != 0.0)
    throw std::runtime_error("N is not 0: LS-DYNA fits the constants, and the card has none");
  std::size_t at = 2;
  if (has("HYPER") || has("077_H")) {  // C10, C01, C11, C20, C02, C30
    take_invariant_law({first[0], first[1], first[3], first[2], first[4], first[5]}, law);
  } else {
    take_own_ogden(first, cards.numbers(at++), law);
  }
  for (; at < cards.lines.size(); ++at) {
    const auto row = cards.numbers(at);
    if (row[0] == 0.0) continue;
    if (!(row[1] > 0.0))
      throw std::runtime_error(at_line(cards.lines[at], "a row G_i lacks its BETA_i above 0"));
    law.branches.push_back({row[0], 0.0, 1.0 / row[1]});
  }
  if (law.branches.empty()) return;
  card.understood.at = ModulusAt::kLongTerm;
  card.understood.branch = BranchNumber::kAbsoluteShear;
}

// Size of the increment against time, with a step between blocks.
std::string increment_rows(const DeckInput& input) {
  std::string out;
  double from_s = 0.0;
  for (const TimeBlock& block : input.test.blocks) {
    const std::string size = real(input.time((block.end_s - from_s) / block.increments), 20) + "\n";
    out += real(input.time(from_s == 0.0 ? 0.0 : from_s * (1.0 + 1e-9)), 20) + size;
    out += real(input.time(block.end_s), 20) + size;
    from_s = block.end_s;
  }
  return out;
}

// Implicit, with increments that follow curve 2 (DTMAX = -2).
std::string lsdyna_control(const DeckInput& input) {
  const std::string first =
      real(input.time(input.test.blocks[0].end_s) / input.test.blocks[0].increments, 10) + "\n";
  return "*KEYWORD\n*CONTROL_TERMINATION\n" + real(input.end(), 10) +
         "\n*CONTROL_IMPLICIT_GENERAL\n$   IMFLAG       DT0\n         1" + first +
         "*CONTROL_IMPLICIT_AUTO\n$    IAUTO    ITEOPT    ITEWIN     DTMIN     DTMAX\n"
         "         1        11         5       0.0      -2.0\n"
         "*CONTROL_IMPLICIT_SOLUTION\n$   NSOLVR    ILIMIT    MAXREF     DCTOL     ECTOL\n"
         "        12         1        15   1.0E-10   1.0E-10\n"
         "*DATABASE_ELOUT\n" +
         first + "*DATABASE_NODOUT\n" + first +
         "*DATABASE_HISTORY_SOLID\n         1\n*DATABASE_HISTORY_NODE\n         7\n";
}

std::vector<DeckFile> lsdyna_deck(const DeckInput& input, const std::string& name) {
  std::string out = lsdyna_control(input) + input.card.text;
  out +=
      "*SECTION_SOLID\n$    SECID    ELFORM\n         1         2\n*PART\ncube\n"
      "$      PID     SECID       MID\n         1         1         1\n*NODE\n" +
      node_rows(8, 16) +
      "*ELEMENT_SOLID\n       1       1       1       2       3       4       5       6       7"
      "       8\n";
  for (int face = 0; face < kFaces; ++face) {
    out += fmt::format("*SET_NODE_LIST\n{:10d}\n", face + 1) + face_nodes(face);
  }
  for (int face = 0; face < 3; ++face) {
    out += fmt::format("*BOUNDARY_SPC_SET\n{:10d}         0{:10d}{:10d}{:10d}\n", face + 1,
                       face == 0 ? 1 : 0, face == 1 ? 1 : 0, face == 2 ? 1 : 0);
  }
  out += input.is_creep() ? "*LOAD_NODE_SET\n         4         3         1       1.0\n"
                          : "*BOUNDARY_PRESCRIBED_MOTION_SET\n"
                            "         4         3         2         1       1.0\n";
  if (const auto& shift = input.card.written.shift) {
    out +=
        "*LOAD_THERMAL_CONSTANT\n$     NSID    NSIDEX     BOXID\n         0\n$        T        "
        "TE\n" +
        field(shift->T_ref_C - kAbsoluteZero_C) + "\n";
  }
  out += "*DEFINE_CURVE\n         1\n" + ramp_rows(input) + "*DEFINE_CURVE\n         2\n" +
         increment_rows(input) + "*END\n";
  return {{name + ".k", out}};
}

void add_006_mistakes(const CardContext&, std::vector<CardMistake>& list) {
  list.push_back({"branch-modulus-as-GI",
                  "GI is the long-term shear modulus in 006; the branch modulus G0 - G_inf stands "
                  "there (as in 076)",
                  [](CardNumbers& n) {
                    if (!n.branches.empty()) std::swap(n.equilibrium, n.branches[0].shear);
                  }});
}

}  // namespace

CardTarget lsdyna_target() {
  return {
      .name = "lsdyna",
      .code = "LS-DYNA *MAT_GENERAL_VISCOELASTIC (076)",
      .extension = ".k",
      .comment = "$",
      .write = write_076,
      .read = read_076,
      .deck = DeckWriter{lsdyna_deck, "ls-dyna_double i={}.k"},
      .laws =
          LawColumn{
              .write = write_lsdyna_law,
              .read = read_lsdyna_law,
              .keywords = {"077_H: C10", "077_H: C10, C01", "077_H: C10, C20, C30",
                           "077_O: Ogden's own 2 mu_i/alpha_i, alpha_i", "", "",
                           "HILL_FOAM: C_i = 2 mu_i/alpha_i, B_i = alpha_i, N = nu/(1 - 2 nu)"},
              .volume = "by Poisson's ratio of K and the law's shear modulus at rest",
              .takes_terms = true,
              .is_for_small_strain = true,
              .most_terms = 12,
              .terms = "approximated: the law after all relaxation and shear moduli G_i = g_i G_0 "
                       "with BETA_i = 1/tau_i, right at small strain; NOT CHECKED at large strain, "
                       "where it is not the fitted law"},
      .elastic = ElasticForm::kBulkOnly,
      .at = ModulusAt::kLongTerm,
      .branch = BranchNumber::kAbsoluteShear,
      .time = TimeNumber::kBeta,
      .bulk = BulkRule::kConstantBulk,
      .states_equilibrium = true,
      .is_case_sensitive = false,
      .reads_fortran_numbers = true,
      .max_terms = 17,
      .needs_density = true,
      .takes_arrhenius = true,
      .why_no_wlf = " (the manual of 076 gives WLF and Arrhenius formulas of opposite sign in A)",
      .temperature = "K",
      .set_temperature = "*LOAD_THERMAL_CONSTANT or another load, in K (0 if not given)",
      .evidence = Evidence::kParsed,
      .evidence_note = "readers found the numbers; 18 rows (6 in old versions), one with beta = 0",
      .advice =
          "Numbers are rounded to ten columns. The empty line after the first card is card 2.",
      .harmonic = "refused: no public statement that *FREQUENCY_DOMAIN reads it"};
}

CardTarget lsdyna006_target() {
  CardTarget target = lsdyna_target();
  target.name = "lsdyna006";
  target.code = "LS-DYNA *MAT_VISCOELASTIC (006)";
  target.write = write_006;
  target.read = read_006;
  target.laws.reset();
  target.add_mistakes = add_006_mistakes;
  target.takes_arrhenius = false;
  target.why_no_wlf = "";
  target.max_terms = 1;
  target.evidence_note = "independent readers found the numbers";
  target.advice = "GI is the long-term shear modulus here. Numbers are rounded to ten columns.";
  return target;
}

}  // namespace viscard
